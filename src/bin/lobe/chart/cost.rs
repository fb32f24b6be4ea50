//! [`Cost`]: a method's time, as a function of its samples.

/// Linear model of a method's time for a picture, in seconds.
#[derive(Clone, Copy, Debug)]
pub struct Cost {
    /// Independent of the number of samples.
    pub fixed: f64,
    /// Per sample per pixel.
    pub per_sample: f64,
}

impl Cost {
    /// Fits two measurements: (samples, seconds).
    pub fn new((few, short): (u32, f64), (many, long): (u32, f64)) -> Self {
        let per_sample = ((long - short) / f64::from(many - few)).max(1e-6);
        Self { fixed: (short - per_sample * f64::from(few)).max(0.0), per_sample }
    }

    pub fn of(&self, spp: u32) -> f64 {
        self.fixed + self.per_sample * f64::from(spp)
    }
}
