//! The checks of the fuzz targets, on the files of `fuzz/corpus` and on a fixed number of changes of each.

mod scenes;

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

/// A pseudo-random generator (splitmix64); each trial has its own.
struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let x = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        (x ^ (x >> 31)) as usize % n
    }
}

/// Runs the check on each file of a corpus and on `trials` changes of each. `telling` are bytes with a meaning in its
/// files, which are inserted more often than others.
fn drive(corpus: &str, trials: u64, telling: &[u8], check: impl Fn(&[u8])) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/corpus").join(corpus);
    let mut paths: Vec<_> = fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    paths.sort();
    assert!(!paths.is_empty());
    for (number, path) in paths.iter().enumerate() {
        let file = fs::read(path).unwrap();
        // Trial 0 is the file itself.
        for trial in 0..=trials {
            let mut random = Random(((number as u64) << 32) + trial);
            let bytes =
                if trial == 0 { file.clone() } else { changed(&file, telling, &mut random) };
            if catch_unwind(AssertUnwindSafe(|| check(&bytes))).is_err() {
                panic!("{}, trial {trial}: {:?}", path.display(), bytes.escape_ascii().to_string());
            }
        }
    }
}

/// The file with one to four changes.
fn changed(file: &[u8], telling: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = file.to_vec();
    for _ in 0..1 + random.below(4) {
        let at = random.below(bytes.len() + 1);
        let byte = telling[random.below(telling.len())];
        match random.below(5) {
            _ if at == bytes.len() => bytes.push(byte),
            0 => bytes[at] ^= 1 << random.below(8),
            1 => bytes[at] = byte,
            2 => bytes.insert(at, byte),
            3 => drop(bytes.remove(at)),
            _ => {
                let from = random.below(bytes.len());
                let piece = bytes[from..(from + random.below(30)).min(bytes.len())].to_vec();
                bytes.splice(at..at, piece);
            }
        }
    }
    bytes
}
