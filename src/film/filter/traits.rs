//! [`Filter`], the trait of reconstruction filters.

use std::fmt::Debug;
use std::sync::Arc;

use glam::Vec2;

use super::parameters::{FilterError, check_radius};
use super::sampler::FilterSampler;
use crate::params::{Fault, Table};

/// Function that reads a kind of filter from a scene file.
pub type ReadFilter = fn(&Table) -> Result<Arc<dyn Filter>, Fault>;

/// A reconstruction filter: the weight of radiance around the centre of a pixel (PBRT 3rd edition, section 7.8).
///
/// It is separable: the product of the same function of x and of y, its [`profile`](Filter::profile). A profile is
/// symmetric, never negative, and falls from the centre to the radius. Lengths are in pixels.
///
/// Positions are drawn in proportion to the filter, and all samples have the same weight (Ernst, Stamminger and Greiner
/// 2006, "Filter Importance Sampling"). So a sample belongs to one pixel, and tiles do not overlap.
/// [`FilterSampler`] draws them.
///
/// A filter of another crate is two functions:
///
/// ```
/// use std::f64::consts::PI;
///
/// use lobe::film::Filter;
/// use lobe::{FilmSettings, PerspectiveSettings, RenderOptions, RenderSettings, Scene, Spectrum, View};
/// use lobe::{light::SkyLight, render};
///
/// /// The Hann window: a period of the cosine, raised to end at zero.
/// #[derive(Debug)]
/// struct Hann;
///
/// impl Filter for Hann {
///     fn radius(&self) -> f32 {
///         1.0
///     }
///     fn profile(&self, x: f64) -> f64 {
///         1.0 + (PI * x).cos()
///     }
/// }
///
/// let film = FilmSettings::new(8, 8).with_filter(Hann);
/// let view = View::perspective(&PerspectiveSettings::default(), film)?;
/// let scene = Scene::builder().light(SkyLight::new(Spectrum::WHITE)).build()?;
/// let rendered = render(&scene, &view, &RenderSettings::default(), &RenderOptions::default())?;
/// assert_eq!(rendered.picture.color, vec![Spectrum::WHITE; 64]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Filter: Send + Sync + Debug {
    /// Half of the filter's width on each axis, in pixels; above 0 and at most
    /// [`MAX_FILTER_RADIUS`](super::MAX_FILTER_RADIUS).
    fn radius(&self) -> f32;

    /// The factor for one axis at `x` pixels from the centre, from 0 to the radius. Need not be normalised.
    fn profile(&self, x: f64) -> f64;

    /// Checks the parameters. By default only the radius.
    ///
    /// # Errors
    /// If a parameter is out of range.
    fn check(&self) -> Result<(), FilterError> {
        check_radius(self.radius())
    }

    /// Prepares the filter for sampling. By default the profile is tabulated up to the radius.
    ///
    /// # Errors
    /// As for [`Filter::check`], and [`FilterError::Profile`].
    fn prepare(&self) -> Result<FilterSampler, FilterError> {
        self.check()?;
        FilterSampler::from_profile(self.radius(), |x| self.profile(x))
    }

    /// The filter's value at this offset from the pixel's centre. It is not normalised.
    fn evaluate(&self, offset: Vec2) -> f32 {
        let radius = self.radius();
        let factor = |x: f32| if x > radius { 0.0 } else { self.profile(f64::from(x)) };
        let Vec2 { x, y } = offset.abs();
        (factor(x) * factor(y)) as f32
    }

    /// Name and parameters, in one line for people.
    fn describe(&self) -> String {
        format!("{self:?}")
    }

    /// Wraps the filter for a film, without a second `Arc` around one that is shared.
    #[doc(hidden)]
    fn into_arc(self) -> Arc<dyn Filter>
    where
        Self: Sized + 'static,
    {
        Arc::new(self)
    }
}

/// A shared filter is a filter.
impl Filter for Arc<dyn Filter> {
    fn radius(&self) -> f32 {
        (**self).radius()
    }

    fn profile(&self, x: f64) -> f64 {
        (**self).profile(x)
    }

    fn check(&self) -> Result<(), FilterError> {
        (**self).check()
    }

    fn prepare(&self) -> Result<FilterSampler, FilterError> {
        (**self).prepare()
    }

    fn evaluate(&self, offset: Vec2) -> f32 {
        (**self).evaluate(offset)
    }

    fn describe(&self) -> String {
        (**self).describe()
    }

    fn into_arc(self) -> Arc<dyn Filter> {
        self
    }
}
