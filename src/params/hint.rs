//! [`hint`]: what a misspelt name may have been meant to be.

/// How many names a hint lists at most.
const LISTED: usize = 12;

/// The nearest of the known names, or all of them if none is near: the end of an error message.
pub fn hint<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> String {
    let known: Vec<&str> = known.collect();
    let lower = name.to_lowercase();
    let distances = known.iter().map(|k| (strsim::osa_distance(&lower, &k.to_lowercase()), *k));
    // As in rustc: a third of the letters may be wrong, and one in any case.
    let is_near = |&(distance, k): &(usize, &str)| {
        3 * distance <= name.chars().count().max(k.chars().count()).max(3)
    };
    let quoted = |name: &&str| format!("`{}`", name.escape_debug());
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
