//! [`Study`]: the results for one scene, and their charts.

use std::fmt::Write;

use super::{Bias, Curve, CurvePoint, Reference, pareto_front};
use crate::metrics::chart::{Axis, Chart, Line, Point, Scale};

/// Results of several methods against one reference.
#[derive(Clone, Debug)]
pub struct Study {
    /// Name of the scene.
    pub scene: String,
    /// The reference.
    pub reference: Reference,
    /// One curve for each method, in the order of the legend.
    pub curves: Vec<Curve>,
    /// The bias of each method, if it is known.
    pub biases: Vec<Option<Bias>>,
    /// Pictures of other programs.
    pub others: Vec<Other>,
}

/// A picture by another program, with the time it took.
#[derive(Clone, Debug, PartialEq)]
pub struct Other {
    /// Its name in the legend.
    pub label: String,
    /// Seconds of its rendering.
    pub seconds: f64,
    /// relMSE against the reference, whose own error is included.
    pub rel_mse: f64,
}

const ERROR: &str = "error: root of relMSE (1 = 100 %)";

impl Study {
    /// Error against time, with the Pareto front.
    pub fn error_by_time(&self) -> Chart {
        let set_ups = self.points().map(|point| point.set_up);
        let set_up = set_ups.fold(f64::INFINITY, f64::min);
        let note = format!("set-up, {set_up:.2} s or more, is part of it");
        let on_front = pareto_front(&self.curves).into_iter();
        Chart {
            title: format!("{}: error against time", self.scene),
            x: Axis {
                title: "time (s), set-up and rendering".into(),
                scale: Scale::Log,
                ..Axis::default()
            },
            lines: self.lines(Curve::slope_by_time, CurvePoint::time).chain(self.loose()).collect(),
            // Shown only where it does not compress the rest of the axis; the table has it in any case.
            marks: if self.shortest() < 20.0 * set_up { vec![(set_up, note)] } else { Vec::new() },
            pareto_front: on_front.filter_map(|(_, p)| Some((p.time(), p.error?[1]))).collect(),
            ..self.chart()
        }
    }

    /// Error against samples per pixel.
    pub fn error_by_samples(&self) -> Chart {
        let mut budgets: Vec<u32> = self.points().map(|point| point.spp).collect();
        budgets.sort_unstable();
        budgets.dedup();
        Chart {
            title: format!("{}: error against samples", self.scene),
            x: Axis {
                title: "samples per pixel".into(),
                scale: Scale::Log,
                ticks: Some(budgets.into_iter().map(f64::from).collect()),
                ..Axis::default()
            },
            lines: self.lines(Curve::slope_by_samples, |point| f64::from(point.spp)).collect(),
            ..self.chart()
        }
    }

    /// The error of each method relative to the smallest one after the same time.
    pub fn error_at_equal_time(&self) -> Chart {
        let least = |time: f64| {
            let errors = self.curves.iter().filter_map(|curve| curve.error_at(time));
            errors.fold(f64::INFINITY, f64::min)
        };
        let line = |(style, curve): (usize, &Curve)| {
            let own: Vec<f64> = curve.claimed().map(|(point, _)| point.time()).collect();
            let point = |&time: &f64| Some(Point::new(time, curve.error_at(time)? / least(time)));
            Line {
                name: curve.method.clone(),
                style,
                is_loose: false,
                points: own.iter().filter_map(point).collect(),
            }
        };
        Chart {
            title: format!("{}: error after the same time, over the least", self.scene),
            x: Axis {
                title: "time (s), set-up and rendering".into(),
                scale: Scale::Log,
                ..Axis::default()
            },
            y: Axis {
                title: "error over that of the best method".into(),
                scale: Scale::Log,
                least: Some((1.0, 1.5)),
                ..Axis::default()
            },
            lines: self.curves.iter().enumerate().map(line).collect(),
            ..Chart::default()
        }
    }

    /// All points as comma-separated values, with a header line.
    pub fn csv(&self) -> String {
        let mut csv = String::from(
            "method,spp,runs,set_up_s,render_s,error_q1,error_median,error_q3,measured_median,reference_error,bias\n",
        );
        let floor = self.reference.floor();
        for (curve, bias) in self.curves.iter().zip(&self.biases) {
            let name = curve.method.replace('"', "\"\"");
            for CurvePoint { spp, runs, set_up, seconds, error, measured } in &curve.points {
                let error =
                    error.map_or(",,".into(), |[q1, q2, q3]| format!("{q1:e},{q2:e},{q3:e}"));
                let largest = curve.points.last().is_some_and(|last| last.spp == *spp);
                let bias =
                    bias.filter(|_| largest).map_or(String::new(), |b| format!("{:e}", b.error));
                let _ = writeln!(
                    csv,
                    "\"{name}\",{spp},{runs},{set_up:.6},{seconds:.6},{error},{:e},{floor:e},{bias}",
                    measured[1]
                );
            }
        }
        for other in &self.others {
            let Other { label, seconds, rel_mse } = other;
            let measured = rel_mse.sqrt();
            let claimed = self
                .reference
                .claimed(*rel_mse)
                .map_or(String::new(), |error| format!("{error:e}"));
            let label = label.replace('"', "\"\"");
            let _ = writeln!(csv, "\"{label}\",,1,,{seconds},,{claimed},,{measured:e},{floor:e},");
        }
        csv
    }

    fn points(&self) -> impl Iterator<Item = &CurvePoint> {
        self.curves.iter().flat_map(|curve| &curve.points)
    }

    fn shortest(&self) -> f64 {
        self.points().map(CurvePoint::time).fold(f64::INFINITY, f64::min)
    }

    /// Common parts of both charts of errors.
    fn chart(&self) -> Chart {
        let floor = self.reference.floor();
        let note = format!("below the reference's own error of {floor:.2e} nothing is claimed");
        Chart {
            y: Axis {
                title: ERROR.into(),
                scale: Scale::Log,
                // Room for the note.
                least: Some((floor / 1.7, floor)),
                ..Axis::default()
            },
            floor: Some((floor, note)),
            ..Chart::default()
        }
    }

    fn lines(
        &self,
        slope: impl Fn(&Curve) -> Option<f64>,
        x: impl Fn(&CurvePoint) -> f64,
    ) -> impl Iterator<Item = Line> {
        self.curves.iter().zip(&self.biases).enumerate().map(move |(style, (curve, bias))| {
            let point = |p: &CurvePoint| match p.error {
                Some([q1, median, q3]) => Point {
                    range: Some((q1.max(self.reference.floor()), q3)),
                    ..Point::new(x(p), median)
                },
                None => Point { is_faint: true, ..Point::new(x(p), self.reference.floor()) },
            };
            let note = match (bias, slope(curve)) {
                (Some(bias), _) if bias.is_certain() => format!(", biased by {:.2e}", bias.size()),
                (_, Some(slope)) => format!(", slope {slope:.2}").replace('-', "−"),
                (_, None) => String::new(),
            };
            Line {
                name: curve.method.clone() + &note,
                style,
                is_loose: false,
                points: curve.points.iter().map(point).collect(),
            }
        })
    }

    fn loose(&self) -> impl Iterator<Item = Line> {
        self.others.iter().enumerate().map(|(index, other)| {
            let error = self.reference.claimed(other.rel_mse);
            let point = Point {
                is_faint: error.is_none(),
                ..Point::new(other.seconds, error.unwrap_or(self.reference.floor()))
            };
            Line {
                name: other.label.clone(),
                style: self.curves.len() + index,
                is_loose: true,
                points: vec![point],
            }
        })
    }
}
