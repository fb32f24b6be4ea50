//! [`LineTable`]: the line numbers of elements, run-length encoded.

/// Maps elements, numbered from 0 in the order of the file, to their line numbers.
#[derive(Default)]
pub(super) struct LineTable {
    count: usize,
    /// The first element and line of each run of elements on consecutive lines.
    runs: Vec<(usize, u64)>,
    /// The line on which the last run would continue.
    next: u64,
}

impl LineTable {
    /// Number of elements.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Appends an element on `line`.
    #[inline]
    pub fn push(&mut self, line: u64) {
        if line != self.next || self.runs.is_empty() {
            self.runs.push((self.count, line));
        }
        self.next = line + 1;
        self.count += 1;
    }

    /// The line of an element.
    pub fn line(&self, element: usize) -> u64 {
        let after = self.runs.partition_point(|run| run.0 <= element);
        let (first, line) = self.runs[after - 1];
        line + (element - first) as u64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_found_again() {
        let lines = [3, 4, 5, 9, 11, 12, 20];
        let mut table = LineTable::default();
        lines.iter().for_each(|&line| table.push(line));
        assert_eq!(table.runs.len(), 4);
        assert_eq!((0..table.count()).map(|i| table.line(i)).collect::<Vec<_>>(), lines);
    }
}
