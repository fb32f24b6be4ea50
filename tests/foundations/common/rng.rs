//! Random numbers of the tests, independent of the crate under test.

use lobe::glam::{DVec3, Vec2, Vec3};

/// SplitMix64 (Steele et al. 2014).
pub struct Rng(u64);

impl Rng {
    /// A generator for one trial of one test, so that a failure can be replayed from its trial alone.
    pub fn new(test: u64, trial: u64) -> Self {
        let mut rng = Self(test.wrapping_mul(0xa076_1d64_78bd_642f) ^ trial.rotate_left(32));
        // The first outputs of neighbouring states are unrelated, but the states overlap: start
        // each trial at a hashed place.
        rng.0 = rng.bits();
        rng
    }

    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A whole number below `count`.
    pub fn below(&mut self, count: usize) -> usize {
        (self.f64() * count as f64) as usize
    }

    /// 53 bits in `[0, 1)`.
    pub fn f64(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// 24 bits in `[0, 1)`, the grid that the crate's samplers use.
    pub fn f32(&mut self) -> f32 {
        (self.bits() >> 40) as f32 / (1 << 24) as f32
    }

    pub fn within(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.f32()
    }

    pub fn sign(&mut self) -> f32 {
        if self.bits() >> 63 == 0 { 1.0 } else { -1.0 }
    }

    pub fn square(&mut self) -> Vec2 {
        Vec2::new(self.f32(), self.f32())
    }

    /// 10^U(-e, e) with a random sign: as likely tiny as huge.
    pub fn coordinate(&mut self, e: f64) -> f32 {
        10.0_f64.powf((2.0 * self.f64() - 1.0) * e) as f32 * self.sign()
    }

    pub fn point(&mut self, e: f64) -> Vec3 {
        Vec3::new(self.coordinate(e), self.coordinate(e), self.coordinate(e))
    }

    /// A unit vector, uniform over the sphere.
    pub fn direction(&mut self) -> Vec3 {
        self.direction_f64().as_vec3()
    }

    pub fn direction_f64(&mut self) -> DVec3 {
        let (z, phi) = (2.0 * self.f64() - 1.0, std::f64::consts::TAU * self.f64());
        let r = (1.0 - z * z).max(0.0).sqrt();
        DVec3::new(r * phi.cos(), r * phi.sin(), z)
    }

    /// Barycentric weights, uniform over the triangle.
    pub fn barycentric(&mut self) -> [f32; 3] {
        let root = self.f32().sqrt();
        let b1 = self.f32() * root;
        [1.0 - root, b1, root - b1]
    }
}
