//! Properties of `assets/dragon.obj`, checked on the file itself.
//!
//! Truth: a closed, oriented two-manifold has every directed edge once and its reverse once, and
//! one fan of triangles at each vertex; the volume enclosed by triangles that look outwards is
//! positive (divergence theorem). Each check was seen to fail on a file broken on purpose; the
//! break stands beside it.

use std::collections::{HashMap, HashSet};

const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/dragon.obj");

type Vector = [f64; 3];

struct Dragon {
    positions: Vec<Vector>,
    normals: Vec<Vector>,
    triangles: Vec<[usize; 3]>,
}

/// Reads `v`, `vn` and `f a//a b//b c//c` lines, which are all that the sculptor writes.
fn read() -> Dragon {
    let text = std::fs::read_to_string(FILE).expect("assets/dragon.obj is there");
    let mut dragon = Dragon { positions: Vec::new(), normals: Vec::new(), triangles: Vec::new() };
    for (n, line) in text.lines().enumerate() {
        let (kind, rest) = line.split_once(' ').unwrap_or((line, ""));
        let mut words = rest.split(' ');
        let mut three = || {
            [0; 3].map(|_| words.next().unwrap_or_else(|| panic!("line {}: three words", n + 1)))
        };
        let number = |w: &str| w.parse::<f64>().unwrap_or_else(|e| panic!("line {}: {e}", n + 1));
        match kind {
            "#" => {}
            "v" => dragon.positions.push(three().map(number)),
            "vn" => dragon.normals.push(three().map(number)),
            "f" => dragon.triangles.push(three().map(|w| corner(w, n + 1))),
            _ => panic!("line {}: `{line}`", n + 1),
        }
    }
    dragon
}

/// `7//7` as 6: position and normal of a corner have the same index.
fn corner(word: &str, line: usize) -> usize {
    let (v, vn) = word.split_once("//").unwrap_or_else(|| panic!("line {line}: `{word}`"));
    assert_eq!(v, vn, "line {line}: position and normal differ");
    v.parse::<usize>().unwrap_or_else(|e| panic!("line {line}: {e}")) - 1
}

