//! [`Axis`], and how its values map to positions and ticks.

/// An axis with its title and unit.
#[derive(Clone, Debug, Default)]
pub struct Axis {
    /// The quantity and its unit.
    pub title: String,
    /// Linear or logarithmic.
    pub scale: Scale,
    /// Values of the ticks, in position of automatic ones.
    pub ticks: Option<Vec<f64>>,
    /// A range that the axis covers in any case.
    pub least: Option<(f64, f64)>,
}

/// How values map to positions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scale {
    /// In proportion.
    #[default]
    Linear,
    /// By their logarithm.
    Log,
}

/// Half of the height of the lane for zero, relative to the rest of the axis.
const LANE: f64 = 0.06;

/// An axis with its range. Positions are values on a linear axis and decimal logarithms on a logarithmic one.
pub struct Span {
    pub low: f64,
    pub high: f64,
    /// Position of zero on a logarithmic axis, if any value is zero.
    pub lane: Option<f64>,
    scale: Scale,
    ticks: Vec<f64>,
}

impl Span {
    /// The range of all finite values, with a margin.
    pub fn new(axis: &Axis, values: impl Iterator<Item = f64>) -> Self {
        let log = axis.scale == Scale::Log;
        let position = |value: f64| if log { value.log10() } else { value };
        let (mut low, mut high, mut has_zero) = (f64::INFINITY, f64::NEG_INFINITY, false);
        let least = axis.least.into_iter().flat_map(|(low, high)| [low, high]);
        for value in values.chain(least) {
            has_zero |= log && value == 0.0;
            let position = position(value);
            if position.is_finite() {
                (low, high) = (low.min(position), high.max(position));
            }
        }
        if low > high {
            (low, high) = if log { (-1.0, 0.0) } else { (0.0, 1.0) };
        }
        // A single value is put in the middle.
        let room = if high > low { 0.04 * (high - low) } else { 0.5 };
        (low, high) = (low - room, high + room);
        let ticks = match &axis.ticks {
            Some(ticks) => ticks.iter().map(|&tick| position(tick)).collect(),
            None if log => log_ticks(low, high),
            None => even_ticks(low, high),
        };
        let mut ticks: Vec<f64> =
            ticks.into_iter().filter(|tick| (low..=high).contains(tick)).collect();
        let lane = has_zero.then_some(low - LANE * (high - low));
        if let Some(lane) = lane {
            low = lane - LANE * (high - low);
            ticks.insert(0, lane);
        }
        Self { low, high, lane, scale: axis.scale, ticks }
    }

    /// The position of a value; `None` if it cannot be shown.
    pub fn position(&self, value: f64) -> Option<f64> {
        match self.scale {
            _ if value == f64::INFINITY => Some(self.high),
            Scale::Linear => value.is_finite().then_some(value),
            Scale::Log if value == 0.0 => self.lane,
            Scale::Log => (value > 0.0).then(|| value.log10()),
        }
    }

    /// Positions of the ticks.
    pub fn ticks(&self) -> &[f64] {
        &self.ticks
    }

    /// The label of a tick.
    pub fn label(&self, position: f64) -> String {
        match self.scale {
            Scale::Linear => plain(position),
            Scale::Log if self.lane == Some(position) => "0".into(),
            Scale::Log => {
                let (exponent, is_whole) =
                    (position.round(), (position - position.round()).abs() < 1e-9);
                match exponent {
                    -3.0..=4.0 => plain(10_f64.powf(position)),
                    5.0..=7.0 if !is_whole => plain(10_f64.powf(position).round()),
                    _ if is_whole => format!("10{}", superscript(exponent as i32)),
                    _ => format!("{:.0e}", 10_f64.powf(position)),
                }
            }
        }
    }
}

/// At most ten powers of ten; on short axes also multiples of them.
fn log_ticks(low: f64, high: f64) -> Vec<f64> {
    let (first, last) = (low.floor() as i32, high.ceil() as i32);
    let step = ((high - low) / 9.0).ceil().max(1.0) as usize;
    let parts: &[f64] = match high - low {
        ..1.2 => &[1.0, 1.5, 2.0, 3.0, 5.0, 7.0],
        ..2.6 => &[1.0, 2.0, 5.0],
        _ => &[1.0],
    };
    let decade = |exponent: i32| parts.iter().map(move |part| f64::from(exponent) + part.log10());
    (first..=last).filter(|e| e.rem_euclid(step as i32) == 0).flat_map(decade).collect()
}

/// Five to ten round numbers.
fn even_ticks(low: f64, high: f64) -> Vec<f64> {
    let rough = (high - low) / 6.0;
    let power = 10_f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].map(|part| part * power).into_iter().find(|&s| s >= rough);
    let step = step.unwrap_or(rough);
    let (first, last) = ((low / step).ceil() as i64, (high / step).floor() as i64);
    (first..=last).map(|n| n as f64 * step).collect()
}

/// The number without digits that are rounding errors.
fn plain(value: f64) -> String {
    let rounded: f64 = format!("{value:.6e}").parse().unwrap_or(value);
    format!("{}", rounded + 0.0)
}

fn superscript(number: i32) -> String {
    let letter = |c: char| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        c => c.to_digit(10).and_then(|d| char::from_u32(0x2070 + d)).unwrap_or(c),
    };
    number.to_string().chars().map(letter).collect()
}
