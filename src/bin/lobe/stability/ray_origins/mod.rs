//! Ray origins: methods to move them off the surface, and the self-hits and lost contacts that result.

pub mod measure;
pub mod method;
pub mod placement;
mod scene;
mod triangle_test;

use measure::{Failure, measure};
use placement::Placement;

use super::sweep::Sweep;
use super::tally::{half_decades, measured, trials};

/// Indices of the crate's triangle test and of the common one in the counts.
const CRATES: usize = 0;
const PLAIN: usize = 1;

/// Self-hits at scales from 1e-6 to 1e6.
pub fn self_hits_by_scale(effort: f64) -> Sweep {
    let mut sweep = by_scale(Failure::SelfHit, effort);
    sweep.name = "ray-origins-scale";
    sweep.title = "False self-hits, by the scene's scale";
    sweep.about += " From a scale of 10,000 on a fixed epsilon hits its own surface with a third of all rays and \
                    more; with the crate's test it would with 4 to 8 in 100,000.";
    sweep.bounds.fill(0.0);
    sweep
}

/// Self-hits of a scene of scale 1 far from the origin.
pub fn self_hits_by_distance(effort: f64) -> Sweep {
    let mut sweep = by_distance(Failure::SelfHit, effort);
    sweep.name = "ray-origins-distance";
    sweep.title = "False self-hits, by the scene's distance from the origin";
    sweep.bounds.fill(0.0);
    sweep
}

/// Contacts at scales from 1e-6 to 1e6.
pub fn contacts_by_scale(effort: f64) -> Sweep {
    let mut sweep = by_scale(Failure::LostContact, effort);
    sweep.name = "ray-contacts-scale";
    sweep.title = "Lost contacts, by the scene's scale";
    sweep.bounds.fill(CONTACTS);
    sweep
}

/// Contacts of a scene of scale 1 far from the origin.
pub fn contacts_by_distance(effort: f64) -> Sweep {
    let mut sweep = by_distance(Failure::LostContact, effort);
    sweep.name = "ray-contacts-distance";
    sweep.title = "Lost contacts, by the scene's distance from the origin";
    sweep.about += " From a distance of 3000 on ours loses most of them, and the fixed epsilon fewer: the offset \
                    exceeds the gap before floats cease to resolve it. Beyond that nothing can be measured.";
    for (bound, &distance) in sweep.bounds.iter_mut().zip(&sweep.parameters) {
        *bound = if distance <= 1000.0 { CONTACTS } else { f64::INFINITY };
    }
    sweep
}

/// Up to one contact in 100,000 is lost to the triangle test's error bound.
const CONTACTS: f64 = 1e-4;

fn rays(effort: f64) -> u32 {
    trials(50_000, effort, 300)
}

fn by_scale(failure: Failure, effort: f64) -> Sweep {
    let placement = |scale| Placement { scale, distance: 0.0 };
    let mut sweep = sweep(failure, half_decades(-6, 6), effort, placement);
    sweep.parameter = "scale of the scene (scene units)";
    sweep
}

fn by_distance(failure: Failure, effort: f64) -> Sweep {
    let placement = |distance| Placement { scale: 1.0, distance };
    let mut sweep = sweep(failure, half_decades(0, 6), effort, placement);
    sweep.parameter = "distance from the origin (sizes of the scene)";
    sweep
}

fn sweep(
    failure: Failure,
    parameters: Vec<f64>,
    effort: f64,
    placement: impl Fn(f64) -> Placement + Sync,
) -> Sweep {
    let rays = rays(effort);
    let named = [
        ("fixed epsilon, plain test", false),
        ("Waechter-Binder, plain test", false),
        ("error bounds, plain test", false),
        ("error bounds, crate's test (ours)", true),
    ];
    let methods = measured(&parameters, named, |_, parameter| {
        let Some([fixed, binder, bounds, _]) = measure(failure, placement(parameter), rays) else {
            return [f64::NAN; 4];
        };
        [fixed[PLAIN], binder[PLAIN], bounds[PLAIN], bounds[CRATES]]
            .map(|count| f64::from(count) / f64::from(rays))
    });
    let trial = match failure {
        Failure::SelfHit => {
            "A ray leaves a hit on a flat patch of four triangles of random shape, and must hit none of them: the \
             exact hit point is in their plane, and the direction leaves it by a sine of 1e-6 or more."
        }
        Failure::LostContact => {
            "A ray leaves a hit towards a plate that is parallel to the surface, 1e-3 of the scale away, and must \
             hit it: by f64, it does from every start between the exact point and the plate."
        }
    };
    Sweep {
        name: "",
        title: "",
        about: format!(
            "{trial} {rays} rays for each point. A fixed epsilon is 1e-4 along the normal; Waechter and Binder's \
             offset is that of Ray Tracing Gems 2019, chapter 6; error bounds are those of PBRT, section 3.9.5. The \
             plain triangle test is Möller and Trumbore's of 1997; the crate's takes no hit at a t within the bound \
             of its error."
        ),
        parameter: "",
        log_parameter: true,
        measure: "share of rays that fail",
        methods,
        fails_from: 1e-3,
        bounds: vec![f64::INFINITY; parameters.len()],
        parameters,
    }
}
