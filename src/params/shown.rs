//! [`Shown`]: text of a user in a message, safe to print on a terminal.

use std::borrow::Cow;
use std::fmt::{self, Display, Formatter, Write};
use std::path::Path;

/// Maximum length of a name, key or value in a message, in characters.
const NAME: usize = 60;

/// Maximum length of a path or an override in a message, in characters.
const LINE: usize = 256;

/// Text from a user or a file, within a message: in one line, without what a terminal obeys, and not longer than can be
/// read. Every message of this crate shows names, keys, values and paths in this way.
///
/// - Control characters, line separators, and marks that change the direction of text (Unicode Standard Annex 9) are
///   escaped: `\n`, `\u{1b}`. All else is shown as it is, also a backslash.
/// - In a text that is too long, an ellipsis takes the place of the middle.
///
/// ```
/// use lobe::params::Shown;
///
/// assert_eq!(Shown::name("red\n\u{1b}[31m").to_string(), r"red\n\u{1b}[31m");
/// assert_eq!(Shown::path("C:\\my scene.toml".as_ref()).to_string(), "C:\\my scene.toml");
/// assert_eq!(Shown::name(&"long".repeat(100)).to_string().chars().count(), 60);
/// ```
#[derive(Clone, Debug)]
pub struct Shown<'a>(Cow<'a, str>);

impl<'a> Shown<'a> {
    /// A name, key or value: at most 60 characters of it.
    pub fn name(text: &'a str) -> Self {
        Self(middle_cut(text, NAME))
    }

    /// A path: at most 256 characters of it.
    pub fn path(path: &'a Path) -> Self {
        match path.to_string_lossy() {
            Cow::Borrowed(text) => Self(middle_cut(text, LINE)),
            Cow::Owned(text) => Self(middle_cut(&text, LINE).into_owned().into()),
        }
    }

    /// A line of text, such as an override: at most 256 characters of it.
    pub fn line(text: &'a str) -> Self {
        Self(middle_cut(text, LINE))
    }

    /// A text of any length, which stays whole.
    pub fn whole(text: &'a str) -> Self {
        Self(text.into())
    }
}

impl Display for Shown<'_> {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        self.0.chars().try_for_each(|c| match c {
            '\n' => f.write_str("\\n"),
            '\r' => f.write_str("\\r"),
            '\t' => f.write_str("\\t"),
            c if is_obeyed(c) => write!(f, "{}", c.escape_unicode()),
            c => f.write_char(c),
        })
    }
}

/// The text in quotes, escaped as in Rust; at most 60 characters of it.
pub fn quoted(text: &str) -> String {
    format!("{:?}", middle_cut(text, NAME))
}

/// At most 60 characters of a text.
pub(crate) fn shortened(text: &str) -> Cow<'_, str> {
    middle_cut(text, NAME)
}

/// Whether terminals take a character for a command or a change of direction.
fn is_obeyed(c: char) -> bool {
    let is_direction = matches!(
        c,
        '\u{61C}' | '\u{200E}' | '\u{200F}' | '\u{202A}'..='\u{202E}' | '\u{2066}'..='\u{2069}'
    );
    c.is_control() || is_direction || matches!(c, '\u{2028}' | '\u{2029}')
}

/// At most `most` characters of a text, with an ellipsis in the middle where any are left out.
fn middle_cut(text: &str, most: usize) -> Cow<'_, str> {
    // Bytes are quick to count, and are no fewer.
    if text.len() <= most || text.chars().count() <= most {
        return text.into();
    }
    let head = most / 2;
    let offset = |place: Option<(usize, char)>| place.map_or(0, |(offset, _)| offset);
    let head_end = offset(text.char_indices().nth(head));
    let tail_start = offset(text.char_indices().rev().nth(most - head - 2));
    format!("{}…{}", &text[..head_end], &text[tail_start..]).into()
}
