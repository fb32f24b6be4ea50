//! [`FaceMaterials`]: the materials that the faces of OBJ files name.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::report::FaceMaterial;
use crate::material::{Material, MatteMaterial, MtlMaterials};
use crate::scene::{Emission, SceneBuilder};
use crate::shape::{MtlMaterial, ObjMaterials, TriangleMesh, read_mtl};
use crate::spectrum::Spectrum;
use crate::texture::Textures;

/// Finds what faces are made of: a material of the scene file with that name, else one of the OBJ file's MTL files, else grey.
pub struct FaceMaterials<'a> {
    /// The materials of the scene file.
    pub known: &'a BTreeMap<String, Arc<dyn Material>>,
    /// The images that materials share.
    pub textures: &'a Textures,
    /// What was left out, with file and line.
    pub notes: Vec<String>,
    /// The materials that were made.
    pub made: Vec<(String, Arc<dyn Material>)>,
    /// How many triangles have which.
    pub counts: Vec<FaceMaterial>,
    /// The MTL files.
    pub files: Vec<PathBuf>,
}

/// A material of an MTL file, its index among the files, and its line.
type Found = BTreeMap<String, (usize, MtlMaterial)>;

impl<'a> FaceMaterials<'a> {
    pub fn new(known: &'a BTreeMap<String, Arc<dyn Material>>, textures: &'a Textures) -> Self {
        let (notes, made, counts, files) = Default::default();
        Self { known, textures, notes, made, counts, files }
    }

    /// Adds a shape whose triangles have the materials that they name. Those that emit become shapes of their own.
    pub fn add(
        &mut self,
        mut builder: SceneBuilder,
        shape: &str,
        mesh: &TriangleMesh,
        faces: &ObjMaterials,
    ) -> SceneBuilder {
        let found = self.read(&faces.libraries);
        // Triangles of each material; the last are those without.
        let mut triangles = vec![Vec::new(); faces.names.len() + 1];
        for (triangle, &index) in faces.of_triangles.iter().enumerate() {
            triangles[(index as usize).min(faces.names.len())].push(triangle as u32);
        }
        let (mut quiet, mut names, mut of_triangles) = (Vec::new(), Vec::new(), Vec::new());
        for (index, triangles) in triangles.iter().enumerate().filter(|(_, all)| !all.is_empty()) {
            let name = faces.names.get(index).map(String::as_str);
            let (key, material, emission) = self.material(shape, name, &faces.libraries, &found);
            if let Some(material) = material {
                self.made.push((key.clone(), material.clone()));
                builder = builder.material(key.clone(), material);
            }
            self.counts.push(FaceMaterial {
                name: key.clone(),
                triangles: triangles.len(),
                is_emitting: emission.is_some(),
            });
            match emission {
                Some(radiance) => {
                    let part = mesh.part(triangles);
                    let name = format!("{shape}/{}", name.unwrap_or_default());
                    let emission = Emission { radiance, two_sided: true };
                    builder = builder.glowing_shape(name, part, key, emission);
                }
                None => {
                    of_triangles.extend(triangles.iter().map(|_| names.len() as u32));
                    names.push(key);
                    quiet.extend_from_slice(triangles);
                }
            }
        }
        if quiet.is_empty() {
            return builder;
        }
        builder.shape_with_materials(shape, mesh.part(&quiet), names, of_triangles)
    }

    /// The name for the builder, a material that is to be added to it, and emission.
    fn material(
        &mut self,
        shape: &str,
        name: Option<&str>,
        libraries: &[String],
        found: &Found,
    ) -> (String, Option<Arc<dyn Material>>, Option<Spectrum>) {
        let Some(name) = name else { return (format!("{shape}/"), Some(grey()), None) };
        let mtl = found.get(name);
        let emission = mtl.and_then(|(_, mtl)| mtl.ke).map(Spectrum::from);
        let emission = emission.filter(|ke| !ke.is_black());
        if self.known.contains_key(name) {
            return (name.to_owned(), None, emission);
        }
        let key = format!("{shape}/{name}");
        let Some((library, mtl)) = mtl else {
            self.notes.push(format!("shape {shape}: no material {name}: it is grey"));
            return (key, Some(grey()), None);
        };
        let file = Path::new(&libraries[*library]);
        let folder = file.parent().unwrap_or(Path::new(""));
        let (material, notes) = MtlMaterials { folder, textures: self.textures }.make(mtl);
        let line = mtl.line;
        self.notes.extend(
            notes.into_iter().map(|note| format!("{}:{line}: {name}: {note}", file.display())),
        );
        (key, Some(material), emission)
    }

    fn read(&mut self, libraries: &[String]) -> Found {
        let mut found = Found::new();
        for (index, library) in libraries.iter().enumerate() {
            self.files.push(library.into());
            match read_mtl(Path::new(library)) {
                Ok(read) => {
                    for note in read.notes {
                        self.notes.push(format!("{library}:{}: {}", note.line, note.what));
                    }
                    for mtl in read.materials {
                        found.entry(mtl.name.clone()).or_insert((index, mtl));
                    }
                }
                Err(error) => self.notes.push(error.to_string()),
            }
        }
        found
    }
}

fn grey() -> Arc<dyn Material> {
    Arc::new(MatteMaterial::new(Spectrum::splat(0.5)))
}
