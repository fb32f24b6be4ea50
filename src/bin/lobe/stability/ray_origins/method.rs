//! Methods to move the origin of a ray off the surface that it leaves.

use lobe::geometry::Ray;
use lobe::glam::Vec3;
use lobe::interaction::SurfaceInteraction;

/// A method to move the origin.
#[derive(Clone, Copy, PartialEq)]
pub enum Method {
    /// By 1e-4 along the geometric normal, whatever the scene.
    FixedEpsilon,
    /// By 256 floats along the geometric normal, component by component, or by 2⁻¹⁶ of it where the
    /// coordinate is below 1/32. Waechter and Binder 2019, "A Fast and Robust Method for Avoiding
    /// Self-Intersection", Ray Tracing Gems, chapter 6.
    WaechterBinder,
    /// Out of the error bounds of the point, as this crate does (PBRT 3rd edition, section 3.9.5).
    ErrorBounds,
    /// Not moved: the control.
    Unmoved,
}

impl Method {
    pub const ALL: [Self; 4] =
        [Self::FixedEpsilon, Self::WaechterBinder, Self::ErrorBounds, Self::Unmoved];

    /// The ray that leaves `si` along `w`.
    pub fn spawn(self, si: &SurfaceInteraction, w: Vec3) -> Ray {
        let n = if w.dot(si.n()) < 0.0 { -si.n() } else { si.n() };
        let p = si.p();
        match self {
            Self::FixedEpsilon => Ray::new(p + 1e-4 * n, w),
            Self::WaechterBinder => {
                let o = [0, 1, 2].map(|axis| waechter_binder(p[axis], n[axis]));
                Ray::new(Vec3::from(o), w)
            }
            Self::ErrorBounds => si.spawn_ray(w),
            Self::Unmoved => Ray::new(p, w),
        }
    }
}

/// One coordinate of the moved origin, with the constants of Waechter and Binder 2019.
fn waechter_binder(p: f32, n: f32) -> f32 {
    const ORIGIN: f32 = 1.0 / 32.0;
    const FLOAT_SCALE: f32 = 1.0 / 65536.0;
    const INT_SCALE: f32 = 256.0;
    if p.abs() < ORIGIN {
        return p + FLOAT_SCALE * n;
    }
    // Adding to a float's bits moves it by that many floats away from zero.
    let floats = (INT_SCALE * n) as i32;
    let away = if p < 0.0 { -floats } else { floats };
    f32::from_bits(p.to_bits().wrapping_add_signed(away))
}
