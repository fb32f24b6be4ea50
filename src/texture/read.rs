//! [`TextureKey`] and [`Textures`]: how scene files refer to textures.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use super::any::{AnyTexture, Pair, TextureValue};
use super::texels::{Curve, Texels};
use super::texels_error::TexelsError;
use super::traits::{Texture, TextureHandle};
use super::value::Constant;
use crate::image::{Image, ImageFile, ReadError};
use crate::params::{AnyKey, Fault, Key, Mark, Param, Problem, Table, Value, quoted};

/// Function that reads a kind of texture from a scene file. It may use textures defined earlier.
pub type Read = fn(&Table, &Textures) -> Result<AnyTexture, Fault>;

/// A key whose value is the name of a texture, or a constant. Range and default apply to the constant.
///
/// ```
/// use lobe::params::Key;
/// use lobe::texture::TextureKey;
///
/// const SIGMA: TextureKey<f32> =
///     TextureKey::of(Key::new("sigma", "roughness").in_unit("degrees").range(0.0..=90.0).default(0.0));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct TextureKey<T>(Key<T>);

impl<T> TextureKey<T> {
    /// A texture key with name, range, default and meaning of `key`.
    pub const fn of(key: Key<T>) -> Self {
        Self(key)
    }
}

impl<T: Param> AnyKey for TextureKey<T> {
    fn name(&self) -> &'static str {
        self.0.name()
    }

    fn meaning(&self) -> &'static str {
        self.0.meaning()
    }

    fn expected(&self) -> String {
        format!("a texture's name or {}", self.0.expected())
    }

    fn default_text(&self) -> Option<String> {
        self.0.default_text()
    }

    fn example(&self) -> String {
        self.0.example()
    }

    fn accepts(&self, value: &Value) -> bool {
        matches!(value, Value::Text(_)) || self.0.accepts(value)
    }
}

/// The textures of a scene, by name, and the images that they share.
#[derive(Clone)]
pub struct Textures {
    /// Each with its cost: how many textures its value asks at a point, itself included; 0 if it is constant.
    named: BTreeMap<String, (AnyTexture, u32)>,
    images: Arc<Mutex<Images>>,
    /// Bytes that each image may take.
    limit: u64,
}

/// Images that were decoded, or could not be, by canonical path and curve.
type Images = BTreeMap<(PathBuf, Curve), Result<Arc<Texels>, Arc<ReadError>>>;

impl Default for Textures {
    /// None yet, and images of up to [`Image::DEFAULT_LIMIT`] bytes.
    fn default() -> Self {
        Self { named: BTreeMap::new(), images: Arc::default(), limit: Image::DEFAULT_LIMIT }
    }
}

impl Textures {
    /// Chooses how many bytes of memory each image may take from now on: as it is decoded, and what is made of it for lookups.
    pub fn with_limit(self, limit: u64) -> Self {
        Self { limit, ..self }
    }

    /// Adds a texture, or replaces the one of that name.
    pub fn add(&mut self, name: impl Into<String>, texture: AnyTexture) {
        self.add_costing(name, texture, 0);
    }

    /// The same with the [cost](Table::cost) of the table that it was read from, which tables that name it are charged.
    pub fn add_costing(&mut self, name: impl Into<String>, texture: AnyTexture, cost: u32) {
        let cost = if texture.is_constant() { 0 } else { cost.saturating_add(1) };
        self.named.insert(name.into(), (texture, cost));
    }

    /// The pixels of an image file, which is read once for each curve, by whatever path, even if it cannot be used.
    ///
    /// # Errors
    /// Those of [`Image::read`] and [`Texels::new`], and if both together take more than the limit.
    pub fn image(&self, file: &Path, curve: Curve) -> Result<Arc<Texels>, Arc<ReadError>> {
        let mut images = self.images.lock().unwrap_or_else(PoisonError::into_inner);
        let key = (fs::canonicalize(file).unwrap_or_else(|_| file.to_owned()), curve);
        if let Some(known) = images.get(&key) {
            return known.clone();
        }
        let read = file_of_texels(file, curve, self.limit);
        let read = read.map(Arc::new).map_err(Arc::new);
        images.insert(key, read.clone());
        read
    }

    /// The same with smaller images, for filtering.
    ///
    /// # Errors
    /// Those of [`Textures::image`] and [`Texels::make_smaller`].
    pub fn image_with_smaller(
        &self,
        file: &Path,
        curve: Curve,
    ) -> Result<Arc<Texels>, Arc<ReadError>> {
        let texels = self.image(file, curve)?;
        texels.make_smaller().map_err(|error| Arc::new(unfit(file, error)))?;
        Ok(texels)
    }

    /// All images that were read: the file, what its codes mean, and the pixels.
    pub fn images(&self) -> Vec<(PathBuf, Curve, Arc<Texels>)> {
        let images = self.images.lock().unwrap_or_else(PoisonError::into_inner);
        let read = images.iter().filter_map(|(key, texels)| Some((key, texels.as_ref().ok()?)));
        read.map(|((file, curve), texels)| (file.clone(), *curve, texels.clone())).collect()
    }

