//! Sixteen f32 at a time, computed with the widest instructions of the processor.
//!
//! Holds the vector traits that traversal is generic over ([`Lanes`], [`Vector`]), one implementation per
//! instruction set, and [`InstructionSet`], which picks one at run time. Knows [`Ray`](crate::geometry::Ray) and
//! nothing of trees. The vector types stay private to this room: only [`InstructionSet::run`] names them, after it
//! has asked the processor, so that code outside cannot execute an instruction that is missing.

// Intrinsics, loads and stores of whole vectors, and calls to functions with `#[target_feature]`.
#![allow(unsafe_code)]

mod instruction_set;
mod lanes;
mod portable;

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
#[cfg(target_arch = "x86_64")]
mod f32x8;
#[cfg(target_arch = "x86_64")]
mod mask_tables;
#[cfg(target_arch = "x86_64")]
mod transpose;

pub use instruction_set::{InstructionSet, InstructionSetError};
pub use lanes::{Kernel, LANES, LaneIndices, Lanes, Mask, Vector, splat3};
