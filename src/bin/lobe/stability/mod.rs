//! Where methods fail: usual ones from the literature, and what this crate does in their place, on the same axes.
//!
//! A [`Sweep`] is one such question, measured at 8 to 30 values of a parameter. The usual methods are written here, as
//! their sources print them, in f32; ours are the crate's public functions, called as a user would. Truth is a closed
//! form, or f64 from the f32 numbers as they are. Random numbers are the measurement's own, so that the same effort
//! gives the same figures.

mod bases;
mod disks;
mod edges;
mod extremes;
mod lights;
pub mod ray_origins;
mod rectangles;
mod rng;
mod sums;
mod tally;
mod usual_rectangle;
mod usual_triangle;

/// One question: how often, or by how much, methods fail as a parameter grows.
pub struct Sweep {
    /// A file's name without ending, such as "ray-origins-scale".
    pub name: &'static str,
    /// What the chart is of, in a few words, such as "False self-hits, by the scene's scale".
    pub title: &'static str,
    /// A few sentences: what was done, what counts as failure or error, what truth is, trials per point, and
    /// the source of the usual method.
    pub about: String,
    /// The x axis with its unit, such as "scale of the scene (scene units)".
    pub parameter: &'static str,
    /// Whether the x axis is logarithmic.
    pub log_parameter: bool,
    /// The y axis with its unit, such as "share of rays that fail". It is always logarithmic; zero is allowed.
    pub measure: &'static str,
    /// Where it was measured.
    pub parameters: Vec<f64>,
    /// What was measured.
    pub methods: Vec<Method>,
    /// From which measure on a method is said to fail.
    pub fails_from: f64,
    /// Ours must not exceed this at the parameter of the same place: the stored bounds. Infinite where nothing is
    /// promised.
    pub bounds: Vec<f64>,
}

/// One method's figures.
pub struct Method {
    /// What it is called.
    pub name: &'static str,
    /// Whether it is this crate's.
    pub is_ours: bool,
    /// One per parameter; NaN where it cannot be measured. A result of the method itself that is infinite or NaN
    /// counts as a failure: an error of infinity, or a trial of the share that fails.
    pub values: Vec<f64>,
}

/// What measures a sweep with so many times the usual number of trials.
pub type Measure = fn(f64) -> Sweep;

/// The names of the sweeps, in order, and what measures them.
pub const ALL: [(&str, Measure); 22] = [
    ("ray-origins-scale", ray_origins::self_hits_by_scale),
    ("ray-origins-distance", ray_origins::self_hits_by_distance),
    ("ray-contacts-scale", ray_origins::contacts_by_scale),
    ("ray-contacts-distance", ray_origins::contacts_by_distance),
    ("edges-scale", edges::by_scale),
    ("edges-distance", edges::by_distance),
    ("edges-offset", edges::by_offset),
    ("lights-distance", lights::by_distance),
    ("lights-size", lights::by_size),
    ("lights-grazing", lights::by_height),
    ("rectangles-angle", rectangles::solid_angles),
    ("rectangles-lamp", rectangles::solid_angles_of_lamps),
    ("rectangles-samples", rectangles::samples),
    ("disks-stretch", disks::stretch),
    ("disks-centre", disks::centre),
    ("disks-edge", disks::half_planes),
    ("bases", bases::near_minus_z),
    ("sums-mean", sums::means),
    ("sums-variance", sums::variances),
    ("extremes-ones", extremes::ones),
    ("extremes-near-one", extremes::near_one),
    ("extremes-near-zero", extremes::near_zero),
];

/// All sweeps, with `effort` times the usual number of trials; `begins` is told the name of each one before it is
/// measured.
pub fn all(effort: f64, begins: &mut dyn FnMut(&str)) -> Vec<Sweep> {
    let measured = ALL.iter().map(|(name, measure)| {
        begins(name);
        measure(effort)
    });
    measured.collect()
}

impl Sweep {
    /// Parameters at which a usual method fails and ours does not.
    pub fn won(&self) -> Vec<f64> {
        let fails = |method: &Method, place: usize| method.values[place] >= self.fails_from;
        let any = |ours: bool, place: usize| {
            self.methods.iter().any(|method| method.is_ours == ours && fails(method, place))
        };
        let known = |place: usize| {
            self.methods.iter().any(|method| method.is_ours && !method.values[place].is_nan())
        };
        (0..self.parameters.len())
            .filter(|&place| any(false, place) && known(place) && !any(true, place))
            .map(|place| self.parameters[place])
            .collect()
    }

    /// Where ours exceeds its stored bound: parameter, value, bound.
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
