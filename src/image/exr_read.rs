//! Reading of OpenEXR files: one part's colours and variance.
//!
//! The crate `exr` reads headers and decompresses single blocks of pixels. Blocks are found here, so that no size that a
//! file claims is believed before it is checked.

use std::io::{BufRead, Read, Seek};

use ::exr::meta::MetaData;
use ::exr::meta::attribute::SampleType;
use ::exr::meta::header::Header;
use ::exr::prelude::{AttributeValue, f16};
use glam::UVec2;

use super::exr::DEGREES_OF_FREEDOM;
use super::exr_blocks::Blocks;
use super::memory::{PIXEL, Refusal, area, check, filled, reserve};
use super::{Encoding, Image};
use crate::spectrum::Spectrum;

/// Most memory that a header takes, for each of its bytes: measured with the smallest attributes, whose hash table has just
/// grown, it was 136.
const HEADER: u64 = 192;

/// A channel within a pixel of an uncompressed block.
#[derive(Clone, Copy)]
struct Channel {
    kind: SampleType,
    /// Bytes that the channels before it have for each pixel.
    offset: usize,
}

impl Channel {
    fn named(header: &Header, name: &str) -> Option<Self> {
        let mut channels = header.channels.channels_with_byte_offset();
        let (offset, channel) = channels.find(|(_, channel)| channel.name == *name)?;
        Some(Self { kind: channel.sample_type, offset })
    }

    /// The numbers of a row of pixels, in which channels follow each other.
    fn read<'a>(self, row: &'a [u8], width: usize) -> impl Iterator<Item = f32> + 'a {
        let bytes = self.kind.bytes_per_sample();
        let value = move |bytes: &[u8]| match (self.kind, bytes) {
            (SampleType::F16, &[a, b]) => f16::from_bits(u16::from_ne_bytes([a, b])).to_f32(),
            (SampleType::U32, &[a, b, c, d]) => u32::from_ne_bytes([a, b, c, d]) as f32,
            (_, &[a, b, c, d]) => f32::from_ne_bytes([a, b, c, d]),
            _ => 0.0,
        };
        row[self.offset * width..][..bytes * width].chunks_exact(bytes).map(value)
    }
}

/// What a file's headers say.
pub(super) struct Layout {
    meta: MetaData,
    /// Index of the first part with colours.
    part: usize,
    colors: [Channel; 3],
    variance: Option<[Channel; 3]>,
    pub size: UVec2,
    /// Bytes of memory that are taken in any case.
    pub base: u128,
}

impl Layout {
    /// Reads the headers, and moves `source` behind them.
    pub fn read(source: &mut impl Read, length: u64, limit: u64) -> Result<Self, Refusal> {
        let longest = limit / HEADER;
        let mut taken = source.take(longest);
        let meta = MetaData::read_from_buffered(&mut taken, true)
            .and_then(|meta| MetaData::validate(&meta.headers, false).map(|_| meta));
        let rest = taken.limit();
        let meta = match meta {
            Ok(meta) => meta,
            Err(_) if rest == 0 && length > longest => {
                let reason = "its header takes more memory than the limit of";
                return Err(Refusal::AboveLimit(format!("{reason} {} MiB", limit >> 20)));
            }
            Err(error) => return Err(unreadable(error).into()),
        };
        let named = |header: &Header, names: [&str; 3]| {
            let [a, b, c] = names.map(|name| Channel::named(header, name));
            Some([a?, b?, c?])
        };
        let colors =
            |header: &Header| named(header, ["R", "G", "B"]).or_else(|| named(header, ["Y"; 3]));
        let mut parts = meta.headers.iter().enumerate();
        let (part, colors) = parts
            .find_map(|(index, header)| Some((index, colors(header)?)))
            .ok_or("it has no channels R, G and B, nor Y")?;
        let header = &meta.headers[part];
        let variance = named(header, ["variance.R", "variance.G", "variance.B"]);
        // Sides are below 2³⁰: `MetaData::validate`.
        let size = UVec2::new(header.layer_size.0 as u32, header.layer_size.1 as u32);
        let planes = if variance.is_some() { 2 } else { 1 };
        let base = planes * PIXEL * u128::from(area(size))
            + u128::from(length + HEADER * (longest - rest));
        check(size, base, limit)?;
        Ok(Self { part, colors, variance, size, base, meta })
    }

