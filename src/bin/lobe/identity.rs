//! [`difference`]: what tells one render from another.

use std::collections::HashMap;

/// The first difference between two renders, in words. Both are lines `key = value`; `places` is what to call them.
pub fn difference(here: &str, there: &str, places: [&str; 2]) -> Option<String> {
    let [own, other] = places;
    if here == there {
        return None;
    }
    fn parts(line: &str) -> (&str, &str) {
        line.split_once(" = ").unwrap_or((line, ""))
    }
    let values: HashMap<_, _> = there.lines().map(parts).collect();
    let ours: HashMap<_, _> = here.lines().map(parts).collect();
    for (key, value) in here.lines().map(parts) {
        match values.get(key) {
            Some(found) if *found == value => {}
            Some(found) => {
                return Some(format!("{key} is {found} {other} and {value} {own}"));
            }
            None => return Some(format!("{key} is {value} {own} and left out {other}")),
        }
    }
    let more = there.lines().map(parts).find(|(key, _)| !ours.contains_key(key));
    Some(match more {
        Some((key, value)) => format!("{key} is {value} {other} and left out {own}"),
        None => "its values are in another order".to_owned(),
    })
}
