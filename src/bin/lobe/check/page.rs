//! The page of a check: for each material its verdicts, its albedo and the shape of its lobes.

use std::error::Error;
use std::fmt::Write;
use std::path::Path;

use lobe::check::{Contract, Options, Report, with_lobes};
use lobe::image::{Display, Picture};
use lobe::metrics::chart::{Chart, escape};

use super::materials::Checked;
use super::{plots, polar};
use crate::page::{begin, data};

const ABOUT: &str = "The albedo is the fraction of uniform light that is returned, without the factor 1/η² of refraction. \
It is estimated by the mean weight of samples, by f asked at their directions, and as the integral of f |cos θ| with specular events: \
the three curves have to lie on each other. In the polar plots the radius is the cube root of f |cos θ| over its maximum, so that faint \
parts show; specular events are straight lines, whose length is the cube root of the fraction of light that they carry. Short lines outside \
mark wo. From some directions f32 does not resolve narrow lobes: there, samples are not compared with integrals.";

/// The page, which embeds everything it shows.
pub fn html(
    scene: &Path,
    checked: &[Checked],
    options: &Options,
    picture: Option<&Picture>,
    threads: usize,
) -> Result<String, Box<dyn Error>> {
    let name = scene.file_stem().unwrap_or("scene".as_ref()).to_string_lossy();
    let mut page = begin(&format!("{name}: check of materials"));
    let (samples, seed) = (options.samples, options.seed);
    let _ = writeln!(
        page,
        "<p>{samples} samples from each of eight directions, seed {seed}. {ABOUT}</p>"
    );
    if let Some(picture) = picture {
        let codes = Display::Srgb.codes(&picture.color);
        let _ = writeln!(
            page,
            "<h2>The scene</h2>\n<p>The three estimates as red, green and blue: a tint is a bug.</p>\n\
             <img class=\"whole\" alt=\"Three estimates of the albedo\" src=\"{}\">",
            data(picture.window.size(), &codes)?
        );
    }
    let charts = plots::charts(checked, samples, threads);
    for (checked, charts) in checked.iter().zip(charts) {
        section(&mut page, checked, options, &charts);
    }
    page.push_str("</html>\n");
    Ok(page)
}

fn section(page: &mut String, checked: &Checked, options: &Options, charts: &[Chart]) {
    let _ = writeln!(page, "<h2>{}</h2>", escape(checked.name));
    let heads = checked.reports.iter().enumerate().map(|(part, (name, _))| match part {
        0 => "<th>all lobes".to_owned(),
        _ => format!("<th>{}", escape(name.rsplit('/').next().unwrap_or_default())),
    });
    let _ = writeln!(page, "<table>\n<tr><th>contract{}", heads.collect::<String>());
    for contract in Contract::ALL {
        let cells = checked.reports.iter().enumerate().map(|(part, (_, report))| {
            let is_asked = contract != Contract::Loss || part == 0 && options.white.is_some();
            cell(report, contract, is_asked)
        });
        let _ = writeln!(page, "<tr><td>{}{}", contract.name(), cells.collect::<String>());
    }
    page.push_str("</table>\n");
    for (name, report) in &checked.reports {
        for finding in &report.findings {
            let (contract, detail) = (finding.contract, escape(&finding.detail));
            let _ = writeln!(
                page,
                "<p><b class=\"fault\">{}: {}</b>: {}: {detail}. To do: {}.</p>",
                escape(name),
                contract.name(),
                contract.meaning(),
                contract.hint()
            );
        }
    }
    charts.iter().for_each(|chart| page.push_str(&chart.svg()));
    page.push_str(&with_lobes(checked.material, polar::svg));
}

fn cell(report: &Report, contract: Contract, is_asked: bool) -> String {
    if report.findings.iter().any(|finding| finding.contract == contract) {
        return "<td class=\"fault\">fail".into();
    }
    if !is_asked {
        return "<td>not promised".into();
    }
    if report.has_several_indices && contract.needs_one_index() {
        return "<td>not compared: several indices".into();
    }
    let resolved = report.directions.iter().filter(|direction| direction.is_resolved).count();
    match report.directions.len() {
        all if contract.needs_resolution() && resolved < all => {
            format!("<td class=\"ok\">pass, from {resolved} of {all} directions")
        }
        _ => "<td class=\"ok\">pass".into(),
    }
}
