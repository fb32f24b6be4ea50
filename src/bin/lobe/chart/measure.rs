//! [`Bench`]: renders whatever the plan wants and the folder does not have yet.

use std::error::Error;

use lobe::metrics::Image;
use lobe::metrics::convergence::{Bias, Curve, Method, Pool, Reference, Run};
use lobe::scene::{IntegratorSettings, LightStrategy, SamplerKind, SamplerSettings};
use lobe::{RenderOptions, Scene};

use super::folder::Folder;
use super::methods::with_strategy;
use super::plan::{Cost, Plan};
use super::steps::Steps;

/// The methods of a chart, and where it stands.
pub struct Bench<'a> {
    pub scene: &'a Scene,
    pub methods: Vec<Method<'a>>,
    /// Of each method.
    pub settings: Vec<(SamplerSettings, IntegratorSettings)>,
    /// What the reader has to know.
    pub notes: Vec<String>,
    pub options: RenderOptions<'a>,
    pub folder: Folder,
    pub is_quiet: bool,
}

/// What the plan has to keep to.
pub struct Limits {
    /// Numbers of samples; where there are none, as many as the time allows.
    pub budgets: Vec<u32>,
    pub seconds: f64,
    pub seeds: u32,
    /// Samples of the reference, if not the usual number.
    pub reference: Option<u32>,
    pub fresh: bool,
}

/// What came out.
pub struct Measured {
    pub reference: Reference,
    pub curves: Vec<Curve>,
    pub biases: Vec<Option<Bias>>,
    /// How far the reference is from the mean of another estimator.
    pub check: Bias,
    pub plan: Plan,
}

/// Seeds of the reference and of its check, from the scene's on: far from those of the methods.
const REFERENCE_SEEDS: u64 = 1_000_000;
const CHECK_SEEDS: u64 = 2_000_000;

impl<'a> Bench<'a> {
    /// Renders what is missing.
    pub fn measure(&mut self, limits: &Limits) -> Result<Measured, Box<dyn Error>> {
        let (costs, print) = self.try_out()?;
        let [reference, check] = self.truths();
        let truth_costs = [cost(&reference)?, cost(&check)?];
        let plan = self.agree(limits, &costs, truth_costs, print)?;
        let runs = self.folder.runs()?;
        let seed = self.scene.sampler().seed;

        let done_parts = [self.folder.count("reference"), self.folder.count("check")];
        let done = runs.iter().map(|run| self.cost_of(run, &costs)).sum::<f64>()
            + f64::from(done_parts[0]) * truth_costs[0].of(plan.part_spp)
            + f64::from(done_parts[1]) * truth_costs[1].of(plan.most());
        let steps = Steps::new(plan.seconds(&costs, truth_costs), done, self.is_quiet);
        let all = plan.seeds as usize * plan.budgets.len() * self.methods.len();
        steps.say(format!(
            "{} methods, {:?} samples, {} seeds: {} of {all} pictures are there",
            self.methods.len(),
            plan.budgets,
            plan.seeds,
            runs.len()
        ));
        let truth = |name: &str, method: &Method, parts: u32, spp: u32, seeds: u64, cost: Cost| {
            let mut pool = self.folder.pool(name)?;
            while pool.count() < parts {
                steps.begin(format!("{name}, part {} of {parts}", pool.count() + 1));
                let (image, _) = method.render(spp, seed + seeds + u64::from(pool.count()))?;
                self.folder.add(name, &mut pool, &image)?;
                steps.done(cost.of(spp));
            }
            Ok::<Pool, Box<dyn Error>>(pool)
        };
        let size = self.scene.film().window().size();
        let pool = truth(
            "reference",
            &reference,
            Plan::PARTS,
            plan.part_spp,
            REFERENCE_SEEDS,
            truth_costs[0],
        )?;
        let reference = Reference::new(&pool, size);
        let pool =
            truth("check", &check, Plan::CHECK_PARTS, plan.most(), CHECK_SEEDS, truth_costs[1])?;
        let all = f64::from(Plan::PARTS) * f64::from(plan.part_spp);
        let check = Bias::new(
            &pool,
            &reference,
            f64::from(Plan::CHECK_PARTS) * f64::from(plan.most()) / all,
        );

        let runs = self.run_all(&plan, &reference, runs, &costs, &steps)?;
        steps.clear();
        let curve = |method: &Method| Curve::new(method.name(), &runs, &reference);
        let curves = self.methods.iter().map(curve).collect();
        let bias = |number: usize| -> Result<Option<Bias>, Box<dyn Error>> {
            let pool = self.folder.pool(&self.mean_name(number))?;
            let part = f64::from(pool.count()) * f64::from(plan.most()) / all;
            Ok((pool.count() > 1).then(|| Bias::new(&pool, &reference, part)))
        };
        let biases = (0..self.methods.len()).map(bias).collect::<Result<_, _>>()?;
        Ok(Measured { reference, curves, biases, check, plan })
    }

