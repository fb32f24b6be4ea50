//! Geometry: rays, shading frames and their trigonometry, angles, error-bounded points, four vectors at a time, float
//! helpers.

pub(crate) mod angle;
mod bounded;
pub mod float;
pub(crate) mod four;
mod frame;
mod optics;
mod ray;
pub mod trig;
mod vector;

pub use bounded::BoundedPoint;
pub use frame::Frame;
pub use optics::{reflect, refract};
pub use ray::Ray;
pub(crate) use vector::{unit, unit_cross};
