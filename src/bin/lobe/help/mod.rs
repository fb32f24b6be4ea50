//! `lobe help`: of a command, or what scene files can hold.

mod page;
mod table;

use std::error::Error;
use std::io::{self, Write};

use clap::Args;
use lobe::params::hint;
use lobe::scene_file::SECTIONS;

/// The topic that is the page of the scene format.
const PAGE: &str = "scene-format";

/// Explains a command, or lists what scene files can hold
#[derive(Args)]
#[command(after_help = topics())]
pub struct Arguments {
    /// A command, or a topic from the list below
    topic: Option<String>,
}

/// What there is to ask for, beside commands.
pub fn topics() -> String {
    let topic = |name: &str, meaning: String| format!("  {name:<13} {meaning}\n");
    let kinds = |section: &&dyn lobe::params::AnySection| {
        let names: Vec<_> = section.kinds().iter().map(|kind| kind.name).collect();
        topic(section.plural(), names.join(", "))
    };
    let page = topic(PAGE, "all of them and how files are read, as Markdown".into());
    let list: String = SECTIONS.iter().map(kinds).chain([page]).collect();
    format!("Topics of `lobe help`, from the registries of what scene files can hold:\n{list}")
}

/// `program` is the whole command line.
pub fn run(arguments: &Arguments, program: clap::Command) -> Result<(), Box<dyn Error>> {
    let topic = match arguments.topic.as_deref() {
        None => return command_help(program, &[]),
        Some(command) if program.find_subcommand(command).is_some() => {
            return command_help(program, &[command]);
        }
        Some(topic) => topic,
    };
    let text = match SECTIONS.iter().find(|section| section.plural() == topic) {
        Some(section) => table::table(*section),
        None if topic == PAGE => page::page(),
        None => {
            let commands = program.get_subcommands().map(clap::Command::get_name);
            let known = commands.chain(SECTIONS.map(|section| section.plural())).chain([PAGE]);
            return Err(format!("there is no help on `{topic}`{}", hint(topic, known)).into());
        }
    };
    unless_closed(std::io::stdout().write_all(text.as_bytes()))
}

/// What `--help` prints.
fn command_help(program: clap::Command, command: &[&str]) -> Result<(), Box<dyn Error>> {
    let arguments = ["lobe"].into_iter().chain(command.iter().copied()).chain(["--help"]);
    match program.try_get_matches_from(arguments) {
        Err(help) => unless_closed(help.print()),
        Ok(_) => Ok(()),
    }
}

/// Whoever closes a pipe has read enough.
fn unless_closed(result: io::Result<()>) -> Result<(), Box<dyn Error>> {
    match result {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        result => Ok(result?),
    }
}
