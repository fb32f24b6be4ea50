//! [`Counters`]: rays and errors of a render.

/// Numbers of rays traced and of errors in a render.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Counters {
    /// Camera rays.
    pub camera_rays: u64,
    /// Shadow rays.
    pub shadow_rays: u64,
    /// Rays scattered at surfaces.
    pub scattered_rays: u64,
    /// Invalid frames, lobes and results of lobes: see [`Bsdf::rejected`](crate::bxdf::Bsdf::rejected). The layers of
    /// [`RenderOptions::layers`](crate::render::RenderOptions::layers) ask for reflectances too, and so count more.
    pub rejected: u64,
    /// Camera rays that could not be traced: see [`Camera`](crate::camera::Camera). Their samples are left out of the
    /// picture and are also counted as non-finite.
    pub refused_camera_rays: u64,
}

impl Counters {
    /// All rays.
    pub fn rays(&self) -> u64 {
        self.camera_rays + self.shadow_rays + self.scattered_rays
    }

    /// Number of counts.
    pub(crate) const COUNT: usize = 5;

    /// All counts, in the order of the fields.
    pub(crate) fn to_array(self) -> [u64; Self::COUNT] {
        let Self { camera_rays, shadow_rays, scattered_rays, rejected, refused_camera_rays } = self;
        [camera_rays, shadow_rays, scattered_rays, rejected, refused_camera_rays]
    }

    /// The inverse of [`to_array`](Self::to_array).
    pub(crate) fn from_array(counts: [u64; Self::COUNT]) -> Self {
        let [camera_rays, shadow_rays, scattered_rays, rejected, refused_camera_rays] = counts;
        Self { camera_rays, shadow_rays, scattered_rays, rejected, refused_camera_rays }
    }

    /// Adds the counts of another worker.
    pub fn add(&mut self, other: &Self) {
        let (a, b) = (self.to_array(), other.to_array());
        *self = Self::from_array(std::array::from_fn(|i| a[i] + b[i]));
    }
}
