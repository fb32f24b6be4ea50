//! Random numbers, the same on every platform.

use lobe::glam::DVec3;

/// SplitMix64 (Steele et al. 2014).
pub struct Rng(u64);

impl Rng {
    /// The generator for one parameter of a sweep.
    pub fn new(seed: u64) -> Self {
        // Hashed, because the states of neighbouring seeds would overlap.
        Self(Self(seed).bits())
    }

    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in `[0, 1)`, with 53 bits.
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Uniform in the cube `[-1, 1)³`.
    pub fn in_cube(&mut self) -> DVec3 {
        DVec3::new(self.unit(), self.unit(), self.unit()) * 2.0 - 1.0
    }

    /// A unit vector, uniform over the sphere, by rejection, because sine and cosine differ between platforms.
    pub fn direction(&mut self) -> DVec3 {
        loop {
            let v = self.in_cube();
            let length2 = v.length_squared();
            if length2 > 1e-6 && length2 <= 1.0 {
                return v / length2.sqrt();
            }
        }
    }

    /// Two of three barycentric weights, uniform over a triangle.
    pub fn in_triangle(&mut self) -> [f64; 2] {
        let (u, v) = (self.unit(), self.unit());
        if u + v > 1.0 { [1.0 - u, 1.0 - v] } else { [u, v] }
    }
}
