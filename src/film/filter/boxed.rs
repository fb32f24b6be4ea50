//! The box: the pixel itself, and nothing around it.

use super::{Filter, ReadFilter};
use crate::params::Kind;

/// `filter = "box"`
pub(super) const KIND: Kind<ReadFilter> =
    Kind { name: "box", meaning: "The pixel itself", keys: &[], read: |_| Ok(Filter::Box) };
