//! [`Cells`]: the sphere of directions, divided where samples are dense.

use std::f64::consts::TAU;

use glam::{DVec2, Vec3};

/// Numbers of which integrals are taken together.
pub type Values = [f64; 4];

/// A rectangle in (1 - |cos θ|, φ) of one hemisphere: solid angle is its area.
#[derive(Clone, Copy)]
struct Cell {
    is_below: bool,
    low: DVec2,
    high: DVec2,
}

/// The sphere, divided into cells that hold equally many of some samples. The cells form a tree.
pub struct Cells {
    nodes: Vec<Node>,
    cells: Vec<Cell>,
    /// Of each cell.
    samples: Vec<Vec<DVec2>>,
}

enum Node {
    Leaf(usize),
    /// Axis, coordinate, and the nodes below and above it.
    Split(usize, f64, [usize; 2]),
}

/// Levels of the tree of each hemisphere.
const DEPTH: u32 = 12;

/// Cells in a row that are next to each other on the sphere, for tests that need more samples in each.
pub const GROUP: usize = 16;

impl Cells {
    /// Divides the sphere so that the cells of a hemisphere hold equally many of its `samples`.
    pub fn new(samples: &[Vec3]) -> Self {
        let mut cells = Self { nodes: Vec::new(), cells: Vec::new(), samples: Vec::new() };
        for is_below in [false, true] {
            let within = samples.iter().filter(|w| (w.z < 0.0) == is_below);
            let mut points: Vec<DVec2> = within.map(|&w| point(w)).collect();
            let all = Cell { is_below, low: DVec2::ZERO, high: DVec2::new(1.0, TAU) };
            cells.divide(all, &mut points, DEPTH);
        }
        cells
    }

    fn divide(&mut self, cell: Cell, points: &mut [DVec2], depth: u32) -> usize {
        let index = self.nodes.len();
        self.nodes.push(Node::Leaf(self.cells.len()));
        if depth == 0 {
            self.cells.push(cell);
            self.samples.push(points.to_vec());
            return index;
        }
        // Across the longer side of the cell on the sphere: r dφ against dq / r.
        let size = cell.high - cell.low;
        let middle = 0.5 * (cell.high + cell.low);
        let radius2 = middle.x * (2.0 - middle.x);
        let axis = usize::from(size.y * radius2 > size.x);
        let half = points.len() / 2;
        points.sort_unstable_by(|a, b| a[axis].total_cmp(&b[axis]));
        let is_inside = |at: f64| at > cell.low[axis] && at < cell.high[axis];
        let at = points.get(half).map(|p| p[axis]).filter(|&at| is_inside(at));
        let at = at.unwrap_or(middle[axis]);
        let count = points.partition_point(|p| p[axis] < at);
        let (below, above) = points.split_at_mut(count);
        let [mut first, mut second] = [cell; 2];
        first.high[axis] = at;
        second.low[axis] = at;
        let first = self.divide(first, below, depth - 1);
        let second = self.divide(second, above, depth - 1);
        self.nodes[index] = Node::Split(axis, at, [first, second]);
        index
    }

    pub fn count(&self) -> usize {
        self.cells.len()
    }

    /// The cell of a direction.
    pub fn of(&self, w: Vec3) -> usize {
        let point = point(w);
        // The first hemisphere has a full tree of nodes.
        let mut node = if w.z < 0.0 { (1 << (DEPTH + 1)) - 1 } else { 0 };
        loop {
            match &self.nodes[node] {
                Node::Leaf(cell) => return *cell,
                Node::Split(axis, at, sides) => node = sides[usize::from(point[*axis] >= *at)],
            }
        }
    }

    /// The integral of `f` over a cell.
    pub fn integrate(&self, cell: usize, f: &impl Fn(Vec3) -> Values) -> Values {
        let (points, cell) = (&self.samples[cell], self.cells[cell]);
        let peaks: Vec<_> =
            points.iter().map(|&at| (at, f(direction(cell.is_below, at)))).collect();
        refine(cell, gauss(cell, f), &peaks, f, 30)
    }
}

/// What is known about a cell from the points of Gauss's rule.
#[derive(Clone, Copy)]
struct Rule {
    integral: Values,
    /// Whether values at the points differ so much that there may be more between them.
    is_uneven: bool,
    /// The largest values.
    high: Values,
}

impl Rule {
    /// Whether a value in the cell is far above those at the points.
    fn is_below(&self, cell: Cell, values: &Values) -> bool {
        let size = cell.high - cell.low;
        let area = size.x * size.y;
        (0..4).any(|i| values[i] > 4.0 * self.high[i] && values[i] * area > 1e-6)
    }
}

