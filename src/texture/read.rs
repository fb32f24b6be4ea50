//! [`TextureKey`] and [`Textures`]: how scene files refer to textures.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use super::texels::{Curve, Texels};
use super::traits::{Texture, TextureHandle};
use super::value::Constant;
use crate::image::{Image, ReadError};
use crate::interaction::SurfaceInteraction;
use crate::params::{AnyKey, Fault, Key, Mark, Param, Problem, Table, Value, quoted};
use crate::spectrum::Spectrum;

/// Function that reads a kind of texture from a scene file. It may use textures defined earlier.
pub type Read = fn(&Table, &Textures) -> Result<AnyTexture, Fault>;

/// A texture whose value type is known at run time only.
#[derive(Clone)]
#[non_exhaustive]
pub enum AnyTexture {
    /// With values of type `f32`.
    Number(TextureHandle<f32>),
    /// With values of type [`Spectrum`].
    Color(TextureHandle<Spectrum>),
}

impl AnyTexture {
    /// With numbers as greys.
    fn into_color(self) -> TextureHandle<Spectrum> {
        match self {
            Self::Color(texture) => texture,
            Self::Number(TextureHandle::Constant(value)) => Spectrum::splat(value).everywhere(),
            Self::Number(texture) => {
                let grey = move |si: &SurfaceInteraction| Spectrum::splat(texture.evaluate(si));
                grey.into_handle()
            }
        }
    }
}

impl From<Constant> for AnyTexture {
    fn from(constant: Constant) -> Self {
        match constant {
            Constant::Number(value) => Self::Number(value.everywhere()),
            Constant::Color(value) => Self::Color(value.everywhere()),
        }
    }
}

/// Two textures with values of one type.
pub(super) enum Pair {
    Numbers([TextureHandle<f32>; 2]),
    Colors([TextureHandle<Spectrum>; 2]),
}

/// A type of values that textures of scene files can have.
pub trait TextureValue: Param + Copy {
    /// The texture, if its values have this type or become it: numbers are greys.
    fn of(texture: &AnyTexture) -> Option<TextureHandle<Self>>;

    /// A constant texture of this value.
    fn everywhere(self) -> TextureHandle<Self>;
}

impl TextureValue for f32 {
    fn of(texture: &AnyTexture) -> Option<TextureHandle<Self>> {
        if let AnyTexture::Number(texture) = texture { Some(texture.clone()) } else { None }
    }

    fn everywhere(self) -> TextureHandle<Self> {
        TextureHandle::Constant(self)
    }
}

impl TextureValue for Spectrum {
    fn of(texture: &AnyTexture) -> Option<TextureHandle<Self>> {
        Some(texture.clone().into_color())
    }

    fn everywhere(self) -> TextureHandle<Self> {
        TextureHandle::Constant(self)
    }
}

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
#[derive(Clone, Default)]
pub struct Textures {
    named: BTreeMap<String, AnyTexture>,
    images: Arc<Mutex<Images>>,
}

/// Images that were decoded, by canonical path and curve.
type Images = BTreeMap<(PathBuf, Curve), Arc<Texels>>;

impl Textures {
    /// Adds a texture, or replaces the one of that name.
    pub fn add(&mut self, name: impl Into<String>, texture: AnyTexture) {
        self.named.insert(name.into(), texture);
    }

    /// The pixels of an image file, which is read once for each curve, by whatever path.
    ///
    /// # Errors
    /// Those of [`Image::read`], and if a value is negative or not finite.
    pub fn image(&self, file: &Path, curve: Curve) -> Result<Arc<Texels>, ReadError> {
        let mut images = self.images.lock().unwrap_or_else(PoisonError::into_inner);
        let key = (fs::canonicalize(file).unwrap_or_else(|_| file.to_owned()), curve);
        if let Some(known) = images.get(&key) {
            return Ok(known.clone());
        }
        let image = Image::read(file)?;
        Texels::check(&image)
            .map_err(|reason| ReadError::Contents { path: file.to_owned(), reason })?;
        let texels = Arc::new(Texels::new(&image, curve));
        images.insert(key, texels.clone());
        Ok(texels)
    }

    /// All images that were read: the file, what its codes mean, and the pixels.
    pub fn images(&self) -> Vec<(PathBuf, Curve, Arc<Texels>)> {
        let images = self.images.lock().unwrap_or_else(PoisonError::into_inner);
        images
            .iter()
            .map(|((file, curve), texels)| (file.clone(), *curve, texels.clone()))
            .collect()
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
            Value::Text(name) => self.by_name(name, node.mark).cloned(),
            Value::Number(_) | Value::Array(_) => table.get(&key.0).map(Constant::into),
            other => Err(table.unfit(key, node, other.to_string(), key.expected())),
        }
    }

    fn by_name(&self, name: &str, mark: Mark) -> Result<&AnyTexture, Fault> {
        self.named.get(name).ok_or_else(|| {
            let known = self.named.keys().map(String::as_str);
            Fault { mark, problem: Problem::unknown_name("texture", name, known) }
        })
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
        let texture = self.by_name(name, node.mark)?;
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
