//! [`Planned`]: the runs that a chart will have, against which those in its file are checked.

use lobe::metrics::convergence::Run;

use super::plan::Plan;

/// The runs of a plan.
pub struct Planned<'a> {
    pub plan: &'a Plan,
    /// Names of all methods, in the order of [`Plan::means`].
    pub methods: Vec<&'a str>,
    /// All seeds, in the order in which they are rendered.
    pub seeds: Vec<u64>,
}

impl Planned<'_> {
    /// Number of runs.
    pub fn count(&self) -> usize {
        self.methods.len() * self.plan.budgets.len() * self.seeds.len()
    }

    /// Largest size of the file of runs.
    pub fn most_bytes(&self) -> u64 {
        // A name of 80 bytes, five numbers of up to 330 digits, and more.
        2048 * (self.count() as u64 + 2)
    }

    /// Parses a file of whole lines. What is wrong comes with the number of its line, and with what to do.
    pub fn parse(&self, text: &str) -> Result<Vec<Run>, (usize, String)> {
        let mut lines = text.lines().zip(1..);
        match lines.next() {
            Some((Run::HEADER, _)) => {}
            _ => return Err((1, format!("expected {}; restore the line", Run::HEADER))),
        }
        let mut runs: Vec<Run> = Vec::new();
        for (line, number) in lines {
            let check = |run: Run| self.check(&run, &runs).map(|()| run);
            let run = line.parse().map_err(|error| format!("{error}")).and_then(check);
            runs.push(run.map_err(|problem| (number, format!("{problem}; remove the line")))?);
        }
        Ok(runs)
    }

    /// Checks that a run is planned and not among those of earlier lines.
    fn check(&self, run: &Run, earlier: &[Run]) -> Result<(), String> {
        let Run { method, spp, seed, .. } = run;
        let is_same =
            |other: &Run| other.method == *method && other.spp == *spp && other.seed == *seed;
        if !self.methods.contains(&method.as_str()) {
            Err(format!("the plan has no method `{method}`"))
        } else if !self.plan.budgets.contains(spp) {
            Err(format!("the plan has no runs with {spp} samples"))
        } else if !self.seeds.contains(seed) {
            Err(format!("the plan has no runs with seed {seed}"))
        } else if let Some(index) = earlier.iter().position(is_same) {
            let line = index + 2;
            Err(format!(
                "line {line} is the run of `{method}` with {spp} samples and seed {seed}, too"
            ))
        } else {
            Ok(())
        }
    }

    /// For each method, the name of its mean and the number of runs with the most samples.
    pub fn last_runs(&self, runs: &[Run]) -> impl Iterator<Item = (&str, u32)> {
        self.methods.iter().zip(&self.plan.means).map(|(&method, mean)| {
            let is_last = |run: &&Run| run.method == method && run.spp == self.plan.most();
            (mean.as_str(), runs.iter().filter(is_last).count() as u32)
        })
    }
}
