//! `params` with a registry of another crate.

use lobe::Spectrum;
use lobe::glam::Vec3;
use lobe::params::{
    Choice, Direction, Document, Fault, Key, Kind, Limits, Mark, Node, Param, Rotation, Scale,
    Section, Table, Value,
};

/// A parameter type of another crate.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Weather {
    Sun,
    Rain,
}

impl Choice for Weather {
    const CHOICES: &'static [(&'static str, Self)] = &[("sun", Self::Sun), ("rain", Self::Rain)];
}

const HEIGHT: Key<f32> = Key::new("height", "of the tree").in_unit("metres").range(0.1..=100.0);
const COLOR: Key<Spectrum> =
    Key::new("color", "of its leaves").at_least(0.0).default(Spectrum::WHITE);
const WEATHER: Key<Option<Weather>> = Key::optional("weather", "around it");
const SECRET: Key<bool> = Key::new("secret", "declared by nobody").default(false);

type Read = fn(&Table) -> Result<String, Fault>;

fn oak(table: &Table) -> Result<String, Fault> {
    let (height, color) = (table.get(&HEIGHT)?, table.get(&COLOR)?.to_array());
    // `weather` is read only for tall trees.
    let weather = if height > 10.0 { table.get(&WEATHER)? } else { None };
    Ok(format!("oak {height} {color:?} {weather:?}"))
}

fn beech(table: &Table) -> Result<String, Fault> {
    table.get(&SECRET).map(|secret| format!("beech {secret}"))
}

static TREES: Section<Read> = Section {
    key: "tree",
    plural: "trees",
    is_named: true,
    selector: "type",
    default: Some("oak"),
    common: &[],
    kinds: &[
        Kind {
            name: "oak",
            meaning: "Grows slowly",
            keys: &[&HEIGHT, &COLOR, &WEATHER],
            read: oak,
        },
        Kind { name: "beech", meaning: "Keeps a secret", keys: &[], read: beech },
    ],
};

fn read(entries: &[(&str, Value)]) -> Result<String, String> {
    let tree = Node::table(entries.iter().cloned());
    let trees = Node::table([("t", tree.value)]);
    let document = Document::new(Node::table([("tree", trees.value)]));
    let root = document.table("the garden", &["tree"]).map_err(|fault| fault.to_string())?;
    let [(name, table)]: [_; 1] = root.tables("tree").unwrap().try_into().ok().unwrap();
    assert_eq!(name, "t");
    let tree = TREES.read(table, |kind, table| (kind.read)(table));
    tree.map_err(|fault| fault.to_string())
}

/// Seen to fail with `finish` left out of
/// `Section::read`; and with undeclared keys read all the same.
#[test]
fn a_foreign_registry_reads_its_kinds() {
    let height = |height: f32| ("height", height.into());
    let good = |entries: &[_], tree: &str| assert_eq!(read(entries).as_deref(), Ok(tree));
    good(&[height(2.5)], "oak 2.5 [1.0, 1.0, 1.0] None");
    good(&[height(0.1)], "oak 0.1 [1.0, 1.0, 1.0] None");
    good(&[("weather", "rain".into()), height(11.0)], "oak 11 [1.0, 1.0, 1.0] Some(Rain)");
    let color = Value::from_iter([0.5, 0.25, 0.0]);
    good(&[("type", "oak".into()), height(1.0), ("color", color)], "oak 1 [0.5, 0.25, 0.0] None");

    let bad = |entries: &[_], message: &str| assert_eq!(read(entries).unwrap_err(), message);
    bad(&[], "[tree.t] lacks `height`, expected metres from 0.1 to 100");
    bad(&[height(0.09)], "`tree.t.height` is 0.09, expected metres from 0.1 to 100");
    bad(&[height(f32::NAN)], "`tree.t.height` is NaN, expected metres from 0.1 to 100");
    bad(&[("heihgt", 1.0.into())], "unknown key `heihgt` in [tree.t]; did you mean `height`?");
    bad(
        &[height(20.0), ("weather", "snow".into())],
        "`tree.t.weather` is \"snow\", expected \"sun\" or \"rain\"",
    );
    bad(&[height(2.0), ("weather", "sun".into())], "`tree.t.weather` has no effect here");
    bad(&[("type", "elm".into())], "`tree.t.type` is \"elm\", expected \"oak\" or \"beech\"");
    bad(
        &[("type", "beech".into())],
        "[tree.t] is read by a kind that does not declare its key `secret`",
    );
}

