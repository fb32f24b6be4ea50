//! Reader of MTL files, the material libraries of Wavefront OBJ.

mod map;
mod notes;
mod report;

use std::collections::HashSet;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;

pub use map::MtlMap;
pub use report::{MtlError, MtlLibrary, MtlMaterial, MtlNote};

use super::obj::{Failure, LogicalLines, text};
use crate::file;
use crate::params::Shown;
use notes::Notes;

/// Reads the MTL file at `path`. [`parse_mtl`] says how.
///
/// # Errors
/// If the file does not exist, is not an ordinary one, has more than 128 MiB or cannot be read. Messages name the file by `path`.
pub fn read_mtl(path: &Path) -> Result<MtlLibrary, MtlError> {
    let name = path.display().to_string();
    let failed = |source| MtlError { name: name.clone(), source };
    let file = file::open(path).map_err(failed)?;
    if file.metadata().map_err(failed)?.len() > MOST << 20 {
        let reason = format!("it is larger than {MOST} MiB, the most that is read");
        return Err(failed(std::io::Error::other(reason)));
    }
    parse_mtl(&name, BufReader::new(file.take(MOST << 20)))
}

/// Maximum size of a file, in MiB, as of scene files.
const MOST: u64 = 128;

/// Reads MTL text: for each `newmtl` line, the values of the lines below it as they stand there.
///
/// What cannot be read is left out and noted with its line, the same thing once: programs write many keys that others do not know, and
/// a scene should not fail for that. Keys may have any case. Lines end and comments begin as in OBJ files. A key that a material has
/// twice has its last value. Of materials with one name the first is kept, and none without a name.
///
/// ```
/// let text = "newmtl Brass\nKd 0.9 0.7 0.3\nPr 0.1\nmap_Kd -s 2 2 1 a plank.png\nshine 3\n";
/// let library = lobe::shape::parse_mtl("room.mtl", text.as_bytes())?;
/// let brass = &library.materials[0];
/// assert_eq!((&*brass.name, brass.kd, brass.pr), ("Brass", Some([0.9, 0.7, 0.3]), Some(0.1)));
/// let plank = brass.map_kd.as_ref().unwrap();
/// assert_eq!((&*plank.file, plank.scale), ("a plank.png", [2.0, 2.0, 1.0]));
/// assert_eq!(library.notes[0].to_string(), "line 5: the key `shine` is not known");
/// # Ok::<(), lobe::shape::MtlError>(())
/// ```
///
/// # Errors
/// If reading fails.
pub fn parse_mtl(name: &str, reader: impl BufRead) -> Result<MtlLibrary, MtlError> {
    let mut lines = LogicalLines::new(reader);
    let mut parser = Parser::default();
    loop {
        match lines.next() {
            Ok(None) => {
                let Parser { materials, notes, .. } = parser;
                return Ok(MtlLibrary { materials, notes: notes.finish() });
            }
            Ok(Some((number, line))) => parser.read_line(number, line),
            Err(Failure::Io(source)) => return Err(MtlError { name: name.to_owned(), source }),
            // Of lines, only the length can be wrong.
            Err(_) => {
                let source =
                    std::io::Error::other("a line is longer than 1 MiB: is it an MTL file?");
                return Err(MtlError { name: name.to_owned(), source });
            }
        }
    }
}

#[derive(Default)]
struct Parser {
    materials: Vec<MtlMaterial>,
    names: HashSet<String>,
    /// Whether the lines are those of a material that is not kept.
    is_left_out: bool,
    notes: Notes,
}

impl Parser {
    fn read_line(&mut self, number: u64, line: &[u8]) {
        let line = text(line);
        let (key, rest) = line.split_once(char::is_whitespace).unwrap_or((&line, ""));
        let rest = rest.trim();
        if key.is_empty() {
            return;
        }
        if key.eq_ignore_ascii_case("newmtl") {
            return self.begin(number, rest);
        }
        if self.is_left_out {
            return;
        }
        let shown = Shown::name(key);
        let set = self.materials.last_mut().map(|material| set(material, number, key, rest));
        let note = match set {
            Some(Set::Done) => return,
            Some(Set::Above) => {
                format!("{shown} is `{}`: what is above 1 counts as 1", Shown::name(rest))
            }
            Some(Set::Unknown) => format!("the key `{shown}` is not known"),
            Some(Set::Unfit(expected)) => {
                format!("{shown} is `{}`, expected {expected}; it is left out", Shown::name(rest))
            }
            None => format!("`{shown}` stands above the first newmtl; it is left out"),
        };
        self.notes.add(number, note);
    }

