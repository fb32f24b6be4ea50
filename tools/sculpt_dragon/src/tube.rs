//! Tubes: flesh around a curve, with an oval section, muscles and a skin that follow it.

use glam::{DVec3, DVec4, Vec4Swizzles};

use crate::curve::{self, Span};
use crate::scales::{Skin, smoothstep};

/// Pieces into which a span is cut to tabulate its row coordinate.
const PIECES: usize = 8;
/// More than the height of any relief.
const RELIEF_REACH: f64 = 0.08;

/// A swelling of the tube about a place on it.
#[derive(Clone, Copy)]
pub struct Muscle {
    /// Place along the curve in keys, 2.5 being halfway between the third and fourth.
    pub at: f64,
    /// Half-length along the curve, in keys.
    pub along: f64,
    /// Angle about the curve: 0 at the back, positive towards `tangent x back`.
    pub angle: f64,
    /// Half-width in angle.
    pub around: f64,
    /// Height, as a part of the radius.
    pub height: f64,
}

/// A tube about a spline.
pub struct Tube {
    spans: Vec<Span>,
    /// Row coordinate of the skin at the cuts of each span.
    rows: Vec<[f64; PIECES + 1]>,
    /// The back of the tube is at `side x tangent`.
    side: DVec3,
    /// Width along `side`, as a part of the height along the back.
    oval: f64,
    skin: Skin,
    /// The skin's relief fades in over the first of these, and out over the second (in keys from
    /// either end).
    fade: (f64, f64),
    muscles: Vec<Muscle>,
}

impl Tube {
    /// A smooth round tube through `keys` (x, y, z, radius).
    pub fn new(keys: &[DVec4]) -> Tube {
        let spans = curve::interpolate(keys);
        let mut tube = Tube {
            spans,
            rows: Vec::new(),
            side: DVec3::Z,
            oval: 1.0,
            skin: Skin::Smooth,
            fade: (0.0, 0.0),
            muscles: Vec::new(),
        };
        tube.number_rows();
        tube
    }

    /// Covers the tube with `skin`, which fades in and out over `fade` keys at the two ends.
    pub fn skin(mut self, skin: Skin, fade: (f64, f64)) -> Tube {
        self.skin = skin;
        self.fade = fade;
        self.number_rows();
        self
    }

    /// Sets the direction that, crossed with the tangent, gives the back.
    pub fn side(mut self, side: DVec3) -> Tube {
        self.side = side.normalize();
        self
    }

    /// Makes the section an ellipse whose width is `oval` times its height.
    pub fn oval(mut self, oval: f64) -> Tube {
        self.oval = oval;
        self
    }

    /// Adds muscles.
    pub fn muscles(mut self, muscles: &[Muscle]) -> Tube {
        self.muscles.extend_from_slice(muscles);
        self
    }

    /// Number of spans.
    pub fn len(&self) -> usize {
        self.spans.len()
    }

    /// A ball that holds the part of the tube about span `i`.
    pub fn ball(&self, i: usize) -> (DVec3, f64) {
        let span = &self.spans[i];
        let centre = span.at(0.5).xyz();
        let cuts = (0..=32).map(|k| span.at(f64::from(k) / 32.0));
        let (mut far, mut thick): (f64, f64) = (0.0, 1e-3);
        for c in cuts {
            far = far.max(c.xyz().distance(centre));
            thick = thick.max(c.w);
        }
        let swelling: f64 = self.muscles.iter().map(|m| m.height.max(0.0)).sum();
        // Two percent for what lies between the cuts.
        (centre, 1.02 * far + 1.02 * thick * (self.oval.max(1.0) + swelling) + RELIEF_REACH)
    }

    /// Point, radius, back direction and sideways direction at `at` keys from the start.
    pub fn station(&self, at: f64) -> Station {
        let i = (at.max(0.0) as usize).min(self.spans.len() - 1);
        let t = at - i as f64;
        let c = self.spans[i].at(t);
        let tangent = self.spans[i].derivative(t).xyz().normalize();
        let back = self.side.cross(tangent).normalize();
        Station { centre: c.xyz(), radius: c.w, tangent, back, across: tangent.cross(back) }
    }

    /// Length of the curve per key at `at` keys from the start.
    pub fn speed(&self, at: f64) -> f64 {
        let i = (at.max(0.0) as usize).min(self.spans.len() - 1);
        self.spans[i].derivative(at - i as f64).xyz().length()
    }