    pub fn attribute(&self, name: &str) -> Option<&AttributeValue> {
        let other = &self.meta.headers[self.part].own_attributes.other;
        other.iter().find(|(known, _)| *known == name).map(|(_, value)| value)
    }
}

/// Columns and rows.
pub(super) fn size(
    mut source: impl BufRead + Seek,
    length: u64,
    limit: u64,
) -> Result<UVec2, Refusal> {
    Ok(Layout::read(&mut source, length, limit)?.size)
}

/// A whole file in memory.
pub(super) struct Contents {
    bytes: Vec<u8>,
    pub layout: Layout,
    /// Bytes of its headers.
    behind: usize,
    limit: u64,
}

impl Contents {
    pub fn read(source: impl BufRead + Seek, length: u64, limit: u64) -> Result<Self, Refusal> {
        let mut bytes = reserve(length)?;
        source.take(length).read_to_end(&mut bytes).map_err(|error| error.to_string())?;
        let mut rest = &bytes[..];
        let layout = Layout::read(&mut rest, length, limit)?;
        let behind = bytes.len() - rest.len();
        let contents = Self { bytes, layout, behind, limit };
        // Before anything is allocated for pixels that are not there.
        contents.blocks()?;
        Ok(contents)
    }

    fn blocks(&self) -> Result<Blocks<'_>, Refusal> {
        let Self { bytes, layout, behind, .. } = self;
        Blocks::find(&layout.meta, layout.part, bytes, *behind)
    }

    /// The header of the part with colours.
    pub fn header(&self) -> &Header {
        &self.layout.meta.headers[self.layout.part]
    }

    /// Decompresses all blocks, and hands over each of their rows: the number of its first pixel, how many it has, and the
    /// bytes, channel by channel. `beside` are bytes of memory that the caller takes for the rows.
    pub fn rows(
        &self,
        beside: u128,
        mut row: impl FnMut(usize, usize, &[u8]),
    ) -> Result<(), Refusal> {
        let Self { layout, limit, .. } = self;
        let base = layout.base + beside;
        check(layout.size, base, *limit)?;
        let blocks = self.blocks()?;
        let bytes_per_pixel = blocks.header.channels.bytes_per_pixel;
        for index in 0..blocks.count {
            let Some(block) = blocks.get(index)? else { continue };
            check(layout.size, base + blocks.memory(&block)?, *limit)?;
            let block = blocks.decompress(block, &layout.meta)?;
            let (corner, width) = (block.index.pixel_position, block.index.pixel_size.0);
            for (y, bytes) in block.data.chunks_exact(bytes_per_pixel * width).enumerate() {
                row((corner.1 + y) * layout.size.x as usize + corner.0, width, bytes);
            }
        }
        Ok(())
    }
}

/// Decodes the first part that has colours, and its variance.
pub(super) fn decode(
    source: impl BufRead + Seek,
    length: u64,
    limit: u64,
) -> Result<Image, Refusal> {
    let contents = Contents::read(source, length, limit)?;
    let layout = &contents.layout;
    let size = layout.size;
    let mut pixels = filled(area(size), Spectrum::BLACK)?;
    let mut variance = match layout.variance {
        Some(_) => filled(area(size), Spectrum::BLACK)?,
        None => Vec::new(),
    };
    contents.rows(0, |start, width, row| {
        copy(&mut pixels[start..][..width], layout.colors, row);
        if let Some(channels) = layout.variance {
            copy(&mut variance[start..][..width], channels, row);
        }
    })?;
    let variance = layout.variance.map(|_| variance);
    let degrees_of_freedom = match layout.attribute(DEGREES_OF_FREEDOM) {
        Some(AttributeValue::I32(degrees)) => u32::try_from(*degrees).ok().filter(|&d| d > 0),
        _ => None,
    };
    Ok(Image { size, pixels, variance, degrees_of_freedom, encoding: Encoding::Linear })
}

/// Reads three channels of a row of pixels.
fn copy(pixels: &mut [Spectrum], channels: [Channel; 3], row: &[u8]) {
    let [r, g, b] = channels.map(|channel| channel.read(row, pixels.len()));
    for (((pixel, r), g), b) in pixels.iter_mut().zip(r).zip(g).zip(b) {
        *pixel = Spectrum::new(r, g, b);
    }
}

fn unreadable(error: ::exr::error::Error) -> String {
    format!("it is not a readable EXR file: {error}")
}
