//! [`Axis`]: from values to places, and where its ticks are.

/// An axis with its title and unit.
#[derive(Clone, Debug, Default)]
pub struct Axis {
    /// What it shows, with the unit.
    pub title: String,
    /// How values are spread along it.
    pub scale: Scale,
    /// Ticks, where the usual ones would not do.
    pub ticks: Option<Vec<f64>>,
    /// What it spans at least.
    pub least: Option<(f64, f64)>,
}

/// How values are spread.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scale {
    /// Evenly.
    #[default]
    Linear,
    /// By their logarithm.
    Log,
}

/// Half of the lane for zero, as a part of what is above it.
const LANE: f64 = 0.06;

/// An axis that knows its ends.
pub struct Span {
    pub low: f64,
    pub high: f64,
    /// Where zero stands on a logarithmic axis, if a value is zero.
    pub lane: Option<f64>,
    scale: Scale,
    ticks: Vec<f64>,
}

impl Span {
    /// Around all finite values, with some room.
    pub fn new(axis: &Axis, values: impl Iterator<Item = f64>) -> Self {
        let log = axis.scale == Scale::Log;
        let place = |value: f64| if log { value.log10() } else { value };
        let (mut low, mut high, mut has_zero) = (f64::INFINITY, f64::NEG_INFINITY, false);
        let least = axis.least.into_iter().flat_map(|(low, high)| [low, high]);
        for value in values.chain(least) {
            has_zero |= log && value == 0.0;
            let place = place(value);
            if place.is_finite() {
                (low, high) = (low.min(place), high.max(place));
            }
        }
        if low > high {
            (low, high) = if log { (-1.0, 0.0) } else { (0.0, 1.0) };
        }
        // A flat line stands in the middle.
        let room = if high > low { 0.04 * (high - low) } else { 0.5 };
        (low, high) = (low - room, high + room);
        let ticks = match &axis.ticks {
            Some(ticks) => ticks.iter().map(|&tick| place(tick)).collect(),
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

    /// Where a value stands; `None` for what cannot be shown.
    pub fn place(&self, value: f64) -> Option<f64> {
        match self.scale {
            _ if value == f64::INFINITY => Some(self.high),
            Scale::Linear => value.is_finite().then_some(value),
            Scale::Log if value == 0.0 => self.lane,
            Scale::Log => (value > 0.0).then(|| value.log10()),
        }
    }

    /// Places of the ticks.
    pub fn ticks(&self) -> &[f64] {
        &self.ticks
    }

    /// What is written at a tick.
    pub fn label(&self, place: f64) -> String {
        match self.scale {
            Scale::Linear => plain(place),
            Scale::Log if self.lane == Some(place) => "0".into(),
            Scale::Log => {
                let (exponent, is_whole) = (place.round(), (place - place.round()).abs() < 1e-9);
                match exponent {
                    -3.0..=4.0 => plain(10_f64.powf(place)),
                    5.0..=7.0 if !is_whole => plain(10_f64.powf(place).round()),
                    _ if is_whole => format!("10{}", superscript(exponent as i32)),
                    _ => format!("{:.0e}", 10_f64.powf(place)),
                }
            }
        }
    }
}

/// Powers of ten, not more than ten of them; with 2 and 5 between them where there are few.
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

/// Round numbers, five to ten of them.
fn even_ticks(low: f64, high: f64) -> Vec<f64> {
    let rough = (high - low) / 6.0;
    let power = 10_f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].map(|part| part * power).into_iter().find(|&s| s >= rough);
    let step = step.unwrap_or(rough);
    let (first, last) = ((low / step).ceil() as i64, (high / step).floor() as i64);
    (first..=last).map(|n| n as f64 * step).collect()
}

/// Without what rounding adds.
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
