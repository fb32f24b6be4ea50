//! Which methods are charted: those that a user might choose from, or a list from a file.

use std::error::Error;
use std::fs;
use std::path::Path;

use lobe::params::Choice;
use lobe::scene::{IntegratorSettings, LightStrategy, SamplerKind, SamplerSettings};
use lobe::scene_file::read_settings;
use toml::de::{DeTable, DeValue};

use crate::scene::SceneArguments;

/// A name, and what it stands for.
pub type Named = (String, SamplerSettings, IntegratorSettings);

/// All samplers with the scene's integrator; and with Sobol points the other ways to find light, and the other choice of
/// roulette.
pub fn usual(sampler: SamplerSettings, integrator: IntegratorSettings) -> Vec<Named> {
    let with = |kind| SamplerSettings { kind, ..sampler };
    let of_kind = |kind: SamplerKind| (kind.name().to_owned(), with(kind), integrator);
    let mut all: Vec<Named> = SamplerKind::all().map(of_kind).collect();
    let sobol = with(SamplerKind::SOBOL);
    let name = sobol.kind.name();
    for (other, strategy) in LightStrategy::CHOICES.iter().map(|&(name, other)| (other, name)) {
        let changed = with_strategy(integrator, other);
        if changed != integrator {
            all.push((format!("{name}, {strategy}"), sobol, changed));
        }
    }
    if let IntegratorSettings::Path { max_depth, roulette, strategy } = integrator {
        let roulette_is = if roulette { "no roulette" } else { "roulette" };
        let changed = IntegratorSettings::Path { max_depth, roulette: !roulette, strategy };
        all.push((format!("{name}, {roulette_is}"), sobol, changed));
    }
    all
}

/// The integrator with another strategy, if it has one.
pub fn with_strategy(integrator: IntegratorSettings, to: LightStrategy) -> IntegratorSettings {
    match integrator {
        IntegratorSettings::Chapter { .. } => integrator,
        IntegratorSettings::Direct { .. } => IntegratorSettings::Direct { strategy: to },
        IntegratorSettings::Path { max_depth, roulette, .. } => {
            IntegratorSettings::Path { max_depth, roulette, strategy: to }
        }
    }
}

/// The methods of a file: a table `[methods]`, in which each name has a list of what `--set` takes.
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
        None => return Err(wrong("there is nothing in it").into()),
    };
    let DeValue::Table(methods) = methods.get_ref() else {
        return Err(wrong("`methods` is no table").into());
    };
    let mut all = Vec::new();
    for (name, list) in methods {
        let name = name.get_ref();
        let DeValue::Array(list) = list.get_ref() else {
            return Err(wrong(&format!("`{name}` has no list")).into());
        };
        let text = |value: &toml::Spanned<DeValue>| match value.get_ref() {
            DeValue::String(text) => Some(text.to_string()),
            _ => None,
        };
        let own: Option<Vec<String>> = list.iter().map(text).collect();
        let own = own.ok_or_else(|| wrong(&format!("the list of `{name}` holds no texts")))?;
        let is_allowed =
            |set: &&String| ["sampler.", "integrator."].iter().any(|p| set.starts_with(p));
        if let Some(other) = own.iter().find(|set| !is_allowed(set)) {
            let what = format!(
                "`{name}` sets `{other}`, but methods differ in `sampler.` and `integrator.` alone"
            );
            return Err(wrong(&what).into());
        }
        if name.chars().any(char::is_control) || name.len() > 80 {
            return Err(
                wrong(&format!("{name:?} is no name of one line and up to 80 letters")).into()
            );
        }
        let is_planned =
            |set: &&String| ["sampler.spp", "sampler.seed"].iter().any(|p| set.starts_with(p));
        if let Some(other) = own.iter().find(is_planned) {
            let what = format!("`{name}` sets `{other}`, which --budgets and --seeds decide on");
            return Err(wrong(&what).into());
        }
        let mut overrides = scene.overrides();
        overrides.extend(own.iter().map(String::as_str));
        let (sampler, integrator) = read_settings(&scene.path, &overrides)
            .map_err(|error| format!("{shown}: method `{name}`: {error}"))?;
        all.push((name.to_string(), sampler, integrator));
    }
    if all.is_empty() { Err(wrong("there is no method in it").into()) } else { Ok(all) }
}
