//! [`ImageTexture`]: an image that is laid onto surfaces.

use std::path::PathBuf;
use std::sync::Arc;

use glam::Vec2;

use super::mapping::{self, Mapping};
use super::texels::{Curve, Texels};
use super::{AnyTexture, Read, Texture, Textures};
use crate::interaction::SurfaceInteraction;
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
        let size = self.texels.size();
        if !st.is_finite() {
            return Spectrum::BLACK;
        }
        // In pixels from the bottom left corner. Far from it, f32 would not tell neighbours apart.
        let at = st.as_dvec2() * size.as_dvec2();
        let pixel = |x: i64, y: i64| {
            let [x, y] = [(x, size.x, self.wrap[0]), (y, size.y, self.wrap[1])]
                .map(|(index, count, wrap)| wrapped(index, count, wrap));
            self.texels.at(x, size.y - 1 - y)
        };
        match self.magnification {
            Magnification::Nearest => pixel(at.x.floor() as i64, at.y.floor() as i64),
            Magnification::Bilinear => {
                let at = at - 0.5;
                let floor = at.floor();
                // Saturated where the coordinates leave 64 bits.
                let [x, y] = floor.to_array().map(|index| index as i64);
                let [next_x, next_y] = [x, y].map(|index| index.saturating_add(1));
                let part = (at - floor).as_vec2();
                let row = |y| pixel(x, y) * (1.0 - part.x) + pixel(next_x, y) * part.x;
                row(y) * (1.0 - part.y) + row(next_y) * part.y
            }
        }
    }
}

/// The pixel of a row or column that stands for this one.
#[inline]
fn wrapped(index: i64, count: u32, wrap: Wrap) -> u32 {
    let count = i64::from(count);
    let inside = match wrap {
        Wrap::Repeat => index.rem_euclid(count),
        Wrap::Mirror => {
            let index = index.rem_euclid(2 * count);
            index.min(2 * count - 1 - index)
        }
        Wrap::Clamp => index.clamp(0, count - 1),
    };
    inside as u32
}

impl Texture<Spectrum> for ImageTexture {
    fn evaluate(&self, si: &SurfaceInteraction) -> Spectrum {
        self.mapping.points(si).into_iter().map(|(st, weight)| self.at(st) * weight).sum()
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
    fn indices_wrap() {
        let all = |wrap| (-3..6).map(|i| wrapped(i, 2, wrap)).collect::<Vec<_>>();
        assert_eq!(all(Wrap::Repeat), [1, 0, 1, 0, 1, 0, 1, 0, 1]);
        assert_eq!(all(Wrap::Mirror), [1, 1, 0, 0, 1, 1, 0, 0, 1]);
        assert_eq!(all(Wrap::Clamp), [0, 0, 0, 0, 1, 1, 1, 1, 1]);
        assert_eq!(wrapped(i64::MIN, 1, Wrap::Mirror), 0);
    }
}
