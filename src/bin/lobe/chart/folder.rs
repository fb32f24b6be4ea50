//! [`Folder`]: where a chart stands, so that one that was interrupted goes on.

use std::error::Error;
use std::fs::{self, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use lobe::image::{Image, Metadata, Picture, Window, write_exr, write_file};
use lobe::metrics::convergence::{Run, RunningMean};

use super::plan::Plan;

/// A folder with the plan, the runs so far, and means of pictures by name and count.
pub struct Folder {
    path: PathBuf,
}

impl Folder {
    /// Takes the folder, and makes it if it is not there.
    pub fn open(path: &Path) -> Result<Self, Box<dyn Error>> {
        fs::create_dir_all(path)
            .map_err(|error| format!("cannot make the folder `{}`: {error}", path.display()))?;
        Ok(Self { path: path.to_owned() })
    }

    pub fn join(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// Writes a file, all or nothing.
    pub fn write(&self, name: &str, contents: &[u8]) -> Result<(), Box<dyn Error>> {
        Ok(write_file(self.join(name), contents)?)
    }

    /// The plan of the chart that was begun here; `None` if there is none.
    pub fn plan(&self) -> Result<Option<Plan>, Box<dyn Error>> {
        let path = self.join("plan.toml");
        match fs::read_to_string(&path) {
            Ok(text) => Plan::from_toml(&text).map(Some).ok_or_else(|| {
                format!("`{}` is no plan of a chart: choose another folder by -o", path.display())
                    .into()
            }),
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(format!("cannot read `{}`: {error}", path.display()).into()),
        }
    }

    /// Begins anew: forgets what was measured here.
    pub fn begin(&self, plan: &Plan) -> Result<(), Box<dyn Error>> {
        // The plan goes first and comes last: without it there is nothing to go on with.
        let means = self.join("means");
        let removed = [(fs::remove_file(self.join("plan.toml"))), fs::remove_dir_all(&means)];
        let is_missing = |error: &std::io::Error| error.kind() == std::io::ErrorKind::NotFound;
        if let Some(error) = removed.into_iter().filter_map(Result::err).find(|e| !is_missing(e)) {
            return Err(format!("cannot empty `{}`: {error}", self.path.display()).into());
        }
        fs::create_dir_all(&means)
            .map_err(|error| format!("cannot make the folder `{}`: {error}", means.display()))?;
        self.write("runs.csv", format!("{}\n", Run::HEADER).as_bytes())?;
        self.write("plan.toml", plan.to_toml().as_bytes())
    }

    /// The runs so far. A last line that is not whole is left out, and written again later.
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

    /// The mean of that name; empty if nothing was added to it yet.
    pub fn pool(&self, name: &str) -> Result<RunningMean, Box<dyn Error>> {
        match self.count(name) {
            0 => Ok(RunningMean::default()),
            count => {
                let image = Image::read(self.mean(name, count))?;
                Ok(RunningMean::from_image(&image, count))
            }
        }
    }

    /// How many pictures the mean of that name has.
    pub fn count(&self, name: &str) -> u32 {
        let is_there = |count: &u32| self.mean(name, *count).exists();
        (1..=MOST).rev().find(is_there).unwrap_or(0)
    }

    /// Adds a picture to the mean of that name, and gives it back as it will be read again: what follows from it
    /// does not depend on interruptions.
    pub fn add(
        &self,
        name: &str,
        pool: &mut RunningMean,
        image: &Image,
    ) -> Result<(), Box<dyn Error>> {
        pool.add(&image.pixels);
        let (color, variance) = pool.pixels();
        let mean = Image { pixels: color.clone(), variance: variance.clone(), ..image.clone() };
        *pool = RunningMean::from_image(&mean, pool.count());
        let (resolution, window) = (image.size, Window::full(image.size));
        let picture = Picture { resolution, window, color, variance, layers: None };
        write_exr(self.mean(name, pool.count()), &picture, &Metadata::default())?;
        let _ = fs::remove_file(self.mean(name, pool.count() - 1));
        Ok(())
    }

    fn mean(&self, name: &str, count: u32) -> PathBuf {
        let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '-' };
        let name: String = name.chars().map(plain).collect();
        self.path.join("means").join(format!("{name}-{count}.exr"))
    }
}

/// The most pictures that a mean is made of.
pub const MOST: u32 = 64;