/// A value that is written and read again is the same, in range or not. Seen to fail with a scale written as its first factor.
#[test]
fn values_are_read_as_they_were_written() {
    fn round<T: Param + PartialEq + std::fmt::Debug>(value: T) {
        let written = value.to_value().unwrap();
        assert_eq!(T::from_value(&written, &Limits::NONE), Some(value), "{written}");
        let example = T::example(&Limits::NONE);
        assert_eq!(T::from_value(&example.to_value().unwrap(), &Limits::NONE), Some(example));
    }
    round(true);
    round("a \"b\"\n".to_owned());
    round(f32::MIN_POSITIVE);
    round(-f32::MAX);
    round(u32::MAX);
    round(u64::MAX);
    round([[1.0_f32, 2.0], [3.0, 0.1]]);
    round(Vec3::new(0.1, -2.0, 1e-30));
    round(Spectrum::new(0.5, 0.0, 7.0));
    round(Direction(Vec3::Y));
    round(Scale(Vec3::splat(3.0)));
    round(Scale(Vec3::new(3.0, 3.0, -1.0)));
    round(Rotation { axis: Vec3::Z, degrees: -30.0 });
    round(Weather::Rain);
    round(Some(4_u32));
}

/// Ranges and their descriptions. Seen to fail with each bound included that is not, with the other way round, and with bounds
/// compared in f64, where the float 0.1 is above 0.1.
#[test]
fn ranges_are_open_or_closed() {
    const ANY: Key<f32> = Key::new("x", "");
    type Case = (Key<f32>, &'static str, &'static [f32], &'static [f32]);
    let cases: [Case; 10] = [
        (ANY, "a finite number", &[0.0, -f32::MAX], &[f32::INFINITY, f32::NAN]),
        (ANY.range(0.0..=1.0), "a number from 0 to 1", &[0.0, 1.0], &[-0.1, 1.1, f32::NAN]),
        (ANY.range(-1e12..=1e12), "a number from -1e12 to 1e12", &[-1e12, 1e12], &[1.1e12]),
        (ANY.range(0.0..=0.1), "a number from 0 to 0.1", &[0.1], &[0.11]),
        (ANY.above(0.0), "a finite number above 0", &[1e-30], &[0.0, -0.0, f32::INFINITY]),
        (ANY.at_least(0.0), "a finite number of at least 0", &[0.0, -0.0], &[-1e-30]),
        (ANY.below(2.0), "a finite number below 2", &[1.999], &[2.0, f32::NEG_INFINITY]),
        (ANY.at_most(2.0), "a finite number of at most 2", &[2.0], &[2.001]),
        (ANY.above(0.0).at_most(1.0), "a number above 0 and up to 1", &[1.0], &[0.0]),
        (ANY.at_least(0.0).below(1.0), "a number of at least 0 and below 1", &[0.0], &[1.0]),
    ];
    for (key, words, inside, outside) in cases {
        assert_eq!(f32::expected(key.limits()), words);
        let reads = |x: &f32| f32::from_value(&(*x).into(), key.limits()).is_some();
        assert!(inside.iter().all(reads), "{words}");
        assert!(!outside.iter().any(reads), "{words}");
        assert!(reads(&f32::example(key.limits())), "{words}");
    }
    assert!(!Limits::NONE.contains(f64::NAN) && Limits::NONE.contains(0.0));
    let whole: Key<u32> = Key::new("n", "").above(1.0).at_most(9.5);
    assert_eq!(u32::expected(whole.limits()), "a whole number from 2 to 9");
}

/// Seen to fail with the folder of another source.
#[test]
fn paths_are_relative_to_the_folder_of_their_source() {
    const FILE: Key<std::path::PathBuf> = Key::new("file", "a file");
    type Read = fn(&Table) -> Result<std::path::PathBuf, Fault>;
    static FILES: Section<Read> = Section {
        key: "file",
        plural: "files",
        is_named: false,
        selector: "type",
        default: Some("file"),
        common: &[],
        kinds: &[Kind {
            name: "file",
            meaning: "",
            keys: &[&FILE],
            read: |table| table.get(&FILE),
        }],
    };
    for (source, path) in [(0, "a/b.obj"), (1, "c/b.obj"), (2, "b.obj")] {
        let mut root = Node::table([("file", Node::table([("file", "b.obj".into())]).value)]);
        let Value::Table(entries) = &mut root.value else { unreachable!() };
        let Value::Table(entries) = &mut entries[0].node.value else { unreachable!() };
        entries[0].node.mark = Mark { source, offset: 0 };
        let document = Document::in_folders(root, vec!["a".into(), "c".into()]);
        let root = document.table("", &["file"]).unwrap();
        let read = FILES.read(root.table("file").unwrap(), |kind, table| (kind.read)(table));
        assert_eq!(read.unwrap(), std::path::PathBuf::from(path));
    }
    let both = ["x.obj", "/y.obj"].map(std::path::PathBuf::from).placed("a".as_ref());
    assert_eq!(both, ["a/x.obj", "/y.obj"].map(std::path::PathBuf::from));
}
