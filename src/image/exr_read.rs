//! Reading of OpenEXR files: one part's colours and variance.
//!
//! The crate `exr` reads headers and decompresses single blocks of pixels. Blocks are found here, so that no size that a
//! file claims is believed before it is checked.

use std::io::{BufRead, Read, Seek};

use ::exr::meta::MetaData;
use ::exr::meta::attribute::SampleType;
use ::exr::meta::header::Header;
use ::exr::prelude::{AttributeValue, Vec2, f16};
use glam::UVec2;

use super::exr::DEGREES_OF_FREEDOM;
use super::exr_blocks::Blocks;
use super::memory::{PIXEL, Refusal, area, check, filled, reserve};
use super::{Encoding, Image, Metadata, ParsePartError, PartMetadata, Picture, Plane, Window};
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
struct Layout {
    meta: MetaData,
    /// Index of the first part with colours.
    part: usize,
    colors: [Channel; 3],
    variance: Option<[Channel; 3]>,
    size: UVec2,
    /// Bytes of memory that are taken in any case.
    base: u128,
}

impl Layout {
    /// Reads the headers, and moves `source` behind them.
    fn read(source: &mut impl Read, length: u64, limit: u64) -> Result<Self, Refusal> {
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
}

/// Columns and rows.
pub(super) fn size(
    mut source: impl BufRead + Seek,
    length: u64,
    limit: u64,
) -> Result<UVec2, Refusal> {
    Ok(Layout::read(&mut source, length, limit)?.size)
}

/// Decodes the first part that has colours, and its variance.
pub(super) fn decode(
    source: impl BufRead + Seek,
    length: u64,
    limit: u64,
) -> Result<Image, Refusal> {
    let mut bytes = reserve(length)?;
    source.take(length).read_to_end(&mut bytes).map_err(|error| error.to_string())?;
    let mut rest = &bytes[..];
    let layout = Layout::read(&mut rest, length, limit)?;
    let size = layout.size;
    let blocks = Blocks::find(&layout.meta, layout.part, &bytes, bytes.len() - rest.len())?;

    let mut pixels = filled(area(size), Spectrum::BLACK)?;
    let mut variance = match layout.variance {
        Some(_) => filled(area(size), Spectrum::BLACK)?,
        None => Vec::new(),
    };
    let bytes_per_pixel = blocks.header.channels.bytes_per_pixel;
    for index in 0..blocks.count {
        let Some(block) = blocks.get(index)? else { continue };
        check(size, layout.base + blocks.memory(&block)?, limit)?;
        let block = blocks.decompress(block, &layout.meta)?;
        let (corner, width) = (block.index.pixel_position, block.index.pixel_size.0);
        for (y, row) in block.data.chunks_exact(bytes_per_pixel * width).enumerate() {
            let start = (corner.1 + y) * size.x as usize + corner.0;
            copy(&mut pixels[start..][..width], layout.colors, row);
            if let Some(channels) = layout.variance {
                copy(&mut variance[start..][..width], channels, row);
            }
        }
    }
    let variance = layout.variance.map(|_| variance);
    let degrees_of_freedom = match layout.attribute(DEGREES_OF_FREEDOM) {
        Some(AttributeValue::I32(degrees)) => u32::try_from(*degrees).ok().filter(|&d| d > 0),
        _ => None,
    };
    Ok(Image { size, pixels, variance, degrees_of_freedom, encoding: Encoding::Linear })
}

/// Reads the metadata of a part of a render, from the header alone.
pub(super) fn part_metadata(
    mut source: impl BufRead + Seek,
    length: u64,
    limit: u64,
) -> Result<Metadata, Refusal> {
    Layout::read(&mut source, length, limit)?.part_metadata()
}

/// Decodes what the film of a part of a render kept. Colours and layers are left out, since the film gives them.
pub(super) fn decode_part(
    source: impl BufRead + Seek,
    length: u64,
    limit: u64,
) -> Result<(Picture, Metadata), Refusal> {
    let mut bytes = reserve(length)?;
    source.take(length).read_to_end(&mut bytes).map_err(|error| error.to_string())?;
    let mut rest = &bytes[..];
    let layout = Layout::read(&mut rest, length, limit)?;
    let (size, metadata) = (layout.size, layout.part_metadata()?);
    let blocks = Blocks::find(&layout.meta, layout.part, &bytes, bytes.len() - rest.len())?;

    let header = blocks.header;
    let of_film = header.channels.channels_with_byte_offset().filter(|(_, channel)| {
        channel.sample_type == SampleType::U32 && channel.name.to_string().starts_with(FILM)
    });
    let of_film: Vec<_> = of_film.map(|(offset, channel)| (offset, &channel.name)).collect();
    let base = layout.base + 4 * of_film.len() as u128 * u128::from(area(size));
    check(size, base, limit)?;
    let mut planes = Vec::new();
    for (_, name) in &of_film {
        planes.push(Plane { name: name.to_string(), values: filled(area(size), 0)? });
    }
    let bytes_per_pixel = header.channels.bytes_per_pixel;
    for index in 0..blocks.count {
        let Some(block) = blocks.get(index)? else { continue };
        check(size, base + blocks.memory(&block)?, limit)?;
        let block = blocks.decompress(block, &layout.meta)?;
        let (corner, width) = (block.index.pixel_position, block.index.pixel_size.0);
        for (y, row) in block.data.chunks_exact(bytes_per_pixel * width).enumerate() {
            let start = (corner.1 + y) * size.x as usize + corner.0;
            for (plane, (offset, _)) in planes.iter_mut().zip(&of_film) {
                let words = row[offset * width..][..4 * width].as_chunks().0;
                for (value, word) in plane.values[start..].iter_mut().zip(words) {
                    *value = u32::from_ne_bytes(*word);
                }
            }
        }
    }
    let corner = |Vec2(x, y)| Some(UVec2::new(u32::try_from(x).ok()?, u32::try_from(y).ok()?));
    let min = corner(header.own_attributes.layer_position);
    let whole = header.shared_attributes.display_window.size;
    let resolution = UVec2::new(whole.0 as u32, whole.1 as u32);
    let window = min.map(|min| Window { min, max: min.saturating_add(size) });
    let window = window.filter(|window| window.max.cmple(resolution).all());
    let window = window.ok_or("its window reaches beyond the image")?;
    Ok((Picture { window, planes, ..Picture::new(resolution, Vec::new()) }, metadata))
}

/// How the names of channels begin that a film keeps.
const FILM: &str = "film.";

impl Layout {
    fn attribute(&self, name: &str) -> Option<&AttributeValue> {
        let other = &self.meta.headers[self.part].own_attributes.other;
        other.iter().find(|(known, _)| *known == name).map(|(_, value)| value)
    }

    fn part_metadata(&self) -> Result<Metadata, Refusal> {
        let text = |name: &str| match self.attribute(name) {
            Some(AttributeValue::Text(text)) => {
                Some(String::from_utf8_lossy(text.as_slice()).into_owned())
            }
            _ => None,
        };
        let part = text("part").ok_or(
            "it is not a complete part of a render: `lobe render --shard K/N` writes those",
        )?;
        let part: PartMetadata = part.parse().map_err(|error: ParsePartError| error.to_string())?;
        let seconds = match self.attribute("renderSeconds") {
            Some(AttributeValue::F64(seconds)) => *seconds,
            _ => 0.0,
        };
        Ok(Metadata {
            scene: text("scene").unwrap_or_default(),
            seed: text("seed").and_then(|seed| seed.parse().ok()).unwrap_or_default(),
            samples_per_pixel: part.samples.end - part.samples.start,
            seconds,
            part: Some(part),
        })
    }
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
