//! [`StudentT`]: Student's t distribution, the error of a mean over an estimate of its standard error.

use std::f64::consts::TAU;

/// Student's t distribution: of a normally distributed error divided by an estimate of its standard error.
///
/// ```
/// use lobe::metrics::StudentT;
///
/// // From four set means, an interval of 95 % takes 3.18 standard errors on either side; of a known error, 1.96.
/// let four_sets = StudentT { degrees_of_freedom: 3.0 };
/// assert!((four_sets.two_sided_quantile(0.05) - 3.182446).abs() < 1e-6);
/// assert!((StudentT::NORMAL.two_sided_quantile(0.05) - 1.959964).abs() < 1e-6);
/// // So 3.18 standard errors are no more surprising than 1.96 of a known one.
/// assert!((four_sets.normal_deviate(3.182446) - 1.959964).abs() < 1e-6);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StudentT {
    /// Degrees of freedom of the estimate, at least 1. Infinite for a known standard error.
    pub degrees_of_freedom: f64,
}

impl StudentT {
    /// The normal distribution, its limit for many degrees of freedom.
    pub const NORMAL: Self = Self { degrees_of_freedom: f64::INFINITY };

    /// The distribution for this number of degrees of freedom; the normal one if it is not known.
    pub fn of(degrees_of_freedom: Option<u32>) -> Self {
        degrees_of_freedom.map_or(Self::NORMAL, |n| Self { degrees_of_freedom: f64::from(n) })
    }

    /// The t that is exceeded on either side with this probability altogether, which has to be in (0, 1).
    pub fn two_sided_quantile(self, probability: f64) -> f64 {
        let target = probability.ln();
        // In logarithms: one degree of freedom has t = 6e11 at a probability of 1e-12.
        let (mut low, mut high) = (-40.0_f64, 40.0_f64);
        while high - low > 1e-14 {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            if self.ln_two_sided(middle.exp()) > target { low = middle } else { high = middle }
        }
        (0.5 * (low + high)).exp()
    }

    /// The z that the normal distribution exceeds as rarely as this one exceeds `t`; both at least 0.
    pub fn normal_deviate(self, t: f64) -> f64 {
        let (nu, near) = (self.degrees_of_freedom, self.about_normal_deviate(t));
        if nu > MANY || t == 0.0 {
            return near;
        }
        // Newton's method. The logarithm of the tail is concave, so that all steps but the first go down to the root.
        let target = self.ln_two_sided(t);
        let mut z = near;
        for _ in 0..20 {
            let tail = Self::NORMAL.ln_two_sided(z);
            let slope = -2.0 * (-0.5 * z * z - tail).exp() / TAU.sqrt();
            let step = (tail - target) / slope;
            z = (z - step).max(0.0);
            if step.abs() <= 1e-10 * z {
                break;
            }
        }
        z
    }

    /// [`normal_deviate`](Self::normal_deviate), about: Peizer and Pratt 1968, "A normal approximation for binomial, F, beta,
    /// and other common, related tail probabilities". The limit is t.
    pub(super) fn about_normal_deviate(self, t: f64) -> f64 {
        let nu = self.degrees_of_freedom;
        if nu.is_infinite() {
            return t;
        }
        (nu - 2.0 / 3.0 + 0.1 / nu) * ((t * t / nu).ln_1p() / (nu - 5.0 / 6.0)).sqrt()
    }

    /// The logarithm of the probability that |t| is exceeded, for `t` of at least 0.
    fn ln_two_sided(self, t: f64) -> f64 {
        let nu = self.degrees_of_freedom;
        if nu > MANY {
            return ln_normal_two_sided(if nu.is_infinite() { t } else { self.normal_deviate(t) });
        }
        // The tail is the regularised incomplete beta function I_x(ν/2, 1/2) with x = ν / (ν + t²) (Abramowitz and
        // Stegun 26.7.1).
        let (a, b, y) = (0.5 * nu, 0.5, t * t / (nu + t * t));
        let x = nu / (nu + t * t);
        let ln_factor = ln_beta_factor(a) - a * (t * t / nu).ln_1p() + b * y.ln();
        if x < (a + 1.0) / (a + b + 2.0) {
            ln_factor - a.ln() + beta_fraction(x, a, b).ln()
        } else {
            // I_x(a, b) = 1 - I_y(b, a) for y = 1 - x, where the fraction converges fast.
            (-ln_factor.exp() / b * beta_fraction(y, b, a)).ln_1p()
        }
    }
}

/// From this many degrees of freedom on, the approximation by Peizer and Pratt is as good as exact.
const MANY: f64 = 1e5;

/// The logarithm of 1 / B(a, 1/2) = Γ(a + 1/2) / (Γ(a) √π), to 1e-15: from a = 16 on by its asymptotic series, below by
/// recurrence.
fn ln_beta_factor(a: f64) -> f64 {
    let (mut shift, mut a) = (1.0, a);
    while a < 16.0 {
        shift *= a / (a + 0.5);
        a += 1.0;
    }
    let square = 1.0 / (a * a);
    let series = (-1.0 / 8.0
        + square * (1.0 / 192.0 - square * (1.0 / 640.0 - square * 17.0 / 14336.0)))
        / a;
    shift.ln() + 0.5 * (2.0 * a / TAU).ln() + series
}

/// The continued fraction of the incomplete beta function (Abramowitz and Stegun 26.5.8), by Lentz's method: I_x(a, b) is
/// xᵃ (1 - x)ᵇ / (a B(a, b)) times this. It converges fast for x below (a + 1) / (a + b + 2).
fn beta_fraction(x: f64, a: f64, b: f64) -> f64 {
    let (mut value, mut c, mut d) = (1.0, 1.0, 0.0);
    for step in 1..10_000_u32 {
        let m = f64::from(step / 2);
        let numerator = if step % 2 == 1 {
            -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0))
        } else {
            m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m))
        };
        d = 1.0 / (1.0 + numerator * d);
        c = 1.0 + numerator / c;
        value *= c * d;
        if (c * d - 1.0).abs() < 1e-15 {
            break;
        }
    }
    1.0 / value
}

/// The logarithm of the probability that a normal variable exceeds `z` on either side, for `z` of at least 0.
fn ln_normal_two_sided(z: f64) -> f64 {
    let ln_density = -0.5 * (z * z + TAU.ln());
    if z < 3.0 {
        // 1/2 + φ(z) (z + z³/3 + z⁵/(3·5) + ...) is below z (Abramowitz and Stegun 26.2.11).
        let (mut term, mut sum, mut k) = (z, z, 1.0);
        while term > 1e-17 * sum {
            k += 2.0;
            term *= z * z / k;
            sum += term;
        }
        (-2.0 * ln_density.exp() * sum).ln_1p()
    } else {
        // φ(z) / (z + 1/(z + 2/(z + 3/...))) is above it (26.2.14). 100 terms give all digits at z = 3.
        let fraction = (1..=100).rev().fold(z, |tail, k| z + f64::from(k) / tail);
        std::f64::consts::LN_2 + ln_density - fraction.ln()
    }
}
