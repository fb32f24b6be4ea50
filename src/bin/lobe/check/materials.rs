//! [`Checked`]: a material with the reports on it and on each of its lobes.

use std::error::Error;

use lobe::bxdf::ScaledBxDF;
use lobe::check::{Options, Report, check as check_lobe, check_material, with_lobes};
use lobe::material::Material;
use lobe::params::{Problem, Shown};
use lobe::scene_file::LoadedScene;

use super::parallel::map;
use crate::steps::Steps;

/// A material by name.
pub type Named<'a> = (&'a str, &'a dyn Material);

/// A material and what was found.
pub struct Checked<'a> {
    pub name: &'a str,
    pub material: &'a dyn Material,
    /// The names of it and of its lobes, if it has several, and the reports on them.
    pub reports: Vec<(String, Report)>,
}

impl Checked<'_> {
    /// Whether neither the material nor any lobe has a fault.
    pub fn is_ok(&self) -> bool {
        self.reports.iter().all(|(_, report)| report.findings.is_empty())
    }
}

/// The materials of a scene, or the one of this name.
pub fn select<'a>(
    loaded: &'a LoadedScene,
    name: Option<&str>,
) -> Result<Vec<Named<'a>>, Box<dyn Error>> {
    let Some(name) = name else {
        let all: Vec<_> = loaded.materials().collect();
        return if all.is_empty() { Err("the scene has no materials".into()) } else { Ok(all) };
    };
    let found = loaded.materials().find(|(known, _)| *known == name);
    let known = loaded.materials().map(|(known, _)| known);
    Ok(vec![found.ok_or_else(|| Problem::unknown_name("material", name, known))?])
}

/// Checks each material, and where it has several lobes, each of them.
pub fn check<'a>(materials: Vec<Named<'a>>, options: &Options, threads: usize) -> Vec<Checked<'a>> {
    let names: Vec<_> = materials.iter().map(|(name, material)| names(name, *material)).collect();
    let jobs: Vec<_> = names
        .iter()
        .enumerate()
        .flat_map(|(at, names)| (0..names.len()).map(move |part| (at, part)))
        .collect();
    let options = Options { checks: jobs.len() as u32, ..*options };
    let steps = Steps::new(jobs.len() as f64, 0.0, false);
    steps.begin("checking".into());
    let reports = map(jobs.len(), threads, &|| steps.done(1.0), &|job| {
        let (at, part) = jobs[job];
        check_part(materials[at].1, part, &options)
    });
    let mut reports = reports.into_iter();
    let checked = materials.into_iter().zip(names).map(|((name, material), names)| Checked {
        name,
        material,
        reports: names.into_iter().zip(reports.by_ref()).collect(),
    });
    checked.collect()
}

/// The name of a material, and those of its lobes if there are several.
fn names(name: &str, material: &dyn Material) -> Vec<String> {
    let name: String =
        Shown::whole(name).to_string().split_whitespace().collect::<Vec<_>>().join("_");
    with_lobes(material, |bsdf| {
        let lobes = bsdf.lobes().enumerate();
        let lobes = lobes.map(|(i, (lobe, _))| format!("{name}/{}:{}", i + 1, lobe.name()));
        let several = if bsdf.lobes().len() > 1 { usize::MAX } else { 0 };
        [name.clone()].into_iter().chain(lobes.take(several)).collect()
    })
}

/// Part 0 is the material, the others are its lobes, which alone return less than all light.
fn check_part(material: &dyn Material, part: usize, options: &Options) -> Report {
    let Some(lobe) = part.checked_sub(1) else { return check_material(material, options) };
    let options = Options { white: None, ..*options };
    with_lobes(material, |bsdf| {
        let lobe = bsdf.lobes().nth(lobe);
        lobe.map_or_else(Report::default, |(&lobe, scale)| {
            check_lobe(&ScaledBxDF::new(lobe, scale), &options)
        })
    })
}
