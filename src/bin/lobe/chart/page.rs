//! The HTML page of a chart: curves, pictures and numbers in one file.

use std::error::Error;
use std::fmt::Write;

use lobe::glam::UVec2;
use lobe::image::{Display, Image};
use lobe::metrics::chart::{Chart, escape};
use lobe::metrics::convergence::{Curve, Study};
use lobe::metrics::{ErrorMap, Errors, Viewing};

use super::measure::Bench;
use super::plan::Plan;
use crate::page::{begin, data};

/// Columns and rows of the crop that is shown of each picture.
const CROP: u32 = 96;

/// The page, which embeds everything it shows.
pub fn html(
    bench: &Bench,
    study: &Study,
    plan: &Plan,
    remarks: &[String],
    charts: [&Chart; 3],
) -> Result<String, Box<dyn Error>> {
    let mut page = begin(&format!("{}: error against time", study.scene));
    let size = bench.loaded.view.film().window().size();
    let _ = writeln!(
        page,
        "<p>{} × {} pixels, {} triangles, {} threads. Medians of {} seeds; bars are quartiles. Errors are roots of relMSE, \
         the mean of (a − b)² / (b² + 0.01), against a reference of {} samples with other seeds, whose own error of {:.2e} \
         is subtracted. The grey band is the Pareto front: points that no other method beats in both time and error.</p>\n<ul>",
        size.x,
        size.y,
        bench.loaded.scene.accel().triangle_count(),
        bench.threads,
        plan.seeds,
        f64::from(Plan::PARTS) * f64::from(plan.part_spp),
        study.reference.floor()
    );
    for remark in remarks {
        let _ = writeln!(page, "<li>{}</li>", escape(remark));
    }
    page.push_str("</ul>\n");
    for chart in charts {
        page.push_str(&chart.svg());
    }
    pictures(&mut page, bench, study)?;
    table(&mut page, study);
    page.push_str("</html>\n");
    Ok(page)
}

/// For each method, a picture after the same time and its signed error, cropped to where the methods are worst.
fn pictures(page: &mut String, bench: &Bench, study: &Study) -> Result<(), Box<dyn Error>> {
    let reference = study.reference.image();
    let Some(time) = common_time(&study.curves) else { return Ok(()) };
    let mut shots = Vec::new();
    for (method, curve) in bench.methods.iter().zip(&study.curves) {
        let spp = samples_in(curve, time);
        let (image, [set_up, seconds]) = method.render(spp, bench.seed(1))?;
        let errors = Errors::between(&image, reference)?;
        let (flip, _) = ErrorMap::flip(&image, reference, Viewing::default())?;
        shots.push((method.name(), spp, set_up + seconds, image, errors, flip.mean()));
    }
    let maps: Vec<ErrorMap> = shots
        .iter()
        .map(|(_, _, _, image, ..)| ErrorMap::signed(image, reference))
        .collect::<Result<_, _>>()?;
    // The median: one bad method should not hide the errors of all others.
    let mut limits: Vec<f32> = maps.iter().map(|map| map.limit).collect();
    limits.sort_unstable_by(f32::total_cmp);
    let limit = limits[limits.len() / 2];
    let window = worst(&maps, reference.size);
    let display = bench.loaded.view.film().display;
    let _ = writeln!(
        page,
        "<h2>The reference</h2>\n<img class=\"whole\" alt=\"The reference\" src=\"{}\">\n\
         <h2>Each method after about {time:.2} s</h2>\n<p>A crop of {} × {} pixels from column {} and row {}, where the methods are worst, and \
         its error: blue is too dark, red too bright; the scale ends at {limit:.1e}. FLIP is for the whole picture.</p>\n\
         <div class=\"grid\">",
        data(reference.size, &display.codes(&reference.pixels))?,
        window.size.x,
        window.size.y,
        window.at.x,
        window.at.y
    );
    figure(page, &window, display, reference, None, "reference")?;
    for ((name, spp, seconds, image, errors, flip), map) in shots.iter().zip(maps) {
        let error = study.reference.claimed(errors.rel_mse);
        let error = error.map_or("not claimed".into(), |error| format!("{error:.2e}"));
        let caption =
            format!("{name}: {spp} samples, {seconds:.2} s, error {error}, FLIP {flip:.4}");
        figure(page, &window, display, image, Some(&ErrorMap { limit, ..map }), &caption)?;
    }
    page.push_str("</div>\n");
    Ok(())
}

