//! Materials by face: OBJ files with MTL files and images, and the scenes that they give.
//!
//! The comment of a test says with which deliberate break of the code it was seen to fail.

#[path = "../folders/mod.rs"]
mod folders;

mod by_triangle;
mod identity;
mod libraries;
mod materials;
mod mtl;
mod notes;
mod obj;
mod scenes;
mod textures;

use std::fs;
use std::path::{Path, PathBuf};

use lobe::Spectrum;
use lobe::glam::UVec2;
use lobe::image::{Display, Metadata, Picture, write_exr, write_pfm, write_png};

/// An empty folder.
fn folder(test: &str) -> PathBuf {
    let folder = folders::of_this_run().join(test);
    fs::create_dir(&folder).unwrap();
    folder
}

/// Writes a file, and the folders that it lies in.
fn write(folder: &Path, name: &str, contents: impl AsRef<[u8]>) {
    let path = folder.join(name);
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(path, contents).unwrap();
}

/// Writes a row of greys as PFM or EXR, or as PNG by the sRGB curve.
fn write_image(path: impl AsRef<Path>, values: &[f32]) {
    let path = path.as_ref();
    let color = values.iter().map(|&value| Spectrum::splat(value)).collect();
    let picture = Picture::new(UVec2::new(values.len() as u32, 1), color);
    match path.extension().and_then(|extension| extension.to_str()) {
        Some("pfm") => write_pfm(path, &picture).unwrap(),
        Some("exr") => write_exr(path, &picture, &Metadata::default()).unwrap(),
        _ => write_png(path, &picture, Display::Srgb, &Metadata::default()).unwrap(),
    }
}

/// Texts without the folder in which a test has its files.
fn without_folder(texts: &[String], folder: &Path) -> Vec<String> {
    let prefix = format!("{}{}", folder.display(), std::path::MAIN_SEPARATOR);
    texts.iter().map(|text| text.replace(&prefix, "")).collect()
}
