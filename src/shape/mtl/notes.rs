//! [`Notes`]: what was left out of an MTL file, each thing once.

use std::collections::HashMap;

use super::report::MtlNote;

/// Maximum number of different notes: a file with more is no MTL file, or no one reads all of them.
const MOST: usize = 100;

/// Collects notes.
#[derive(Default)]
pub(super) struct Notes {
    notes: Vec<MtlNote>,
    /// By text: the index of the note, and how many further lines it stands for.
    known: HashMap<String, (usize, u64)>,
    /// Line of the first note beyond the maximum, and how many there are.
    beyond: Option<(u64, u64)>,
}

impl Notes {
    /// Adds a note, or counts a line for which the same was noted.
    pub fn add(&mut self, line: u64, what: String) {
        if let Some((_, more)) = self.known.get_mut(&what) {
            *more += 1;
        } else if self.notes.len() == MOST {
            self.beyond.get_or_insert((line, 0)).1 += 1;
        } else {
            self.known.insert(what.clone(), (self.notes.len(), 0));
            self.notes.push(MtlNote { line, what });
        }
    }

    /// In the order of their first lines.
    pub fn finish(mut self) -> Vec<MtlNote> {
        for (index, more) in self.known.into_values().filter(|(_, more)| *more > 0) {
            let lines = if more == 1 { "line" } else { "lines" };
            self.notes[index].what.push_str(&format!(" (the same in {more} more {lines})"));
        }
        if let Some((line, count)) = self.beyond {
            let lines = if count == 1 { "line is" } else { "lines are" };
            self.notes.push(MtlNote { line, what: format!("{count} more {lines} not understood") });
        }
        self.notes
    }
}
