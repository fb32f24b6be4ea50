//! `lobe help`: help on a command, or a table of what scene files can contain.

mod page;
mod table;

use std::error::Error;
use std::io::{self, Write};

use clap::Args;
use lobe::params::{AnySection, Shown, hint};
use lobe::scene_file::SECTIONS;

/// The topic for the page of the scene format.
const PAGE: &str = "scene-format";

/// Explains a command, or lists what scene files can contain
#[derive(Args)]
#[command(after_help = topics())]
pub struct Arguments {
    /// A command, or a topic from the list below
    topic: Option<String>,
}

/// All topics, other than commands.
pub fn topics() -> String {
    let topic = |name: &str, meaning: String| format!("  {name:<13} {meaning}\n");
    let kinds = |section: &&dyn AnySection| {
        let names: Vec<_> = section.kinds().iter().map(|kind| kind.name).collect();
        topic(section.plural(), names.join(", "))
    };
    let page = topic(PAGE, "all of these, and how scene files are read, as Markdown".into());
    let list: String = SECTIONS.iter().map(kinds).chain([page]).collect();
    format!("Topics of `lobe help`, on what scene files can contain:\n{list}")
}

/// Prints the topic. `program` is the whole command line.
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
            let hint = kind(topic).unwrap_or_else(|| hint(topic, known));
            return Err(format!("there is no help on `{}`{hint}", Shown::name(topic)).into());
        }
    };
    unless_closed(std::io::stdout().write_all(text.as_bytes()))
}

/// Where a word is explained that is a kind, or what topics are about.
fn kind(word: &str) -> Option<String> {
    if ["scene", "scenes"].contains(&word) {
        return Some(format!("; did you mean `{PAGE}`?"));
    }
    let has_kind =
        |section: &&&dyn AnySection| section.kinds().iter().any(|kind| kind.name == word);
    let topics: Vec<_> =
        SECTIONS.iter().filter(has_kind).map(|s| format!("`{}`", s.plural())).collect();
    let section = SECTIONS.iter().find(|section| section.key() == word);
    match section {
        Some(section) => Some(format!("; did you mean `{}`?", section.plural())),
        None if topics.is_empty() => None,
        None => Some(format!("; it is among {}", topics.join(" and "))),
    }
}

/// Prints the same as `--help`.
fn command_help(program: clap::Command, command: &[&str]) -> Result<(), Box<dyn Error>> {
    let arguments = ["lobe"].into_iter().chain(command.iter().copied()).chain(["--help"]);
    match program.try_get_matches_from(arguments) {
        Err(help) => unless_closed(help.print()),
        Ok(_) => Ok(()),
    }
}

/// A closed pipe is no error: the reader has seen enough.
fn unless_closed(result: io::Result<()>) -> Result<(), Box<dyn Error>> {
    match result {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        result => Ok(result?),
    }
}
