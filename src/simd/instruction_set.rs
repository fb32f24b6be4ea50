//! [`InstructionSet`]: which instructions rays are traced and hits are shaded with.

use std::fmt;
use std::str::FromStr;

#[cfg(target_arch = "x86_64")]
use super::avx2::Avx2;
#[cfg(target_arch = "x86_64")]
use super::avx512::Avx512;
use super::float::Block;
use super::lanes::{Kernel, LANES, Lanes};
use super::portable::Portable;

/// The SIMD instructions that rays are traced and hits are shaded with: `portable`, `avx2` or `avx512`.
///
/// A value always names instructions that this processor has. All give the same picture to the bit, at different
/// speed. Choose one other than the fastest for measuring and for tests.
///
/// ```
/// use lobe::accel::InstructionSet;
///
/// let fastest = InstructionSet::fastest();
/// assert_eq!(InstructionSet::available().last(), Some(&fastest));
/// assert_eq!(fastest.name().parse(), Ok(fastest));
/// let error = "sse9".parse::<InstructionSet>().unwrap_err();
/// assert_eq!(error.to_string(), "unknown instruction set \"sse9\": expected portable, avx2 or avx512");
/// ```
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct InstructionSet(Known);

/// All instruction sets. Those beyond `Portable` are only ever stored in an [`InstructionSet`] if the processor has
/// them, which [`InstructionSet::run`] relies on.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Known {
    Portable,
    Avx2,
    Avx512,
}

impl Known {
    /// From the slowest to the fastest.
    const ALL: [Self; 3] = [Self::Portable, Self::Avx2, Self::Avx512];

    fn name(self) -> &'static str {
        match self {
            Self::Portable => "portable",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
        }
    }

    fn is_available(self) -> bool {
        match self {
            Self::Portable => true,
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => Avx2::is_available(),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => Avx512::is_available(),
            #[cfg(not(target_arch = "x86_64"))]
            Self::Avx2 | Self::Avx512 => false,
        }
    }
}

/// Why a name is no [`InstructionSet`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum InstructionSetError {
    /// There is no instruction set of that name.
    #[error("unknown instruction set {0:?}: expected portable, avx2 or avx512")]
    Unknown(String),
    /// This processor lacks it.
    #[error("this processor does not have {0}: it has {list}", list = available_names())]
    Unavailable(&'static str),
}

fn available_names() -> String {
    InstructionSet::available().iter().map(|set| set.name()).collect::<Vec<_>>().join(", ")
}

impl InstructionSet {
    /// Glam's vectors of four, which every processor runs: SSE2 on x86-64.
    pub const PORTABLE: Self = Self(Known::Portable);

    /// Those that this processor has, the fastest last: [`PORTABLE`](Self::PORTABLE); `avx2`, which is AVX2 with
    /// FMA, BMI1, BMI2, LZCNT and POPCNT; `avx512`, which adds AVX-512 F, VL, BW and DQ.
    pub fn available() -> Vec<Self> {
        Known::ALL.into_iter().filter(|set| set.is_available()).map(Self).collect()
    }

    /// The fastest of those that this processor has.
    pub fn fastest() -> Self {
        let fastest = Known::ALL.into_iter().rev().find(|set| set.is_available());
        fastest.map_or(Self::PORTABLE, Self)
    }

    /// The name, as [`FromStr`] reads it.
    pub fn name(self) -> &'static str {
        self.0.name()
    }

    /// Lanes of the vector that the triangles of a leaf are tested with ([`Lanes::Narrow`]).
    pub(crate) fn leaf_lanes(self) -> usize {
        match self.0 {
            Known::Avx2 => 8,
            Known::Portable | Known::Avx512 => LANES,
        }
    }

    /// Runs a kernel with these instructions.
    #[inline(always)]
    pub(crate) fn run<K: Kernel>(
        self,
        data: &K::Data,
        scratch: &mut K::Scratch,
        input: &K::Input,
        kernel: K,
    ) -> K::Output {
        match self.0 {
            #[cfg(target_arch = "x86_64")]
            Known::Avx512 => Avx512::call(data, scratch, input, kernel),
            #[cfg(target_arch = "x86_64")]
            Known::Avx2 => Avx2::call(data, scratch, input, kernel),
            _ => Portable::call(data, scratch, input, kernel),
        }
    }

    /// Runs a loop over blocks with these instructions.
    #[inline(always)]
    pub(crate) fn run_block<K: BlockKernel>(self, kernel: K) -> K::Output {
        self.run(&(), &mut (), &(), OfLanes(kernel))
    }
}

/// A loop over blocks of numbers that is written once for all instruction sets.
///
/// As for [`Kernel`], `run` and all that takes or returns vectors is marked `#[inline(always)]`.
pub trait BlockKernel {
    /// The result.
    type Output;

    /// Runs the loop with one type of vectors.
    fn run<F: Block>(self) -> Self::Output;
}

/// A [`BlockKernel`] as a [`Kernel`].
struct OfLanes<K>(K);

impl<K: BlockKernel> Kernel for OfLanes<K> {
    type Input = ();
    type Data = ();
    type Scratch = ();
    type Output = K::Output;

    #[inline(always)]
    fn run<L: Lanes>(self, (): &(), (): &(), (): &mut ()) -> K::Output {
        self.0.run::<L::Block>()
    }
}

/// The fastest.
impl Default for InstructionSet {
    fn default() -> Self {
        Self::fastest()
    }
}

impl fmt::Display for InstructionSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl fmt::Debug for InstructionSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for InstructionSet {
    type Err = InstructionSetError;

    fn from_str(name: &str) -> Result<Self, InstructionSetError> {
        let Some(set) = Known::ALL.into_iter().find(|set| set.name() == name) else {
            return Err(InstructionSetError::Unknown(name.to_owned()));
        };
        if set.is_available() {
            Ok(Self(set))
        } else {
            Err(InstructionSetError::Unavailable(set.name()))
        }
    }
}
