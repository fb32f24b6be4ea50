//! [`Summary`]: the output of a command, one key and value per line.

use std::fmt::Display;
use std::io::{self, Write};

use lobe::image::{Picture, Window};
use lobe::scene::{FilmSettings, Scene};

/// Lines for people and programs alike: a key without blanks, then the value, then its unit if any. Keys may repeat.
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
                self.add("error", format!("{error:.2e} standard error of a pixel, in radiance"));
            }
            // Each layer costs time, so there is no error without an EXR.
            None if picture.layers.is_some() => {
                self.add("error", "unknown: the samples are a single set; see sampler.replicates");
            }
            None => {}
        }
    }

    /// Prints all lines, with the values aligned. A closed pipe is no error: the reader has seen enough.
    pub fn print(&self) -> io::Result<()> {
        let width = self.0.iter().map(|(key, _)| key.len()).max().unwrap_or(0);
        let lines = self.0.iter().map(|(key, value)| format!("{key:width$}  {value}\n"));
        let mut stdout = io::stdout().lock();
        let printed =
            stdout.write_all(lines.collect::<String>().as_bytes()).and_then(|()| stdout.flush());
        printed.or_else(|error| match error.kind() {
            io::ErrorKind::BrokenPipe => Ok(()),
            _ => Err(io::Error::new(error.kind(), format!("cannot print the summary: {error}"))),
        })
    }
}
