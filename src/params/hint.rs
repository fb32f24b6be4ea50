//! [`hint`]: suggestions for a misspelt name.

use super::shown::Shown;

/// Maximum number of names in a hint.
const LISTED: usize = 20;

/// Maximum length of names that are compared, in bytes. The time grows with its square.
const COMPARED: usize = 100;

/// Suffix of an error message: the nearest known name, or all known names if none is near.
pub fn hint<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> String {
    let known: Vec<&str> = known.collect();
    let lower = name.to_lowercase();
    let near_length = |k: &&&str| name.len() <= COMPARED && k.len() <= COMPARED;
    let distances = known
        .iter()
        .filter(near_length)
        .map(|k| (strsim::osa_distance(&lower, &k.to_lowercase()), *k));
    // As in rustc: up to a third of the letters may differ, and one in any case.
    let is_near = |&(distance, k): &(usize, &str)| {
        3 * distance <= name.chars().count().max(k.chars().count()).max(3)
    };
    let quoted = |name: &&str| format!("`{}`", Shown::name(name));
    match distances.min_by_key(|&(distance, _)| distance).filter(is_near) {
        Some((_, nearest)) => format!("; did you mean {}?", quoted(&nearest)),
        None if known.is_empty() => String::new(),
        None => format!("; expected {}", one_of(known.iter().map(quoted))),
    }
}

/// "a", "a or b", "a, b or c".
pub fn one_of(names: impl ExactSizeIterator<Item = String>) -> String {
    let rest = names.len().saturating_sub(LISTED);
    let mut names: Vec<String> = names.take(LISTED).collect();
    if rest > 0 {
        names.push(format!("{rest} more"));
    }
    match names.split_last() {
        Some((last, others)) if !others.is_empty() => format!("{} or {last}", others.join(", ")),
        _ => names.concat(),
    }
}
