//! Measures of the difference between images.
//!
//! [`Errors::between`] computes MSE, relMSE, PSNR and so on, [`flip`] what a viewer sees who flips between both images,
//! [`z_test`] whether noise explains the difference, [`half_widths`] confidence intervals by [`StudentT`]; [`ErrorMap`] shows where it is. [`convergence`] follows errors over
//! samples and time, and [`chart`] draws them. Images are those of [`image`](crate::image).

pub mod chart;
mod confidence;
pub mod convergence;
mod errors;
mod flip;
mod map;
mod plane;
mod student_t;
mod z_test;

pub use confidence::half_widths;
pub use errors::{CompareError, Errors};
pub use flip::{Exposures, Viewing, flip};
pub use map::ErrorMap;
pub use student_t::StudentT;
pub use z_test::{ZTest, z_test};
