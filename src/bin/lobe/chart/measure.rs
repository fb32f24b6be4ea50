//! [`Bench`]: renders those pictures of the plan that the folder does not have yet.

use std::error::Error;

use lobe::RenderOptions;
use lobe::image::Image;
use lobe::metrics::convergence::{Bias, Curve, Method, Reference, Run, RunningMean};
use lobe::params::Shown;
use lobe::render::{RenderSettings, SamplerSettings};
use lobe::sampling::SamplerKind;
use lobe::scene_file::LoadedScene;

use super::cost::Cost;
use super::methods::with_changes;
use super::plan::Plan;
use super::results::{CHECK, REFERENCE, Results};
use super::runs::Planned;
use crate::scene::SceneArguments;
use crate::steps::Steps;

/// The methods of a chart, and where its results are stored.
pub struct Bench<'a> {
    pub scene: &'a SceneArguments,
    pub loaded: &'a LoadedScene,
    pub methods: Vec<Method<'a>>,
    /// Settings of each method.
    pub settings: Vec<RenderSettings>,
    /// Remarks for the report.
    pub notes: Vec<String>,
    pub options: RenderOptions<'a>,
    /// Number of threads that render.
    pub threads: usize,
    pub results: Results,
    pub is_quiet: bool,
}

/// Limits given on the command line.
pub struct Limits {
    /// Numbers of samples per pixel; if empty, as many powers of two as the time allows.
    pub budgets: Vec<u32>,
    pub seconds: f64,
    pub seeds: u32,
    /// Samples per pixel of the reference, in place of the default.
    pub reference: Option<u32>,
    pub fresh: bool,
}

/// Results of a chart.
pub struct Measured {
    pub reference: Reference,
    pub curves: Vec<Curve>,
    pub biases: Vec<Option<Bias>>,
    /// Difference between the reference and the mean of another estimator.
    pub check: Bias,
    pub plan: Plan,
}

/// Offsets from the scene's seed, so that the reference and its check use other seeds than the methods.
const REFERENCE_SEEDS: u64 = 1_000_000;
const CHECK_SEEDS: u64 = 2_000_000;

impl<'a> Bench<'a> {
    /// Renders the missing pictures, and evaluates all of them.
    pub fn measure(&mut self, limits: &Limits) -> Result<Measured, Box<dyn Error>> {
        let (costs, fingerprint) = self.try_out()?;
        let [reference, check] = self.truths();
        let truth_costs = [cost(&reference)?, cost(&check)?];
        let plan = self.agree(limits, &costs, truth_costs, fingerprint)?;
        let planned = self.planned(&plan);
        let runs = self.results.runs(&planned)?;
        self.results.check_means(&planned, &runs)?;

        let done_parts = [self.results.count(REFERENCE), self.results.count(CHECK)];
        let done = runs.iter().map(|run| self.cost_of(run, &costs)).sum::<f64>()
            + f64::from(done_parts[0]) * truth_costs[0].of(plan.part_spp)
            + f64::from(done_parts[1]) * truth_costs[1].of(plan.most());
        let steps = Steps::new(plan.seconds(&costs, truth_costs), done, self.is_quiet);
        steps.say(format!(
            "{} methods, {:?} samples, {} seeds: {} of {} pictures exist",
            self.methods.len(),
            plan.budgets,
            plan.seeds,
            runs.len(),
            planned.count()
        ));
        let truth = |name: &str, method: &Method, parts: u32, spp: u32, seeds: u64, cost: Cost| {
            let mut mean = self.results.mean(name, parts)?;
            while mean.count() < parts {
                steps.begin(format!("{name}, part {} of {parts}", mean.count() + 1));
                let (image, _) = method.render(spp, self.seed(seeds + u64::from(mean.count())))?;
                self.results.add(name, &mut mean, &image)?;
                steps.done(cost.of(spp));
            }
            Ok::<RunningMean, Box<dyn Error>>(mean)
        };
        let size = self.loaded.view.film().window().size();
        let parts = truth(
            REFERENCE,
            &reference,
            Plan::PARTS,
            plan.part_spp,
            REFERENCE_SEEDS,
            truth_costs[0],
        )?;
        let reference = Reference::new(&parts, size);
        let parts =
            truth(CHECK, &check, Plan::CHECK_PARTS, plan.most(), CHECK_SEEDS, truth_costs[1])?;
        let all = f64::from(Plan::PARTS) * f64::from(plan.part_spp);
        let check = Bias::new(
            &parts,
            &reference,
            f64::from(Plan::CHECK_PARTS) * f64::from(plan.most()) / all,
        );

        let runs = self.run_all(&planned, &reference, runs, &costs, &steps)?;
        steps.clear();
        let curve = |method: &Method| Curve::new(method.name(), &runs, &reference);
        let curves = self.methods.iter().map(curve).collect();
        let bias = |index: usize| -> Result<Option<Bias>, Box<dyn Error>> {
            let mean = self.results.mean(&plan.means[index], plan.seeds)?;
            let part = f64::from(mean.count()) * f64::from(plan.most()) / all;
            Ok((mean.count() > 1).then(|| Bias::new(&mean, &reference, part)))
        };
        let biases = (0..self.methods.len()).map(bias).collect::<Result<_, _>>()?;
        Ok(Measured { reference, curves, biases, check, plan })
    }

