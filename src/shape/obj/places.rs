//! [`Places`]: in which line each thing of a file stands, in little memory.

/// The lines of things that are numbered from 0 in the order of their lines, usually one a line.
#[derive(Default)]
pub(super) struct Places {
    count: usize,
    /// Where a run of things on consecutive lines begins: its first thing and its line.
    runs: Vec<(usize, u64)>,
    /// The line with which the last run would go on.
    next: u64,
}

impl Places {
    /// How many things there are.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Adds the next thing, which stands in `line`.
    #[inline]
    pub fn push(&mut self, line: u64) {
        if line != self.next || self.runs.is_empty() {
            self.runs.push((self.count, line));
        }
        self.next = line + 1;
        self.count += 1;
    }

    /// The line of a thing that was added.
    pub fn line(&self, thing: usize) -> u64 {
        let after = self.runs.partition_point(|run| run.0 <= thing);
        let (first, line) = self.runs[after - 1];
        line + (thing - first) as u64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_found_again() {
        let lines = [3, 4, 5, 9, 11, 12, 20];
        let mut places = Places::default();
        lines.iter().for_each(|&line| places.push(line));
        assert_eq!(places.runs.len(), 4);
        assert_eq!((0..places.count()).map(|i| places.line(i)).collect::<Vec<_>>(), lines);
    }
}
