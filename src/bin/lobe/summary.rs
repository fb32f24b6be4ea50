//! [`Summary`]: the output of a command, one key and value per line.

use std::fmt::Display;
use std::io::{self, Write};

use lobe::Spectrum;
use lobe::film::Fireflies;
use lobe::image::{Picture, Window};
use lobe::light::BoundingSphere;
use lobe::params::Shown;
use lobe::scene::{FilmSettings, Scene};
use lobe::scene_file::LoadReport;
use lobe::shape::SkippedLines;

/// Lines for people and programs alike: a key without blanks, then the value, then its unit if any. Keys may repeat. Values
/// are printed as [`Shown::whole`], so each stays in its line.
#[derive(Default)]
pub struct Summary(Vec<(&'static str, String)>);

impl Summary {
    /// Adds a line.
    pub fn add(&mut self, key: &'static str, value: impl Display) {
        self.0.push((key, value.to_string()));
    }

    /// Adds the size of the image, and its crop.
    pub fn add_film(&mut self, film: &FilmSettings) {
        self.add("image", format!("{}x{} pixels", film.resolution.x, film.resolution.y));
        if let Some(Window { min, max }) = film.crop {
            self.add("crop", format!("[{}, {}, {}, {}]", min.x, min.y, max.x, max.y));
        }
    }

    /// Adds the number of triangles, and of those without area.
    pub fn add_meshes(&mut self, scene: &Scene) {
        let triangles = scene.shapes().map(|(_, mesh)| mesh.indices.len()).sum::<usize>();
        self.add("triangles", triangles);
        let degenerate = triangles - scene.accel().triangle_count();
        if degenerate > 0 {
            self.add("degenerate", format!("{degenerate} triangles without area, left out"));
        }
    }

    /// Adds the standard error of a picture.
    pub fn add_error(&mut self, picture: &Picture) {
        match picture.standard_error() {
            Some(error) => {
                let error = format!("{error:.2e} standard error of a pixel, in radiance");
                let degrees = picture.degrees_of_freedom.unwrap_or(0);
                self.add("error", format!("{error}, with {degrees} degrees of freedom"));
            }
            // Each layer costs time, so there is no error without an EXR.
            None if picture.layers.is_some() => {
                self.add("error", "unknown: the samples are a single set; see sampler.replicates");
            }
            None => {}
        }
    }

    /// Adds how much of the noise is that of single samples, if it is.
    pub fn add_fireflies(&mut self, fireflies: Option<Fireflies>) {
        let Some(Fireflies { pixels, share, .. }) = fireflies.filter(|found| found.pixels > 0)
        else {
            return;
        };
        let noise = format!("together {:.1} % of the picture's", 100.0 * share);
        self.add(
            "fireflies",
            format!("{pixels} pixels: one sample holds most of their variance, {noise}"),
        );
    }

    /// Adds a line `warning` for each thing about a scene that is allowed, but usually a mistake.
    pub fn add_warnings(&mut self, scene: &Scene, report: &LoadReport) {
        for ((name, _), odd) in scene.shapes().zip(&report.meshes) {
            let mut warn = |SkippedLines { count, first, .. }, what: &str| {
                if count > 0 {
                    self.add(
                        "warning",
                        format!("{name}: {count} {what}, the first in line {first}, left out"),
                    );
                }
            };
            warn(odd.short_faces, "faces with fewer than 3 corners");
            warn(odd.unknown_lines, "lines with an unknown keyword");
        }
        if scene.shapes().next().is_none() {
            self.add("warning", "the scene has no shapes");
        }
        // Some size, since the power of a sky grows with the scene.
        let bounds = BoundingSphere { radius: 1.0, ..scene.bounding_sphere() };
        let is_dark = scene.lights().iter().all(|l| l.power(&bounds) == Some(Spectrum::BLACK));
        if is_dark {
            self.add("warning", "the scene has no light: the picture will be black");
        }
    }

    /// Adds a line `warning` for each thing that was left out of MTL files; of many, the first `most`.
    pub fn add_notes(&mut self, report: &LoadReport, most: usize) {
        report.notes.iter().take(most).for_each(|note| self.add("warning", note));
        let left = report.notes.len().saturating_sub(most);
        if left > 0 {
            self.add("warning", format!("and {left} more, which lobe info shows"));
        }
    }

    /// Prints all lines, with the values aligned, as [`print`] does.
    pub fn print(&self) -> io::Result<()> {
        let width = self.0.iter().map(|(key, _)| key.len()).max().unwrap_or(0);
        let lines =
            self.0.iter().map(|(key, value)| format!("{key:width$}  {}\n", Shown::whole(value)));
        print(&lines.collect::<String>())
    }
}

/// Prints a text. A closed pipe is no error: the reader has seen enough.
pub fn print(text: &str) -> io::Result<()> {
    let mut stdout = io::stdout().lock();
    let printed = stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush());
    printed.or_else(|error| match error.kind() {
        io::ErrorKind::BrokenPipe => Ok(()),
        _ => Err(io::Error::new(error.kind(), format!("cannot print the summary: {error}"))),
    })
}