    /// The scene's seed plus an offset. Any number is a seed, so after the largest one comes 0.
    pub fn seed(&self, offset: u64) -> u64 {
        self.loaded.settings.sampler.seed.wrapping_add(offset)
    }

    /// Renders one picture with each method. Returns their costs and a checksum of them. Methods that give the same bits
    /// as an earlier one with the same sampler are duplicates and removed.
    fn try_out(&mut self) -> Result<(Vec<Cost>, u32), Box<dyn Error>> {
        let (mut images, mut costs): (Vec<(SamplerSettings, Image)>, Vec<Cost>) =
            (Vec::new(), Vec::new());
        let mut fingerprint = crc32fast::Hasher::new();
        let mut kept: Vec<Method> = Vec::new();
        let threads = self.threads;
        fingerprint.update(format!("{} {threads}", env!("CARGO_PKG_VERSION")).as_bytes());
        let settings = std::mem::take(&mut self.settings);
        for (method, settings) in std::mem::take(&mut self.methods).into_iter().zip(settings) {
            let RenderSettings { sampler, ref integrator } = settings;
            let (image, _) = method.render(4, self.seed(0))?;
            if let Some(same) =
                images.iter().position(|known| known.0 == sampler && known.1 == image)
            {
                let note = format!(
                    "{} gives the same pictures as {} here, and is left out",
                    method.name(),
                    kept[same].name()
                );
                self.notes.push(note);
                continue;
            }
            // The settings, too: a picture of few samples may not show all differences.
            fingerprint.update(
                format!("{} {sampler:?} {}", method.name(), integrator.describe()).as_bytes(),
            );
            for band in image.pixels.iter().flat_map(|pixel| pixel.to_array()) {
                fingerprint.update(&band.to_bits().to_le_bytes());
            }
            costs.push(cost(&method)?);
            images.push((sampler, image));
            self.settings.push(settings);
            kept.push(method);
        }
        self.methods = kept;
        Ok((costs, fingerprint.finalize()))
    }

    /// The methods for the reference and for its check: multiple importance sampling with Sobol points in one set, and
    /// light sampling alone with independent samples; both without roulette.
    fn truths(&self) -> [Method<'a>; 2] {
        let by = |name: &str, kind, strategy| {
            let sampler = SamplerSettings { kind, replicates: 1, ..self.loaded.settings.sampler };
            let changes = [strategy, "integrator.roulette=false"];
            let integrator = with_changes(self.scene, &self.loaded.settings.integrator, &changes);
            let settings = RenderSettings::new(sampler, integrator);
            Method::of_settings(&self.loaded.scene, &self.loaded.view, name, settings, self.options)
        };
        [
            by("reference", SamplerKind::SOBOL, "integrator.strategy=\"mis\""),
            by("check", SamplerKind::INDEPENDENT, "integrator.strategy=\"light\""),
        ]
    }

