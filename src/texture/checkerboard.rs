//! [`CheckerboardTexture`]: two textures in turn.

use std::ops::{Add, Mul};

use glam::Vec2;

use super::any::Pair;
use super::mapping::{self, Mapping};
use super::value::Constant;
use super::{AnyTexture, Read, Texture, TextureHandle, TextureKey, Textures};
use crate::interaction::SurfaceInteraction;
use crate::params::{AnyKey, Fault, Key, Kind, Table};

/// Squares of one unit, in turn of one texture and of another (PBRT 3rd edition, section 10.5.1).
///
/// Over the footprint of a pixel the two are mixed by the area that each has, in closed form: of the box around the footprint in the
/// texture's coordinates.
#[derive(Clone)]
pub struct CheckerboardTexture<T> {
    textures: [TextureHandle<T>; 2],
    mapping: Mapping,
}

impl<T> CheckerboardTexture<T> {
    /// The first texture in the square from (0, 0) to (1, 1), by the texture coordinates of the surface.
    pub fn new(first: impl Texture<T> + 'static, second: impl Texture<T> + 'static) -> Self {
        let textures = [first.into_handle(), second.into_handle()];
        Self { textures, mapping: Mapping::default() }
    }

    /// Places the squares.
    pub fn with_mapping(self, mapping: Mapping) -> Self {
        Self { mapping, ..self }
    }

    /// The fraction of the second texture.
    fn second(&self, si: &SurfaceInteraction) -> f32 {
        let points = self.mapping.points(si).into_iter();
        match si.footprint() {
            None => points.map(|(st, weight)| weight * fraction(st, Vec2::ZERO)).sum(),
            Some(footprint) => {
                let steps = self.mapping.steps(si, footprint);
                let fraction = |((st, weight), [a, b]): ((Vec2, f32), [Vec2; 2])| {
                    weight * fraction(st, a.abs() + b.abs())
                };
                points.zip(steps).map(fraction).sum()
            }
        }
    }
}

/// The fraction of odd squares in a box of this size around a point.
fn fraction(center: Vec2, size: Vec2) -> f32 {
    let [s, t] = [odd(center.x, size.x), odd(center.y, size.y)];
    s + t - 2.0 * s * t
}

/// The fraction of odd units in an interval of this length around a number.
fn odd(center: f32, length: f32) -> f32 {
    // Of two units, exactly.
    let (x, length) = (f64::from(center).rem_euclid(2.0), f64::from(length));
    // Where f32 has overflowed, or that many units are as many odd ones.
    if x.is_nan() || length >= 1e30 {
        return 0.5;
    }
    // Far away, f32 no longer tells odd from even; nor is the edge of a unit hit by chance.
    if length.is_nan() || length < 1e-6 {
        return x.floor().rem_euclid(2.0) as f32;
    }
    // The integral of 0 over even units and 1 over odd ones.
    let up_to = |x: f64| {
        let pairs = (x / 2.0).floor();
        pairs + (x - 2.0 * pairs - 1.0).max(0.0)
    };
    ((up_to(x + length / 2.0) - up_to(x - length / 2.0)) / length) as f32
}

impl<T> Texture<T> for CheckerboardTexture<T>
where
    T: Copy + Add<Output = T> + Mul<f32, Output = T> + Send + Sync + 'static,
{
    fn evaluate(&self, si: &SurfaceInteraction) -> T {
        let [first, second] = &self.textures;
        match self.second(si) {
            0.0 => first.evaluate(si),
            1.0 => second.evaluate(si),
            part => first.evaluate(si) * (1.0 - part) + second.evaluate(si) * part,
        }
    }
}

const FIRST: TextureKey<Constant> =
    TextureKey::of(Key::new("first", "in the square from (0, 0) to (1, 1)"));
const SECOND: TextureKey<Constant> = TextureKey::of(Key::new("second", "in the squares beside it"));

/// `type = "checkerboard"`
const KEYS: [&dyn AnyKey; 8] = mapping::with_keys([&FIRST, &SECOND]);

pub(super) const KIND: Kind<Read> = Kind {
    name: "checkerboard",
    meaning: "Squares of two textures in turn, filtered over pixels in closed form",
    keys: &KEYS,
    read,
};

fn read(table: &Table, textures: &Textures) -> Result<AnyTexture, Fault> {
    let mapping = mapping::read(table)?;
    Ok(match textures.pair(table, [&FIRST, &SECOND])? {
        Pair::Numbers([a, b]) => {
            AnyTexture::Number(CheckerboardTexture::new(a, b).with_mapping(mapping).into_handle())
        }
        Pair::Colors([a, b]) => {
            AnyTexture::Color(CheckerboardTexture::new(a, b).with_mapping(mapping).into_handle())
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against sums over 1000 points of each interval.
    #[test]
    fn fractions_are_means() {
        for (center, length) in
            [(0.3, 0.2), (0.9, 0.5), (-1.2, 0.7), (2.0, 3.3), (7.4, 12.0), (-3.9, 1.9), (0.5, 1.0)]
        {
            let at = |i: i32| center + length * (f64::from(i) + 0.5) / 1000.0 - length / 2.0;
            let mean = (0..1000).map(|i| at(i).floor().rem_euclid(2.0)).sum::<f64>() / 1000.0;
            let found = f64::from(odd(center as f32, length as f32));
            assert!((found - mean).abs() < 2e-3, "{center}, {length}: {found}, not {mean}");
        }
        assert_eq!(
            [odd(0.5, 0.0), odd(1.5, 0.0), odd(-0.5, 0.0), odd(-1.5, 0.0)],
            [0.0, 1.0, 1.0, 0.0]
        );
    }

    /// However far away and large, they are fractions; of what is not finite, the mean.
    ///
    /// Caught: sums far away, which lose the length; no mean of infinite lengths, and of points that are not finite.
    #[test]
    fn fractions_stay_between_none_and_all() {
        let far = [0.0, 0.3, 1e6, 1e10, 3e17, -1e20, 1e30, f32::MAX];
        for center in far {
            for length in [0.0, 1e-3, 1.0, 2.5, 1e4, 1e12, 1e25, 1e30, f32::MAX] {
                let found = odd(center, length);
                assert!((0.0..=1.0).contains(&found), "{center}, {length}: {found}");
            }
            assert_eq!(odd(center, f32::INFINITY), 0.5);
        }
        assert_eq!([odd(1e17, 3.0), odd(1.5, 3.0)], [odd(0.0, 3.0), 1.0 / 3.0]);
        for center in [f32::INFINITY, f32::NEG_INFINITY, f32::NAN] {
            assert_eq!([odd(center, 0.0), odd(center, 1.0)], [0.5; 2], "{center}");
        }
    }
}
