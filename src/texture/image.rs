//! [`ImageTexture`]: an image that is laid onto surfaces.

use std::path::PathBuf;
use std::sync::Arc;

use glam::{UVec2, Vec2};

use super::channel::{Channel, OfChannel};
use super::mapping::{self, Mapping};
use super::place::Place;
use super::texels::{Curve, Texels};
use super::wrap::Wrap;
use super::{AnyTexture, Read, Texture, Textures};
use crate::interaction::{BLOCK, HitBlock, SurfaceInteraction};
use crate::params::{AnyKey, Choice, Fault, Key, Kind, Table};
use crate::spectrum::Spectrum;

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

/// What stands for many pixels of an image that fall into one of the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Minification {
    /// Whatever pixel a sample meets: noise, which more samples reduce.
    None,
    /// Their mean over the footprint of the picture's pixel, from smaller images (mipmaps): no noise, but blur where the footprint is
    /// estimated too large.
    Anisotropic,
}

impl Choice for Minification {
    const CHOICES: &'static [(&'static str, Self)] =
        &[("none", Self::None), ("anisotropic", Self::Anisotropic)];
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
/// let stripes = ImageTexture::new(Texels::new(&image, Curve::Srgb)?).with_wrap(Wrap::Mirror);
/// # Ok::<(), lobe::texture::TexelsError>(())
/// ```
#[derive(Clone)]
pub struct ImageTexture {
    texels: Arc<Texels>,
    mapping: Mapping,
    wrap: [Wrap; 2],
    magnification: Magnification,
    minification: Minification,
}

impl ImageTexture {
    /// Repeated, bilinear, by the texture coordinates of the surface. Textures may share an image.
    pub fn new(texels: impl Into<Arc<Texels>>) -> Self {
        Self {
            texels: texels.into(),
            mapping: Mapping::default(),
            wrap: [Wrap::Repeat; 2],
            magnification: Magnification::Bilinear,
            minification: Minification::None,
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
        OfChannel { colors: self, channel }
    }

    /// Chooses what stands for many pixels that fall into one of the picture. Nothing is filtered if memory for smaller images is not available:
    /// [`Texels::make_smaller`] tells.
    pub fn with_minification(self, minification: Minification) -> Self {
        if minification == Minification::Anisotropic {
            let made = self.texels.make_smaller();
            return Self {
                minification: made.map_or(Minification::None, |()| minification),
                ..self
            };
        }
        Self { minification, ..self }
    }

    /// The colour at a point of the image's plane. Black if the point is not finite.
    pub fn at(&self, st: Vec2) -> Spectrum {
        self.within(&self.texels, st)
    }

    /// Whether all of the image is black.
    pub(crate) fn is_black(&self) -> bool {
        let UVec2 { x, y } = self.texels.size();
        (0..y).all(|y| (0..x).all(|x| self.texels.at(x, y).is_black()))
    }

    /// The same in the image or in a smaller one.
    #[inline]
    fn within(&self, texels: &Texels, st: Vec2) -> Spectrum {
        self.place(texels.size(), st).value(texels)
    }

    /// Where a point of the image's plane lies among the pixels of an image of this size.
    #[inline]
    fn place(&self, size: UVec2, st: Vec2) -> Place {
        if !st.is_finite() {
            return Place::default();
        }
        let [wrap_s, wrap_t] = self.wrap;
        // Rows count from the top.
        let last = size.y - 1;
        match self.magnification {
            Magnification::Nearest => {
                let [x, y] = [wrap_s.nearest(st.x, size.x), last - wrap_t.nearest(st.y, size.y)];
                Place { x: [x; 2], y: [y; 2], part: [0.0; 2], exists: true }
            }
            Magnification::Bilinear => {
                let (x, part_x) = wrap_s.neighbours(st.x, size.x);
                let ([below, above], part_y) = wrap_t.neighbours(st.y, size.y);
                let y = [last - below, last - above];
                Place { x, y, part: [part_x, part_y], exists: true }
            }
        }
    }

    /// The mean over a footprint: the parallelogram of two steps to the next pixels of the picture, around a point.
    ///
    /// Along the longer side at most 16 lookups, each in two smaller images whose pixels are about as wide as the shorter side. Where pixels of
    /// the picture are no larger than those of the image it is [`at`](Self::at).
    pub fn mean(&self, st: Vec2, steps: [Vec2; 2]) -> Spectrum {
        const MOST: f32 = 16.0;
        let size = self.texels.size().as_vec2();
        let [a, b] = steps.map(|step| step * size);
        let (longer, step) = if a.length() > b.length() { (a, steps[0]) } else { (b, steps[1]) };
        let length = longer.length();
        if !(a.is_finite() && b.is_finite()) || length <= 1.0 {
            return self.at(st);
        }
        let width = (a.perp_dot(b).abs() / length).max(1.0);
        let lookups = (length / width).ceil().clamp(1.0, MOST);
        let width = width.max(length / lookups);
        let mut sum = Spectrum::BLACK;
        for i in 0..lookups as u32 {
            let along = (i as f32 + 0.5) / lookups - 0.5;
            sum += self.between_sizes(st + step * along, width.log2());
        }
        sum / lookups
    }

    /// Between the images that are smaller by powers of two next to a `level`, at least 0.
    fn between_sizes(&self, st: Vec2, level: f32) -> Spectrum {
        let smaller = self.texels.smaller();
        let of = |level: usize| match level {
            0 => &*self.texels,
            _ => &smaller[level - 1],
        };
        let last = smaller.len();
        let first = (level as usize).min(last);
        let part = (level - first as f32).min(1.0);
        let value = self.within(of(first), st);
        if part == 0.0 || first == last {
            return value;
        }
        value * (1.0 - part) + self.within(of(first + 1), st) * part
    }
}

impl Texture<Spectrum> for ImageTexture {
    fn evaluate(&self, si: &SurfaceInteraction) -> Spectrum {
        let points = self.mapping.points(si).into_iter();
        let footprint = match self.minification {
            Minification::None => None,
            Minification::Anisotropic => si.footprint(),
        };
        match footprint {
            None => points.map(|(st, weight)| self.at(st) * weight).sum(),
            Some(footprint) => {
                let steps = self.mapping.steps(si, footprint);
                points.zip(steps).map(|((st, weight), steps)| self.mean(st, steps) * weight).sum()
            }
        }
    }

