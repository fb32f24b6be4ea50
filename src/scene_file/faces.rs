//! [`FaceMaterials`]: the materials that the faces of OBJ files name.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::report::FaceMaterial;
use crate::material::{Material, MatteMaterial, MtlMaterials};
use crate::params::{Shown, quoted};
use crate::scene::{Emission, SceneBuilder};
use crate::shape::{MtlMaterial, MtlNote, ObjMaterials, TriangleMesh, read_mtl};
use crate::spectrum::Spectrum;
use crate::texture::{Texture, TextureHandle, Textures};

/// Finds what faces are made of: a material of the scene file with that name, else one of the OBJ file's MTL files, else grey.
pub struct FaceMaterials<'a> {
    /// The materials of the scene file.
    known: &'a BTreeMap<String, Arc<dyn Material>>,
    /// The images that materials share.
    textures: &'a Textures,
    /// Names that the builder has materials for.
    taken: BTreeSet<String>,
    /// Names of the shapes of the scene file, and of the parts of these that became shapes.
    shapes: BTreeSet<String>,
    pub found: Found,
}

/// What was found beside the materials.
#[derive(Default)]
pub struct Found {
    /// What was left out, with file and line.
    pub notes: Vec<String>,
    /// Lines `key = value` that change with the materials of faces, but not with the images of these.
    pub identity: Vec<String>,
    /// The MTL files.
    pub files: Vec<PathBuf>,
    /// The materials that were made for faces.
    pub materials: Vec<(String, Arc<dyn Material>)>,
    /// Names that faces have and the scene file does not, each once.
    pub unclaimed: Vec<String>,
    /// How many triangles have which.
    pub counts: Vec<FaceMaterial>,
}

/// A material of an MTL file, and the index of the file.
type Library = BTreeMap<String, (usize, MtlMaterial)>;

/// What faces of one name are made of.
struct Made {
    /// Name for the builder.
    key: String,
    emission: Option<TextureHandle<Spectrum>>,
}

impl<'a> FaceMaterials<'a> {
    /// `shapes` are the names of all shapes of the scene file, which those of parts differ from.
    pub fn new(
        known: &'a BTreeMap<String, Arc<dyn Material>>,
        textures: &'a Textures,
        shapes: BTreeSet<String>,
    ) -> Self {
        let taken = known.keys().cloned().collect();
        Self { known, textures, taken, shapes, found: Found::default() }
    }

    /// Adds a shape whose triangles have the materials that they name, and one for each material that emits, on one side or on both. Returns
    /// their names.
    pub fn add(
        &mut self,
        mut builder: SceneBuilder,
        shape: &str,
        mesh: &TriangleMesh,
        faces: &ObjMaterials,
        two_sided: bool,
    ) -> (SceneBuilder, Vec<String>) {
        let library = self.read(&faces.libraries);
        let indices = faces.of_triangles.iter().flat_map(|index| index.to_le_bytes());
        let names = faces.names.iter().flat_map(|name| name.bytes().chain([b'\n']));
        let sum = crc32fast::hash(&indices.chain(names).collect::<Vec<_>>());
        self.found
            .identity
            .push(format!("materials of triangles of {} = {sum:08x}", quoted(shape)));
        // Triangles of each material; the last are those without.
        let mut triangles = vec![Vec::new(); faces.names.len() + 1];
        for (triangle, &index) in faces.of_triangles.iter().enumerate() {
            triangles[(index as usize).min(faces.names.len())].push(triangle as u32);
        }
        let (mut quiet, mut names, mut of_triangles) = (Vec::new(), Vec::new(), Vec::new());
        let mut glowing = Vec::new();
        for (index, triangles) in triangles.iter().enumerate().filter(|(_, all)| !all.is_empty()) {
            let name = faces.names.get(index).map(String::as_str);
            let Made { key, emission } = match name {
                Some(name) => self.material(&mut builder, shape, name, faces, &library),
                None => {
                    let note = format!(
                        "shape {}: {} triangles name no material and are grey",
                        quoted(shape),
                        triangles.len()
                    );
                    self.found.notes.push(note);
                    Made { key: self.add_material(&mut builder, shape, "", grey()), emission: None }
                }
            };
            let (triangle_count, is_emitting) = (triangles.len(), emission.is_some());
            let count = FaceMaterial { name: key.clone(), triangle_count, is_emitting };
            self.found.counts.push(count);
            match emission {
                Some(radiance) => {
                    let name = format!("{shape}/{}", name.unwrap_or_default());
                    let name = unique(name, &mut self.shapes);
                    let emission = Emission { radiance, two_sided };
                    glowing.push((name, mesh.part(triangles), key, emission));
                }
                None => {
                    of_triangles.extend(triangles.iter().map(|_| names.len() as u32));
                    names.push(key);
                    quiet.extend_from_slice(triangles);
                }
            }
        }
        let mut added = Vec::with_capacity(1 + glowing.len());
        if !quiet.is_empty() {
            added.push(shape.to_owned());
            builder = builder.shape_with_materials(shape, mesh.part(&quiet), names, of_triangles);
        }
        for (name, part, key, emission) in glowing {
            added.push(name.clone());
            builder = builder.glowing_shape(name, part, key, emission);
        }
        (builder, added)
    }