/// The integral of a cell whose estimate is `coarse`, from those of its quarters.
///
/// `peaks` are values at samples: they tell of what lies between the points of the rule.
fn refine(
    cell: Cell,
    coarse: Rule,
    peaks: &[(DVec2, Values)],
    f: &impl Fn(Vec3) -> Values,
    depth: u32,
) -> Values {
    let middle = 0.5 * (cell.low + cell.high);
    let mut parts = [(cell, coarse); 4];
    let mut fine = [0.0; 4];
    for (i, (part, rule)) in parts.iter_mut().enumerate() {
        for axis in 0..2 {
            match i >> axis & 1 {
                0 => part.high[axis] = middle[axis],
                _ => part.low[axis] = middle[axis],
            }
        }
        *rule = gauss(*part, f);
        fine = sum(fine, rule.integral);
    }
    let is_good = |i: usize| (fine[i] - coarse.integral[i]).abs() <= 1e-7 + 1e-4 * fine[i].abs();
    let is_even = !coarse.is_uneven
        && parts.iter().all(|(_, rule)| !rule.is_uneven)
        && peaks.iter().all(|(_, values)| !coarse.is_below(cell, values));
    let is_done = is_even && (0..4).all(is_good) || fine.iter().any(|x| !x.is_finite());
    if depth == 0 || is_done {
        return fine;
    }
    let refined = |total, (part, rule): (Cell, Rule)| {
        let is_within = |at: DVec2| at.cmpge(part.low).all() && at.cmplt(part.high).all();
        let within: Vec<_> = peaks.iter().copied().filter(|(at, _)| is_within(*at)).collect();
        sum(total, refine(part, rule, &within, f, depth - 1))
    };
    parts.into_iter().fold([0.0; 4], refined)
}

fn sum(a: Values, b: Values) -> Values {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]]
}

/// Gauss's rule with three points along each axis.
fn gauss(cell: Cell, f: &impl Fn(Vec3) -> Values) -> Rule {
    const POINTS: [[f64; 2]; 3] = [
        [0.112_701_665_379_258_3, 5.0 / 18.0],
        [0.5, 8.0 / 18.0],
        [0.887_298_334_620_741_7, 5.0 / 18.0],
    ];
    let size = cell.high - cell.low;
    let area = size.x * size.y;
    let (mut integral, mut low, mut high) = ([0.0; 4], [f64::INFINITY; 4], [0.0; 4]);
    for [x, weight_x] in POINTS {
        for [y, weight_y] in POINTS {
            let values = f(direction(cell.is_below, cell.low + size * DVec2::new(x, y)));
            for i in 0..4 {
                integral[i] += weight_x * weight_y * area * values[i];
                low[i] = values[i].min(low[i]);
                high[i] = values[i].max(high[i]);
            }
        }
    }
    let is_uneven = (0..4).any(|i| high[i] > 32.0 * low[i] && high[i] * area > 1e-6);
    let rule = Rule { integral, is_uneven, high };
    let corners = [
        cell.low,
        cell.high,
        DVec2::new(cell.low.x, cell.high.y),
        DVec2::new(cell.high.x, cell.low.y),
    ];
    let is_below = |at: DVec2| rule.is_below(cell, &f(direction(cell.is_below, at)));
    Rule { is_uneven: is_uneven || corners.into_iter().any(is_below), ..rule }
}

/// (1 - |cos θ|, φ) of a direction: precise near the poles.
fn point(w: Vec3) -> DVec2 {
    let w = w.as_dvec3();
    let from_pole = (w.x * w.x + w.y * w.y) / (1.0 + w.z.abs());
    DVec2::new(from_pole.min(1.0), w.y.atan2(w.x).rem_euclid(TAU))
}

fn direction(is_below: bool, point: DVec2) -> Vec3 {
    let sin = (point.x * (2.0 - point.x)).sqrt();
    let cos = (1.0 - point.x) as f32;
    let cos = if is_below { -cos } else { cos };
    Vec3::new((sin * point.y.cos()) as f32, (sin * point.y.sin()) as f32, cos)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::Random;

    /// Seen to fail with the hemispheres exchanged, and with an edge of a cell taken for its middle.
    #[test]
    fn cells_divide_the_sphere() {
        let mut random = Random::new(1);
        let mut any = || {
            let (z, phi) = (2.0 * f64::from(random.next()) - 1.0, TAU * f64::from(random.next()));
            direction(z < 0.0, DVec2::new(1.0 - z.abs(), phi))
        };
        let samples: Vec<Vec3> = (0..20_000).map(|_| any()).filter(|w| w.x > 0.0).collect();
        let cells = Cells::new(&samples);
        let mut area = 0.0;
        for cell in 0..cells.count() {
            area += cells.integrate(cell, &|_| [1.0; 4])[0];
        }
        assert!((area - 2.0 * TAU).abs() < 1e-9, "{area}");
        for w in (0..10_000).map(|_| any()) {
            let Cell { is_below, low, high } = cells.cells[cells.of(w)];
            let at = point(w);
            assert!((w.z < 0.0) == is_below && at.cmpge(low).all() && at.cmple(high).all(), "{w}");
        }
    }
}
