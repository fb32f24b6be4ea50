//! Parameters: typed values read from a tree, with each key declared once.
//!
//! Each [`Kind`] of material, light, and so on declares its [`Key`]s as constants: name, meaning, range, default.
//! The same constants read its [`Table`] and generate `lobe help` and the page of the scene format. Undeclared keys
//! are errors, which suggest the nearest declared name.
//!
//! This module is independent of all kinds and of the file format. It reads a [`Document`], a tree in which every
//! value has a [`Mark`]. A [`Fault`] contains the mark of what is wrong.
//!
//! ```
//! use lobe::params::{Document, Fault, Key, Kind, Node, Section, Table};
//!
//! const WIDTH: Key<f32> = Key::new("width", "of a stripe, in scene units").above(0.0);
//! const SOFT: Key<bool> = Key::new("soft", "whether edges fade").default(false);
//!
//! fn read(table: &Table) -> Result<(f32, bool), Fault> {
//!     Ok((table.get(&WIDTH)?, table.get(&SOFT)?))
//! }
//!
//! type Read = fn(&Table) -> Result<(f32, bool), Fault>;
//! const STRIPES: Kind<Read> =
//!     Kind { name: "stripes", meaning: "Bands along x", keys: &[&WIDTH, &SOFT], read };
//! const PATTERN: Section<Read> = Section {
//!     key: "pattern",
//!     plural: "patterns",
//!     is_named: false,
//!     selector: "type",
//!     default: None,
//!     common: &[],
//!     kinds: &[STRIPES],
//! };
//!
//! let pattern = |key, value: f32| {
//!     let pattern = Node::table([("type", "stripes".into()), (key, value.into())]);
//!     let document = Document::new(Node::table([("pattern", pattern.value)]));
//!     let root = document.table("the drawing", &["pattern"])?;
//!     PATTERN.read(root.table("pattern")?, |kind, table| (kind.read)(table))
//! };
//! assert_eq!(pattern("width", 2.0).unwrap(), (2.0, false));
//! let message = |key, value| pattern(key, value).unwrap_err().to_string();
//! assert_eq!(message("width", 0.0), "`pattern.width` is 0, expected a finite number above 0");
//! assert_eq!(
//!     message("witdh", 2.0),
//!     "unknown key `witdh` in [pattern] of type \"stripes\"; did you mean `width`?"
//! );
//! ```

mod choice;
mod error;
mod handedness;
mod hint;
mod key;
mod kind;
mod limits;
mod param;
mod quantity;
mod shown;
mod table;
mod tree;

pub use choice::Choice;
pub use error::{Fault, Problem};
pub use handedness::Handedness;
pub use hint::hint;
pub(crate) use hint::one_of;
pub use key::{AnyKey, Key};
pub use kind::{AnySection, Kind, Section};
pub use limits::Limits;
pub use param::Param;
pub use quantity::{Direction, Factor, Rotation, Scale};
pub(crate) use shown::shortened;
pub use shown::{Shown, quoted};
pub use table::{Document, Table};
pub use tree::{Entry, Mark, Node, Value};
