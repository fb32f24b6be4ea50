//! [`Curve`]: a method's error over samples and time.

use super::{Reference, Run};

/// Summary of the runs of one method.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// The method's name.
    pub method: String,
    /// One point for each number of samples, in rising order.
    pub points: Vec<CurvePoint>,
}

/// Summary of the runs of one method with the same number of samples and different seeds.
#[derive(Clone, Debug, PartialEq)]
pub struct CurvePoint {
    /// Samples per pixel.
    pub spp: u32,
    /// Number of runs.
    pub runs: usize,
    /// Median of the seconds of set-up.
    pub set_up: f64,
    /// Median of the seconds of rendering.
    pub seconds: f64,
    /// Lower quartile, median and upper quartile of the error (root of relMSE), with the reference's own error subtracted.
    /// `None` if the median is not above the reference's own error.
    pub error: Option<[f64; 3]>,
    /// The same as measured, with the reference's own error included.
    pub measured: [f64; 3],
}

impl CurvePoint {
    /// Seconds of set-up and rendering.
    pub fn time(&self) -> f64 {
        self.set_up + self.seconds
    }
}

impl Curve {
    /// Summarises the runs of the method with this name.
    pub fn new(method: &str, runs: &[Run], reference: &Reference) -> Self {
        let own: Vec<&Run> = runs.iter().filter(|run| run.method == method).collect();
        let mut budgets: Vec<u32> = own.iter().map(|run| run.spp).collect();
        budgets.sort_unstable();
        budgets.dedup();
        let point = |spp: u32| {
            let runs: Vec<&Run> = own.iter().copied().filter(|run| run.spp == spp).collect();
            let of = |field: fn(&Run) -> f64| quartiles(runs.iter().map(|run| field(run)));
            let square = of(|run| run.rel_mse);
            CurvePoint {
                spp,
                runs: runs.len(),
                set_up: of(|run| run.set_up)[1],
                seconds: of(|run| run.seconds)[1],
                error: reference
                    .claimed(square[1])
                    .map(|_| square.map(|square| reference.subtracted_from(square))),
                measured: square.map(f64::sqrt),
            }
        };
        Self { method: method.into(), points: budgets.into_iter().map(point).collect() }
    }

    /// The points with a claimed error, each with its median.
    pub fn claimed(&self) -> impl Iterator<Item = (&CurvePoint, f64)> {
        self.points.iter().filter_map(|point| Some((point, point.error?[1])))
    }

    /// Order of convergence: the slope of log error over log samples, by least squares; -0.5 for independent samples.
    /// `None` for fewer than three claimed points.
    pub fn slope_by_samples(&self) -> Option<f64> {
        slope(self.claimed().map(|(point, error)| (f64::from(point.spp), error)))
    }

    /// The same over the time of rendering. Set-up is left out, because it would make the slope steeper while it dominates
    /// the time.
    pub fn slope_by_time(&self) -> Option<f64> {
        slope(self.claimed().map(|(point, error)| (point.seconds, error)))
    }

    /// The error after this many seconds, interpolated linearly between the logarithms of claimed points; `None` outside
    /// their range.
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

/// Lower quartile, median and upper quartile, interpolated linearly (definition 7 of Hyndman and Fan 1996).
fn quartiles(values: impl Iterator<Item = f64>) -> [f64; 3] {
    let mut values: Vec<f64> = values.collect();
    values.sort_unstable_by(f64::total_cmp);
    [0.25, 0.5, 0.75].map(|part| {
        let index = part * (values.len() - 1) as f64;
        let (low, high) = (values[index.floor() as usize], values[index.ceil() as usize]);
        low + (index - index.floor()) * (high - low)
    })
}

/// Slope of the least squares line through the logarithms of points.
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
