//! The command `lobe`: renders scene files, shows what they contain, compares images, and checks materials.

mod arguments;
mod chart;
mod check;
mod compare;
mod help;
mod identity;
mod images;
mod info;
mod interrupt;
mod merge;
mod output;
mod page;
mod progress;
mod render;
mod scene;
mod stability;
mod state;
mod steps;
mod summary;

use std::error::Error;
use std::io::Write;
use std::process::ExitCode;

use clap::{CommandFactory, Parser, Subcommand};
use lobe::params::Shown;

const EXAMPLES: &str = "\
Examples:
  lobe render assets/chapter8.toml                      writes chapter8.png and chapter8.exr
  lobe render scene.toml -o a.png --spp 256 --set camera.fov=40
  lobe render model.obj                                 a model alone: its MTL file, light, a camera that sees all
  lobe info scene.toml                                  triangles, bounds, tree, memory
  lobe merge scene-*-of-8.exr -o scene.exr               the parts of lobe render --shard, added up
  lobe compare a.exr reference.exr                      errors, FLIP, and whether noise explains them
  lobe chart scene.toml                                 error against time, for each method
  lobe chart --stability                                where methods fail numerically
  lobe check scene.toml                                 whether materials keep their contracts
  lobe help materials                                   kinds of materials, their keys and ranges

`lobe help render` and so on show more examples.";

/// Renders scenes of triangle meshes with PBRT's materials and reflection.
#[derive(Parser)]
#[command(version, disable_help_subcommand = true)]
#[command(after_help = format!("{EXAMPLES}\n\n{}", help::topics()))]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Render(render::Arguments),
    Info(info::Arguments),
    Merge(merge::Arguments),
    Compare(compare::Arguments),
    Chart(chart::Arguments),
    Check(check::Arguments),
    Help(help::Arguments),
}

fn main() -> ExitCode {
    let success = |()| ExitCode::SUCCESS;
    let result: Result<ExitCode, Box<dyn Error>> = match parse().command {
        Command::Render(arguments) => render::run(&arguments),
        Command::Info(arguments) => info::run(&arguments).map(success),
        Command::Merge(arguments) => merge::run(&arguments).map(success),
        Command::Compare(arguments) => compare::run(&arguments).map(success),
        Command::Chart(arguments) => chart::run(&arguments).map(success),
        Command::Check(arguments) => check::run(&arguments),
        Command::Help(arguments) => help::run(&arguments, Arguments::command()).map(success),
    };
    match result {
        Ok(code) => code,
        Err(error) => {
            // If stderr is closed, the exit code still reports the failure.
            let _ = writeln!(std::io::stderr(), "error: {}", lines(&error.to_string()));
            ExitCode::FAILURE
        }
    }
}

/// The arguments of the command line. Exits with code 2 where they are wrong, or after printing help.
fn parse() -> Arguments {
    Arguments::try_parse().unwrap_or_else(|error| {
        // clap's message repeats arguments as they are: that about their shown forms is safe to print.
        let shown =
            std::env::args_os().map(|text| Shown::line(&text.to_string_lossy()).to_string());
        Arguments::try_parse_from(shown).err().unwrap_or(error).exit()
    })
}

/// A message of several lines: what errors of other packages quote is escaped here, except for line ends.
fn lines(message: &str) -> String {
    let lines: Vec<_> = message.lines().map(|line| Shown::whole(line).to_string()).collect();
    lines.join("\n")
}
