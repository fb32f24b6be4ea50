//! [`Sweep`]: one question, measured at several values of a parameter.

/// One question: how often, or by how much, methods fail as a parameter varies.
pub struct Sweep {
    /// File name without extension, such as "ray-origins-scale".
    pub name: &'static str,
    /// Title of the chart, such as "False self-hits, by the scene's scale".
    pub title: &'static str,
    /// A few sentences: the setup, what counts as failure or error, the truth, the trials per point, and the source of the
    /// common method.
    pub about: String,
    /// Label of the x axis with its unit, such as "scale of the scene (scene units)".
    pub parameter: &'static str,
    /// Whether the x axis is logarithmic.
    pub log_parameter: bool,
    /// Label of the y axis with its unit, such as "share of rays that fail". The axis is logarithmic; zero is allowed.
    pub measure: &'static str,
    /// The values of the parameter.
    pub parameters: Vec<f64>,
    /// The results by method.
    pub methods: Vec<Method>,
    /// A method counts as failed from this result on.
    pub fails_from: f64,
    /// Stored bounds, one per parameter, which ours must not exceed. Infinite where there is none.
    pub bounds: Vec<f64>,
}

/// The results of one method.
pub struct Method {
    /// Its name in the legend.
    pub name: &'static str,
    /// Whether it is this crate's method.
    pub is_ours: bool,
    /// One result per parameter; NaN where it cannot be measured. If the method itself returns infinity or NaN this counts
    /// as an infinite error, or as a failed trial.
    pub values: Vec<f64>,
}

impl Sweep {
    /// Parameters at which a common method fails and ours does not.
    pub fn won(&self) -> Vec<f64> {
        let fails = |method: &Method, index: usize| method.values[index] >= self.fails_from;
        let any = |ours: bool, index: usize| {
            self.methods.iter().any(|method| method.is_ours == ours && fails(method, index))
        };
        let known = |index: usize| {
            self.methods.iter().any(|method| method.is_ours && !method.values[index].is_nan())
        };
        (0..self.parameters.len())
            .filter(|&index| any(false, index) && known(index) && !any(true, index))
            .map(|index| self.parameters[index])
            .collect()
    }

    /// Parameters at which ours exceeds its stored bound: (parameter, result, bound).
    pub fn broken(&self) -> Vec<(f64, f64, f64)> {
        let mut broken = Vec::new();
        for method in self.methods.iter().filter(|method| method.is_ours) {
            for ((&parameter, &value), &bound) in
                self.parameters.iter().zip(&method.values).zip(&self.bounds)
            {
                if value > bound {
                    broken.push((parameter, value, bound));
                }
            }
        }
        broken
    }
}