    fn material(
        &mut self,
        builder: &mut SceneBuilder,
        shape: &str,
        name: &str,
        faces: &ObjMaterials,
        library: &Library,
    ) -> Made {
        let mtl = library.get(name);
        let emission = mtl.and_then(|(index, mtl)| self.emission(&faces.libraries[*index], mtl));
        // Lines may change, and with floats a text is the simplest that all values are part of.
        let values = mtl.map(|(_, mtl)| format!("{:?}", mtl.without_lines()));
        let sum = crc32fast::hash(values.unwrap_or_default().as_bytes());
        self.found.identity.push(format!(
            "material {} of {} = {sum:08x}",
            quoted(name),
            quoted(shape)
        ));
        if self.known.contains_key(name) {
            return Made { key: name.to_owned(), emission };
        }
        if !self.found.unclaimed.iter().any(|known| known == name) {
            self.found.unclaimed.push(name.to_owned());
        }
        let Some((index, mtl)) = mtl else {
            let note = format!(
                "shape {}: there is no material {}; its faces are grey",
                quoted(shape),
                quoted(name)
            );
            self.found.notes.push(note);
            return Made { key: self.add_material(builder, shape, name, grey()), emission: None };
        };
        let file = &faces.libraries[*index];
        let (material, notes) = self.materials_of(file).make(mtl);
        self.note(file, mtl, &notes);
        Made { key: self.add_material(builder, shape, name, material), emission }
    }

    /// What faces of a material emit, if they do.
    fn emission(&mut self, file: &Path, mtl: &MtlMaterial) -> Option<TextureHandle<Spectrum>> {
        let (emission, notes) = self.materials_of(file).emission(mtl);
        self.note(file, mtl, &notes);
        (emission.constant() != Some(Spectrum::BLACK)).then_some(emission)
    }

    fn materials_of<'f>(&self, file: &'f Path) -> MtlMaterials<'f>
    where
        'a: 'f,
    {
        let folder = file.parent().unwrap_or(Path::new(""));
        MtlMaterials { folder, textures: self.textures }
    }

    fn note(&mut self, file: &Path, mtl: &MtlMaterial, notes: &[MtlNote]) {
        let (file, name) = (Shown::path(file), quoted(&mtl.name));
        let note =
            |MtlNote { line, what }: &MtlNote| format!("{file}:{line}: material {name}: {what}");
        self.found.notes.extend(notes.iter().map(note));
    }

    /// Adds a material to the builder under a name that no other has.
    fn add_material(
        &mut self,
        builder: &mut SceneBuilder,
        shape: &str,
        name: &str,
        material: Arc<dyn Material>,
    ) -> String {
        let key = unique(format!("{shape}/{name}"), &mut self.taken);
        self.found.materials.push((key.clone(), material.clone()));
        *builder = std::mem::take(builder).material(key.clone(), material);
        key
    }

    fn read(&mut self, libraries: &[PathBuf]) -> Library {
        let mut library = Library::new();
        for (index, file) in libraries.iter().enumerate() {
            match read_mtl(file) {
                Ok(read) => {
                    let note = |note: MtlNote| {
                        format!("{}:{}: {}", Shown::path(file), note.line, note.what)
                    };
                    self.found.notes.extend(read.notes.into_iter().map(note));
                    self.found.files.push(file.clone());
                    for mtl in read.materials {
                        library.entry(mtl.name.clone()).or_insert((index, mtl));
                    }
                }
                Err(error) => self.found.notes.push(error.to_string()),
            }
        }
        library
    }
}

/// A name that is not among those that are taken, and now is.
fn unique(mut name: String, taken: &mut BTreeSet<String>) -> String {
    while !taken.insert(name.clone()) {
        name.push('\'');
    }
    name
}

fn grey() -> Arc<dyn Material> {
    Arc::new(MatteMaterial::new(Spectrum::splat(0.5)))
}
