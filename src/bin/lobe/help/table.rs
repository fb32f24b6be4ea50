//! The table of one registry, as text.

use lobe::params::{AnyKey, AnySection};

/// Maximum length of a line, in characters.
const WIDTH: usize = 100;

/// Names and descriptions of the kinds of a section, with their keys.
pub fn table(section: &dyn AnySection) -> String {
    let name = if section.is_named() { ".NAME" } else { "" };
    let selector = section.selector();
    let note = if section.default().is_none() {
        format!("    {selector} is required")
    } else {
        String::new()
    };
    let mut text = format!("[{}{name}]{note}\n", section.key());
    for kind in section.kinds() {
        let is_default = section.default() == Some(kind.name);
        let note = if is_default { " (default)" } else { "" };
        text += &format!("\n{selector} = {:?}{note}\n", kind.name);
        text += &wrapped(kind.meaning, 2);
        text += &kind.keys.iter().map(|key| lines(*key)).collect::<String>();
    }
    if !section.common().is_empty() {
        text += &format!("\nwith any {selector}\n");
        text += &section.common().iter().map(|key| lines(*key)).collect::<String>();
    }
    text
}

fn lines(key: &dyn AnyKey) -> String {
    let default = match key.default_text() {
        Some(default) => format!("default {default}"),
        None => "required".into(),
    };
    let text = format!("{}; {default}. {}", key.expected(), sentence(key.meaning()));
    let wrapped = wrapped(&text, 19);
    format!("    {:<15}{}", key.name(), wrapped.trim_start())
}

/// The phrase with a capital first letter.
pub fn sentence(phrase: &str) -> String {
    let mut letters = phrase.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

/// Wraps a text to lines indented by `indent` spaces.
fn wrapped(text: &str, indent: usize) -> String {
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        let line = lines.last_mut().expect("it starts with one line");
        if !line.is_empty() && indent + line.chars().count() + 1 + word.chars().count() > WIDTH {
            lines.push(word.into());
        } else {
            let space = if line.is_empty() { "" } else { " " };
            *line += &format!("{space}{word}");
        }
    }
    lines.iter().map(|line| format!("{:indent$}{line}\n", "")).collect()
}
