//! The output of a check as text: columns separated by blanks, then verdicts.

use lobe::check::{Direction, Report};
use lobe::params::Shown;

use super::materials::Checked;

const COLUMNS: [&str; 12] = [
    "line",
    "name",
    "cos",
    "band",
    "albedo",
    "error",
    "evaluated",
    "integral",
    "specular",
    "density",
    "rejected",
    "p",
];

/// A line for each direction, then one for each material or lobe without fault and for each fault.
pub fn text(checked: &[Checked]) -> String {
    let reports = || checked.iter().flat_map(|checked| &checked.reports);
    let mut rows = vec![COLUMNS.map(str::to_owned)];
    for (name, report) in reports() {
        rows.extend(report.directions.iter().flat_map(|direction| self::rows(name, direction)));
    }
    let width = |column: usize| rows.iter().map(|row| row[column].len()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..COLUMNS.len()).map(width).collect();
    let mut text = String::new();
    for [line, name, numbers @ ..] in &rows {
        text += &format!("{line:0$}  {name:1$}", widths[0], widths[1]);
        for (number, width) in numbers.iter().zip(&widths[2..]) {
            text += &format!("  {number:>width$}");
        }
        text.push('\n');
    }
    reports().for_each(|(name, report)| text += &verdict(name, report));
    text
}

/// A row, or one for each band if they differ.
fn rows(name: &str, direction: &Direction) -> Vec<[String; 12]> {
    let Direction { cos, sampled, evaluated, integrated, specular, .. } = direction;
    let bands = if is_coloured(direction) { &["r", "g", "b"][..] } else { &["all"] };
    let row = |(band, label): (usize, &&str)| {
        let fraction = |number: f64| format!("{number:.5}");
        let p = direction.p.filter(|_| direction.is_resolved);
        let p = p.map_or("-".into(), |p| format!("{p:.2e}"));
        [
            "direction".into(),
            name.into(),
            cos.to_string(),
            (*label).into(),
            fraction(sampled[band].mean),
            fraction(sampled[band].error),
            fraction(evaluated[band]),
            fraction(integrated[band] + specular[band]),
            fraction(specular[band]),
            fraction(direction.density),
            fraction(direction.rejected),
            p,
        ]
    };
    bands.iter().enumerate().map(row).collect()
}

/// Whether the bands differ.
pub fn is_coloured(direction: &Direction) -> bool {
    let Direction { sampled: [r, g, b], integrated, .. } = direction;
    let differ = |a: f64, b: f64| (a - b).abs() > 1e-6;
    let [x, y, z] = *integrated;
    differ(r.mean, g.mean) || differ(r.mean, b.mean) || differ(x, y) || differ(x, z)
}

fn verdict(name: &str, report: &Report) -> String {
    if report.findings.is_empty() {
        let left_out = match report.has_several_indices {
            true => {
                "; energy, albedo and reciprocity are not compared: light crosses with several indices"
            }
            false => "",
        };
        return format!("ok     {name}{left_out}\n");
    }
    let line = |finding: &lobe::check::Finding| {
        let (contract, detail) = (finding.contract, Shown::whole(&finding.detail));
        format!("fault  {name}  {}: {detail}; {}\n", contract.name(), contract.hint())
    };
    report.findings.iter().map(line).collect()
}
