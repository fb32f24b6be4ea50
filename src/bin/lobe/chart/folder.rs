//! [`Folder`]: the results of a chart on disk, from which an interrupted one is resumed.

use std::error::Error;
use std::fs::{self, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use lobe::image::{Image, Metadata, Picture, write_exr, write_file};
use lobe::metrics::convergence::{Run, RunningMean};

use super::plan::Plan;

/// A folder with the plan, the runs so far, and mean pictures by name and number of pictures.
pub struct Folder {
    path: PathBuf,
}

impl Folder {
    /// Opens the folder, and creates it if it does not exist.
    pub fn open(path: &Path) -> Result<Self, Box<dyn Error>> {
        fs::create_dir_all(path)
            .map_err(|error| format!("cannot create the folder `{}`: {error}", path.display()))?;
        Ok(Self { path: path.to_owned() })
    }

    pub fn join(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// Writes a file whole or not at all.
    pub fn write(&self, name: &str, contents: &[u8]) -> Result<(), Box<dyn Error>> {
        Ok(write_file(self.join(name), contents)?)
    }

    /// The plan of the chart in this folder; `None` if there is none.
    pub fn plan(&self) -> Result<Option<Plan>, Box<dyn Error>> {
        let path = self.join("plan.toml");
        match fs::read_to_string(&path) {
            Ok(text) => Plan::from_toml(&text).map(Some).ok_or_else(|| {
                format!(
                    "`{}` is not the plan of a chart: choose another folder with -o",
                    path.display()
                )
                .into()
            }),
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(format!("cannot read `{}`: {error}", path.display()).into()),
        }
    }

    /// Starts again with this plan: removes all results.
    pub fn begin(&self, plan: &Plan) -> Result<(), Box<dyn Error>> {
        // The plan is removed first and written last: without it nothing is resumed.
        let means = self.join("means");
        let removed = [(fs::remove_file(self.join("plan.toml"))), fs::remove_dir_all(&means)];
        let is_missing = |error: &std::io::Error| error.kind() == std::io::ErrorKind::NotFound;
        if let Some(error) = removed.into_iter().filter_map(Result::err).find(|e| !is_missing(e)) {
            return Err(format!("cannot empty `{}`: {error}", self.path.display()).into());
        }
        fs::create_dir_all(&means)
            .map_err(|error| format!("cannot create the folder `{}`: {error}", means.display()))?;
        self.write("runs.csv", format!("{}\n", Run::HEADER).as_bytes())?;
        self.write("plan.toml", plan.to_toml().as_bytes())
    }

    /// The runs so far. An incomplete last line is removed; its run is repeated later.
    pub fn runs(&self) -> Result<Vec<Run>, Box<dyn Error>> {
        let path = self.join("runs.csv");
        let text = fs::read_to_string(&path)
            .map_err(|error| format!("cannot read `{}`: {error}", path.display()))?;
        let whole = &text[..text.rfind('\n').map_or(0, |end| end + 1)];
        if whole.len() < text.len() {
            self.write("runs.csv", whole.as_bytes())?;
        }
        let mut runs = Vec::new();
        for line in whole.lines().skip(1) {
            let run = line.parse().map_err(|error| format!("`{}`: {error}", path.display()))?;
            runs.push(run);
        }
        Ok(runs)
    }

    pub fn add_run(&self, run: &Run) -> Result<(), Box<dyn Error>> {
        let path = self.join("runs.csv");
        OpenOptions::new()
            .append(true)
            .open(&path)
            .and_then(|mut file| file.write_all(format!("{run}\n").as_bytes()))
            .map_err(|error| format!("cannot write to `{}`: {error}", path.display()).into())
    }

    /// The mean picture of this name; empty if nothing was added yet.
    pub fn mean(&self, name: &str) -> Result<RunningMean, Box<dyn Error>> {
        match self.count(name) {
            0 => Ok(RunningMean::default()),
            count => {
                let image = Image::read(self.mean_path(name, count))?;
                Ok(RunningMean::from_image(&image, count))
            }
        }
    }

    /// Number of pictures in the mean of this name.
    pub fn count(&self, name: &str) -> u32 {
        let is_there = |count: &u32| self.mean_path(name, *count).exists();
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

    fn mean_path(&self, name: &str, count: u32) -> PathBuf {
        let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '-' };
        let name: String = name.chars().map(plain).collect();
        self.path.join("means").join(format!("{name}-{count}.exr"))
    }
}

/// Largest number of pictures in a mean.
pub const MOST: u32 = 64;
