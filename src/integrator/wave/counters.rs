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

    /// Adds the counts of another worker.
    pub fn add(&mut self, other: &Self) {
        self.camera_rays += other.camera_rays;
        self.shadow_rays += other.shadow_rays;
        self.scattered_rays += other.scattered_rays;
        self.rejected += other.rejected;
        self.refused_camera_rays += other.refused_camera_rays;
    }
}
