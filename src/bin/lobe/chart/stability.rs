//! `lobe chart --stability`: charts of numerical failures.

use std::error::Error;
use std::fmt::Write;
use std::fs::File;
use std::io::Read;
use std::path::Path;

use lobe::metrics::chart::{Axis, Chart, Line, Point, Scale, escape};
use lobe::params::Shown;

use super::folder::{Folder, check_size};
use crate::page::begin;
use crate::stability::sweep::{Method, Sweep};
use crate::stability::{ALL, all};
use crate::steps::Steps;
use crate::summary::Summary;

/// The table of all numbers, and its first line.
const TABLE: &str = "stability.csv";
const HEADER: &str = "sweep,parameter,method,is_ours,value,bound";

/// Measures all sweeps, and writes a chart of each, a table of all numbers and a page.
///
/// # Errors
/// If files cannot be written; or, after they are written, if ours exceeds a stored bound.
pub fn run(folder: &Path, effort: f64, is_quiet: bool) -> Result<(), Box<dyn Error>> {
    let folder = Folder::open(folder, TABLE, check_table)?;
    let steps = Steps::new(ALL.len() as f64, 0.0, is_quiet);
    let mut begun = 0;
    let sweeps = all(effort, &mut |name| {
        steps.done(if begun > 0 { 1.0 } else { 0.0 });
        steps.begin(name.into());
        begun += 1;
    });
    steps.clear();
    let mut csv = format!("{HEADER}\n");
    sweeps.iter().for_each(|sweep| add_rows(&mut csv, sweep));
    // First, because it marks the folder as one of these charts.
    folder.write(TABLE, csv.as_bytes())?;
    let mut page = begin("Where methods fail");
    let mut summary = Summary::default();
    let mut broken = Vec::new();
    for sweep in &sweeps {
        let svg = chart(sweep).svg();
        folder.write(&format!("{}.svg", sweep.name), svg.as_bytes())?;
        let verdict = verdict(sweep);
        let (title, about) = (escape(sweep.title), escape(&sweep.about));
        let shown = escape(&verdict);
        let _ = writeln!(page, "<h2>{title}</h2>\n<p>{about}</p>\n<p><b>{shown}</b></p>\n{svg}");
        summary.add("sweep", format!("{}: {verdict}", sweep.name));
        let each = sweep.broken().into_iter();
        broken.extend(each.map(|(parameter, value, bound)| {
            format!("{} at {parameter:e}: {value:.3e}, above {bound:.3e}", sweep.name)
        }));
    }
    page.push_str("</html>\n");
    folder.write("index.html", page.as_bytes())?;
    if !is_quiet {
        summary.add("wrote", folder.join("index.html").display());
        summary.print()?;
    }
    if broken.is_empty() {
        return Ok(());
    }
    let list = broken.join("\n  ");
    Err(format!("ours exceeds {} stored bounds:\n  {list}", broken.len()).into())
}

/// Checks that an earlier chart wrote this table.
fn check_table(path: &Path) -> Result<(), Box<dyn Error>> {
    let mut found = vec![0; HEADER.len()];
    let mut is_table = || {
        // Some files, such as pipes, have no end.
        check_size(path, 1 << 24).ok()?;
        File::open(path).and_then(|mut file| file.read_exact(&mut found)).ok()?;
        (found == HEADER.as_bytes()).then_some(())
    };
    is_table().ok_or_else(|| {
        format!(
            "`{}` is not a table of `lobe chart --stability`, whose first line is {HEADER}: choose another folder with -o",
            Shown::path(path)
        )
        .into()
    })
}

/// A sentence on where a common method fails and ours does not.
fn verdict(sweep: &Sweep) -> String {
    let won = sweep.won();
    match (won.first(), won.last()) {
        (Some(first), Some(last)) => format!(
            "a common method fails and ours does not at {} of {} parameters, from {first:.3e} to {last:.3e}",
            won.len(),
            sweep.parameters.len()
        ),
        _ => "there is no parameter at which a common method fails and ours does not".into(),
    }
}

fn chart(sweep: &Sweep) -> Chart {
    // Ours has the same style in all charts.
    const OURS: usize = 2;
    let mut usual = [1, 0, 3, 4, 5].into_iter().cycle();
    let line = |method: &Method| Line {
        name: method.name.into(),
        style: if method.is_ours { OURS } else { usual.next().unwrap_or(0) },
        is_loose: false,
        points: sweep
            .parameters
            .iter()
            .zip(&method.values)
            .map(|(&x, &y)| Point::new(x, y))
            .collect(),
    };
    Chart {
        title: sweep.title.into(),
        x: Axis {
            title: sweep.parameter.into(),
            scale: if sweep.log_parameter { Scale::Log } else { Scale::Linear },
            ..Axis::default()
        },
        y: Axis { title: sweep.measure.into(), scale: Scale::Log, ..Axis::default() },
        lines: sweep.methods.iter().map(line).collect(),
        floor: Some((sweep.fails_from, "said to fail above".into())),
        ..Chart::default()
    }
}

fn add_rows(csv: &mut String, sweep: &Sweep) {
    for method in &sweep.methods {
        for (index, (parameter, value)) in sweep.parameters.iter().zip(&method.values).enumerate() {
            let bound = match sweep.bounds[index] {
                bound if method.is_ours && bound.is_finite() => format!("{bound:e}"),
                _ => String::new(),
            };
            let (name, ours) = (method.name, method.is_ours);
            let _ =
                writeln!(csv, "{},{parameter:e},\"{name}\",{ours},{value:e},{bound}", sweep.name);
        }
    }
}
