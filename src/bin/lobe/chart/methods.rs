//! The methods of a chart: the usual ones, or a list from a file.

use std::error::Error;
use std::fs;
use std::path::Path;
use std::sync::Arc;

use lobe::integrator::Integrator;
use lobe::light::LightStrategy;
use lobe::params::Choice;
use lobe::render::{RenderSettings, SamplerSettings};
use lobe::sampling::SamplerKind;
use lobe::scene_file::{SceneFileError, read_settings};
use toml::de::{DeTable, DeValue};

use crate::scene::SceneArguments;

/// A method: name and settings.
pub type Named = (String, RenderSettings);

/// Each sampler with the scene's integrator; and Sobol points with each other light strategy, and with roulette switched
/// on or off. Settings that the scene's integrator does not have are skipped.
pub fn usual(scene: &SceneArguments) -> Result<Vec<Named>, SceneFileError> {
    let RenderSettings { sampler, integrator } = read_settings(&scene.path, &scene.overrides())?;
    let of_kind = |kind: SamplerKind| {
        let sampler = SamplerSettings { kind, ..sampler };
        (kind.name().to_owned(), RenderSettings { sampler, integrator: integrator.clone() })
    };
    let mut all: Vec<Named> = SamplerKind::all().map(of_kind).collect();
    let strategies = LightStrategy::CHOICES
        .iter()
        .map(|(name, _)| (format!("integrator.strategy={name:?}"), (*name).to_owned()));
    let roulette = [(true, "roulette"), (false, "no roulette")]
        .map(|(is_on, name)| (format!("integrator.roulette={is_on}"), name.to_owned()));
    for (change, name) in strategies.chain(roulette) {
        let changed = with_changes(scene, &integrator, &[&change]);
        if changed.describe() != integrator.describe() {
            let sampler = SamplerSettings { kind: SamplerKind::SOBOL, ..sampler };
            let name = format!("{}, {name}", sampler.kind.name());
            all.push((name, RenderSettings::new(sampler, changed)));
        }
    }
    Ok(all)
}

/// The scene's integrator with these overrides, except for keys that it does not have.
pub fn with_changes(
    scene: &SceneArguments,
    integrator: &Arc<dyn Integrator>,
    changes: &[&str],
) -> Arc<dyn Integrator> {
    let (mut overrides, mut changed) = (scene.overrides(), integrator.clone());
    for &change in changes {
        overrides.push(change);
        match read_settings(&scene.path, &overrides) {
            Ok(settings) => changed = settings.integrator,
            Err(_) => drop(overrides.pop()),
        }
    }
    changed
}

/// Reads methods from a TOML file: a table `[methods]`, in which each name has a list of overrides as for `--set`.
pub fn read(path: &Path, scene: &SceneArguments) -> Result<Vec<Named>, Box<dyn Error>> {
    let shown = path.display();
    let text =
        fs::read_to_string(path).map_err(|error| format!("cannot read `{shown}`: {error}"))?;
    let table = DeTable::parse(&text).map_err(|error| {
        let start = error.span().map_or(0, |span| span.start);
        let line = 1 + text[..start].matches('\n').count();
        format!("{shown}:{line}: {}", error.message())
    })?;
    let wrong = |what: &str| {
        format!(
            "{shown}: {what}; expected a table [methods] with lines such as\n  \
             \"sobol, one set\" = ['sampler.type=\"sobol\"', 'sampler.replicates=1']"
        )
    };
    let methods = match table.get_ref().iter().next() {
        Some((key, value)) if key.get_ref() == "methods" && table.get_ref().len() == 1 => value,
        Some((key, _)) => return Err(wrong(&format!("unknown table `{}`", key.get_ref())).into()),
        None => return Err(wrong("it is empty").into()),
    };
    let DeValue::Table(methods) = methods.get_ref() else {
        return Err(wrong("`methods` is not a table").into());
    };
    let mut all = Vec::new();
    for (name, list) in methods {
        let name = name.get_ref();
        let DeValue::Array(list) = list.get_ref() else {
            return Err(wrong(&format!("`{name}` is not a list")).into());
        };
        let text = |value: &toml::Spanned<DeValue>| match value.get_ref() {
            DeValue::String(text) => Some(text.to_string()),
            _ => None,
        };
        let own: Option<Vec<String>> = list.iter().map(text).collect();
        let own = own.ok_or_else(|| {
            wrong(&format!("the list of `{name}` has values that are not strings"))
        })?;
        let is_allowed =
            |set: &&String| ["sampler.", "integrator."].iter().any(|p| set.starts_with(p));
        if let Some(other) = own.iter().find(|set| !is_allowed(set)) {
            let what = format!(
                "`{name}` sets `{other}`, but methods can only set `sampler.` and `integrator.`"
            );
            return Err(wrong(&what).into());
        }
        if name.chars().any(char::is_control) || name.len() > 80 {
            return Err(
                wrong(&format!("{name:?} is not a name of one line and at most 80 bytes")).into()
            );
        }
        let is_planned =
            |set: &&String| ["sampler.spp", "sampler.seed"].iter().any(|p| set.starts_with(p));
        if let Some(other) = own.iter().find(is_planned) {
            let what = format!("`{name}` sets `{other}`, which is chosen by --budgets and --seeds");
            return Err(wrong(&what).into());
        }
        let mut overrides = scene.overrides();
        overrides.extend(own.iter().map(String::as_str));
        let settings = read_settings(&scene.path, &overrides)
            .map_err(|error| format!("{shown}: method `{name}`: {error}"))?;
        all.push((name.to_string(), settings));
    }
    if all.is_empty() { Err(wrong("[methods] is empty").into()) } else { Ok(all) }
}