    /// The texture that the key's value names, or a constant texture if the value is a number or a colour.
    ///
    /// # Errors
    /// If there is no texture of that name, if its values are colours where numbers are expected, or if a constant is out of range;
    /// and those of [`Table::get`].
    pub fn get<T: TextureValue>(
        &self,
        table: &Table,
        key: &TextureKey<T>,
    ) -> Result<TextureHandle<T>, Fault> {
        match self.named(table, key, &key.0)? {
            Some(texture) => Ok(texture),
            None => table.get(&key.0).map(T::everywhere),
        }
    }

    /// The same for an optional key.
    ///
    /// # Errors
    /// Those of [`Textures::get`].
    pub fn find<T: TextureValue>(
        &self,
        table: &Table,
        key: &TextureKey<Option<T>>,
    ) -> Result<Option<TextureHandle<T>>, Fault> {
        match self.named(table, key, &key.0)? {
            Some(texture) => Ok(Some(texture)),
            None => Ok(table.get(&key.0)?.map(T::everywhere)),
        }
    }

    /// The textures of two keys, each with values of either type; if one is of colours, so are both.
    ///
    /// # Errors
    /// Those of [`Textures::get`].
    pub(super) fn pair(
        &self,
        table: &Table,
        keys: [&TextureKey<Constant>; 2],
    ) -> Result<Pair, Fault> {
        let [first, second] = keys.map(|key| self.any(table, key));
        Ok(match (first?, second?) {
            (AnyTexture::Number(first), AnyTexture::Number(second)) => {
                Pair::Numbers([first, second])
            }
            (first, second) => Pair::Colors([first, second].map(AnyTexture::into_color)),
        })
    }

    fn any(&self, table: &Table, key: &TextureKey<Constant>) -> Result<AnyTexture, Fault> {
        let Some(node) = table.value(key)? else { return table.get(&key.0).map(Constant::into) };
        match &node.value {
            Value::Text(name) => self.by_name(table, name, node.mark).cloned(),
            Value::Number(_) | Value::Array(_) => table.get(&key.0).map(Constant::into),
            other => Err(table.unfit(key, node, other.to_string(), key.expected())),
        }
    }

    /// The texture that `table` names at `mark`.
    fn by_name(&self, table: &Table, name: &str, mark: Mark) -> Result<&AnyTexture, Fault> {
        let (texture, cost) = self.named.get(name).ok_or_else(|| {
            let known = self.named.keys().map(String::as_str);
            Fault { mark, problem: Problem::unknown_name("texture", name, known) }
        })?;
        table.charge(mark, *cost)?;
        Ok(texture)
    }

    /// The texture that the key's value names. `None` if the key is missing or its value is a constant. A texture
    /// that is itself constant has to be in the range of the key `constant`.
    fn named<T: TextureValue>(
        &self,
        table: &Table,
        key: &dyn AnyKey,
        constant: &dyn AnyKey,
    ) -> Result<Option<TextureHandle<T>>, Fault> {
        let Some(node) = table.value(key)? else { return Ok(None) };
        let name = match &node.value {
            Value::Text(name) => name,
            Value::Number(_) | Value::Array(_) => return Ok(None),
            other => return Err(table.unfit(key, node, other.to_string(), key.expected())),
        };
        let texture = self.by_name(table, name, node.mark)?;
        let found = T::of(texture);
        // Only constant textures can be checked against the range here.
        let value = found.as_ref().and_then(|found| found.constant()?.to_value());
        let is_fit = value.is_none_or(|value| constant.accepts(&value));
        let has_type = found.is_some();
        found.filter(|_| is_fit).map(Some).ok_or_else(|| {
            let found = format!("the texture {}, {}", quoted(name), describe(texture));
            let cure = match texture {
                AnyTexture::Color(texture) if !has_type && texture.constant().is_none() => {
                    "; an image has numbers with `values = \"luminance\"` in its table"
                }
                _ => "",
            };
            table.unfit(key, node, found, constant.expected() + cure)
        })
    }
}

/// Pixels of a file, within a limit of bytes.
fn file_of_texels(file: &Path, curve: Curve, limit: u64) -> Result<Texels, ReadError> {
    let image = ImageFile::open(file, limit)?.decode()?;
    // Smaller images take less than the image itself, which is dropped before.
    image.check_beside(file, Texels::BYTES, limit)?;
    Texels::new(&image, curve).map_err(|error| unfit(file, error))
}

fn unfit(file: &Path, error: TexelsError) -> ReadError {
    let path = file.to_owned();
    match error {
        TexelsError::OutOfMemory(bytes) => ReadError::OutOfMemory { path, bytes },
        _ => ReadError::Contents { path, reason: error.to_string() },
    }
}

/// The texture's constant value, or the type of its values.
fn describe(texture: &AnyTexture) -> String {
    fn of<T: TextureValue>(texture: &TextureHandle<T>, kind: &str) -> String {
        let value = texture.constant().and_then(|value| value.to_value());
        value.map_or_else(|| kind.to_owned(), |value| value.to_string())
    }
    match texture {
        AnyTexture::Number(texture) => of(texture, "of numbers"),
        AnyTexture::Color(texture) => of(texture, "of colours"),
    }
}