    /// One picture of each method: what it costs, and what it looks like. Methods that give the same bits as one before, by the
    /// same sampler, are the same and left out.
    fn try_out(&mut self) -> Result<(Vec<Cost>, u32), Box<dyn Error>> {
        let (mut images, mut costs): (Vec<(SamplerSettings, Image)>, Vec<Cost>) =
            (Vec::new(), Vec::new());
        let mut print = crc32fast::Hasher::new();
        let mut kept: Vec<Method> = Vec::new();
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        let threads = self.options.threads.map_or(threads, usize::from);
        print.update(format!("{} {threads}", env!("CARGO_PKG_VERSION")).as_bytes());
        let settings = std::mem::take(&mut self.settings);
        for (method, (sampler, integrator)) in
            std::mem::take(&mut self.methods).into_iter().zip(settings)
        {
            let (image, _) = method.render(4, self.scene.sampler().seed)?;
            if let Some(same) =
                images.iter().position(|known| known.0 == sampler && known.1 == image)
            {
                let note = format!("{} does here what {} does", method.name(), kept[same].name());
                self.notes.push(note);
                continue;
            }
            // What a picture of few samples does not show is in the settings.
            print.update(format!("{} {sampler:?} {integrator:?}", method.name()).as_bytes());
            for band in image.pixels.iter().flat_map(|pixel| pixel.to_array()) {
                print.update(&band.to_bits().to_le_bytes());
            }
            costs.push(cost(&method)?);
            images.push((sampler, image));
            self.settings.push((sampler, integrator));
            kept.push(method);
        }
        self.methods = kept;
        Ok((costs, print.finalize()))
    }

    /// The reference's estimator, light and surface sampling weighed against each other, without roulette, by Sobol points
    /// in one set; and another one to check it by, light sampling alone with independent samples.
    fn truths(&self) -> [Method<'a>; 2] {
        let by = |name: &str, kind, strategy| {
            let sampler = SamplerSettings { kind, replicates: 1, ..*self.scene.sampler() };
            let mut integrator = with_strategy(*self.scene.integrator(), strategy);
            if let IntegratorSettings::Path { roulette, .. } = &mut integrator {
                *roulette = false;
            }
            Method::of_settings(self.scene, name, sampler, integrator, self.options)
        };
        [
            by("reference", SamplerKind::SOBOL, LightStrategy::Mis),
            by("check", SamplerKind::INDEPENDENT, LightStrategy::Light),
        ]
    }

    /// The plan of the folder, or a new one.
    fn agree(
        &self,
        limits: &Limits,
        costs: &[Cost],
        truths: [Cost; 2],
        print: u32,
    ) -> Result<Plan, Box<dyn Error>> {
        let Limits { budgets, seconds, seeds, reference, fresh } = limits;
        let with = |budgets| Plan::new(budgets, *seeds, *reference, print);
        if !fresh && let Some(plan) = self.folder.plan()? {
            // What was not asked for may be as it is there.
            let budgets = if budgets.is_empty() { &plan.budgets } else { budgets };
            let mut asked = with(budgets.clone());
            if reference.is_none() {
                asked.part_spp = plan.part_spp;
            }
            return if asked == plan {
                Ok(plan)
            } else {
                Err(format!(
                    "`{}` holds a chart of another scene, or with other settings: choose another folder by -o, \
                     or begin anew by --fresh",
                    self.folder.join("plan.toml").display()
                )
                .into())
            };
        }
        let plan = match budgets.as_slice() {
            [] => Plan::for_time(*seconds, costs, truths, with),
            budgets => with(budgets.to_vec()),
        };
        self.folder.begin(&plan)?;
        Ok(plan)
    }

    /// Budget by budget and seed by seed the methods take turns, so that a busy machine is no disadvantage to one of them.
    fn run_all(
        &self,
        plan: &Plan,
        reference: &Reference,
        mut runs: Vec<Run>,
        costs: &[Cost],
        steps: &Steps,
    ) -> Result<Vec<Run>, Box<dyn Error>> {
        for &spp in &plan.budgets {
            for number in 0..u64::from(plan.seeds) {
                let seed = self.scene.sampler().seed + 1 + number;
                for (place, method) in self.methods.iter().enumerate() {
                    let is_known = |run: &Run| {
                        run.method == method.name() && run.spp == spp && run.seed == seed
                    };
                    if runs.iter().any(is_known) {
                        continue;
                    }
                    steps.begin(format!(
                        "{}, {spp} spp, seed {} of {}",
                        method.name(),
                        number + 1,
                        plan.seeds
                    ));
                    let (run, image) = method
                        .run(spp, seed, reference)
                        .map_err(|error| format!("{}, {spp} samples: {error}", method.name()))?;
                    let mean = self.mean_name(place);
                    // One more than there are runs was kept if the end came between both.
                    if spp == plan.most() && u64::from(self.folder.count(&mean)) == number {
                        let mut pool = self.folder.pool(&mean)?;
                        self.folder.add(&mean, &mut pool, &image)?;
                    }
                    self.folder.add_run(&run)?;
                    steps.done(costs[place].of(spp));
                    runs.push(run);
                }
            }
        }
        Ok(runs)
    }

    fn mean_name(&self, place: usize) -> String {
        format!("{}-{}", place + 1, self.methods[place].name())
    }

    fn cost_of(&self, run: &Run, costs: &[Cost]) -> f64 {
        let place = self.methods.iter().position(|method| method.name() == run.method);
        place.map_or(0.0, |place| costs[place].of(run.spp))
    }
}

/// What a method costs, from one sample and from four; the first picture only warms up.
fn cost(method: &Method) -> Result<Cost, Box<dyn Error>> {
    let time = |spp| Ok::<f64, Box<dyn Error>>(method.render(spp, 0)?.1[1]);
    time(1)?;
    let (few, many) = (time(1)?, time(4)?);
    Ok(Cost::new((1, few), (4, many)))
}
