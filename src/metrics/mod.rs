//! How far an image is from another one.
//!
//! [`Image::read`] takes EXR, PFM and PNG files; [`Errors::between`] has the usual numbers, [`flip`] what a viewer
//! sees who flips between both, [`z_test`] whether noise can explain the difference; [`ErrorMap`] shows where.
//! [`convergence`] follows errors over samples and time.

pub mod chart;
pub mod convergence;
mod errors;
mod flip;
mod image;
mod map;
mod pfm;
mod plane;
mod z_test;

pub use errors::{CompareError, Errors};
pub use flip::{Exposures, Viewing, flip};
pub use image::{Encoding, Image, ReadImageError};
pub use map::ErrorMap;
pub use z_test::{ZTest, z_test};
