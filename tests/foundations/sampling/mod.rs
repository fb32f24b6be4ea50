//! Warps, samplers, and the permutation behind stratified samples.

mod discrete;
mod domains;
mod permutation;
mod samplers;
mod spherical_rectangle;
mod warps;
