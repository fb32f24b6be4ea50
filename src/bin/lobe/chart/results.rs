//! [`Results`]: the plan, the runs and the mean pictures of a chart on disk, from which an interrupted one is resumed.

use std::error::Error;
use std::fs::{self, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use lobe::Spectrum;
use lobe::glam::UVec2;
use lobe::image::{Image, Metadata, Picture, WriteError, write_exr};
use lobe::metrics::convergence::{Run, RunningMean};
use lobe::params::Shown;

use super::folder::{Folder, check_size};
use super::plan::Plan;
use super::runs::Planned;

/// Results in a folder: the plan, the runs so far, and mean pictures by name and number of pictures.
pub struct Results {
    pub folder: Folder,
    /// Size of all pictures.
    size: UVec2,
}

const PLAN: &str = "plan.toml";
const RUNS: &str = "runs.csv";

/// All files that a chart writes, apart from the plan and the means.
const FILES: [&str; 6] = [
    RUNS,
    "curves.csv",
    "error-by-time.svg",
    "error-by-samples.svg",
    "equal-time.svg",
    "index.html",
];

/// Names of means that each chart has.
pub const REFERENCE: &str = "reference";
pub const CHECK: &str = "check";

/// What to do about results that cannot be used.
pub const REMEDY: &str = "restore it, or start again with --fresh";

impl Results {
    /// Opens the folder of a chart, or a new or empty one.
    pub fn open(path: &Path, size: UVec2) -> Result<Self, Box<dyn Error>> {
        let folder = Folder::open(path, PLAN, |plan| Plan::read(plan).map(drop))?;
        Ok(Self { folder, size })
    }

    /// The plan of the chart in this folder; `None` if there is none.
    pub fn plan(&self) -> Result<Option<Plan>, Box<dyn Error>> {
        let path = self.folder.join(PLAN);
        fs::symlink_metadata(&path).is_ok().then(|| Plan::read(&path)).transpose()
    }

    /// Starts again with this plan: removes the files of the chart that is there, and no others.
    pub fn begin(&self, plan: &Plan) -> Result<(), Box<dyn Error>> {
        let text = plan.to_toml();
        if text.len() as u64 > Plan::MOST_BYTES {
            return Err("there are too many methods or numbers of samples for a plan".into());
        }
        // The plan of what is removed stays until that is done, so that a chart that is killed here starts again.
        let old = self.plan()?;
        let removed = Plan { starting: true, ..old.as_ref().unwrap_or(plan).clone() };
        self.folder.write(PLAN, removed.to_toml().as_bytes())?;
        for name in FILES {
            self.folder.remove(name)?;
        }
        for name in means_of(&removed).chain(means_of(plan)) {
            self.remove_means(name, MOST)?;
        }
        self.create_means()?;
        self.folder.write(RUNS, format!("{}\n", Run::HEADER).as_bytes())?;
        self.folder.write(PLAN, text.as_bytes())
    }

    /// The runs so far. An incomplete last line is removed; its run is repeated later.
    pub fn runs(&self, planned: &Planned) -> Result<Vec<Run>, Box<dyn Error>> {
        let path = self.folder.join(RUNS);
        let unfit = |error: Box<dyn Error>| format!("{error}; {REMEDY}");
        check_size(&path, planned.most_bytes()).map_err(unfit)?;
        let text = fs::read_to_string(&path)
            .map_err(|error| format!("cannot read `{}`: {error}; {REMEDY}", Shown::path(&path)))?;
        let whole = &text[..text.rfind('\n').map_or(0, |end| end + 1)];
        let runs = planned.parse(whole).map_err(|(line, problem)| {
            format!("{}:{line}: {problem}, or start again with --fresh", Shown::path(&path))
        })?;
        if whole.len() < text.len() {
            self.folder.write(RUNS, whole.as_bytes())?;
        }
        Ok(runs)
    }

    /// Appends a run. What is written of a run when space ends is removed by [`runs`](Self::runs).
    pub fn add_run(&self, run: &Run) -> Result<(), Box<dyn Error>> {
        let path = self.folder.join(RUNS);
        OpenOptions::new()
            .append(true)
            .open(&path)
            .and_then(|mut file| file.write_all(format!("{run}\n").as_bytes()))
            .map_err(|error| WriteError::System { path, error }.into())
    }

    /// Checks the means: that they fit the runs and can be used. Removes those that have been replaced.
    pub fn check_means(&self, planned: &Planned, runs: &[Run]) -> Result<(), Box<dyn Error>> {
        let Planned { plan, .. } = planned;
        self.mean(REFERENCE, Plan::PARTS)?;
        self.mean(CHECK, Plan::CHECK_PARTS)?;
        let mut pictures = 0;
        for (name, done) in planned.last_runs(runs) {
            let count = self.mean(name, plan.seeds)?.count();
            if count < done {
                return Err(format!(
                    "`{}` has {done} runs with {} samples, but `{}` is missing: {REMEDY}",
                    Shown::path(&self.folder.join(RUNS)),
                    plan.most(),
                    Shown::path(&self.mean_path(name, done))
                )
                .into());
            }
            pictures += count;
        }
        // A chart that is killed between both has one picture more than runs.
        if runs.is_empty() && pictures > 1 {
            let path = self.folder.join(RUNS);
            return Err(format!(
                "`{}` has no runs, but there are means of {pictures} pictures: {REMEDY}",
                Shown::path(&path)
            )
            .into());
        }
        for name in means_of(plan) {
            self.remove_means(name, self.count(name).saturating_sub(1))?;
        }
        self.create_means()
    }

    /// The mean of this name, of at most `most` pictures; empty if nothing was added yet.
    pub fn mean(&self, name: &str, most: u32) -> Result<RunningMean, Box<dyn Error>> {
        let count = self.count(name);
        if count == 0 {
            return Ok(RunningMean::default());
        }
        let path = self.mean_path(name, count);
        let image = Image::read(&path).map_err(|error| format!("{error}; {REMEDY}"))?;
        match self.problem(&image, count, most) {
            Some(problem) => Err(format!("`{}` {problem}: {REMEDY}", Shown::path(&path)).into()),
            None => Ok(RunningMean::from_image(&image, count)),
        }
    }

    /// Why an image is not the mean of `count` pictures.
    fn problem(&self, image: &Image, count: u32, most: u32) -> Option<String> {
        let (found, expected) = (image.size, self.size);
        let is_any = |pixels: &[Spectrum], is_wrong: fn(&f32) -> bool| {
            pixels.iter().flat_map(|pixel| pixel.to_array()).any(|value| is_wrong(&value))
        };
        if count > most {
            Some(format!("is the mean of {count} pictures, expected at most {most}"))
        } else if found != expected {
            let [size, expected] = [found, expected].map(|size| format!("{} x {}", size.x, size.y));
            Some(format!("has {size} pixels, expected {expected}"))
        } else if is_any(&image.pixels, |value| !value.is_finite()) {
            Some("has values that are not finite".into())
        } else if count > 1 && image.variance.is_none() {
            Some(format!("has no variance, expected that of {count} pictures"))
        } else if image.variance.iter().any(|v| is_any(v, |value| value.is_nan() || *value < 0.0)) {
            Some("has variances that are not numbers of at least 0".into())
        } else {
            None
        }
    }

    /// Number of pictures in the mean of this name.
    pub fn count(&self, name: &str) -> u32 {
        let is_there = |count: &u32| self.mean_path(name, *count).is_file();
        (1..=MOST).rev().find(is_there).unwrap_or(0)
    }

    /// Adds a picture to the mean of this name and stores it. `mean` is rounded as it is stored, so that results do not
    /// depend on interruptions.
    pub fn add(
        &self,
        name: &str,
        mean: &mut RunningMean,
        image: &Image,
    ) -> Result<(), Box<dyn Error>> {
        mean.add(&image.pixels);
        let (color, variance) = mean.pixels();
        let stored = Image { pixels: color.clone(), variance: variance.clone(), ..image.clone() };
        *mean = RunningMean::from_image(&stored, mean.count());
        let degrees_of_freedom = mean.degrees_of_freedom();
        let picture = Picture { variance, degrees_of_freedom, ..Picture::new(image.size, color) };
        write_exr(self.mean_path(name, mean.count()), &picture, &Metadata::default())?;
        let _ = fs::remove_file(self.mean_path(name, mean.count() - 1));
        Ok(())
    }

    fn create_means(&self) -> Result<(), Box<dyn Error>> {
        let path = self.folder.join("means");
        fs::create_dir_all(&path).map_err(|error| {
            format!("cannot create the folder `{}`: {error}", Shown::path(&path)).into()
        })
    }

    /// Removes the means of this name of up to `most` pictures.
    fn remove_means(&self, name: &str, most: u32) -> Result<(), Box<dyn Error>> {
        (1..=most).try_for_each(|count| self.folder.remove(&mean_file(name, count)))
    }

    fn mean_path(&self, name: &str, count: u32) -> PathBuf {
        self.folder.join(&mean_file(name, count))
    }
}

fn mean_file(name: &str, count: u32) -> String {
    format!("means/{name}-{count}.exr")
}

/// Names of all means of a plan.
fn means_of(plan: &Plan) -> impl Iterator<Item = &str> {
    [REFERENCE, CHECK].into_iter().chain(plan.means.iter().map(String::as_str))
}

/// Largest number of pictures in a mean.
pub const MOST: u32 = 64;
