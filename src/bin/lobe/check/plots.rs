//! The albedo of a material over the angle, in three ways.

use lobe::check::{Direction, albedo, with_lobes};
use lobe::metrics::chart::{Axis, Chart, Line, Point};

use super::materials::Checked;
use super::parallel::map;
use super::table::is_coloured;
use crate::steps::Steps;

/// Angles of a curve, from the normal to the other side: the middles of equal parts, so none is along the surface.
const ANGLES: usize = 24;

/// The most samples of a point of a curve.
const SAMPLES: u32 = 1 << 14;

fn angle(index: usize) -> f64 {
    180.0 * (index as f64 + 0.5) / ANGLES as f64
}

/// Charts of each material: one, or one for each band if it is coloured.
pub fn charts(checked: &[Checked], samples: u32, threads: usize) -> Vec<Vec<Chart>> {
    let points = checked.len() * ANGLES;
    let steps = Steps::new(points as f64, 0.0, false);
    steps.begin("curves".into());
    let curves = map(points, threads, &|| steps.done(1.0), &|point| {
        let cos = angle(point % ANGLES).to_radians().cos() as f32;
        let material = checked[point / ANGLES].material;
        with_lobes(material, |bsdf| albedo(bsdf, cos, samples.min(SAMPLES)))
    });
    curves.chunks(ANGLES).map(of_material).collect()
}

fn of_material(curve: &[Direction]) -> Vec<Chart> {
    match curve.iter().any(is_coloured) {
        true => {
            ["red", "green", "blue"].iter().enumerate().map(|(i, b)| chart(curve, i, b)).collect()
        }
        false => vec![chart(curve, 0, "all bands")],
    }
}

fn chart(curve: &[Direction], band: usize, name: &str) -> Chart {
    let line = |name: &str, style: usize, value: &dyn Fn(&Direction) -> f64| Line {
        name: name.into(),
        style,
        is_loose: false,
        points: (0..).map(angle).zip(curve).map(|(x, at)| Point::new(x, value(at))).collect(),
    };
    Chart {
        title: format!("Albedo, {name}"),
        x: Axis {
            title: "angle between wo and the normal, in degrees; from 90 on, from the inner side"
                .into(),
            ticks: Some((0..=6).map(|i| 30.0 * f64::from(i)).collect()),
            least: Some((0.0, 180.0)),
            ..Axis::default()
        },
        y: Axis {
            title: "fraction of uniform light".into(),
            least: Some((0.0, 1.0)),
            ..Axis::default()
        },
        lines: vec![
            line("own samples", 0, &|at| at.sampled[band].mean),
            line("f at these", 1, &|at| at.evaluated[band]),
            line("integral of f", 2, &|at| at.integrated[band] + at.specular[band]),
        ],
        ..Chart::default()
    }
}
