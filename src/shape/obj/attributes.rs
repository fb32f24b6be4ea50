//! [`Attributes`]: the vertex attributes that tobj has parsed, in the order of the file.

use glam::{Vec2, Vec3};
use tobj::{Mesh, Model};

use super::error::{ObjAttribute, ObjProblem};
use super::feed::CLOSING_CORNERS;
use super::line_table::LineTable;
use crate::geometry::unit;

/// The vertex attributes of a file. All numbers are finite.
pub(super) struct Attributes {
    pub positions: Vec<Vec3>,
    pub textures: Vec<Vec2>,
    /// Of unit length or zero.
    pub normals: Vec<Vec3>,
}

impl Attributes {
    /// Collects the attributes from tobj's models, of which there is one for each closing face of
    /// the feed.
    ///
    /// # Errors
    /// The first number that is NaN, infinite or out of range, with its line.
    pub fn collect(
        models: &[Model],
        line_tables: &[LineTable; 3],
    ) -> Result<Self, (u64, ObjProblem)> {
        use ObjAttribute::{Normal, Texture, Vertex};
        Ok(Self {
            positions: values(models, |mesh| &mesh.positions, Vertex, line_tables, Vec3::from)?,
            textures: values(models, |mesh| &mesh.texcoords, Texture, line_tables, Vec2::from)?,
            normals: values(
                models,
                |mesh| &mesh.normals,
                Normal,
                line_tables,
                |n| unit(n.into()).unwrap_or_default(),
            )?,
        })
    }
}

/// The values of one attribute, each made from `N` numbers.
fn values<T, const N: usize>(
    models: &[Model],
    numbers: impl Fn(&Mesh) -> &Vec<f32>,
    attribute: ObjAttribute,
    line_tables: &[LineTable; 3],
    make: impl Fn([f32; N]) -> T,
) -> Result<Vec<T>, (u64, ObjProblem)> {
    let table = &line_tables[attribute as usize];
    let mut values = Vec::with_capacity(table.count());
    for model in models {
        // What exceeds the count repeats the last value, in faces beyond the end of a shorter list.
        let left = (table.count() - values.len()).min(CLOSING_CORNERS);
        for numbers in numbers(&model.mesh).as_chunks().0.iter().take(left) {
            if !numbers.iter().all(|x| x.abs() <= attribute.limit()) {
                let mut found = [0.0; 3];
                found[..N].copy_from_slice(numbers);
                let index = values.len() + 1;
                let problem = ObjProblem::OutOfRange { attribute, index, found };
                return Err((table.line(index - 1), problem));
            }
            values.push(make(*numbers));
        }
    }
    Ok(values)
}
