//! [`Plan`]: how many samples, seeds and parts of the reference.

/// What a method's picture costs, in seconds.
#[derive(Clone, Copy, Debug)]
pub struct Cost {
    /// Whatever the number of samples is.
    pub fixed: f64,
    /// For each sample per pixel.
    pub per_sample: f64,
}

impl Cost {
    /// From how long two numbers of samples took.
    pub fn new((few, short): (u32, f64), (many, long): (u32, f64)) -> Self {
        let per_sample = ((long - short) / f64::from(many - few)).max(1e-6);
        Self { fixed: (short - per_sample * f64::from(few)).max(0.0), per_sample }
    }

    pub fn of(&self, spp: u32) -> f64 {
        self.fixed + self.per_sample * f64::from(spp)
    }
}

/// What is rendered. A chart that was interrupted goes on with the same plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Samples per pixel, rising.
    pub budgets: Vec<u32>,
    /// How many pictures of each method with each of them.
    pub seeds: u32,
    /// Samples per pixel of each part of the reference.
    pub part_spp: u32,
    /// Tells scene and methods from others.
    pub print: u32,
}

impl Plan {
    /// Parts of the reference, and the samples that each has for one of the largest budget, if nothing else is asked
    /// for: so its squared error is about a thirtieth of what the best methods reach, or less.
    pub const PARTS: u32 = 8;
    const PART_SPP: u32 = 4;
    /// Parts of the check, which have as many samples as the largest budget.
    pub const CHECK_PARTS: u32 = 4;

    /// A plan with so many samples in the whole of the reference, or as many as suit the budgets.
    pub fn new(budgets: Vec<u32>, seeds: u32, reference: Option<u32>, print: u32) -> Self {
        let most = budgets.last().copied().unwrap_or(1);
        let usual = || Self::PART_SPP.saturating_mul(most);
        let part_spp = reference.map_or_else(usual, |spp| spp.div_ceil(Self::PARTS));
        Self { budgets, seeds, part_spp, print }
    }

    /// One with powers of two as budgets, as many as the time allows; at least up to 4.
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

    /// What all of it takes.
    pub fn seconds(&self, methods: &[Cost], [reference, check]: [Cost; 2]) -> f64 {
        let runs = methods.iter().flat_map(|cost| self.budgets.iter().map(|&spp| cost.of(spp)));
        f64::from(self.seeds) * runs.sum::<f64>()
            + f64::from(Self::PARTS) * reference.of(self.part_spp)
            + f64::from(Self::CHECK_PARTS) * check.of(self.most())
    }

    /// The plan as it is kept, in lines of TOML.
    pub fn to_toml(&self) -> String {
        let Self { budgets, seeds, part_spp, print } = self;
        format!(
            "# What `lobe chart` renders here.\n\
             budgets = {budgets:?}\nseeds = {seeds}\npart_spp = {part_spp}\nprint = {print}\n"
        )
    }

    /// What [`to_toml`](Self::to_toml) wrote.
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
            print: value("print")?.parse().ok()?,
        };
        plan.budgets.is_sorted_by(|a, b| a < b).then_some(plan)
    }
}
