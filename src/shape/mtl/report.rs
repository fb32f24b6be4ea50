//! [`MtlLibrary`]: the materials of an MTL file, as they stand there.

use std::fmt::{self, Display, Formatter};
use std::io::{self, ErrorKind};

use super::MtlMap;
use crate::params::Shown;

/// Why an MTL file cannot be read.
#[derive(Debug, thiserror::Error)]
#[error("{}: {}", Shown::line(name), reason(source))]
pub struct MtlError {
    /// The file, as the caller named it.
    pub name: String,
    /// The error of the operating system.
    pub source: io::Error,
}

fn reason(source: &io::Error) -> String {
    match source.kind() {
        ErrorKind::NotFound => "there is no such file".into(),
        ErrorKind::IsADirectory => "is a directory, expected an MTL file".into(),
        _ => format!("cannot be read: {source}"),
    }
}

/// The materials of an MTL file.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct MtlLibrary {
    /// In the order of the file, each name once: of two with the same name the first, and none without a name.
    pub materials: Vec<MtlMaterial>,
    /// What was left out, each thing once, in the order of the first lines.
    pub notes: Vec<MtlNote>,
}

/// What was left out of an MTL file.
#[derive(Clone, Debug, PartialEq)]
pub struct MtlNote {
    /// The first line of which it holds, counted from 1.
    pub line: u64,
    /// What, what was expected, and in how many more lines it is the same.
    pub what: String,
}

impl Display for MtlNote {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        write!(f, "line {}: {}", self.line, self.what)
    }
}

/// The values of a material, each as its line says, or `None` without one. Keys are those of Wavefront's specification of MTL, with the
/// physically based ones that many programs share.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct MtlMaterial {
    /// The name after `newmtl`.
    pub name: String,
    /// The line of `newmtl`.
    pub line: u64,
    /// Diffuse colour.
    pub kd: Option<[f32; 3]>,
    /// Specular colour.
    pub ks: Option<[f32; 3]>,
    /// Emission.
    pub ke: Option<[f32; 3]>,
    /// Transmission filter.
    pub tf: Option<[f32; 3]>,
    /// Specular exponent, of Phong.
    pub ns: Option<f32>,
    /// Index of refraction.
    pub ni: Option<f32>,
    /// Opacity.
    pub d: Option<f32>,
    /// 1 - opacity, in most programs.
    pub tr: Option<f32>,
    /// Roughness, perceptual.
    pub pr: Option<f32>,
    /// How much it is a metal.
    pub pm: Option<f32>,
    /// Illumination model.
    pub illum: Option<u32>,
    /// Image of the diffuse colour.
    pub map_kd: Option<MtlMap>,
    /// Image of the emission.
    pub map_ke: Option<MtlMap>,
    /// Image of the opacity.
    pub map_d: Option<MtlMap>,
    /// Image of the roughness.
    pub map_pr: Option<MtlMap>,
    /// Image of how much it is a metal.
    pub map_pm: Option<MtlMap>,
    /// Image of heights.
    pub map_bump: Option<MtlMap>,
    /// Image of normals.
    pub norm: Option<MtlMap>,
}

impl MtlMaterial {
    /// The same values as if they stood anywhere else in a file: for comparisons.
    pub fn without_lines(&self) -> Self {
        let mut same = Self { line: 0, ..self.clone() };
        let Self { map_kd, map_ke, map_d, map_pr, map_pm, map_bump, norm, .. } = &mut same;
        for map in [map_kd, map_ke, map_d, map_pr, map_pm, map_bump, norm].into_iter().flatten() {
            map.line = 0;
        }
        same
    }
}