    fn begin(&mut self, line: u64, name: &str) {
        self.is_left_out = true;
        if name.is_empty() {
            self.notes.add(line, "a newmtl has no name: no face can have it".into());
        } else if !self.names.insert(name.to_owned()) {
            let name = Shown::name(name);
            self.notes
                .add(line, format!("material `{name}` stands there twice; the first one holds"));
        } else {
            self.is_left_out = false;
            let material = MtlMaterial { name: name.to_owned(), line, ..MtlMaterial::default() };
            self.materials.push(material);
        }
    }
}

/// What became of a line.
enum Set {
    Done,
    /// A fraction was set that is above 1.
    Above,
    Unknown,
    /// What was expected.
    Unfit(&'static str),
}

fn set(material: &mut MtlMaterial, line: u64, key: &str, rest: &str) -> Set {
    let color = |target: &mut Option<[f32; 3]>| match colour(rest) {
        None => Set::Unfit("one or three numbers that are finite and not negative"),
        found => {
            *target = found;
            Set::Done
        }
    };
    let number = |target: &mut Option<f32>| match rest.parse::<f32>() {
        Ok(value) if value.is_finite() => {
            *target = Some(value);
            Set::Done
        }
        _ => Set::Unfit("a finite number"),
    };
    let fraction = |set: Set, value: f32| match set {
        Set::Done if value > 1.0 => Set::Above,
        set => set,
    };
    let reflected = |target: &mut Option<[f32; 3]>| {
        let set = color(target);
        fraction(set, target.unwrap_or_default().into_iter().fold(0.0, f32::max))
    };
    let share = |target: &mut Option<f32>| {
        let set = number(target);
        fraction(set, target.unwrap_or_default())
    };
    let map = |target: &mut Option<MtlMap>| match map::parse(line, rest) {
        None => Set::Unfit("options with their numbers, and the name of an image"),
        found => {
            *target = found;
            Set::Done
        }
    };
    // Programs differ in case.
    match &*key.to_ascii_lowercase() {
        "kd" => reflected(&mut material.kd),
        "ks" => reflected(&mut material.ks),
        "ke" => color(&mut material.ke),
        "tf" => reflected(&mut material.tf),
        "ns" => number(&mut material.ns),
        "ni" => number(&mut material.ni),
        // `d -halo` thins towards the middle.
        "d" => match rest.strip_prefix("-halo") {
            Some(_) => Set::Unfit("a finite number"),
            None => share(&mut material.d),
        },
        "tr" => share(&mut material.tr),
        "pr" => share(&mut material.pr),
        "pm" => share(&mut material.pm),
        "illum" => match rest.parse() {
            Ok(model @ 0..=10) => {
                material.illum = Some(model);
                Set::Done
            }
            _ => Set::Unfit("a whole number from 0 to 10"),
        },
        // Ambient light is an approximation of what a renderer of light finds by itself.
        "ka" | "map_ka" => Set::Done,
        "map_kd" => map(&mut material.map_kd),
        "map_ke" => map(&mut material.map_ke),
        "map_d" => map(&mut material.map_d),
        "map_pr" => map(&mut material.map_pr),
        "map_pm" => map(&mut material.map_pm),
        "map_bump" | "bump" => map(&mut material.map_bump),
        "norm" | "map_norm" | "map_kn" => map(&mut material.norm),
        _ => Set::Unknown,
    }
}

/// A colour; one number stands for all bands.
fn colour(text: &str) -> Option<[f32; 3]> {
    let numbers: Vec<f32> =
        text.split_whitespace().map(str::parse).collect::<Result<_, _>>().ok()?;
    let color = match numbers[..] {
        [grey] => [grey; 3],
        [r, g, b] => [r, g, b],
        _ => return None,
    };
    color.iter().all(|&band| band.is_finite() && band >= 0.0).then_some(color)
}
