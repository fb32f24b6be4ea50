//! [`Plan`]: the numbers of samples, of seeds, and of parts of the reference.

use std::error::Error;
use std::path::Path;

use lobe::params::{AnyKey, Document, Fault, Key, Limits, Param, Value};
use lobe::scene_file::read_document;

use super::cost::Cost;
use super::folder::check_size;

/// What a chart renders. An interrupted chart resumes with the same plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Numbers of samples per pixel, rising.
    pub budgets: Vec<u32>,
    /// Number of pictures for each method and number of samples.
    pub seeds: u32,
    /// Samples per pixel of each part of the reference.
    pub part_spp: u32,
    /// Names of the mean pictures of all methods, in letters, digits and hyphens.
    pub means: Vec<String>,
    /// CRC-32 of the numbers above, the version, the number of threads, and each method's name, settings and trial picture.
    pub fingerprint: u32,
    /// Whether the results in the folder are still being removed or not yet there, and do not count.
    pub starting: bool,
}

impl Plan {
    /// Number of parts of the reference.
    pub const PARTS: u32 = 8;
    /// Default samples of each part, as a multiple of the largest budget. The reference's squared error is then at most
    /// about 1/32 of the best method's.
    const PART_SPP: u32 = 4;
    /// Number of parts of the check, which have as many samples as the largest budget.
    pub const CHECK_PARTS: u32 = 4;
    /// Largest size of a plan's file.
    pub const MOST_BYTES: u64 = 1 << 20;

    /// A plan with `part_spp` samples per pixel in each part of the reference, or the default. `trials` is a checksum of the methods.
    pub fn new(
        budgets: Vec<u32>,
        seeds: u32,
        part_spp: Option<u32>,
        means: Vec<String>,
        trials: u32,
    ) -> Self {
        let most = budgets.last().copied().unwrap_or(1);
        let part_spp = part_spp.unwrap_or(Self::PART_SPP.saturating_mul(most));
        // So that a plan that was changed by hand is not taken for that of the results.
        let limits = format!("{trials} {budgets:?} {seeds} {part_spp}");
        let fingerprint = crc32fast::hash(limits.as_bytes());
        Self { budgets, seeds, part_spp, means, fingerprint, starting: false }
    }

    /// A plan with as many powers of two as budgets as the time allows, at least 1, 2 and 4.
    pub fn for_time(
        seconds: f64,
        methods: &[Cost],
        truths: [Cost; 2],
        with: impl Fn(Vec<u32>) -> Self,
    ) -> Self {
        let plan = |count: u32| with((0..count).map(|k| 1 << k).collect());
        let fits = |count: &u32| plan(*count).seconds(methods, truths) <= seconds;
        plan((4..=16).take_while(fits).last().unwrap_or(3))
    }

    /// The largest number of samples.
    pub fn most(&self) -> u32 {
        self.budgets.last().copied().unwrap_or(1)
    }

    /// Expected total time, in seconds.
    pub fn seconds(&self, methods: &[Cost], [reference, check]: [Cost; 2]) -> f64 {
        let runs = methods.iter().flat_map(|cost| self.budgets.iter().map(|&spp| cost.of(spp)));
        f64::from(self.seeds) * runs.sum::<f64>()
            + f64::from(Self::PARTS) * reference.of(self.part_spp)
            + f64::from(Self::CHECK_PARTS) * check.of(self.most())
    }

    /// The plan as TOML, for its file.
    pub fn to_toml(&self) -> String {
        let Self { budgets, seeds, part_spp, means, fingerprint, starting } = self;
        let starting = if *starting { "starting = true\n" } else { "" };
        format!(
            "# What `lobe chart` renders here.\n\
             budgets = {budgets:?}\nseeds = {seeds}\npart_spp = {part_spp}\nmeans = {means:?}\n\
             fingerprint = {fingerprint}\n{starting}"
        )
    }

    /// Reads the file of a plan.
    pub fn read(path: &Path) -> Result<Self, Box<dyn Error>> {
        let advice = "this is not a plan of `lobe chart`: choose another folder with -o";
        // Looked at first: some files, such as pipes, have no end.
        check_size(path, Self::MOST_BYTES).map_err(|error| format!("{error}; {advice}"))?;
        read_document(path, Self::from_document)
            .map_err(|error| format!("{error}; {advice}").into())
    }

    fn from_document(document: &Document) -> Result<Self, Fault> {
        let keys: [&dyn AnyKey; 6] = [&BUDGETS, &SEEDS, &PART_SPP, &MEANS, &FINGERPRINT, &STARTING];
        let table = document.table("the plan of a chart", &keys.map(AnyKey::name))?;
        Ok(Self {
            budgets: table.get(&BUDGETS)?.0,
            seeds: table.get(&SEEDS)?,
            part_spp: table.get(&PART_SPP)?,
            means: table.get(&MEANS)?.0,
            fingerprint: table.get(&FINGERPRINT)?,
            starting: table.get(&STARTING)?,
        })
    }
}

const BUDGETS: Key<Budgets> = Key::new("budgets", "samples per pixel").range(1.0..=16777215.0);
const SEEDS: Key<u32> = Key::new("seeds", "pictures of each method").range(2.0..=64.0);
const PART_SPP: Key<u32> =
    Key::new("part_spp", "samples of a part of the reference").range(1.0..=67108864.0);
const MEANS: Key<Means> = Key::new("means", "names of the means of methods");
const FINGERPRINT: Key<u32> = Key::new("fingerprint", "checksum");
const STARTING: Key<bool> = Key::new("starting", "whether results do not count").default(false);

/// Rising numbers of samples.
#[derive(Clone)]
struct Budgets(Vec<u32>);

impl Param for Budgets {
    fn from_value(value: &Value, limits: &Limits) -> Option<Self> {
        let all = list(value, |value| u32::from_value(value, limits))?;
        all.is_sorted_by(|a, b| a < b).then_some(Self(all))
    }

    fn to_value(&self) -> Option<Value> {
        self.0.iter().map(u32::to_value).collect()
    }

    fn expected(limits: &Limits) -> String {
        format!("a rising list, each {}", u32::expected(limits))
    }

    fn example(_: &Limits) -> Self {
        Self(vec![1, 2, 4])
    }
}

/// Names of files, without number and extension.
#[derive(Clone)]
struct Means(Vec<String>);

impl Param for Means {
    fn from_value(value: &Value, limits: &Limits) -> Option<Self> {
        let is_plain = |name: &String| {
            name.len() <= 120 && name.bytes().all(|c| c.is_ascii_alphanumeric() || c == b'-')
        };
        list(value, |value| String::from_value(value, limits).filter(is_plain)).map(Self)
    }

    fn to_value(&self) -> Option<Value> {
        self.0.iter().map(String::to_value).collect()
    }

    fn expected(_: &Limits) -> String {
        "a list of names of letters, digits and hyphens".into()
    }

    fn example(_: &Limits) -> Self {
        Self(vec!["1-sobol".into()])
    }
}

/// A list with at least one value.
fn list<T>(value: &Value, read: impl Fn(&Value) -> Option<T>) -> Option<Vec<T>> {
    let Value::Array(nodes) = value else { return None };
    if nodes.is_empty() {
        return None;
    }
    nodes.iter().map(|node| read(&node.value)).collect()
}
