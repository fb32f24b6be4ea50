//! [`Contract`]: what lobes have to keep, and what to do where they do not.

/// What a lobe has to keep; each variant is documented by how it is broken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Contract {
    /// A value, density or direction is not finite, or negative.
    Invalid,
    /// A sample is on a side of the surface that the flags exclude.
    Side,
    /// The flags of a sample are not those of its event.
    Event,
    /// The value of a sample, or of `f_and_pdf`, is not f at its direction.
    Value,
    /// The density of a sample, or of `f_and_pdf`, is not pdf at its direction.
    Density,
    /// Samples are not distributed as the density says.
    Distribution,
    /// The density and what is rejected do not add up to 1.
    Integral,
    /// More light is returned than comes in.
    Gain,
    /// Light is lost against the promise to return all.
    Loss,
    /// The mean weight of samples is not the integral of f cos θ.
    Albedo,
    /// Exchanged directions give another value.
    Reciprocity,
    /// Samples change with `uc`, which `uses_uc` denies: renderers give such a lobe none.
    EventNumber,
}

impl Contract {
    /// All contracts, in the order of their declaration.
    pub const ALL: [Self; 12] = [
        Self::Invalid,
        Self::Side,
        Self::Event,
        Self::Value,
        Self::Density,
        Self::Distribution,
        Self::Integral,
        Self::Gain,
        Self::Loss,
        Self::Albedo,
        Self::Reciprocity,
        Self::EventNumber,
    ];

    /// Its name, in one word or two.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Invalid => "invalid",
            Self::Side => "wrong side",
            Self::Event => "wrong event",
            Self::Value => "value of samples",
            Self::Density => "density of samples",
            Self::Distribution => "distribution",
            Self::Integral => "integral of pdf",
            Self::Gain => "energy gained",
            Self::Loss => "energy lost",
            Self::Albedo => "albedo",
            Self::Reciprocity => "reciprocity",
            Self::EventNumber => "use of uc",
        }
    }

    /// Whether it is not looked at from directions from which f32 does not [resolve](super::Direction::is_resolved) the lobe.
    pub const fn needs_resolution(self) -> bool {
        matches!(self, Self::Distribution | Self::Integral | Self::Albedo)
    }

    /// Whether it is not looked at where light crosses the surface [with several indices](super::Report::has_several_indices).
    pub const fn needs_one_index(self) -> bool {
        matches!(self, Self::Gain | Self::Loss | Self::Albedo | Self::Reciprocity)
    }

    /// What was seen, in a sentence without its full stop.
    pub const fn meaning(self) -> &'static str {
        match self {
            Self::Invalid => "a value, density or direction is not finite, or negative",
            Self::Side => "a sample is on a side of the surface that the flags exclude",
            Self::Event => "the flags of a sample are not those of its event",
            Self::Value => "the value of a sample, or of f_and_pdf, is not f at its direction",
            Self::Density => {
                "the density of a sample, or of f_and_pdf, is not pdf at its direction"
            }
            Self::Distribution => "samples are not distributed as pdf says (chi-square)",
            Self::Integral => "pdf and the share of samples without direction do not add up to 1",
            Self::Gain => "more light is returned than comes in",
            Self::Loss => "light is lost against the promise to return all",
            Self::Albedo => "the mean weight of samples is not the integral of f cos θ",
            Self::Reciprocity => "f changes when its directions are exchanged",
            Self::EventNumber => "samples change with uc, and uses_uc is false",
        }
    }

    /// What to look for.
    pub const fn hint(self) -> &'static str {
        match self {
            Self::Invalid => "look for 0/0 along the surface, and for roots of numbers below 0",
            Self::Side => "return None for samples on the other side",
            Self::Event => "give samples the flags of their event, not all flags of the lobe",
            Self::Value => "return f(wo, wi) of the sampled direction",
            Self::Density => "return pdf(wo, wi) of the sampled direction, of all events together",
            Self::Distribution => "pdf must be the density with which sample_f draws",
            Self::Integral => "pdf must integrate to 1 over all directions, less the share of None",
            Self::Gain => "look for a missing factor 1/eta² or a factor that counts twice",
            Self::Loss => "look for a factor below 1 that counts twice",
            Self::Albedo => "look at pdf, and for parts of f that sample_f never draws",
            Self::Reciprocity => "f(wo, wi) = f(wi, wo), with the factor eta² across a boundary",
            Self::EventNumber => "return true from uses_uc",
        }
    }
}
