//! [`difference`]: what tells one render from another.

use std::collections::HashMap;

/// The first difference between two renders, in words. Both are lines `key = value`.
pub fn difference(here: &str, there: &str) -> Option<String> {
    if here == there {
        return None;
    }
    fn parts(line: &str) -> (&str, &str) {
        line.split_once(" = ").unwrap_or((line, ""))
    }
    let values: HashMap<_, _> = there.lines().map(parts).collect();
    let own: HashMap<_, _> = here.lines().map(parts).collect();
    for (key, value) in here.lines().map(parts) {
        match values.get(key) {
            Some(other) if *other == value => {}
            Some(other) => return Some(format!("{key} is {other} there and {value} here")),
            None => return Some(format!("{key} is {value} here and left out there")),
        }
    }
    let more = there.lines().map(parts).find(|(key, _)| !own.contains_key(key));
    Some(match more {
        Some((key, value)) => format!("{key} is {value} there and left out here"),
        None => "its values are in another order".to_owned(),
    })
}
