//! Reading of OpenEXR files that hold a part of a render.

use std::io::{BufRead, Seek};

use ::exr::meta::attribute::SampleType;
use ::exr::prelude::{AttributeValue, Vec2};
use glam::UVec2;

use super::exr_read::{Contents, Layout};
use super::memory::{Refusal, area, check, filled};
use super::{Metadata, ParsePartError, PartMetadata, Picture, Plane, Window};

/// How the names of channels begin that a film keeps.
const FILM: &str = "film.";

/// Reads the metadata of a part of a render, from the header alone.
pub fn metadata(
    mut source: impl BufRead + Seek,
    length: u64,
    limit: u64,
) -> Result<Metadata, Refusal> {
    metadata_of(&Layout::read(&mut source, length, limit)?)
}

/// Decodes what the film of a part of a render kept. Colours and layers are left out, since the film gives them.
pub fn decode(
    source: impl BufRead + Seek,
    length: u64,
    limit: u64,
) -> Result<(Picture, Metadata), Refusal> {
    let contents = Contents::read(source, length, limit)?;
    let (size, metadata) = (contents.layout.size, metadata_of(&contents.layout)?);
    let header = contents.header();
    let of_film = header.channels.channels_with_byte_offset().filter(|(_, channel)| {
        channel.sample_type == SampleType::U32 && channel.name.to_string().starts_with(FILM)
    });
    let of_film: Vec<_> = of_film.map(|(offset, channel)| (offset, &channel.name)).collect();
    let beside = 4 * of_film.len() as u128 * u128::from(area(size));
    check(size, contents.layout.base + beside, limit)?;
    let mut planes = Vec::new();
    for (_, name) in &of_film {
        planes.push(Plane { name: name.to_string(), values: filled(area(size), 0)? });
    }
    contents.rows(beside, |start, width, row| {
        for (plane, (offset, _)) in planes.iter_mut().zip(&of_film) {
            let words = row[offset * width..][..4 * width].as_chunks().0;
            for (value, word) in plane.values[start..].iter_mut().zip(words) {
                *value = u32::from_ne_bytes(*word);
            }
        }
    })?;
    let corner = |Vec2(x, y)| Some(UVec2::new(u32::try_from(x).ok()?, u32::try_from(y).ok()?));
    let min = corner(header.own_attributes.layer_position);
    let whole = header.shared_attributes.display_window.size;
    let resolution = UVec2::new(whole.0 as u32, whole.1 as u32);
    let window = min.map(|min| Window { min, max: min.saturating_add(size) });
    let window = window.filter(|window| window.max.cmple(resolution).all());
    let window = window.ok_or("its window reaches beyond the image")?;
    Ok((Picture { window, planes, ..Picture::new(resolution, Vec::new()) }, metadata))
}

fn metadata_of(layout: &Layout) -> Result<Metadata, Refusal> {
    let text = |name: &str| match layout.attribute(name) {
        Some(AttributeValue::Text(text)) => {
            Some(String::from_utf8_lossy(text.as_slice()).into_owned())
        }
        _ => None,
    };
    let part = text("part")
        .ok_or("it is not a complete part of a render: `lobe render --shard K/N` writes those")?;
    let part: PartMetadata = part.parse().map_err(|error: ParsePartError| error.to_string())?;
    let seconds = match layout.attribute("renderSeconds") {
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
