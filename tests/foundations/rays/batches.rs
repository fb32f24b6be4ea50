//! Batches give the same as single rays, for any rays in any order.

use lobe::accel::{Accel, Hit};
use lobe::geometry::Ray;
use lobe::glam::Vec3;

use super::answers::{assert_batch, cut, orders};
use super::kinds::{Kind, many, none};
use crate::common::Rng;
use crate::common::meshes::{lumpy, placed, soup};

/// A tree, rays, and the hit of each ray alone.
struct RunningMean {
    accel: Accel,
    rays: Vec<Ray>,
    hits: Vec<Hit>,
    /// Where the rays of each group end: a camera's tiles, rays of every kind, invalid rays.
    ends: [usize; 3],
}

/// Camera rays in tiles of 8 x 8 pixels, as a renderer orders them.
fn tiles(eye: Vec3, side: usize) -> impl Iterator<Item = Ray> {
    let per_row = side / 8;
    (0..side * side).map(move |i| {
        let (tile, pixel) = (i / 64, i % 64);
        let (x, y) = (tile % per_row * 8 + pixel % 8, tile / per_row * 8 + pixel / 8);
        let on_film = |pixel: usize| (pixel as f32 + 0.5) / side as f32 - 0.5;
        let across = eye.cross(Vec3::Y).normalize();
        let up = across.cross(eye).normalize();
        Ray::new(eye, -eye.normalize() + on_film(x) * across + on_film(y) * up)
    })
}

fn pool(test: u64) -> RunningMean {
    let mut rng = Rng::new(test, 0);
    let chips: Vec<[Vec3; 3]> = (0..400)
        .map(|_| {
            let at = 2.0 * rng.direction();
            [(); 3].map(|()| at + 0.3 * rng.direction())
        })
        .collect();
    let beside = placed(lumpy(2, 9), 1e-3, Vec3::new(0.0, 0.0, 1.5));
    let meshes = [lumpy(4, 9), soup(&chips), beside, lumpy(4, 9)];
    let accel = Accel::build(&meshes);
    let mut rays: Vec<Ray> = tiles(Vec3::new(2.0, 1.5, -3.0), 128).collect();
    let tiles = rays.len();
    for kind in Kind::ALL {
        rays.extend(many(kind, &meshes, test, 500));
    }
    let kinds = rays.len();
    rays.extend(none());
    let hits = rays.iter().map(|ray| accel.intersect1(ray)).collect();
    let ends = [tiles, kinds, rays.len()];
    RunningMean { accel, rays, hits, ends }
}

/// Every length up to five times the widest hardware's, and around the powers of two above, for coherent and for
/// unrelated rays. Caught: what is left over when lengths are
/// divided by 8 not written, for either question; eight rays given the octant of the first, its padding, or
/// the widest range of them; answers put in the wrong places; a hit written beyond the end.
#[test]
fn batches_of_all_lengths() {
    let pool = pool(1300);
    let around = [64, 128, 256, 512, 1024, 2048, 4096];
    let lengths = (0..=80).chain(around.iter().flat_map(|n| [n - 1, *n, n + 1]));
    for length in lengths {
        let mut rng = Rng::new(1301, length as u64);
        for from in [0, pool.ends[0], pool.ends[1]] {
            let from = from + rng.below(100);
            let to = (from + length).min(pool.rays.len());
            let order: Vec<usize> = (from..to).collect();
            assert_batch(&pool.accel, &pool.rays, &order, &pool.hits, &format!("from {from}"));
        }
        let order: Vec<usize> = (0..length).map(|_| rng.below(pool.rays.len())).collect();
        assert_batch(&pool.accel, &pool.rays, &order, &pool.hits, "any rays");
    }
}

/// All rays at once, in orders from coherent to none. Caught: as above, but for the padding.
#[test]
fn batches_in_all_orders() {
    let pool = pool(1310);
    for (number, order) in orders(&pool.rays, &mut Rng::new(1311, 0)).iter().enumerate() {
        for batch in cut(order) {
            let what = format!("order {number}");
            assert_batch(&pool.accel, &pool.rays, batch, &pool.hits, &what);
        }
        assert_batch(&pool.accel, &pool.rays, order, &pool.hits, "all of them");
    }
}

/// A camera's tiles with a few unrelated rays: other octants, lengths, origins and ranges, invalid rays,
/// duplicates. They must not change the hits of the others. Caught: eight rays that all
/// miss when one of them is NaN, or has a 0 in its direction; octant, padding and range as above.
#[test]
fn unrelated_rays_in_a_tile_change_nothing() {
    let pool = pool(1320);
    let [tiles, kinds, all] = pool.ends;
    for trial in 0..1500 {
        let mut rng = Rng::new(1321, trial);
        let length = [8, 16, 64, 100, 256][rng.below(5)];
        let from = rng.below(tiles - length);
        let mut order: Vec<usize> = (from..from + length).collect();
        for _ in 0..[1, 2, length / 4, length / 2][rng.below(4)] {
            let place = rng.below(length);
            order[place] = match rng.below(3) {
                0 => tiles + rng.below(kinds - tiles),
                1 => kinds + rng.below(all - kinds),
                _ => order[rng.below(length)],
            };
        }
        assert_batch(&pool.accel, &pool.rays, &order, &pool.hits, &format!("tile {trial}"));
    }
}

/// State of a traversal is per thread: threads that share a tree do not disturb each other.
/// Caught: a ray's octant kept in a static.
#[test]
fn threads_share_a_tree() {
    let pool = pool(1330);
    std::thread::scope(|scope| {
        for thread in 0..4 {
            let pool = &pool;
            scope.spawn(move || {
                for trial in 0..20 {
                    let mut rng = Rng::new(1331 + thread, trial);
                    let order: Vec<usize> = (0..1024).map(|_| rng.below(pool.rays.len())).collect();
                    assert_batch(&pool.accel, &pool.rays, &order, &pool.hits, "at once");
                }
            });
        }
    });
}

/// Caught, here and below: lengths not compared.
#[test]
#[should_panic(expected = "left == right")]
fn as_many_hits_as_rays() {
    pool(1340).accel.intersect(&[Ray::new(Vec3::ZERO, Vec3::Z); 3], &mut [Hit::MISS; 4]);
}

#[test]
#[should_panic(expected = "left == right")]
fn as_many_answers_as_rays() {
    pool(1341).accel.occluded(&[Ray::new(Vec3::ZERO, Vec3::Z); 3], &mut [false; 2]);
}
