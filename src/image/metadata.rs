//! [`Metadata`]: how a picture was made.

use std::fmt::{self, Display, Formatter};
use std::ops::Range;
use std::str::FromStr;

/// How a picture was made. PNG and EXR files store it beside the pixels.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Metadata {
    /// The scene's name, usually the path of its file.
    pub scene: String,
    /// The sampler's seed.
    pub seed: u64,
    /// Samples taken in each pixel.
    pub samples_per_pixel: u32,
    /// Wall-clock seconds of the rendering, without loading and writing.
    pub seconds: f64,
    /// Which part of a render it is, if it is not a whole one. EXR files alone hold it.
    pub part: Option<PartMetadata>,
}

/// Which part of a render a picture is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PartMetadata {
    /// Its samples, of those of a pixel.
    pub samples: Range<u32>,
    /// Samples of a pixel in all parts together.
    pub all_samples: u32,
    /// Samples that were left out because they were not finite.
    pub non_finite: u64,
    /// What is rendered, in lines `key = value`: parts of one render have the same.
    pub identity: String,
}

impl Display for PartMetadata {
    /// The samples in a line, then the identity.
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        let Self { samples, all_samples, non_finite, identity } = self;
        let Range { start, end } = samples;
        write!(f, "samples {start} to {end} of {all_samples}, {non_finite} not finite\n{identity}")
    }
}

/// A text that is not of a part of a render.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("its attribute `part` is damaged")]
pub struct ParsePartError;

impl FromStr for PartMetadata {
    type Err = ParsePartError;

    fn from_str(text: &str) -> Result<Self, ParsePartError> {
        let parse = || {
            let (head, identity) = text.split_once('\n')?;
            let (start, rest) = head.strip_prefix("samples ")?.split_once(" to ")?;
            let (end, rest) = rest.split_once(" of ")?;
            let (all, rest) = rest.split_once(", ")?;
            let samples = start.parse().ok()?..end.parse().ok()?;
            let all_samples = all.parse().ok()?;
            let non_finite = rest.strip_suffix(" not finite")?.parse().ok()?;
            let is_sound = samples.start < samples.end && samples.end <= all_samples;
            let identity = identity.to_owned();
            is_sound.then_some(Self { samples, all_samples, non_finite, identity })
        };
        parse().ok_or(ParsePartError)
    }
}

/// Name and version of this crate, which files give as their software.
pub(super) const SOFTWARE: &str = concat!("lobe ", env!("CARGO_PKG_VERSION"));