fn minus(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

impl Dragon {
    fn corners(&self, t: &[usize; 3]) -> [Vector; 3] {
        t.map(|v| self.positions[v])
    }

    /// Twice the area, along the normal.
    fn normal2(&self, t: &[usize; 3]) -> Vector {
        let [a, b, c] = self.corners(t);
        cross(minus(b, a), minus(c, a))
    }
}

/// Seen to fail with every fifth face left out, and with two million bytes of comment.
#[test]
fn size() {
    let bytes = std::fs::metadata(FILE).expect("assets/dragon.obj is there").len();
    assert!(bytes < 8_000_000, "{bytes} bytes");
    let dragon = read();
    let n = dragon.triangles.len();
    assert!((90_000..=110_000).contains(&n), "{n} triangles");
    assert_eq!(dragon.positions.len(), dragon.normals.len());
}

/// Seen to fail with one face left out, and with the corners of one face in another order.
#[test]
fn closed_and_oriented() {
    let dragon = read();
    let mut edges = HashSet::new();
    for t in &dragon.triangles {
        for k in 0..3 {
            let edge = (t[k], t[(k + 1) % 3]);
            assert!(edge.0 != edge.1, "a triangle names vertex {} twice", edge.0);
            assert!(edges.insert(edge), "edge {edge:?} occurs twice in the same direction");
        }
    }
    for &(a, b) in &edges {
        assert!(edges.contains(&(b, a)), "edge {:?} has a triangle on one side only", (a, b));
    }
}

/// Seen to fail with two distant vertices welded into one, and with one face left out.
#[test]
fn one_fan_at_each_vertex() {
    let dragon = read();
    // For each vertex, the link: from each neighbour to the next around the vertex.
    let mut links = vec![HashMap::new(); dragon.positions.len()];
    for t in &dragon.triangles {
        for k in 0..3 {
            links[t[k]].insert(t[(k + 1) % 3], t[(k + 2) % 3]);
        }
    }
    for (v, link) in links.iter().enumerate() {
        let first = *link.keys().next().unwrap_or_else(|| panic!("vertex {v} is in no triangle"));
        let (mut at, mut steps) = (first, 0);
        while steps < link.len() {
            at = *link
                .get(&at)
                .unwrap_or_else(|| panic!("the triangles about vertex {v} do not close"));
            steps += 1;
            if at == first {
                break;
            }
        }
        assert!(
            at == first && steps == link.len(),
            "the triangles about vertex {v} are not one fan"
        );
    }
}

/// Seen to fail with a tetrahedron added.
#[test]
fn one_piece() {
    let dragon = read();
    let mut neighbours = vec![Vec::new(); dragon.positions.len()];
    for t in &dragon.triangles {
        for k in 0..3 {
            neighbours[t[k]].push(t[(k + 1) % 3]);
        }
    }
    let mut seen = vec![false; dragon.positions.len()];
    let mut stack = vec![0];
    while let Some(v) = stack.pop() {
        if !std::mem::replace(&mut seen[v], true) {
            stack.extend(&neighbours[v]);
        }
    }
    let apart = seen.iter().filter(|s| !**s).count();
    assert_eq!(apart, 0, "vertices that do not hang together with the first");
}

/// Seen to fail with the corners of all faces in the other order.
#[test]
fn outward() {
    let dragon = read();
    let volume: f64 = dragon
        .triangles
        .iter()
        .map(|t| {
            let [a, b, c] = dragon.corners(t);
            dot(a, cross(b, c)) / 6.0
        })
        .sum();
    assert!(volume > 1.0, "volume {volume}");
}

/// Seen to fail with one vertex moved onto another, and with one moved onto the middle of an edge
/// opposite to it.
#[test]
fn no_degenerate_triangle() {
    let dragon = read();
    let mut places = HashSet::new();
    for p in &dragon.positions {
        assert!(p.iter().all(|x| x.is_finite()));
        assert!(places.insert(p.map(f64::to_bits)), "two vertices at {p:?}");
    }
    for t in &dragon.triangles {
        let [a, b, c] = dragon.corners(t);
        let n = dragon.normal2(t);
        // Height over the longest side, as a part of that side.
        let longest =
            [minus(b, a), minus(c, b), minus(a, c)].iter().map(|&e| dot(e, e)).fold(0.0, f64::max);
        let height = dot(n, n).sqrt() / longest;
        assert!(height > 1e-3, "triangle {t:?} is a sliver: {height}");
    }
}

/// Seen to fail with one normal doubled, with one turned about, and with 600 laid flat.
#[test]
fn normals_are_unit_and_agree_with_the_faces() {
    let dragon = read();
    let mut means = vec![[0.0; 3]; dragon.positions.len()];
    let mut agree = 0;
    for t in &dragon.triangles {
        let n = dragon.normal2(t);
        for &v in t {
            means[v] = [0, 1, 2].map(|k| means[v][k] + n[k]);
            agree += usize::from(dot(dragon.normals[v], n) > 0.0);
        }
    }
    for (v, (&n, mean)) in dragon.normals.iter().zip(means).enumerate() {
        // Four decimals are written.
        let length = dot(n, n).sqrt();
        assert!((length - 1.0).abs() < 2e-4, "normal {v} has length {length}");
        assert!(dot(n, mean) > 0.0, "normal {v} looks away from its triangles");
    }
    // At the edges of scales and claws a corner may look away from one of its triangles.
    let share = agree as f64 / (3 * dragon.triangles.len()) as f64;
    assert!(share > 0.995, "only {share} of the corners look the way of their face");
}

/// Seen to fail with the feet lifted by 0.001, with the whole moved by 0.1, and 1.2 times as large.
#[test]
fn stands_on_the_ground_about_the_origin() {
    let dragon = read();
    let mut low = [f64::INFINITY; 3];
    let mut high = [f64::NEG_INFINITY; 3];
    for p in &dragon.positions {
        low = [0, 1, 2].map(|k| low[k].min(p[k]));
        high = [0, 1, 2].map(|k| high[k].max(p[k]));
    }
    assert_eq!(low[1], 0.0, "the lowest point");
    assert!((2.7..=3.0).contains(&high[1]), "height {}", high[1]);
    for (axis, extent) in [(0, 4.1..=4.3), (2, 1.7..=2.1)] {
        assert!(
            (low[axis] + high[axis]).abs() < 1e-5,
            "axis {axis}: {} to {}",
            low[axis],
            high[axis]
        );
        let size = high[axis] - low[axis];
        assert!(extent.contains(&size), "axis {axis}: extent {size}");
    }
}
