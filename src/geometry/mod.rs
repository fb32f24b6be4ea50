//! Geometry: rays, shading frames, spherical trigonometry, mirror reflection and refraction, points
//! with error bounds, and constants of floating-point rounding.
//!
//! Directions are vectors of the world or of shading coordinates, in which the normal is the z axis
//! ([`Frame`] converts). Lengths are in scene units, angles in radians.
//!
//! ```
//! use lobe::geometry::{Frame, Ray, reflect};
//! use lobe::glam::Vec3;
//!
//! // A ray from z = 1 meets the plane z = 0 at t = 1 and is reflected.
//! let ray = Ray::new(Vec3::Z, Vec3::new(1.0, 0.0, -1.0));
//! let p = ray.o + 1.0 * ray.d;
//! let wr = reflect(-ray.d, Vec3::Z);
//! assert_eq!((p, wr), (Vec3::X, Vec3::new(1.0, 0.0, 1.0)));
//!
//! // cos θ in shading coordinates is the z component.
//! let local = Frame::from_normal(Vec3::Z).to_local(wr.normalize());
//! assert!((lobe::geometry::trig::cos_theta(local) - 0.5_f32.sqrt()).abs() < 1e-6);
//! ```

mod bounded;
pub mod float;
mod frame;
mod optics;
mod pixel_cone;
mod ray;
pub mod trig;
mod vector;
mod xyz;

pub(crate) use bounded::Bounded;
pub use bounded::BoundedPoint;
pub(crate) use frame::Axes;
pub use frame::Frame;
pub use optics::{reflect, refract};
pub use pixel_cone::PixelCone;
pub use ray::Ray;
pub(crate) use vector::{unit, unit_cross, unit_wide};
pub(crate) use xyz::Xyz;
