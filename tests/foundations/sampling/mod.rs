//! Warps, samplers, and the permutation behind stratified samples.

mod blue_noise;
mod discrete;
mod discrete_2d;
mod domains;
mod permutation;
mod samplers;
mod sobol;
mod spherical_rectangle;
mod warps;
