//! Reader of Wavefront OBJ files.

mod attributes;
mod error;
mod faces;
mod feed;
mod keywords;
mod line_table;
mod lines;
mod materials;
mod merge;
mod report;

use std::collections::HashSet;
use std::fs;
use std::io::{BufRead, BufReader, ErrorKind};
use std::path::{Path, PathBuf};

pub use error::{ObjAttribute, ObjError, ObjProblem};
pub use report::{ObjMaterials, ObjMesh, ObjReport, SkippedLines};

use super::kind::{Load, Read};
use crate::file;
use crate::params::{Fault, Key, Kind, Table};
use attributes::Attributes;
pub(super) use error::Failure;
use feed::Feed;
pub(super) use lines::LogicalLines;
pub(super) use materials::text;

/// Reads the OBJ file at `path` as one mesh. [`parse_obj`] says how.
///
/// # Errors
/// If the file does not exist, is not an ordinary one or cannot be read, and all errors of [`parse_obj`]. Messages name the
/// file by `path`.
pub fn read_obj(path: &Path) -> Result<ObjMesh, ObjError> {
    let name = path.display().to_string();
    let unreadable = |source: std::io::Error| match source.kind() {
        ErrorKind::NotFound => ObjError::Missing { name: name.clone() },
        ErrorKind::IsADirectory => ObjError::Directory { name: name.clone() },
        _ => ObjError::Unreadable { name: name.clone(), source },
    };
    let file = file::open(path).map_err(unreadable)?;
    let mut read = parse_obj(&name, BufReader::with_capacity(1 << 17, file))?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let libraries = std::mem::take(&mut read.materials.libraries);
    let all = libraries.iter().flat_map(|text| library_files(folder, &text.to_string_lossy()));
    // One file may be named in several ways.
    let mut known = HashSet::new();
    let is_new = |file: &PathBuf| known.insert(fs::canonicalize(file).unwrap_or(file.clone()));
    read.materials.libraries = all.filter(is_new).collect();
    Ok(read)
}

/// The files that a `mtllib` line names: one, whose name may have blanks, as most programs write it; or several, if there is none of that
/// name, but one for each word.
fn library_files(folder: &Path, text: &str) -> Vec<PathBuf> {
    if let Some(whole) = file::find(folder, text) {
        return vec![whole];
    }
    let words = text.split_ascii_whitespace().map(|name| file::find(folder, name));
    words.collect::<Option<Vec<_>>>().unwrap_or_else(|| vec![folder.join(text.replace('\\', "/"))])
}

/// Reads OBJ text as one mesh. `name` is the name of the file in messages.
///
/// All objects and groups become one mesh. `usemtl` and `mtllib` lines become [`ObjMaterials`]; the files that they name are
/// not opened. Other names, points, lines and curves are ignored, in whatever encoding they are. What is odd is
/// counted in [`ObjReport`].
/// - Polygons are triangulated as fans around their first corner. Faces with fewer than three
///   corners are skipped and counted.
/// - Indices count from 1, or if negative, backwards from the face. A face may refer to elements
///   that follow it.
/// - Vertex i of the file is vertex i of the mesh. If corners at a vertex differ in texture
///   coordinate or normal, copies of the vertex are appended after the last one of the file.
/// - Normals are scaled to unit length. A corner without a normal, or with a zero one, gets
///   [`Vec3::ZERO`](glam::Vec3::ZERO). A corner without texture coordinates gets
///   [`Vec2::ZERO`](glam::Vec2::ZERO). If no corner of the file has any, the mesh has none.
/// - Numbers after the third of a vertex (w, or a colour) and after the second of a texture
///   coordinate are ignored. A missing second one is 0.
/// - Lines end in LF, CR LF or CR. A comment may end any line, a backslash continues it, and any
///   line may begin with a UTF-8 byte order mark. Without comments, but with what continues it, a
///   line has at most 1 MiB.
/// - Lines with a keyword that the OBJ specification does not have are skipped and counted.
///
/// ```
/// let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4 # a quad\n";
/// let read = lobe::shape::parse_obj("quad.obj", text.as_bytes())?;
/// assert_eq!(read.mesh.indices, [[0, 1, 2], [0, 2, 3]]);
///
/// let error = lobe::shape::parse_obj("bad.obj", "v 0 0 0\nf 1 1 2\n".as_bytes()).unwrap_err();
/// assert_eq!(error.to_string(), "bad.obj:2: face refers to vertex 2, but the file has only 1 vertex");
/// # Ok::<(), lobe::shape::ObjError>(())
/// ```
///
/// # Errors
/// If reading fails; if a line is malformed, refers to an element that does not exist, or has a
/// number that is not finite or out of range; if there is no face with three corners; if there are more vertices or
/// triangles than a `u32` can index.
pub fn parse_obj(name: &str, reader: impl BufRead) -> Result<ObjMesh, ObjError> {
    read(reader).map_err(|failure| {
        let name = name.to_owned();
        match failure {
            Failure::Io(source) => ObjError::Unreadable { name, source },
            Failure::Line(line, problem) => ObjError::Line { name, line, problem },
            Failure::NoFaces(vertices) => ObjError::NoFaces { name, vertices },
            Failure::TooMany(what) => ObjError::TooLarge { name, what },
        }
    })
}

fn read(reader: impl BufRead) -> Result<ObjMesh, Failure> {
    // Without tobj's triangulation, and with points and lines kept: the closing faces of the feed
    // then come back as they were sent.
    let options = tobj::LoadOptions::default();
    let mut feed = Feed::new(reader);
    let models = match tobj::load_obj_buf(&mut feed, &options, |_| Ok(Default::default())) {
        Ok((models, _)) => models,
        Err(error) => return Err(feed.into_failure(error)),
    };
    let attributes = Attributes::collect(&models, &feed.line_tables)
        .map_err(|(line, problem)| Failure::Line(line, problem))?;
    drop(models);
    let mut read = merge::merge(feed.faces, attributes).ok_or(Failure::TooMany("vertices"))?;
    read.report.unknown_lines = feed.unknown;
    read.materials = feed.materials.finish();
    debug_assert_eq!(read.mesh.check(), Ok(()));
    Ok(read)
}

const OBJ: Key<PathBuf> = Key::new("obj", "path of an OBJ file");

/// `type = "obj"`
pub(super) const KIND: Kind<Read> =
    Kind { name: "obj", meaning: "The triangles of an OBJ file", keys: &[&OBJ], read: read_kind };

fn read_kind(table: &Table) -> Result<Load, Fault> {
    let (path, mark) = (table.get(&OBJ)?, table.mark(&OBJ));
    Ok(Box::new(move || read_obj(&path).map_err(|error| Fault::new(mark, error))))
}