    /// The plan in the folder if it fits what the user asked for, or a new one.
    fn agree(
        &self,
        limits: &Limits,
        costs: &[Cost],
        truths: [Cost; 2],
        fingerprint: u32,
    ) -> Result<Plan, Box<dyn Error>> {
        let Limits { budgets, seconds, seeds, reference, fresh } = limits;
        let part_spp = reference.map(|spp| spp.div_ceil(Plan::PARTS));
        let with = |budgets, part_spp| {
            Plan::new(budgets, *seeds, part_spp, self.mean_names(), fingerprint)
        };
        if !fresh
            && let Some(plan) = self.results.plan()?
            && !plan.starting
        {
            // Limits that the user did not give are taken from the stored plan.
            let budgets = if budgets.is_empty() { &plan.budgets } else { budgets };
            let asked = with(budgets.clone(), part_spp.or(Some(plan.part_spp)));
            return if asked == plan {
                Ok(plan)
            } else {
                Err(format!(
                    "`{}` holds a chart of another scene, or with other settings: choose another folder with -o, \
                     or start again with --fresh",
                    Shown::path(&self.results.folder.join("plan.toml"))
                )
                .into())
            };
        }
        let plan = match budgets.as_slice() {
            [] => Plan::for_time(*seconds, costs, truths, |budgets| with(budgets, part_spp)),
            budgets => with(budgets.to_vec(), part_spp),
        };
        self.results.begin(&plan)?;
        Ok(plan)
    }

    /// The methods take turns for each number of samples and seed, so that other load on the machine affects all alike.
    fn run_all(
        &self,
        planned: &Planned,
        reference: &Reference,
        mut runs: Vec<Run>,
        costs: &[Cost],
        steps: &Steps,
    ) -> Result<Vec<Run>, Box<dyn Error>> {
        let Planned { plan, seeds, .. } = planned;
        for &spp in &plan.budgets {
            for (place, &seed) in (0..).zip(seeds) {
                for (index, method) in self.methods.iter().enumerate() {
                    let is_known = |run: &Run| {
                        run.method == method.name() && run.spp == spp && run.seed == seed
                    };
                    if runs.iter().any(is_known) {
                        continue;
                    }
                    let (name, of) = (method.name(), plan.seeds);
                    steps.begin(format!("{name}, {spp} spp, seed {} of {of}", place + 1));
                    let (run, image) = method
                        .run(spp, seed, reference)
                        .map_err(|error| format!("{name}, {spp} samples: {error}"))?;
                    let mean_name = &plan.means[index];
                    // After an interruption between both writes, the mean has one picture more than there are runs.
                    if spp == plan.most() && self.results.count(mean_name) == place {
                        let mut mean = self.results.mean(mean_name, plan.seeds)?;
                        self.results.add(mean_name, &mut mean, &image)?;
                    }
                    self.results.add_run(&run)?;
                    steps.done(costs[index].of(spp));
                    runs.push(run);
                }
            }
        }
        Ok(runs)
    }

    fn planned<'p>(&'p self, plan: &'p Plan) -> Planned<'p> {
        let methods = self.methods.iter().map(Method::name).collect();
        let seeds = (1..=u64::from(plan.seeds)).map(|place| self.seed(place)).collect();
        Planned { plan, methods, seeds }
    }

    fn mean_names(&self) -> Vec<String> {
        let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '-' };
        let name = |(number, method): (u32, &Method)| {
            format!("{number}-{}", method.name().chars().map(plain).collect::<String>())
        };
        (1..).zip(&self.methods).map(name).collect()
    }

    fn cost_of(&self, run: &Run, costs: &[Cost]) -> f64 {
        let index = self.methods.iter().position(|method| method.name() == run.method);
        index.map_or(0.0, |index| costs[index].of(run.spp))
    }
}

/// Measures a method's cost with one and with four samples per pixel, after a warm-up.
fn cost(method: &Method) -> Result<Cost, Box<dyn Error>> {
    let time = |spp| Ok::<f64, Box<dyn Error>>(method.render(spp, 0)?.1[1]);
    time(1)?;
    let (few, many) = (time(1)?, time(4)?);
    Ok(Cost::new((1, few), (4, many)))
}
