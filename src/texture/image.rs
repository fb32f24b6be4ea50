//! [`ImageTexture`]: an image that is laid onto surfaces.

use std::path::PathBuf;
use std::sync::Arc;

use glam::Vec2;

use super::mapping::{self, Mapping};
use super::texels::{Curve, Texels};
use super::{AnyTexture, Read, Texture, Textures};
use crate::interaction::{HitBlock, SurfaceInteraction};
use crate::params::{Choice, Fault, Key, Kind, Table};
use crate::spectrum::Spectrum;

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

/// What is between the centres of pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Magnification {
    /// Straight lines from centre to centre.
    Bilinear,
    /// The nearest pixel.
    Nearest,
}

impl Choice for Magnification {
    const CHOICES: &'static [(&'static str, Self)] =
        &[("bilinear", Self::Bilinear), ("nearest", Self::Nearest)];
}

/// An image on surfaces: colours, or numbers by one [`Channel`] of it.
///
/// s runs along rows, t upwards from the last row, and (0, 0) and (1, 1) are corners of the image.
///
/// ```
/// use lobe::Spectrum;
/// use lobe::glam::UVec2;
/// use lobe::image::{Encoding, Image};
/// use lobe::texture::{Curve, ImageTexture, Texels, Wrap};
///
/// let pixels = vec![Spectrum::WHITE, Spectrum::BLACK];
/// let size = UVec2::new(2, 1);
/// let image = Image { size, pixels, variance: None, degrees_of_freedom: None, encoding: Encoding::Srgb };
/// let stripes = ImageTexture::new(Texels::new(&image, Curve::Srgb)).with_wrap(Wrap::Mirror);
/// ```
#[derive(Clone)]
pub struct ImageTexture {
    texels: Arc<Texels>,
    mapping: Mapping,
    wrap: [Wrap; 2],
    magnification: Magnification,
}

impl ImageTexture {
    /// Repeated, bilinear, by the texture coordinates of the surface. Textures may share an image.
    pub fn new(texels: impl Into<Arc<Texels>>) -> Self {
        Self {
            texels: texels.into(),
            mapping: Mapping::default(),
            wrap: [Wrap::Repeat; 2],
            magnification: Magnification::Bilinear,
        }
    }

    /// Places the image.
    pub fn with_mapping(self, mapping: Mapping) -> Self {
        Self { mapping, ..self }
    }

    /// Continues the image beyond its edges.
    pub fn with_wrap(self, wrap: Wrap) -> Self {
        Self { wrap: [wrap; 2], ..self }
    }

    /// Chooses what is between the centres of pixels.
    pub fn with_magnification(self, magnification: Magnification) -> Self {
        Self { magnification, ..self }
    }

    /// Numbers from one channel.
    pub fn channel(self, channel: Channel) -> impl Texture<f32> + Clone + use<> {
        OfChannel { image: self, channel }
    }

    /// The colour at a point of the image's plane. Black if the point is not finite.
    pub fn at(&self, st: Vec2) -> Spectrum {
        if !st.is_finite() {
            return Spectrum::BLACK;
        }
        let ([wrap_s, wrap_t], size) = (self.wrap, self.texels.size());
        let (s, t) = (wrap_s.folded(st.x), wrap_t.folded(st.y));
        // Rows count from the top.
        let last = size.y - 1;
        match self.magnification {
            Magnification::Nearest => {
                let index = |at: f32, count: u32| {
                    ((f64::from(at) * f64::from(count)) as u32).min(count - 1)
                };
                self.texels.at(index(s, size.x), last - index(t, size.y))
            }
            Magnification::Bilinear => {
                let (x, part_x) = wrap_s.neighbours(s, size.x);
                let ([below, above], part_y) = wrap_t.neighbours(t, size.y);
                self.texels.between(x, [last - below, last - above], [part_x, part_y])
            }
        }
    }
}

impl Wrap {
    /// The coordinate in `[0, 1]` that stands for this one.
    #[inline]
    fn folded(self, s: f32) -> f32 {
        match self {
            Self::Repeat => s - floor(s),
            Self::Mirror => {
                let s = s - 2.0 * floor(0.5 * s);
                if s > 1.0 { 2.0 - s } else { s }
            }
            Self::Clamp => s.clamp(0.0, 1.0),
        }
    }