    /// Signed distance (estimated) from `p` to the part of the tube about span `i`.
    pub fn distance(&self, i: usize, p: DVec3) -> f64 {
        let span = &self.spans[i];
        let t = span.closest(p);
        let c = span.at(t);
        let offset = p - c.xyz();
        let length = offset.length();
        let radius = c.w.max(1e-3);
        let plain =
            matches!(self.skin, Skin::Smooth) && self.oval == 1.0 && self.muscles.is_empty();
        if plain || length < 1e-9 {
            return length - radius;
        }
        let tangent = span.derivative(t).xyz().normalize();
        let back = self.side.cross(tangent).normalize();
        let (x, y) = (offset.dot(back), offset.dot(tangent.cross(back)));
        // On the caps the angle loses its meaning towards the pole, so everything that depends on
        // it fades there.
        let on_cap = (i == 0 && t == 0.0) || (i + 1 == self.spans.len() && t == 1.0);
        let sideways = if on_cap { (x * x + y * y) / (length * length) } else { 1.0 };
        let theta = y.atan2(x);
        let section =
            1.0 + sideways * (self.section(x, y) - 1.0 + self.swelling(i as f64 + t, theta));
        let bare = length - radius * section;
        // Far from the skin its relief changes nothing that matters.
        if bare.abs() > RELIEF_REACH || matches!(self.skin, Skin::Smooth) {
            return bare;
        }
        // Where a bend crowds the rows or pulls them apart, the relief gives way.
        let stretch = span.stretch(t, offset);
        let calm = smoothstep(0.15, 0.45, stretch) * (1.0 - smoothstep(1.6, 2.4, stretch));
        bare - radius * sideways * calm * self.relief(i, t, theta)
    }

    /// Radius of the unit section in direction (x, y).
    fn section(&self, x: f64, y: f64) -> f64 {
        if self.oval == 1.0 {
            return 1.0;
        }
        let l2 = x * x + y * y;
        if l2 == 0.0 { 1.0 } else { (l2 / (x * x + y * y / (self.oval * self.oval))).sqrt() }
    }

    fn swelling(&self, at: f64, theta: f64) -> f64 {
        let bump = |m: &Muscle| {
            let a = (at - m.at) / m.along;
            let turn = (theta - m.angle + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU)
                - std::f64::consts::PI;
            let b = turn / m.around;
            let q = a * a + b * b;
            if q < 1.0 { m.height * (1.0 - q) * (1.0 - q) } else { 0.0 }
        };
        self.muscles.iter().map(bump).sum()
    }

    fn relief(&self, i: usize, t: f64, theta: f64) -> f64 {
        let piece = ((t * PIECES as f64) as usize).min(PIECES - 1);
        let rows = &self.rows[i];
        let u = rows[piece] + (t * PIECES as f64 - piece as f64) * (rows[piece + 1] - rows[piece]);
        let at = i as f64 + t;
        let start = if self.fade.0 > 0.0 { smoothstep(0.0, self.fade.0, at) } else { 1.0 };
        let rest = self.spans.len() as f64 - at;
        let end = if self.fade.1 > 0.0 { smoothstep(0.0, self.fade.1, rest) } else { 1.0 };
        if start * end == 0.0 {
            return 0.0;
        }
        start * end * self.skin.relief(u, theta)
    }

    /// Integrates 1 / (length of a row) along the curve, so that rows shrink with the radius.
    fn number_rows(&mut self) {
        let mut u = 0.0;
        let mut rows = Vec::with_capacity(self.spans.len());
        for span in &self.spans {
            let mut row = [u; PIECES + 1];
            for (k, cut) in row.iter_mut().enumerate().skip(1) {
                let t = (k as f64 - 0.5) / PIECES as f64;
                let speed = span.derivative(t).xyz().length();
                u += speed / PIECES as f64 / (self.skin.row_length() * span.at(t).w.max(0.02));
                *cut = u;
            }
            rows.push(row);
        }
        self.rows = rows;
    }
}

/// A place on a tube with its frame.
pub struct Station {
    /// Point on the curve.
    pub centre: DVec3,
    /// Radius there.
    pub radius: f64,
    /// Unit tangent.
    pub tangent: DVec3,
    /// Unit direction of the back.
    pub back: DVec3,
    /// `tangent x back`.
    pub across: DVec3,
}
