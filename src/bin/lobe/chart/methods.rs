//! The methods of a chart: the usual ones, or a list from a file.

use std::path::Path;
use std::sync::Arc;

use lobe::integrator::Integrator;
use lobe::light::LightStrategy;
use lobe::params::{Choice, Entry, Fault, Mark, Node, Shown, Value, quoted};
use lobe::render::{RenderSettings, SamplerSettings};
use lobe::sampling::SamplerKind;
use lobe::scene_file::{Place, SceneFileError, read_document, read_settings};

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

/// What a list has to contain, for messages.
const EXPECTED: &str = "expected a table [methods] with lines such as\n  \
                        \"sobol, one set\" = ['sampler.type=\"sobol\"', 'sampler.replicates=1']";

/// Something wrong in a list of methods.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
struct Wrong(String);

fn wrong(mark: Mark, what: String) -> Fault {
    Fault::new(mark, Wrong(what))
}

/// Reads methods from a TOML file: a table `[methods]`, in which each name has a list of overrides as for `--set`.
pub fn read(path: &Path, scene: &SceneArguments) -> Result<Vec<Named>, SceneFileError> {
    // What is wrong without any method is no fault of the list.
    read_settings(&scene.path, &scene.overrides())?;
    read_document(path, |document| {
        document.table("the list of methods", &["methods"])?.table("methods")?;
        let methods = document.root.follow(&["methods"]);
        if methods.entries().is_empty() {
            return Err(wrong(methods.mark, format!("there are no methods; {EXPECTED}")));
        }
        methods.entries().iter().map(|entry| method(entry, scene)).collect()
    })
}

fn method(entry: &Entry, scene: &SceneArguments) -> Result<Named, Fault> {
    let Entry { key: name, mark, node } = entry;
    if name.chars().any(char::is_control) || name.len() > 80 {
        let what = format!("{} is not a name of one line and at most 80 bytes", quoted(name));
        return Err(wrong(*mark, what));
    }
    let Value::Array(list) = &node.value else {
        let what = format!(
            "`{name}` is {}, expected a list of settings in quotes",
            Shown::name(&node.value.to_string())
        );
        return Err(wrong(node.mark, what));
    };
    let own = list.iter().map(setting).collect::<Result<Vec<_>, _>>()?;
    let mut overrides = scene.overrides();
    overrides.extend(own);
    let settings = read_settings(&scene.path, &overrides).map_err(|error| {
        let is_at = |setting: &&Node| match (&error, &setting.value) {
            (SceneFileError::Wrong { place: Place::Override { text }, .. }, Value::Text(own)) => {
                text == own
            }
            _ => false,
        };
        let mark = list.iter().find(is_at).unwrap_or(node).mark;
        wrong(mark, format!("method `{name}`: {error}"))
    })?;
    Ok((name.clone(), settings))
}

/// One override of a method's list.
fn setting(node: &Node) -> Result<&str, Fault> {
    let Value::Text(text) = &node.value else {
        return Err(wrong(
            node.mark,
            format!("{} is not a setting in quotes", Shown::name(&node.value.to_string())),
        ));
    };
    let begins_with = |keys: &[&str]| keys.iter().any(|key| text.starts_with(key));
    if !begins_with(&["sampler.", "integrator."]) {
        return Err(wrong(
            node.mark,
            format!(
                "`{}` is not a setting of a method: expected `sampler.` or `integrator.`",
                Shown::name(text)
            ),
        ));
    }
    if begins_with(&["sampler.spp", "sampler.seed"]) {
        let what =
            format!("`{}` has no effect: it is chosen by --budgets and --seeds", Shown::name(text));
        return Err(wrong(node.mark, what));
    }
    Ok(text)
}
