//! Several numbers at a time, computed with the widest instructions of the processor.
//!
//! - [`Float`]: what formulas are generic over. A formula stands once for f32, f64 and vectors.
//! - [`Block`]: what loops over blocks of numbers need besides; [`BlockKernel`] is such a loop.
//! - [`Lanes`], [`Vector`] and [`Eight`]: what traversal needs besides; [`Kernel`] is code that is generic over them.
//! - [`InstructionSet`], which picks an implementation at run time.
//!
//! The vector types stay private to this room: only [`InstructionSet::run`] names them, after it has asked the processor,
//! so that code outside cannot execute an instruction that is missing.

// Intrinsics, loads and stores of whole vectors, and calls to functions with `#[target_feature]`.
#![allow(unsafe_code)]

mod eight;
mod f32x4;
mod float;
mod instruction_set;
mod lanes;
mod portable;
mod row;
mod scalar;
#[cfg(test)]
mod tests;
mod twice;

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
#[cfg(target_arch = "x86_64")]
mod f32x8;
#[cfg(target_arch = "x86_64")]
mod transpose;

pub use eight::{ARITY, Eight};
pub use float::{Bits, Block, Float, LaneMask, MAX_LANES, Mask, eighth_turn, four};
pub use instruction_set::{BlockKernel, InstructionSet, InstructionSetError};
pub use lanes::{Kernel, LANES, LaneIndices, Lanes, Pick, Vector, splat3};
pub use row::{ROW, Row, RowMask, Rows, groups, indices, lanes_within};
