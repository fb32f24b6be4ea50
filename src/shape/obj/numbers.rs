//! [`Numbers`]: what tobj has read, in the order of the file.

use glam::{Vec2, Vec3};
use tobj::{Mesh, Model};

use super::error::{ObjAttribute, ObjProblem};
use super::feed::CLOSING_CORNERS;
use super::places::Places;
use crate::geometry::unit;

/// The numbers of a file. All are finite.
pub(super) struct Numbers {
    pub positions: Vec<Vec3>,
    pub textures: Vec<Vec2>,
    /// Of unit length or zero.
    pub normals: Vec<Vec3>,
}

impl Numbers {
    /// Collects them from tobj's models, one for each closing face of the feed.
    ///
    /// # Errors
    /// The first number that is NaN, infinite or too large, with its line.
    pub fn collect(models: &[Model], places: &[Places; 3]) -> Result<Self, (u64, ObjProblem)> {
        use ObjAttribute::{Normal, Texture, Vertex};
        Ok(Self {
            positions: values(models, |mesh| &mesh.positions, Vertex, places, Vec3::from)?,
            textures: values(models, |mesh| &mesh.texcoords, Texture, places, Vec2::from)?,
            normals: values(
                models,
                |mesh| &mesh.normals,
                Normal,
                places,
                |n| unit(n.into()).unwrap_or_default(),
            )?,
        })
    }
}

/// All values of one attribute, made from their `N` numbers.
fn values<T, const N: usize>(
    models: &[Model],
    numbers: impl Fn(&Mesh) -> &Vec<f32>,
    attribute: ObjAttribute,
    places: &[Places; 3],
    make: impl Fn([f32; N]) -> T,
) -> Result<Vec<T>, (u64, ObjProblem)> {
    let places = &places[attribute as usize];
    let mut values = Vec::with_capacity(places.count());
    for model in models {
        // What is left over is the last value of all, repeated in each face that had no other.
        let left = (places.count() - values.len()).min(CLOSING_CORNERS);
        for numbers in numbers(&model.mesh).as_chunks().0.iter().take(left) {
            if !numbers.iter().all(|x| x.abs() <= attribute.limit()) {
                let mut found = [0.0; 3];
                found[..N].copy_from_slice(numbers);
                let index = values.len() + 1;
                let problem = ObjProblem::OutOfRange { attribute, index, found };
                return Err((places.line(index - 1), problem));
            }
            values.push(make(*numbers));
        }
    }
    Ok(values)
}