    /// The two pixels whose centres are next to a coordinate in `[0, 1]`, of `count` in a row, and the weight of the second.
    #[inline]
    fn neighbours(self, s: f32, count: u32) -> ([u32; 2], f32) {
        // In f64, as wide images have more columns than f32 tells apart.
        let at = f64::from(s) * f64::from(count) - 0.5;
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
fn floor(x: f32) -> f32 {
    // From 2^23 on all are integers.
    if x.abs() >= 8_388_608.0 {
        return x;
    }
    let truncated = x as i32 as f32;
    if truncated > x { truncated - 1.0 } else { truncated }
}

impl Texture<Spectrum> for ImageTexture {
    fn evaluate(&self, si: &SurfaceInteraction) -> Spectrum {
        self.mapping.points(si).into_iter().map(|(st, weight)| self.at(st) * weight).sum()
    }

    fn evaluate_block(&self, hits: &HitBlock, values: &mut [Spectrum]) {
        match self.mapping.of_uv() {
            Some(plane) => {
                for (i, value) in values.iter_mut().enumerate() {
                    // As the sum of one weighted value.
                    *value = self.at(plane.transform_point2(hits.uv(i)));
                }
            }
            None => {
                for (i, value) in values.iter_mut().enumerate() {
                    *value = self.evaluate(&hits.get(i));
                }
            }
        }
    }
}

/// What of a colour is a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channel {
    /// The red band.
    Red,
    /// The green band.
    Green,
    /// The blue band.
    Blue,
    /// The luminance of Rec. 709.
    Luminance,
}

impl Channel {
    #[inline]
    fn of(self, color: Spectrum) -> f32 {
        let [r, g, b] = color.to_array();
        match self {
            Self::Red => r,
            Self::Green => g,
            Self::Blue => b,
            Self::Luminance => color.luminance(),
        }
    }
}

#[derive(Clone)]
struct OfChannel {
    image: ImageTexture,
    channel: Channel,
}

impl Texture<f32> for OfChannel {
    fn evaluate(&self, si: &SurfaceInteraction) -> f32 {
        self.channel.of(self.image.evaluate(si))
    }
}

/// What a texture of a scene file holds.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Values {
    Colors,
    Numbers(Channel),
}

impl Choice for Values {
    const CHOICES: &'static [(&'static str, Self)] = &[
        ("rgb", Self::Colors),
        ("red", Self::Numbers(Channel::Red)),
        ("green", Self::Numbers(Channel::Green)),
        ("blue", Self::Numbers(Channel::Blue)),
        ("luminance", Self::Numbers(Channel::Luminance)),
    ];
}

const FILE: Key<PathBuf> = Key::new("file", "path of a PNG, JPEG, EXR or PFM file");
const VALUES: Key<Values> =
    Key::new("values", "colours, or numbers of one band").default(Values::Colors);
const CURVE: Key<Option<Curve>> = Key::optional(
    "curve",
    "what the codes of PNG and JPEG mean; if left out, srgb for colours and linear for numbers",
);
const WRAP: Key<Wrap> = Key::new("wrap", "what is beyond the edges").default(Wrap::Repeat);
const MAGNIFICATION: Key<Magnification> =
    Key::new("magnification", "what is between the centres of pixels")
        .default(Magnification::Bilinear);

/// `type = "image"`
pub(super) const KIND: Kind<Read> = Kind {
    name: "image",
    meaning: "An image file",
    keys: &[
        &FILE,
        &VALUES,
        &CURVE,
        &WRAP,
        &MAGNIFICATION,
        mapping::KEYS[0],
        mapping::KEYS[1],
        mapping::KEYS[2],
        mapping::KEYS[3],
        mapping::KEYS[4],
        mapping::KEYS[5],
    ],
    read,
};

fn read(table: &Table, textures: &Textures) -> Result<AnyTexture, Fault> {
    let (file, values) = (table.get(&FILE)?, table.get(&VALUES)?);
    let curve = table.get(&CURVE)?.unwrap_or(match values {
        Values::Colors => Curve::Srgb,
        Values::Numbers(_) => Curve::Linear,
    });
    let texels =
        textures.image(&file, curve).map_err(|error| Fault::new(table.mark(&FILE), error))?;
    let image = ImageTexture::new(texels)
        .with_mapping(mapping::read(table)?)
        .with_wrap(table.get(&WRAP)?)
        .with_magnification(table.get(&MAGNIFICATION)?);
    Ok(match values {
        Values::Colors => AnyTexture::Color(image.into_handle()),
        Values::Numbers(channel) => AnyTexture::Number(image.channel(channel).into_handle()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_continue_beyond_the_edges() {
        let pixel = |wrap: Wrap, s: f32| (wrap.folded(s) * 2.0) as u32;
        let all = |wrap| (-3..6).map(|i| pixel(wrap, 0.5 * i as f32 + 0.25)).collect::<Vec<_>>();
        assert_eq!(all(Wrap::Repeat), [1, 0, 1, 0, 1, 0, 1, 0, 1]);
        assert_eq!(all(Wrap::Mirror), [1, 1, 0, 0, 1, 1, 0, 0, 1]);
        assert_eq!(all(Wrap::Clamp), [0, 0, 0, 0, 1, 2, 2, 2, 2]);
        for (wrap, before, after) in
            [(Wrap::Repeat, [2, 0], [2, 0]), (Wrap::Mirror, [0, 0], [2, 2])]
        {
            assert_eq!(wrap.neighbours(0.0, 3), (before, 0.5));
            assert_eq!(wrap.neighbours(1.0, 3), (after, 0.5));
        }
    }
}
