//! [`Curve`]: a method's errors over samples and time.

use super::{Reference, Run};

/// What the runs of one method say.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// The method's name.
    pub method: String,
    /// One for each number of samples, in rising order.
    pub points: Vec<CurvePoint>,
}

/// Runs of one method with the same number of samples, which differ by their seeds.
#[derive(Clone, Debug, PartialEq)]
pub struct CurvePoint {
    /// Samples per pixel.
    pub spp: u32,
    /// How many runs.
    pub runs: usize,
    /// Seconds before the rendering, median.
    pub set_up: f64,
    /// Seconds of rendering, median.
    pub seconds: f64,
    /// The error as a root of relMSE, without the reference's: lower quartile, median, upper quartile. `None` where the
    /// median is not above the reference's own error.
    pub error: Option<[f64; 3]>,
    /// The same with the reference's error in it, as it was measured.
    pub measured: [f64; 3],
}

impl CurvePoint {
    /// Seconds from the beginning to the picture.
    pub fn time(&self) -> f64 {
        self.set_up + self.seconds
    }
}

impl Curve {
    /// Collects the runs of the method of that name.
    pub fn new(method: &str, runs: &[Run], reference: &Reference) -> Self {
        let own: Vec<&Run> = runs.iter().filter(|run| run.method == method).collect();
        let mut budgets: Vec<u32> = own.iter().map(|run| run.spp).collect();
        budgets.sort_unstable();
        budgets.dedup();
        let point = |spp: u32| {
            let runs: Vec<&Run> = own.iter().copied().filter(|run| run.spp == spp).collect();
            let of = |field: fn(&Run) -> f64| quartiles(runs.iter().map(|run| field(run)));
            let square = of(|run| run.rel_mse);
            let floor = reference.floor() * reference.floor();
            let without = |square: f64| (square - floor).max(0.0).sqrt();
            CurvePoint {
                spp,
                runs: runs.len(),
                set_up: of(|run| run.set_up)[1],
                seconds: of(|run| run.seconds)[1],
                error: reference.claimed(square[1]).map(|_| square.map(without)),
                measured: square.map(f64::sqrt),
            }
        };
        Self { method: method.into(), points: budgets.into_iter().map(point).collect() }
    }

    /// The points whose error is claimed, each with its median.
    pub fn claimed(&self) -> impl Iterator<Item = (&CurvePoint, f64)> {
        self.points.iter().filter_map(|point| Some((point, point.error?[1])))
    }

    /// The slope of the error's logarithm over that of the samples, by least squares: -0.5 for independent samples.
    /// `None` for fewer than three claimed points.
    pub fn slope_by_samples(&self) -> Option<f64> {
        slope(self.claimed().map(|(point, error)| (f64::from(point.spp), error)))
    }

    /// The same over the time of rendering alone: set-up would make it steeper for as long as it is most of the time.
    pub fn slope_by_time(&self) -> Option<f64> {
        slope(self.claimed().map(|(point, error)| (point.seconds, error)))
    }

    /// The error after so many seconds, on straight lines between the logarithms of claimed points; `None` outside.
    pub fn error_at(&self, time: f64) -> Option<f64> {
        let points: Vec<_> = self.claimed().map(|(point, error)| (point.time(), error)).collect();
        points.windows(2).find_map(|pair| {
            let [(t0, e0), (t1, e1)] = [pair[0], pair[1]];
            let part = (time / t0).ln() / (t1 / t0).ln();
            (t0 <= time && time <= t1)
                .then(|| e0 * (e1 / e0).powf(if t1 > t0 { part } else { 0.0 }))
        })
    }
}

/// The points that no other point beats in both time and error, of all curves: number of the curve and point, by
/// rising time (Pareto's front).
pub fn front(curves: &[Curve]) -> Vec<(usize, &CurvePoint)> {
    let each =
        |(number, curve)| Curve::claimed(curve).map(move |(point, error)| (number, point, error));
    let mut all: Vec<_> = curves.iter().enumerate().flat_map(each).collect();
    all.sort_by(|a, b| a.1.time().total_cmp(&b.1.time()).then(a.2.total_cmp(&b.2)));
    let mut best = f64::INFINITY;
    all.retain(|&(_, _, error)| {
        let is_better = error < best;
        best = best.min(error);
        is_better
    });
    all.into_iter().map(|(number, point, _)| (number, point)).collect()
}

/// Lower quartile, median and upper quartile, on straight lines between the values (definition 7 of Hyndman and Fan
/// 1996).
fn quartiles(values: impl Iterator<Item = f64>) -> [f64; 3] {
    let mut values: Vec<f64> = values.collect();
    values.sort_unstable_by(f64::total_cmp);
    [0.25, 0.5, 0.75].map(|part| {
        let place = part * (values.len() - 1) as f64;
        let (low, high) = (values[place.floor() as usize], values[place.ceil() as usize]);
        low + (place - place.floor()) * (high - low)
    })
}

/// Of the least squares line through logarithms.
fn slope(points: impl Iterator<Item = (f64, f64)>) -> Option<f64> {
    let points: Vec<(f64, f64)> = points.map(|(x, y)| (x.ln(), y.ln())).collect();
    if points.len() < 3 {
        return None;
    }
    let count = points.len() as f64;
    let mean_x = points.iter().map(|(x, _)| x).sum::<f64>() / count;
    let mean_y = points.iter().map(|(_, y)| y).sum::<f64>() / count;
    let covariance: f64 = points.iter().map(|(x, y)| (x - mean_x) * (y - mean_y)).sum();
    let variance: f64 = points.iter().map(|(x, _)| (x - mean_x).powi(2)).sum();
    (variance > 0.0).then(|| covariance / variance)
}
