//! Reading triangle meshes from Wavefront OBJ.

mod error;
mod faces;
mod feed;
mod lines;
mod merge;
mod numbers;
mod places;

use std::fs::File;
use std::io::{BufRead, BufReader, ErrorKind};
use std::path::{Path, PathBuf};

pub use error::{ObjAttribute, ObjError, ObjProblem};

use super::{Load, Read, TriangleMesh};
use crate::params::{Fault, Key, Kind, Table};
use feed::{Failure, Feed};
use numbers::Numbers;

/// A mesh that was read from an OBJ file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ObjMesh {
    /// The mesh. It has at least one triangle and passes [`TriangleMesh::check`].
    pub mesh: TriangleMesh,
    /// What was noticed on the way.
    pub report: ObjReport,
}

/// What is odd about a mesh, though not wrong.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct ObjReport {
    /// Triangles without area: corners coincide or lie on one line. They are in the mesh.
    pub degenerate_triangles: usize,
    /// Vertices of the file to which no face refers. They are in the mesh.
    pub unused_vertices: usize,
}

/// Reads the OBJ file at `path` as one mesh. See [`parse_obj`].
///
/// # Errors
/// If there is no file, if it can't be read, or for what [`parse_obj`] refuses. The messages name
/// the file by `path`.
pub fn read_obj(path: &Path) -> Result<ObjMesh, ObjError> {
    let name = path.display().to_string();
    let unreadable = |source: std::io::Error| match source.kind() {
        ErrorKind::NotFound => ObjError::Missing { name: name.clone() },
        _ if path.is_dir() => ObjError::Directory { name: name.clone() },
        _ => ObjError::Unreadable { name: name.clone(), source },
    };
    let file = File::open(path).map_err(unreadable)?;
    match parse_obj(&name, BufReader::with_capacity(1 << 17, file)) {
        Err(ObjError::Unreadable { source, .. }) => Err(unreadable(source)),
        result => result,
    }
}

/// Reads OBJ text as one mesh. `name` stands for the file in messages.
///
/// What counts are the lines `v`, `vt`, `vn` and `f`: all objects and groups become one mesh, and
/// names, materials, points, lines and curves are passed over, in whatever encoding they are.
/// - Polygons are cut into fans around their first corner.
/// - Indices count from 1, or backwards from the face if they are negative. A face may refer to
///   what the file lists only after it.
/// - Vertex i of the file is vertex i of the mesh. Where corners at a vertex differ in texture
///   coordinate or normal, copies of the vertex follow after the last one of the file.
/// - Normals are scaled to unit length. A corner with the normal zero or without one gets
///   [`Vec3::ZERO`](glam::Vec3::ZERO), and a corner without texture coordinates [`Vec2::ZERO`](glam::Vec2::ZERO). If no corner of the
///   file has any, the mesh has none.
/// - Numbers beyond the third of a vertex (w, or a colour) and beyond the second of a texture
///   coordinate are passed over; a missing second one is 0.
/// - Lines end in LF, CR LF or CR. A comment may end every line, a backslash continues it, and the
///   text may begin with a UTF-8 byte order mark.
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
/// If reading fails; if a line can't be understood, refers to what is not there, or holds a number
/// that is not finite; if there is no face; if there are more vertices or triangles than a `u32`
/// can number.
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
    // Not triangulated, points and lines kept: the closing faces of the feed come back as they are.
    let options = tobj::LoadOptions::default();
    let mut feed = Feed::new(reader);
    let models = match tobj::load_obj_buf(&mut feed, &options, |_| Ok(Default::default())) {
        Ok((models, _)) => models,
        Err(error) => return Err(feed.into_failure(error)),
    };
    let numbers = Numbers::collect(&models, &feed.places)
        .map_err(|(line, problem)| Failure::Line(line, problem))?;
    drop(models);
    let read = merge::merge(feed.faces, numbers).ok_or(Failure::TooMany("vertices"))?;
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
