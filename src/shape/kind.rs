//! [`Read`]: how a kind of shape is read.

use super::obj::ObjMesh;
use crate::params::{Fault, Table};

/// How a kind of shape is read. Settings come first and files last: what is returned reads the mesh itself.
pub type Read = fn(&Table) -> Result<Load, Fault>;

/// Makes the mesh of a shape, for example from its file.
pub type Load = Box<dyn FnOnce() -> Result<ObjMesh, Fault>>;
