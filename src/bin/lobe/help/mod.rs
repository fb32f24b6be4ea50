//! `lobe help`: of a command, or what scene files can hold.

mod page;
mod table;

use std::error::Error;
use std::io::Write;

use clap::{Args, CommandFactory};
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

pub fn run(arguments: &Arguments) -> Result<(), Box<dyn Error>> {
    let mut program = crate::Arguments::command();
    let Some(topic) = &arguments.topic else { return Ok(program.print_long_help()?) };
    // Names in usage lines are complete only then.
    program.build();
    if let Some(command) = program.find_subcommand_mut(topic) {
        return Ok(command.print_long_help()?);
    }
    let text = match SECTIONS.iter().find(|section| section.plural() == topic) {
        Some(section) => table::table(*section),
        None if topic == PAGE => page::page(),
        None => {
            let commands = program.get_subcommands().map(clap::Command::get_name);
            let known = commands.chain(SECTIONS.map(|section| section.plural())).chain([PAGE]);
            return Err(format!("there is no help on `{topic}`{}", hint(topic, known)).into());
        }
    };
    match std::io::stdout().write_all(text.as_bytes()) {
        // Whoever listened has read enough.
        Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
        result => Ok(result?),
    }
}
