//! What tells one scene from another, in lines.

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::{UVec2, Vec2, Vec3};

use crate::file;
use crate::params::{Document, Node, Value};
use crate::scene::Scene;
use crate::shape::TriangleMesh;
use crate::texture::{Curve, Texels, Textures};

/// Version, values, meshes, images, and `faces`, lines about the materials of these: see
/// [`LoadedScene::identity`](super::LoadedScene::identity).
pub fn lines(
    document: &Document,
    scene: &Scene,
    textures: &Textures,
    faces: &[String],
) -> Vec<String> {
    let mut lines = vec![concat!("lobe = ", env!("CARGO_PKG_VERSION")).to_owned()];
    push_values("", &document.root, &mut lines);
    for (name, mesh) in scene.shapes() {
        let (triangles, sum) = (mesh.indices.len(), checksum(mesh));
        lines.push(format!("mesh of shape {name:?} = {triangles} triangles, checksum {sum:08x}"));
    }
    lines.extend_from_slice(faces);
    // By name alone and sorted: the same in any folder.
    let images = textures.images();
    let others = document.files().into_iter().filter(|file| {
        // Meshes have lines of their own.
        let is_mesh = file.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("obj"));
        !is_mesh && images.iter().all(|(image, ..)| image != file)
    });
    let mut files: Vec<_> = others.map(|file| other(&file)).collect();
    files.extend(images.into_iter().map(image));
    files.sort();
    lines.extend(files);
    lines
}

/// A file that a kind reads by itself: of a light.
fn other(path: &Path) -> String {
    let mut sum = crc32fast::Hasher::new();
    let read = file::open(path).and_then(|file| {
        let mut reader = BufReader::new(file);
        loop {
            let bytes = reader.fill_buf()?;
            if bytes.is_empty() {
                return Ok(());
            }
            sum.update(bytes);
            let count = bytes.len();
            reader.consume(count);
        }
    });
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    match read {
        Ok(()) => format!("file {name:?} = checksum {:08x}", sum.finalize()),
        // It was there when the scene was loaded.
        Err(error) => format!("file {name:?} = {error}"),
    }
}

fn image((file, curve, texels): (PathBuf, Curve, Arc<Texels>)) -> String {
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    let (UVec2 { x, y }, sum) = (texels.size(), texels.checksum());
    format!("image {name:?} as {curve:?} = {x} x {y} pixels, checksum {sum:08x}")
}

/// A line for each value that is not a table, in the order of the document.
fn push_values(name: &str, node: &Node, lines: &mut Vec<String>) {
    let Value::Table(entries) = &node.value else {
        lines.push(format!("{name} = {}", plain(&node.value)));
        return;
    };
    for entry in entries {
        let key = entry.key.escape_debug();
        let name = if name.is_empty() { key.to_string() } else { format!("{name}.{key}") };
        push_values(&name, &entry.node, lines);
    }
}

/// The value with its numbers in one notation, whether they were written as 40 or 40.0.
fn plain(value: &Value) -> Value {
    match value {
        Value::Number(text) if text.parse::<i128>().is_err() => {
            Value::Number(text.parse().map_or(text.clone(), |number: f64| number.to_string()))
        }
        Value::Array(values) => Value::Array(
            values.iter().map(|node| Node { mark: node.mark, value: plain(&node.value) }).collect(),
        ),
        _ => value.clone(),
    }
}

/// CRC-32 of all that a mesh consists of.
fn checksum(mesh: &TriangleMesh) -> u32 {
    let TriangleMesh { positions, normals, uvs, indices } = mesh;
    let mut sum = crc32fast::Hasher::new();
    let mut add = |numbers: &[[u8; 4]]| sum.update(numbers.as_flattened());
    let of_vec3 = |v: &Vec3| v.to_array().map(f32::to_le_bytes);
    positions.iter().for_each(|p| add(&of_vec3(p)));
    normals.iter().for_each(|n| add(&of_vec3(n)));
    uvs.iter().for_each(|uv: &Vec2| add(&uv.to_array().map(f32::to_le_bytes)));
    indices.iter().for_each(|triangle| add(&triangle.map(u32::to_le_bytes)));
    sum.finalize()
}
