//! Vectors against single numbers, and these against the truth.

use std::f64::consts::TAU;

use glam::{DVec2, Vec2};

use super::{Bits, Block, BlockKernel, Eight, Float, InstructionSet, Kernel, LaneMask, Lanes};

/// Sixteen pairs of numbers at a time, through every operation.
struct Everything<'a> {
    a: &'a [f32; 16],
    b: &'a [f32; 16],
}

/// The bits of every operation in every lane, one row for each.
type Results = Vec<[u32; 16]>;

impl BlockKernel for Everything<'_> {
    type Output = Results;

    #[inline(always)]
    fn run<F: Block>(self) -> Results {
        let mut all = Vec::new();
        for at in (0..16).step_by(F::LANES) {
            let (a, b) = (F::load(&self.a[at..]), F::load(&self.b[at..]));
            let mask = |mask: F::Mask| F::select(mask, a, b);
            let bits = |x: F::Bits| F::from_bits(x);
            let pairs: [Vec2; 16] = std::array::from_fn(|i| Vec2::new(self.a[i], self.b[i]));
            let [first, second] = F::load_pairs(&pairs[at..]);
            let mut eights = [[0.0; 8]; 16];
            let mut fours = [[0.0; 4]; 16];
            F::scatter([a, b, a + b, a - b, b - a, a * b, b, a], &mut eights);
            F::scatter4([b, a, a * b, a], &mut fours);
            let [e0, e1, e2, e3, e4, e5, e6, e7] = F::gather(|lane| &eights[lane]);
            let [f0, f1, f2, f3] = F::gather4(|lane| &fours[lane]);
            let rows = [
                a + b,
                a - b,
                a * b,
                a / b,
                -a,
                a.sqrt(),
                a.abs(),
                a.floor(),
                a.copysign(b),
                a.min(b),
                a.max(b),
                mask(a.lt(b)),
                mask(a.le(b)),
                mask(a.gt(b)),
                mask(a.ge(b)),
                mask(a.eq(b)),
                mask(!a.lt(b) & a.le(b)),
                mask(a.lt(b) | b.lt(a)),
                mask(a.lt(b) ^ a.le(b)),
                mask(F::Mask::splat(true)),
                mask(F::Mask::splat(false)),
                F::splat(0.1),
                F::constant(0.1),
                bits(a.to_bits().wrapping_add(F::Bits::splat(3))),
                bits(a.to_bits() ^ b.to_bits()),
                bits(a.to_bits() | b.to_bits()),
                bits(a.to_bits().is_negative()),
                a.abs().min(F::splat(1.0)).unit_circle()[0],
                a.abs().min(F::splat(1.0)).unit_circle()[1],
                a.atan2(b),
                first,
                second,
                e0,
                e1,
                e2,
                e3,
                e4,
                e5,
                e6,
                e7,
                f0,
                f1,
                f2,
                f3,
            ];
            let masks = [a.lt(b), a.eq(a)];
            let tell = |i: usize| {
                let mask = masks[i];
                let lanes = (1_u64 << F::LANES) - 1;
                assert_eq!(mask.any(), mask.bits() != 0);
                assert_eq!(F::Mask::from_bits(mask.bits()).bits(), mask.bits());
                assert_eq!(mask.all(), u64::from(mask.bits()) == lanes);
                F::select(mask, F::splat(1.0), F::splat(0.0))
            };
            let (x, y) = (tell(0), tell(1));
            all.resize(rows.len() + 4, [0; 16]);
            for (row, number) in all.iter_mut().zip(rows.into_iter().chain([x, y])) {
                let mut numbers = [0.0; 16];
                number.store(&mut numbers);
                for lane in 0..F::LANES {
                    row[at + lane] = numbers[lane].to_bits();
                }
            }
            for (row, mask) in all[rows.len() + 2..].iter_mut().zip(masks) {
                for lane in 0..F::LANES {
                    row[at + lane] = mask.bits() >> lane & 1;
                }
            }
        }
        all
    }
}

/// The same with the vectors of traversal, which may be pairs of those of blocks.
struct WithLanes<'a>(Everything<'a>);

impl Kernel for WithLanes<'_> {
    type Input = ();
    type Data = ();
    type Scratch = ();
    type Output = Results;

    #[inline(always)]
    fn run<L: Lanes>(self, (): &(), (): &(), (): &mut ()) -> Results {
        self.0.run::<L>()
    }
}

/// One NaN is like another: its sign and its payload are the processor's.
fn one_nan(mut results: Results) -> Results {
    for bits in results.iter_mut().flatten() {
        if f32::from_bits(*bits).is_nan() {
            *bits = f32::NAN.to_bits();
        }
    }
    results
}

