//! [`Path`]: which instructions rays are traced with, and the way from the outside to them.

#[cfg(target_arch = "x86_64")]
use super::lanes::{Avx2, Avx512};
use super::lanes::{LANES, Portable};
use super::stack::Stack;
use super::walk::{Found, Start, Unsure};
use super::{Accel, Hit};
use crate::geometry::Ray;

/// The instructions that rays are traced with. All give the same hits to the bit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Path {
    /// What every processor of the target has.
    Portable,
    /// AVX2.
    Avx2,
    /// AVX-512 with its extensions VL, BW and DQ.
    Avx512,
}

impl Path {
    /// Those that this processor has, the fastest last.
    pub fn available() -> Vec<Self> {
        #[cfg_attr(not(target_arch = "x86_64"), expect(unused_mut))]
        let mut paths = vec![Self::Portable];
        #[cfg(target_arch = "x86_64")]
        {
            let has = [
                is_x86_feature_detected!("avx2"),
                is_x86_feature_detected!("bmi1"),
                is_x86_feature_detected!("bmi2"),
                is_x86_feature_detected!("lzcnt"),
                is_x86_feature_detected!("popcnt"),
            ];
            let has_512 = [
                is_x86_feature_detected!("avx512f"),
                is_x86_feature_detected!("avx512vl"),
                is_x86_feature_detected!("avx512bw"),
                is_x86_feature_detected!("avx512dq"),
            ];
            if has.iter().all(|&it| it) {
                paths.push(Self::Avx2);
                if has_512.iter().all(|&it| it) {
                    paths.push(Self::Avx512);
                }
            }
        }
        paths
    }

    /// How many triangles a leaf is to hold at most, so that they and their vertices mostly fit into one of the
    /// vectors that leaves are tested with.
    pub(super) fn most_in_leaf(self) -> usize {
        match self {
            Self::Avx2 => 8,
            Self::Portable | Self::Avx512 => LANES,
        }
    }
}

/// Defines a method of [`Accel`] that goes the way of its path to a generic one. All of it that uses vectors has
/// to be inlined into a function that is compiled for the instructions of the path. Nowhere else may a type of
/// vectors be chosen.
macro_rules! dispatch {
    ($name:ident($accel:ident, $stack:ident, $($argument:ident: $type:ty),*) -> $result:ty, <$lanes:ident> $body:expr) => {
        #[inline(always)]
        pub(super) fn $name(&self, stack: &mut Stack, $($argument: $type),*) -> $result {
            #[inline(always)]
            fn generic<$lanes: super::lanes::Lanes>($accel: &Accel, $stack: &mut Stack, $($argument: $type),*) -> $result {
                $body
            }
            fn portable(accel: &Accel, stack: &mut Stack, $($argument: $type),*) -> $result {
                generic::<Portable>(accel, stack, $($argument),*)
            }
            #[cfg(target_arch = "x86_64")]
            #[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt")]
            fn avx2(accel: &Accel, stack: &mut Stack, $($argument: $type),*) -> $result {
                generic::<Avx2>(accel, stack, $($argument),*)
            }
            #[cfg(target_arch = "x86_64")]
            #[target_feature(enable = "avx512f,avx512vl,avx512bw,avx512dq,avx2,bmi1,bmi2,lzcnt,popcnt")]
            fn avx512(accel: &Accel, stack: &mut Stack, $($argument: $type),*) -> $result {
                generic::<Avx512>(accel, stack, $($argument),*)
            }
            match self.path {
                #[cfg(target_arch = "x86_64")]
                // SAFETY: the path is one of those that are available.
                Path::Avx512 => unsafe { avx512(self, stack, $($argument),*) },
                #[cfg(target_arch = "x86_64")]
                // SAFETY: likewise.
                Path::Avx2 => unsafe { avx2(self, stack, $($argument),*) },
                _ => portable(self, stack, $($argument),*),
            }
        }
    };
}

impl Accel {
    dispatch!(answer_hits(accel, stack, rays: &[Ray], hits: &mut [Hit]) -> (), <L> {
        accel.answer_batch::<L, Hit>(stack, rays, hits);
    });
    dispatch!(answer_occluded(accel, stack, rays: &[Ray], occluded: &mut [bool]) -> (), <L> {
        accel.answer_batch::<L, bool>(stack, rays, occluded);
    });
    dispatch!(closest_of_one(accel, stack, ray: &Ray, start: Start) -> Found, <L> {
        match accel.find::<L, false>(stack, ray, start) {
            Ok(found) => found,
            Err(Unsure) => accel.surely_closest(stack, ray, start),
        }
    });
    dispatch!(any_of_one(accel, stack, ray: &Ray, start: Start) -> bool, <L> {
        match accel.find_any::<L, false>(stack, ray, start) {
            Ok(found) => found,
            Err(Unsure) => accel.surely_any(stack, ray, start),
        }
    });
    // Not part of the two above, since they hardly ever run.
    dispatch!(surely_closest(accel, stack, ray: &Ray, start: Start) -> Found, <L> {
        accel.find::<L, true>(stack, ray, start).unwrap_or(None)
    });
    dispatch!(surely_any(accel, stack, ray: &Ray, start: Start) -> bool, <L> {
        accel.find_any::<L, true>(stack, ray, start).unwrap_or(false)
    });
}
