//! [`pareto_front`]: the best method for each time.

use super::{Curve, CurvePoint};

/// The Pareto front of all curves: the claimed points that no other point beats in both time and error, by rising time,
/// each with the index of its curve.
pub fn pareto_front(curves: &[Curve]) -> Vec<(usize, &CurvePoint)> {
    let each =
        |(index, curve)| Curve::claimed(curve).map(move |(point, error)| (index, point, error));
    let mut all: Vec<_> = curves.iter().enumerate().flat_map(each).collect();
    all.sort_by(|a, b| a.1.time().total_cmp(&b.1.time()).then(a.2.total_cmp(&b.2)));
    let mut best = f64::INFINITY;
    all.retain(|&(_, _, error)| {
        let is_better = error < best;
        best = best.min(error);
        is_better
    });
    all.into_iter().map(|(index, point, _)| (index, point)).collect()
}