/// All pairs of numbers of all kinds, by every instruction set and by single f32. Seen to fail with exchanged operands of
/// `min`, with a rounding that is not down, and with two quarters of a transposed matrix exchanged.
#[test]
fn every_instruction_set_gives_the_bits_of_f32() {
    let numbers = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        0.5,
        -2.75,
        1e-45,
        -1e-45,
        f32::MIN_POSITIVE,
        3.4e38,
        -3.4e38,
        1e10,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::NAN,
        0.3,
        7.999_999_5,
        -8.5,
    ];
    let pairs: Vec<[f32; 2]> = numbers.into_iter().flat_map(|a| numbers.map(|b| [a, b])).collect();
    for (trial, pairs) in pairs.chunks_exact(16).enumerate() {
        let a: [f32; 16] = std::array::from_fn(|i| pairs[i][0]);
        let b: [f32; 16] = std::array::from_fn(|i| pairs[i][1]);
        let expected = one_nan(Everything { a: &a, b: &b }.run::<f32>());
        for set in InstructionSet::available() {
            let blocks = set.run_block(Everything { a: &a, b: &b });
            let lanes = set.run(&(), &mut (), &(), WithLanes(Everything { a: &a, b: &b }));
            for found in [blocks, lanes].map(one_nan) {
                for (row, (found, expected)) in found.iter().zip(&expected).enumerate() {
                    assert_eq!(
                        found, expected,
                        "{set}, trial {trial}, operation {row}: {a:?}, {b:?}"
                    );
                }
            }
        }
    }
}

/// Compared with f64 at 2^20 + 1 turns from 0 to 1.
#[test]
fn unit_circle_is_exact_to_rounding() {
    for i in 0..=1 << 20 {
        let turn = i as f32 / (1 << 20) as f32;
        let error = DVec2::from(turn.unit_circle().map(f64::from))
            - DVec2::from_angle(TAU * f64::from(turn));
        let error = error.abs().max_element();
        assert!(error <= f64::from(f32::EPSILON), "{turn}: error {error}");
    }
}

/// Compared with f64 for vectors of 2^20 directions and 20 lengths.
#[test]
fn angles_are_exact_to_rounding() {
    for i in -(1 << 19)..1 << 19 {
        let length = 10.0_f64.powi(i % 20);
        let v = (length * DVec2::from_angle(TAU * f64::from(i) / f64::from(1 << 20))).as_vec2();
        let [x, y] = [v.x, v.y].map(f64::from);
        let found = f64::from(Float::atan2(v.y, v.x));
        let truth = y.atan2(x);
        let error = (found - truth).abs();
        assert!(error <= 3e-7_f64.min(3e-7 * truth.abs()), "{v}: {found}, expected {truth}");
    }
}

/// What an [`Eight`] makes of a mask and of keys, with the lanes' numbers as ids.
struct Sorted(u32, [f32; 8]);

impl Kernel for Sorted {
    type Input = ();
    type Data = ();
    type Scratch = ();
    /// Ids and keys, largest first, the lane of the last, and the ids compressed.
    type Output = ([f32; 8], [f32; 8], usize, [f32; 8]);

    #[inline(always)]
    fn run<L: Lanes>(self, (): &(), (): &(), (): &mut ()) -> Self::Output {
        let ids = L::Boxes::load(&[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
        let mask = <L::Boxes as Float>::Mask::from_bits(self.0);
        let ([a, b], last) = L::Boxes::largest_first(mask, ids, L::Boxes::load(&self.1));
        let mut out = ([0.0; 8], [0.0; 8], last, [0.0; 8]);
        a.store(&mut out.0);
        b.store(&mut out.1);
        ids.compress(self.0).store(&mut out.3);
        out
    }
}

/// All masks, with keys that are equal, zero, negative or infinite too.
#[test]
fn eights_are_sorted_and_compressed() {
    let keys = [
        [1.0, 5.0, 3.0, 2.0, 8.0, 7.0, 6.0, 4.0],
        [2.0, 2.0, 0.0, 0.0, 2.0, 1.0, 1.0, 0.0],
        [-1.0, 0.5, f32::INFINITY, -0.0, f32::MIN, 1e-40, f32::MAX, -7.0],
    ];
    for set in InstructionSet::available() {
        for mask in 1..256_u32 {
            for keys in keys {
                let (ids, sorted, last, compressed) =
                    set.run(&(), &mut (), &(), Sorted(mask, keys));
                let lanes: Vec<f32> =
                    (0..8).filter(|lane| mask >> lane & 1 == 1).map(|lane| lane as f32).collect();
                let len = lanes.len();
                assert_eq!(compressed[..len], lanes, "{set}, {mask:b}");
                let mut found = ids[..len].to_vec();
                assert_eq!(found[len - 1] as usize, last, "{set}, {mask:b}: {ids:?}");
                for (id, key) in found.iter().zip(sorted) {
                    assert_eq!(keys[*id as usize], key, "{set}, {mask:b}");
                }
                let finite = sorted.map(|key| key.min(f32::MAX));
                let is_sorted =
                    finite[..len].windows(2).all(|pair| pair[0] >= pair[1] - 1e-6 * pair[1].abs());
                assert!(is_sorted, "{set}, {mask:b}: {sorted:?}");
                found.sort_by(f32::total_cmp);
                assert_eq!(found, lanes, "{set}, {mask:b}");
            }
        }
    }
}
