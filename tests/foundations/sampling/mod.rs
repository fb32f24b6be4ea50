//! Warps, samplers, and the permutation behind stratified samples.

mod blue_noise;
mod domains;
mod permutation;
mod samplers;
mod sobol;
mod warps;