    fn evaluate_block(&self, hits: &HitBlock, values: &mut [Spectrum]) {
        let plane = self.mapping.of_uv().filter(|_| self.minification == Minification::None);
        let Some(plane) = plane else {
            for (i, value) in values.iter_mut().enumerate() {
                *value = self.evaluate(&hits.get(i));
            }
            return;
        };
        // In steps, so that the processor waits for the memory of many hits at once.
        let mut places = [Place::default(); BLOCK];
        let places = &mut places[..values.len()];
        for (i, place) in places.iter_mut().enumerate() {
            *place = self.place(self.texels.size(), plane.transform_point2(hits.uv(i)));
        }
        let touched = places.iter().map(|place| self.texels.touch(place.x[0], place.y[0]));
        std::hint::black_box(touched.fold(0, u32::wrapping_add));
        for (place, value) in places.iter().zip(values) {
            *value = place.value(&self.texels);
        }
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

static FILE: Key<PathBuf> = Key::new("file", "path of a PNG, JPEG, EXR or PFM file");
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
const MINIFICATION: Key<Minification> = Key::new(
    "minification",
    "what stands for many pixels that fall into one of the picture: one of them, or the mean over its footprint",
)
.default(Minification::None);

/// `type = "image"`
const KEYS: [&dyn AnyKey; 12] =
    mapping::with_keys([&FILE, &VALUES, &CURVE, &WRAP, &MAGNIFICATION, &MINIFICATION]);

pub(super) const KIND: Kind<Read> =
    Kind { name: "image", meaning: "An image file", keys: &KEYS, read };

fn read(table: &Table, textures: &Textures) -> Result<AnyTexture, Fault> {
    let (file, values) = (table.get(&FILE)?, table.get(&VALUES)?);
    let curve = table.get(&CURVE)?.unwrap_or(match values {
        Values::Colors => Curve::Srgb,
        Values::Numbers(_) => Curve::Linear,
    });
    let minification = table.get(&MINIFICATION)?;
    let texels = match minification {
        Minification::None => textures.image(&file, curve),
        Minification::Anisotropic => textures.image_with_smaller(&file, curve),
    };
    let texels = texels.map_err(|error| Fault::new(table.mark(&FILE), error))?;
    let image = ImageTexture::new(texels)
        .with_mapping(mapping::read(table)?)
        .with_wrap(table.get(&WRAP)?)
        .with_magnification(table.get(&MAGNIFICATION)?)
        .with_minification(minification);
    Ok(match values {
        Values::Colors => AnyTexture::Color(image.into_handle()),
        Values::Numbers(channel) => AnyTexture::Number(image.channel(channel).into_handle()),
    })
}
