//! Warps, samplers, and the permutation behind stratified samples.

mod domains;
mod permutation;
mod samplers;
mod warps;
