//! [`Steps`]: how far a chart is, on a terminal.

use indicatif::{ProgressBar, ProgressStyle};

const TEMPLATE: &str = "{bar:24} {percent:>3} %  {eta} left  {msg}";

/// A bar on stderr over the seconds that the plan expects; nothing at all where that is no terminal.
pub struct Steps(Option<ProgressBar>);

impl Steps {
    /// A bar of which so much is done already.
    pub fn new(seconds: f64, done: f64, is_quiet: bool) -> Self {
        let style =
            ProgressStyle::with_template(TEMPLATE).unwrap_or_else(|_| ProgressStyle::default_bar());
        let bar = || {
            let bar = ProgressBar::new(thousandths(seconds)).with_style(style);
            bar.set_position(thousandths(done));
            bar.reset_eta();
            bar
        };
        Self((!is_quiet).then(bar))
    }

    /// A line above the bar.
    pub fn say(&self, line: String) {
        self.0.iter().for_each(|bar| bar.println(&line));
    }

    /// What comes next.
    pub fn begin(&self, what: String) {
        self.0.iter().for_each(|bar| bar.set_message(what.clone()));
    }

    /// That it is done, and how long it should have taken.
    pub fn done(&self, seconds: f64) {
        self.0.iter().for_each(|bar| bar.inc(thousandths(seconds)));
    }

    /// Leaves the terminal as it was.
    pub fn clear(&self) {
        self.0.iter().for_each(ProgressBar::finish_and_clear);
    }
}

impl Drop for Steps {
    fn drop(&mut self) {
        self.clear();
    }
}

fn thousandths(seconds: f64) -> u64 {
    (1000.0 * seconds).round() as u64
}
