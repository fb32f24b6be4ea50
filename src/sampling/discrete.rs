//! stub
/// stub
pub struct Discrete(Vec<f32>);
impl Discrete {
    /// stub
    pub fn new(weights: impl Iterator<Item = f64>) -> Self {
        let w: Vec<f64> = weights.collect();
        let total: f64 = w.iter().sum();
        Self(w.iter().map(|w| (w / total) as f32).collect())
    }
    /// stub
    pub fn probability(&self, i: usize) -> f32 {
        self.0[i]
    }
    /// stub
    pub fn sample(&self, u: f32) -> (usize, f32, f32) {
        let mut u = u;
        for (i, &p) in self.0.iter().enumerate() {
            if u < p {
                return (i, p, u / p);
            }
            u -= p;
        }
        (self.0.len() - 1, self.0[self.0.len() - 1], 0.0)
    }
}
