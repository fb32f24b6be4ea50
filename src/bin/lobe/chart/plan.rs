//! [`Plan`]: the numbers of samples, of seeds, and of parts of the reference.

/// Linear model of a method's time for a picture, in seconds.
#[derive(Clone, Copy, Debug)]
pub struct Cost {
    /// Independent of the number of samples.
    pub fixed: f64,
    /// Per sample per pixel.
    pub per_sample: f64,
}

impl Cost {
    /// Fits two measurements: (samples, seconds).
    pub fn new((few, short): (u32, f64), (many, long): (u32, f64)) -> Self {
        let per_sample = ((long - short) / f64::from(many - few)).max(1e-6);
        Self { fixed: (short - per_sample * f64::from(few)).max(0.0), per_sample }
    }

    pub fn of(&self, spp: u32) -> f64 {
        self.fixed + self.per_sample * f64::from(spp)
    }
}

/// What a chart renders. An interrupted chart resumes with the same plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Numbers of samples per pixel, rising.
    pub budgets: Vec<u32>,
    /// Number of pictures for each method and number of samples.
    pub seeds: u32,
    /// Samples per pixel of each part of the reference.
    pub part_spp: u32,
    /// CRC-32 of the version, the number of threads, and each method's name, settings and trial picture. `None` for plans of
    /// versions that had another one: they equal no new plan.
    pub fingerprint: Option<u32>,
}

impl Plan {
    /// Number of parts of the reference.
    pub const PARTS: u32 = 8;
    /// Default samples of each part, as a multiple of the largest budget. The reference's squared error is then at most
    /// about 1/32 of the best method's.
    const PART_SPP: u32 = 4;
    /// Number of parts of the check, which have as many samples as the largest budget.
    pub const CHECK_PARTS: u32 = 4;

    /// A plan with `reference` samples per pixel in all parts of the reference together, or the default.
    pub fn new(budgets: Vec<u32>, seeds: u32, reference: Option<u32>, fingerprint: u32) -> Self {
        let most = budgets.last().copied().unwrap_or(1);
        let usual = || Self::PART_SPP.saturating_mul(most);
        let part_spp = reference.map_or_else(usual, |spp| spp.div_ceil(Self::PARTS));
        Self { budgets, seeds, part_spp, fingerprint: Some(fingerprint) }
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
        let Self { budgets, seeds, part_spp, fingerprint } = self;
        let fingerprint = fingerprint.map_or(String::new(), |sum| format!("fingerprint = {sum}\n"));
        format!(
            "# What `lobe chart` renders here.\n\
             budgets = {budgets:?}\nseeds = {seeds}\npart_spp = {part_spp}\n{fingerprint}"
        )
    }

    /// Parses the result of [`to_toml`](Self::to_toml).
    pub fn from_toml(text: &str) -> Option<Self> {
        let value =
            |key: &str| text.lines().find_map(|line| line.strip_prefix(key)?.strip_prefix(" = "));
        let budgets = value("budgets")?.strip_prefix('[')?.strip_suffix(']')?;
        let budgets: Option<Vec<u32>> =
            budgets.split(',').map(|spp| spp.trim().parse().ok()).collect();
        let plan = Self {
            budgets: budgets?,
            seeds: value("seeds")?.parse().ok()?,
            part_spp: value("part_spp")?.parse().ok()?,
            fingerprint: match value("fingerprint") {
                Some(sum) => Some(sum.parse().ok()?),
                None => None,
            },
        };
        plan.budgets.is_sorted_by(|a, b| a < b).then_some(plan)
    }
}
