//! A sculpture: groups of shapes, joined one after another.

use glam::{DMat3, DVec3, DVec4};

use crate::shape::{Shape, ellipsoid, round_cone, smooth_max, smooth_min};
use crate::tube::Tube;

/// How a group joins what stands before it.
#[derive(Clone, Copy)]
pub enum Join {
    /// Flesh is added.
    Add,
    /// Flesh is taken away.
    Carve,
}

/// Shapes that are joined to one another before they join the rest.
pub struct Group {
    join: Join,
    /// Width over which the group blends with what stands before it.
    pub blend: f64,
    /// Width over which the group's shapes blend with one another.
    pub inner: f64,
}

/// Groups of shapes in the order in which they are joined.
#[derive(Default)]
pub struct Sculpture {
    tubes: Vec<Tube>,
    groups: Vec<Group>,
    /// Each shape with its group; groups ascend.
    shapes: Vec<(usize, Shape)>,
    /// A ball that holds each shape; infinite where the distance is too rough an estimate to be
    /// compared with one's.
    balls: Vec<(DVec3, f64)>,
}

impl Sculpture {
    /// Begins a group; the shapes that follow belong to it.
    pub fn group(&mut self, join: Join, blend: f64, inner: f64) {
        self.groups.push(Group { join, blend, inner });
    }

    /// Adds a tube to the present group.
    pub fn tube(&mut self, tube: Tube) {
        let index = self.tubes.len();
        for span in 0..tube.len() {
            self.push(Shape::Tube { tube: index, span }, tube.ball(span));
        }
        self.tubes.push(tube);
    }

    /// Adds a round tube through `keys` (x, y, z, radius).
    pub fn bone(&mut self, keys: &[DVec4]) {
        self.tube(Tube::new(keys));
    }

    /// Adds the hull of two balls.
    pub fn cone(&mut self, a: DVec3, ra: f64, b: DVec3, rb: f64) {
        let ball = (a.midpoint(b), 0.5 * a.distance(b) + ra.max(rb));
        self.push(Shape::Cone { a, b, ra, rb }, ball);
    }

    /// Adds an ellipsoid whose axes are the columns of `frame`.
    pub fn ellipsoid(&mut self, centre: DVec3, frame: DMat3, radii: DVec3) {
        self.push(Shape::Ellipsoid { centre, frame, radii }, (centre, f64::INFINITY));
    }

    /// Adds everything beyond the plane at `offset` along the unit vector `normal`.
    pub fn beyond(&mut self, normal: DVec3, offset: f64) {
        self.push(Shape::Beyond { normal, offset }, (DVec3::ZERO, f64::INFINITY));
    }

    fn push(&mut self, shape: Shape, ball: (DVec3, f64)) {
        self.shapes.push((self.groups.len() - 1, shape));
        self.balls.push(ball);
    }

    /// Number of shapes.
    pub fn len(&self) -> usize {
        self.shapes.len()
    }

    /// The group of shape `i`: its number and itself.
    pub fn group_of(&self, i: usize) -> (usize, &Group) {
        let g = self.shapes[i].0;
        (g, &self.groups[g])
    }

    /// Signed distance (estimated) from `p` to shape `i` alone.
    pub fn distance(&self, i: usize, p: DVec3) -> f64 {
        match self.shapes[i].1 {
            Shape::Tube { tube, span } => self.tubes[tube].distance(span, p),
            Shape::Cone { a, b, ra, rb } => round_cone(p, a, b, ra, rb),
            Shape::Ellipsoid { centre, ref frame, radii } => ellipsoid(p, centre, frame, radii),
            Shape::Beyond { normal, offset } => offset - normal.dot(p),
        }
    }

    /// The field at `p`, as if only the shapes in `list` (ascending) existed.
    pub fn value(&self, p: DVec3, list: &[u16]) -> f64 {
        let mut field = f64::INFINITY;
        let mut i = 0;
        while i < list.len() {
            let (g, group) = self.group_of(list[i] as usize);
            // A shape at this distance or beyond makes no difference to the field.
            let idle = match group.join {
                Join::Add => field + group.blend,
                Join::Carve => group.blend - field,
            };
            let mut inside = f64::INFINITY;
            while i < list.len() && self.shapes[list[i] as usize].0 == g {
                let shape = list[i] as usize;
                i += 1;
                let (centre, radius) = self.balls[shape];
                if group.inner == 0.0 && p.distance(centre) - radius >= idle.min(inside) {
                    continue;
                }
                let d = self.distance(shape, p);
                inside = if group.inner > 0.0 {
                    smooth_min(inside, d, group.inner)
                } else {
                    inside.min(d)
                };
            }
            field = match group.join {
                Join::Add => smooth_min(field, inside, group.blend),
                Join::Carve => smooth_max(field, -inside, group.blend),
            };
        }
        field
    }
}
