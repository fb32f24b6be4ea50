//! Circles of imports.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use super::imports::Imports;

/// Files that reach each other, with their shortest circle.
pub struct Circle<'a> {
    pub files: BTreeSet<&'a str>,
    /// The shortest circle; its last element is the first again.
    pub shortest: Vec<&'a str>,
}

/// Each group of files that reach each other (a strongly connected component), the largest first.
pub fn circles(imports: &Imports) -> Vec<Circle<'_>> {
    let mut next: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for (from, to) in imports.keys() {
        next.entry(from).or_default().push(to);
    }
    let reached: BTreeMap<&str, BTreeSet<&str>> =
        next.keys().map(|&file| (file, reach(&next, file))).collect();
    let reaches = |a: &str, b: &str| reached.get(a).is_some_and(|files| files.contains(b));
    let mut seen: BTreeSet<&str> = BTreeSet::new();
    let mut circles = Vec::new();
    for &file in next.keys() {
        if seen.contains(file) || !reaches(file, file) {
            continue;
        }
        let files: BTreeSet<&str> =
            reached[file].iter().copied().filter(|other| reaches(other, file)).collect();
        seen.extend(&files);
        let shortest = files.iter().filter_map(|&start| shortest(&next, start));
        let shortest = shortest.min_by_key(Vec::len).expect("the files reach each other");
        circles.push(Circle { files, shortest });
    }
    circles.sort_by_key(|circle| std::cmp::Reverse(circle.files.len()));
    circles
}

/// All files that `start` reaches in one or more steps.
fn reach<'a>(next: &BTreeMap<&'a str, Vec<&'a str>>, start: &'a str) -> BTreeSet<&'a str> {
    let (mut reached, mut waiting) = (BTreeSet::new(), vec![start]);
    while let Some(file) = waiting.pop() {
        waiting.extend(next.get(file).into_iter().flatten().filter(|&&to| reached.insert(to)));
    }
    reached
}

/// The shortest way from `start` back to it.
fn shortest<'a>(next: &BTreeMap<&'a str, Vec<&'a str>>, start: &'a str) -> Option<Vec<&'a str>> {
    let (mut before, mut waiting) = (BTreeMap::new(), VecDeque::from([start]));
    while let Some(file) = waiting.pop_front() {
        for &to in next.get(file).into_iter().flatten() {
            if before.contains_key(to) {
                continue;
            }
            before.insert(to, file);
            waiting.push_back(to);
        }
    }
    let (mut way, mut file) = (vec![start], start);
    loop {
        file = before.get(file).copied()?;
        way.push(file);
        if file == start {
            way.reverse();
            return Some(way);
        }
    }
}
