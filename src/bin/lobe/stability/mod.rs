//! Where numerical methods fail: common ones from the literature, and this crate's, on the same axes.
//!
//! Each [`Sweep`] answers one question at 8 to 30 values of a parameter. The common methods are written here in f32, as
//! their sources print them; ours are the crate's public functions, called as a user would. The truth is a closed form, or
//! computed in f64 from the f32 inputs. Random numbers come from a generator of its own ([`rng`]), so that the same effort
//! gives the same figures on every platform.

mod bases;
mod disks;
mod edges;
mod extremes;
mod facets;
mod fresnel;
mod lights;
pub mod ray_origins;
mod rectangles;
mod rng;
mod sums;
pub mod sweep;
mod tally;
mod textures;
mod usual_rectangle;
mod usual_triangle;

use sweep::Sweep;

/// Measures a sweep; the argument is the factor on the number of trials.
pub type Measure = fn(f64) -> Sweep;

/// The names of the sweeps, in order, and the functions that measure them.
pub const ALL: [(&str, Measure); 30] = [
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
    ("fresnel-index", fresnel::near_one),
    ("fresnel-critical", fresnel::critical_angle),
    ("facets-smooth", facets::toward_smooth),
    ("facets-pole", facets::pole),
    ("facets-horizon", facets::horizon),
    ("facets-samples", facets::visible_normals),
    ("textures-grazing", textures::grazing),
    ("textures-distance", textures::distance),
];

/// All sweeps, with `effort` times the usual number of trials. Calls `begins` with the name of each before it is
/// measured.
pub fn all(effort: f64, begins: &mut dyn FnMut(&str)) -> Vec<Sweep> {
    let measured = ALL.iter().map(|(name, measure)| {
        begins(name);
        measure(effort)
    });
    measured.collect()
}
