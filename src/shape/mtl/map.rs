//! [`MtlMap`]: an image of an MTL file, with its options.

/// An image that an MTL file names, and how it is placed.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct MtlMap {
    /// The line that names it, counted from 1.
    pub line: u64,
    /// The name, as in the file: relative to its folder, often with backslashes.
    pub file: String,
    /// `-s`: factors of the texture coordinates.
    pub scale: [f32; 3],
    /// `-o`: added to the scaled texture coordinates.
    pub offset: [f32; 3],
    /// `-mm`: the values are base + gain · value.
    pub base_gain: [f32; 2],
    /// `-bm`: factor of heights.
    pub bump: f32,
    /// `-clamp`: whether the image stands once.
    pub is_clamped: bool,
    /// `-imfchan`: the channel that is read: r, g, b, m (matte), l (luminance) or z (depth).
    pub channel: Option<char>,
}

/// Parses options and the name after them. `None` if an option is not known or lacks a number, or if there is no name.
pub fn parse(line: u64, text: &str) -> Option<MtlMap> {
    let mut map = MtlMap {
        line,
        file: String::new(),
        scale: [1.0; 3],
        offset: [0.0; 3],
        base_gain: [0.0, 1.0],
        bump: 1.0,
        is_clamped: false,
        channel: None,
    };
    let mut rest = text.trim();
    while let Some(option) = rest.strip_prefix('-') {
        let (name, after) = word(option)?;
        rest = after;
        match &*name.to_ascii_lowercase() {
            "s" => rest = numbers(rest, &mut map.scale)?,
            "o" => rest = numbers(rest, &mut map.offset)?,
            // Turbulence is noise that programs do not agree on.
            "t" => rest = numbers(rest, &mut [0.0; 3])?,
            "mm" => rest = numbers(rest, &mut map.base_gain)?,
            "bm" => rest = numbers(rest, std::slice::from_mut(&mut map.bump))?,
            "boost" | "texres" => rest = word(rest)?.1,
            "clamp" => {
                let (value, after) = word(rest)?;
                (map.is_clamped, rest) = (value.eq_ignore_ascii_case("on"), after);
            }
            "imfchan" => {
                let (value, after) = word(rest)?;
                (map.channel, rest) = (value.chars().next(), after);
            }
            "blendu" | "blendv" | "cc" | "type" => rest = word(rest)?.1,
            _ => return None,
        }
    }
    map.file = rest.trim_matches('"').to_owned();
    (!map.file.is_empty()).then_some(map)
}

/// The first word and what follows it.
fn word(text: &str) -> Option<(&str, &str)> {
    let text = text.trim_start();
    let end = text.find(char::is_whitespace).unwrap_or(text.len());
    let (word, rest) = text.split_at(end);
    (!word.is_empty()).then_some((word, rest.trim_start()))
}

/// Reads as many numbers as there are, at least one and at most as many as `into` has.
fn numbers<'a>(mut text: &'a str, into: &mut [f32]) -> Option<&'a str> {
    for (i, number) in into.iter_mut().enumerate() {
        let found = word(text).and_then(|(word, rest)| Some((word.parse::<f32>().ok()?, rest)));
        match found {
            Some((value, rest)) if value.is_finite() => (*number, text) = (value, rest),
            _ if i > 0 => break,
            _ => return None,
        }
    }
    Some(text)
}
