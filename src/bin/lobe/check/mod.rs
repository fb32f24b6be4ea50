//! `lobe check`: whether the materials of a scene keep the contracts of lobes.

mod arguments;
mod breaks;
mod help;
mod image;
mod materials;
mod page;
mod parallel;
mod plots;
mod polar;
mod table;

use std::error::Error;
use std::process::ExitCode;

use lobe::check::Options;
use lobe::image::{check_writable, write_file};
use lobe::params::Shown;

use crate::output::{Output, check_own};
use crate::summary::print;
pub use arguments::Arguments;
use materials::Checked;

/// What a lobe that promises to return all light may lose.
const WHITE: f64 = 1e-3;

pub fn run(arguments: &Arguments) -> Result<ExitCode, Box<dyn Error>> {
    let Arguments { samples, seed, .. } = *arguments;
    let threads = arguments.threads.count();
    let options = Options { samples, seed, ..Options::default() };
    let Some(scene) = &arguments.scene else {
        return breaks::run(&Options { white: Some(WHITE), ..options }, threads);
    };
    let page = arguments.page.as_deref();
    if let Some(path) = page {
        if path.extension().is_none_or(|extension| !extension.eq_ignore_ascii_case("html")) {
            let shown = Shown::path(path);
            return Err(format!("cannot write `{shown}`: its name has to end in .html").into());
        }
        check_writable(path)?;
    }
    let image = match &arguments.image {
        Some(path) => Output::all(std::slice::from_ref(path), &scene.path, &[])?,
        None => Vec::new(),
    };
    let loaded = scene.load()?;
    let paths: Vec<_> = page.into_iter().chain(image.iter().map(|output| &*output.path)).collect();
    check_own(&paths, &[loaded.files(), vec![scene.path.clone()]].concat())?;
    let materials = materials::select(&loaded, arguments.material.as_deref())?;

    let options = Options { white: arguments.white.then_some(WHITE), ..options };
    let checked = materials::check(materials, &options, threads);
    print(&table::text(&checked))?;
    let picture = image::render(&loaded, &image, arguments)?;
    if let Some(path) = page {
        let html = page::html(&scene.path, &checked, &options, picture.as_ref(), threads)?;
        write_file(path, html.as_bytes())?;
    }
    let wrote = paths.iter().map(|path| format!("wrote  {}\n", Shown::path(path)));
    print(&wrote.collect::<String>())?;
    let is_ok = checked.iter().all(Checked::is_ok);
    Ok(if is_ok { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
