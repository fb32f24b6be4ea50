//! [`Counters`]: what a render did.

/// What a render did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Rays from the camera.
    pub camera_rays: u64,
    /// Rays towards lights.
    pub shadow_rays: u64,
    /// Rays that were scattered at a surface.
    pub scattered_rays: u64,
    /// Lobe answers that were rejected: see [`Bsdf::rejected`](crate::bxdf::Bsdf::rejected).
    pub rejected: u64,
    /// Camera rays that could not be traced: see [`Camera`](crate::camera::Camera). Their samples are left out of the
    /// picture and counted among those that are not finite, too.
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
