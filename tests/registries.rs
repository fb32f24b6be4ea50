//! Rules that every entry of every registry has to keep, now and later.
//!
//! Values are the keys' defaults, or their examples where there is none.

mod folders;

use std::collections::HashSet;

use lobe::params::{AnyKey, AnySection, Kind};
use lobe::scene_file::{SECTIONS, read_settings};

/// Calls `check` for each kind of each registry.
fn for_all_kinds(mut check: impl FnMut(&dyn AnySection, &Kind<()>)) {
    let mut count = 0;
    for section in SECTIONS {
        section.kinds().iter().for_each(|kind| check(section, kind));
        count += section.kinds().len();
    }
    assert!(count >= 25, "{count} kinds");
}

/// All keys of a kind, except the selector.
fn keys(section: &dyn AnySection, kind: &Kind<()>) -> Vec<&'static dyn AnyKey> {
    kind.keys.iter().chain(section.common()).copied().collect()
}

fn value(key: &dyn AnyKey) -> String {
    // Four equal numbers are an empty crop.
    if key.name() == "crop" {
        return "[0, 0, 1, 1]".into();
    }
    if key.name() == "file" {
        return format!("{IMAGE:?}");
    }
    key.default_text().filter(|default| default != "none").unwrap_or_else(|| key.example())
}

/// An image of one pixel, beside the scenes.
const IMAGE: &str = "one.pfm";

/// A scene with one table of this kind that contains these lines.
fn scene(section: &dyn AnySection, kind: &Kind<()>, lines: &str) -> String {
    let name = if section.is_named() { ".x" } else { "" };
    let (key, selector) = (section.key(), section.selector());
    // The example of a name, for kinds that refer to another material.
    let named = if key == "material" { "[material.name]\ntype = \"matte\"\n" } else { "" };
    format!("{named}[{key}{name}]\n{selector} = {:?}\n{lines}", kind.name)
}

/// The error in a scene before its meshes are read. `test` names the file that it is read from.
fn fault(test: &str, text: &str) -> Option<String> {
    let folder = folders::of_this_run();
    let path = folder.join(format!("{test}.toml"));
    std::fs::write(&path, text).unwrap();
    // Tests write it at the same time: whole, by one rename.
    if !folder.join(IMAGE).exists() {
        let pixel = [1.0_f32; 3].map(f32::to_le_bytes).concat();
        let image = folder.join(format!("{test}.pfm"));
        std::fs::write(&image, [&b"PF\n1 1\n-1\n"[..], &pixel].concat()).unwrap();
        std::fs::rename(&image, folder.join(IMAGE)).unwrap();
    }
    read_settings(&path, &[]).err().map(|error| error.to_string())
}

/// Seen to fail with `bump` left out of the keys of matte ("is read by a kind that does not declare its key"), and with
/// the sky reading no `radiance` ("has no effect here").
#[test]
fn a_kind_reads_the_keys_that_it_declares_and_no_others() {
    for_all_kinds(|section, kind| {
        let all = keys(section, kind);
        let lines: String = all.iter().map(|k| format!("{} = {}\n", k.name(), value(*k))).collect();
        let text = scene(section, kind, &lines);
        assert_eq!(fault("all", &text), None, "{text}");
    });
}

/// Seen to fail with a default sigma of 91 degrees.
#[test]
fn defaults_can_be_written_down_and_are_in_range() {
    for_all_kinds(|section, kind| {
        let all = keys(section, kind);
        let required = all.iter().filter(|key| key.default_text().is_none() || is_material(**key));
        let required: String =
            required.map(|key| format!("{} = {}\n", key.name(), value(*key))).collect();
        let text = scene(section, kind, &required);
        assert_eq!(fault("required", &text), None, "{text}");
        for key in all.iter().filter(|key| key.default_text().is_some_and(|d| d != "none")) {
            let line = format!("{} = {}\n", key.name(), key.default_text().unwrap());
            let emits = if key.name() == "two_sided" { "emission = [1, 1, 1]\n" } else { "" };
            let text = scene(section, kind, &format!("{required}{emits}{line}"));
            assert_eq!(fault("default", &text), None, "{text}");
        }
    });
}

/// Every shape needs a material or an emission.
fn is_material(key: &dyn AnyKey) -> bool {
    key.name() == "material"
}

/// Seen to fail with the search for unknown keys after the reading of values.
#[test]
fn a_misspelt_key_is_refused_with_the_nearest_name() {
    for_all_kinds(|section, kind| {
        for key in keys(section, kind) {
            let text = scene(section, kind, &format!("{}z = {}\n", key.name(), value(key)));
            let message = fault("misspelt", &text).unwrap_or_default();
            let end = format!("; did you mean `{}`?", key.name());
            let start = format!("unknown key `{}z` in [{}", key.name(), section.key());
            assert!(message.contains(&start) && message.ends_with(&end), "{message}");
        }
    });
}

/// Seen to fail with the tent named "box".
#[test]
fn names_are_unique_and_meanings_fit_into_tables() {
    let all_unique = |names: Vec<&str>| {
        let count = names.len();
        let unique: HashSet<_> = names.iter().collect();
        assert_eq!(unique.len(), count, "{names:?}");
        assert!(names.iter().all(|name| !name.is_empty()), "{names:?}");
    };
    all_unique(SECTIONS.map(|section| section.key()).to_vec());
    all_unique(SECTIONS.map(|section| section.plural()).to_vec());
    for section in SECTIONS {
        all_unique(section.kinds().iter().map(|kind| kind.name).collect());
        let has = |name: &str| section.kinds().iter().any(|kind| kind.name == name);
        assert!(section.default().is_none_or(has), "{}", section.key());
    }
    for_all_kinds(|section, kind| {
        let all = keys(section, kind);
        all_unique(all.iter().map(|key| key.name()).chain([section.selector()]).collect());
        let mut texts: Vec<String> = vec![kind.meaning.into()];
        texts.extend(all.iter().map(|key| key.meaning().to_owned()));
        texts.extend(all.iter().map(|key| key.expected()));
        for text in texts {
            let is_line =
                !text.contains(['|', '\n']) && !text.ends_with('.') && !text.contains("  ");
            assert!(is_line && !text.is_empty(), "{:?}: {text:?}", kind.name);
        }
    });
}
