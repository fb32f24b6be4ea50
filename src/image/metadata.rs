//! [`Metadata`]: how a picture was made.

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
}

/// Name and version of this crate, which files give as their software.
pub(super) const SOFTWARE: &str = concat!("lobe ", env!("CARGO_PKG_VERSION"));
