//! [`ByMaterial`]: hits in the order of their materials.

use std::ops::Range;

/// Hits in the order of their materials, so that blocks have one material each. Those of the same material keep their order.
#[derive(Default)]
pub struct ByMaterial {
    /// Per material of the scene: the sort that it was last met in, and its number there.
    last_met: Vec<(u64, u32)>,
    /// Number of sorts so far.
    sorts: u64,
    /// Per material of the last sort: the material, and where its hits end.
    runs: Vec<(u32, usize)>,
    /// Per hit: the number of its material.
    numbers: Vec<u32>,
    order: Vec<u32>,
}

/// Most materials for which one pass each beats a counting sort.
const FEW: usize = 4;

impl ByMaterial {
    /// Bytes for that many hits and materials.
    pub const fn bytes(hits: usize, materials: usize) -> usize {
        hits * (size_of::<(u32, usize)>() + 2 * size_of::<u32>())
            + materials * size_of::<(u64, u32)>()
    }

    /// Room for that many hits, in a scene of so many materials.
    pub fn new(hits: usize, materials: usize) -> Self {
        Self {
            last_met: vec![(0, 0); materials],
            sorts: 0,
            runs: Vec::with_capacity(hits),
            numbers: Vec::with_capacity(hits),
            order: Vec::with_capacity(hits),
        }
    }

    /// Sorts the hits 0 to `hits` by the material that `material_of` returns for each.
    ///
    /// # Panics
    /// If it is not below the number of materials.
    pub fn sort(&mut self, hits: usize, material_of: impl Fn(usize) -> u32) {
        let Self { last_met, sorts, runs, numbers, order } = self;
        *sorts += 1;
        runs.clear();
        order.clear();
        if last_met.len() == 1 {
            order.extend(0..hits as u32);
            runs.push((0, hits));
            return;
        }
        numbers.clear();
        for hit in 0..hits {
            let material = material_of(hit);
            let met = &mut last_met[material as usize];
            if met.0 != *sorts {
                *met = (*sorts, runs.len() as u32);
                runs.push((material, 0));
            }
            numbers.push(met.1);
        }
        order.resize(hits, 0);
        if runs.len() <= FEW {
            // A pass for each, without branches: every hit is written, and stays if it has the material.
            let mut end = 0;
            for (number, run) in (0..).zip(runs) {
                for (hit, &of_hit) in (0..).zip(&*numbers) {
                    if end < hits {
                        order[end] = hit;
                    }
                    end += usize::from(of_hit == number);
                }
                run.1 = end;
            }
            return;
        }
        for &number in &*numbers {
            runs[number as usize].1 += 1;
        }
        // From counts to starts, which become ends as hits are placed.
        let mut start = 0;
        for (_, count) in runs.iter_mut() {
            start += std::mem::replace(count, start);
        }
        for (hit, &number) in (0..).zip(&*numbers) {
            let (_, place) = &mut runs[number as usize];
            order[*place] = hit;
            *place += 1;
        }
    }

    /// Each material and its hits: a range of [`order`](Self::order).
    pub fn runs(&self) -> impl Iterator<Item = (u32, Range<usize>)> {
        let mut start = 0;
        self.runs
            .iter()
            .map(move |&(material, end)| (material, std::mem::replace(&mut start, end)..end))
    }

    /// The hits, material by material.
    pub fn order(&self) -> &[u32] {
        &self.order
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hits_are_sorted_and_keep_their_order() {
        let mut by_material = ByMaterial::new(6, 6);
        for (wave, materials) in [[3, 1, 3, 3, 0, 1], [5, 5, 5, 5, 5, 2], [0; 6]].iter().enumerate()
        {
            by_material.sort(6, |hit| materials[hit]);
            let mut found = Vec::new();
            for (material, range) in by_material.runs() {
                assert!(!range.is_empty(), "wave {wave}");
                for &hit in &by_material.order()[range] {
                    assert_eq!(materials[hit as usize], material, "wave {wave}");
                    found.push(hit);
                }
            }
            let mut expected: Vec<u32> = (0..6).collect();
            let first = |hit: &u32| materials.iter().position(|m| *m == materials[*hit as usize]);
            expected.sort_by_key(first);
            assert_eq!(found, expected, "wave {wave}");
        }
    }
}
