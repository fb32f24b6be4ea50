//! The results of a chart: files in its folder, and a summary on the terminal.

use std::error::Error;

use lobe::metrics::convergence::{Bias, Other, Study, pareto_front};

use super::measure::{Bench, Measured};
use super::page;
use crate::summary::Summary;

/// Writes charts, tables and the page, and prints the summary.
pub fn write(
    bench: &Bench,
    measured: Measured,
    others: Vec<Other>,
    scene: &str,
) -> Result<(), Box<dyn Error>> {
    let Measured { reference, curves, biases, check, plan } = measured;
    let folder = &bench.results.folder;
    let study = Study { scene: scene.into(), reference, curves, biases, others };
    let charts = [
        ("error-by-time.svg", study.error_by_time()),
        ("error-by-samples.svg", study.error_by_samples()),
        ("equal-time.svg", study.error_at_equal_time()),
    ];
    let mut written = Vec::new();
    for (name, chart) in &charts {
        folder.write(name, chart.svg().as_bytes())?;
        written.push(*name);
    }
    folder.write("curves.csv", study.csv().as_bytes())?;
    let remarks = remarks(bench, &study, &check);
    let [by_time, by_samples, equal_time] = &charts;
    let page =
        page::html(bench, &study, &plan, &remarks, [&by_time.1, &by_samples.1, &equal_time.1])?;
    folder.write("index.html", page.as_bytes())?;
    written.extend(["curves.csv", "runs.csv", "index.html"]);
    if bench.is_quiet {
        return Ok(());
    }

    let mut summary = Summary::default();
    summary.add("scene", scene);
    summary.add("samples", format!("{:?} per pixel, {} seeds each", plan.budgets, plan.seeds));
    summary.add("reference", format!("{:.3e} own error, root of relMSE", study.reference.floor()));
    for curve in &study.curves {
        let slope = curve.slope_by_samples().map_or("no slope".into(), |s| format!("slope {s:.3}"));
        let last = curve.claimed().last();
        let last = last.map_or("nothing claimed".into(), |(point, error)| {
            format!("{error:.3e} after {} samples, {:.3} s", point.spp, point.time())
        });
        summary.add("method", format!("{}: {last}, {slope}", curve.method));
    }
    for (index, point) in pareto_front(&study.curves) {
        let error = point.error.map_or(0.0, |error| error[1]);
        let name = &study.curves[index].method;
        summary.add(
            "best",
            format!("{:.3} s: {name}, {} samples, {error:.3e}", point.time(), point.spp),
        );
    }
    for remark in &remarks {
        summary.add("note", remark);
    }
    for name in written {
        summary.add("wrote", folder.join(name).display());
    }
    Ok(summary.print()?)
}

/// Remarks on which results can be trusted.
fn remarks(bench: &Bench, study: &Study, check: &Bias) -> Vec<String> {
    let mut remarks = bench.notes.clone();
    let Study { reference, curves, biases, .. } = study;
    let more = "give it more samples with --reference and --fresh";
    remarks.extend(reference.distrust().map(|distrust| format!("{distrust}; {more}")));
    let points = || curves.iter().flat_map(|curve| &curve.points);
    let hidden = points().filter(|point| point.error.is_none()).count();
    if hidden > 0 {
        remarks.push(format!(
            "{hidden} of {} points are below the reference's own error and not claimed; {more}",
            points().count()
        ));
    }
    remarks.push(if check.is_certain() {
        format!(
            "the reference differs from its check (light sampling alone, independent samples) by {:.2e}, which noise does \
             not explain: one of them is wrong, or rare bright samples are missing",
            check.size()
        )
    } else {
        "the reference agrees with its check (light sampling alone, independent samples) within noise".into()
    });
    for (curve, bias) in curves.iter().zip(biases) {
        let Some(bias) = bias.filter(Bias::is_certain) else { continue };
        let (mean, error) = bias.mean;
        remarks.push(format!(
            "{} is biased by {:.2e}, which more samples do not reduce; its mean is off by {mean:+.2e} in radiance \
             (standard error {error:.1e})",
            curve.method,
            bias.size()
        ));
    }
    remarks
}
