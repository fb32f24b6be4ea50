//! [`Wrap`]: how images continue.

use crate::params::Choice;

/// What a flat texture holds outside of [0, 1]².
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wrap {
    /// The same again.
    Repeat,
    /// The same, every other time mirrored.
    Mirror,
    /// The values at the edge.
    Clamp,
}

impl Choice for Wrap {
    const CHOICES: &'static [(&'static str, Self)] =
        &[("repeat", Self::Repeat), ("mirror", Self::Mirror), ("clamp", Self::Clamp)];
}

impl Wrap {
    /// The coordinate in `[0, 1]` that stands for this one. In f64, which holds the difference of a coordinate and an integer exactly.
    #[inline]
    fn folded(self, s: f32) -> f64 {
        let s = f64::from(s);
        match self {
            Self::Repeat => s - floor(s),
            Self::Mirror => {
                let s = s - 2.0 * floor(0.5 * s);
                if s > 1.0 { 2.0 - s } else { s }
            }
            Self::Clamp => s.clamp(0.0, 1.0),
        }
    }

    /// The pixel at a coordinate, of `count` in a row.
    #[inline]
    pub(super) fn nearest(self, s: f32, count: u32) -> u32 {
        let index = |s: f64| (s * f64::from(count)) as u32;
        match self {
            Self::Mirror => {
                let s = f64::from(s);
                let index = index(s - 2.0 * floor(0.5 * s)).min(2 * count - 1);
                index.min(2 * count - 1 - index)
            }
            _ => index(self.folded(s)).min(count - 1),
        }
    }

    /// The two pixels whose centres are next to a coordinate, of `count` in a row, and the weight of the second.
    #[inline]
    pub(super) fn neighbours(self, s: f32, count: u32) -> ([u32; 2], f32) {
        let at = self.folded(s) * f64::from(count) - 0.5;
        let last = count - 1;
        if at < 0.0 {
            let before = if self == Self::Repeat { last } else { 0 };
            return ([before, 0], (at + 1.0) as f32);
        }
        let first = (at as u32).min(last);
        let second = match self {
            Self::Repeat if first == last => 0,
            _ => (first + 1).min(last),
        };
        ([first, second], (at - f64::from(first)) as f32)
    }
}

/// The largest integer that is not larger. Without SSE4, that of the standard library is a call.
#[inline]
fn floor(x: f64) -> f64 {
    // From 2^52 on all are integers.
    if x.abs() >= 4_503_599_627_370_496.0 {
        return x;
    }
    let truncated = x as i64 as f64;
    if truncated > x { truncated - 1.0 } else { truncated }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_continue_beyond_the_edges() {
        let all = |wrap: Wrap| {
            (-3..6).map(|i| wrap.nearest(0.5 * i as f32 + 0.25, 2)).collect::<Vec<_>>()
        };
        assert_eq!(all(Wrap::Repeat), [1, 0, 1, 0, 1, 0, 1, 0, 1]);
        assert_eq!(all(Wrap::Mirror), [1, 1, 0, 0, 1, 1, 0, 0, 1]);
        assert_eq!(all(Wrap::Clamp), [0, 0, 0, 0, 1, 1, 1, 1, 1]);
        for (wrap, before, after) in
            [(Wrap::Repeat, [2, 0], [2, 0]), (Wrap::Mirror, [0, 0], [2, 2])]
        {
            assert_eq!(wrap.neighbours(0.0, 3), (before, 0.5));
            assert_eq!(wrap.neighbours(1.0, 3), (after, 0.5));
        }
    }
}