fn figure(
    page: &mut String,
    window: &Crop,
    display: Display,
    image: &Image,
    map: Option<&ErrorMap>,
    caption: &str,
) -> Result<(), Box<dyn Error>> {
    let caption = escape(caption);
    let part = data(window.size, &window.of(&display.codes(&image.pixels), image.size))?;
    let _ = write!(page, "<figure><div class=\"pair\"><img alt=\"{caption}\" src=\"{part}\">");
    if let Some(map) = map {
        let part = data(window.size, &window.of(&map.codes(), image.size))?;
        let _ = write!(page, "<img alt=\"Its error\" src=\"{part}\">");
    }
    let _ = writeln!(page, "</div><figcaption>{caption}</figcaption></figure>");
    Ok(())
}

/// A rectangle of the pictures.
struct Crop {
    at: UVec2,
    size: UVec2,
}

impl Crop {
    /// This rectangle's part of a picture's codes.
    fn of(&self, codes: &[u8], size: UVec2) -> Vec<u8> {
        let row = |y: u32| {
            let start = 3 * ((self.at.y + y) * size.x + self.at.x) as usize;
            &codes[start..start + 3 * self.size.x as usize]
        };
        (0..self.size.y).flat_map(row).copied().collect()
    }
}

/// The crop with the largest sum of squared errors, at multiples of half its size.
fn worst(maps: &[ErrorMap], size: UVec2) -> Crop {
    let part = size.min(UVec2::splat(CROP));
    let sum = |at: UVec2| {
        let row = |map: &ErrorMap, y: u32| {
            let start = ((at.y + y) * size.x + at.x) as usize;
            let values = &map.values[start..start + part.x as usize];
            values
                .iter()
                .map(|&value| f64::from(value.clamp(-map.limit, map.limit).powi(2)))
                .sum::<f64>()
        };
        maps.iter().map(|map| (0..part.y).map(|y| row(map, y)).sum::<f64>()).sum::<f64>()
    };
    let step = (part / 2).max(UVec2::ONE);
    let starts = |size: u32, part: u32, step: u32| (0..=size - part).step_by(step as usize);
    let all = starts(size.y, part.y, step.y)
        .flat_map(|y| starts(size.x, part.x, step.x).map(move |x| UVec2::new(x, y)));
    let at = all.max_by(|&a, &b| sum(a).total_cmp(&sum(b))).unwrap_or_default();
    Crop { at, size: part }
}

/// Geometric mean of the ends of the time range that all curves cover; if there is none, the time of the fastest method
/// with the largest number of samples.
fn common_time(curves: &[Curve]) -> Option<f64> {
    let ends = |curve: &Curve| Some((curve.points.first()?.time(), curve.points.last()?.time()));
    let low = curves.iter().filter_map(ends).map(|(low, _)| low).fold(0.0, f64::max);
    let high = curves.iter().filter_map(ends).map(|(_, high)| high).fold(f64::INFINITY, f64::min);
    high.is_finite().then(|| if low < high { (low * high).sqrt() } else { high })
}

/// Number of samples that a method takes in this time.
fn samples_in(curve: &Curve, time: f64) -> u32 {
    let (Some(first), Some(last)) = (curve.points.first(), curve.points.last()) else { return 1 };
    let more = f64::from(last.spp - first.spp);
    let each = (last.time() - first.time()) / more;
    // A single point, or points of equal time, do not determine the time per sample.
    if more == 0.0 || each <= 0.0 {
        return first.spp;
    }
    (f64::from(first.spp) + (time - first.time()) / each).round().max(1.0) as u32
}

fn table(page: &mut String, study: &Study) {
    page.push_str(
        "<h2>Numbers</h2>\n<table>\n<tr><th>method<th>samples<th>set-up, s<th>rendering, s<th>error<th>quartiles\n",
    );
    for curve in &study.curves {
        for point in &curve.points {
            let (error, range) = match point.error {
                Some([q1, median, q3]) => {
                    (format!("{median:.3e}"), format!("{q1:.3e} to {q3:.3e}"))
                }
                None => ("not claimed".into(), String::new()),
            };
            let _ = writeln!(
                page,
                "<tr><td>{}<td>{}<td>{:.4}<td>{:.4}<td>{error}<td>{range}",
                escape(&curve.method),
                point.spp,
                point.set_up,
                point.seconds
            );
        }
    }
    for other in &study.others {
        let error = study.reference.claimed(other.rel_mse);
        let error = error.map_or("not claimed".into(), |error| format!("{error:.3e}"));
        let label = escape(&other.label);
        let _ = writeln!(page, "<tr><td>{label}<td><td><td>{:.4}<td>{error}<td>", other.seconds);
    }
    page.push_str("</table>\n");
}
