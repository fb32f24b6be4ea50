//! The measurements behind the stability charts, with few trials: that ours keeps its stored bounds, and that each
//! chart has a place where a usual method fails and ours does not.

#[path = "../../src/bin/lobe/stability/mod.rs"]
mod stability;

mod ray_origins;

use stability::Sweep;

/// A hundredth of the usual trials.
fn sweeps() -> Vec<Sweep> {
    let mut begun = Vec::new();
    let sweeps = stability::all(0.01, &mut |name| begun.push(name.to_owned()));
    assert_eq!(begun, sweeps.iter().map(|sweep| sweep.name).collect::<Vec<_>>());
    sweeps
}
