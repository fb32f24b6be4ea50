//! [`Steps`]: progress of a command of many steps on the terminal.

use indicatif::{ProgressBar, ProgressStyle};
use lobe::params::Shown;

const TEMPLATE: &str = "{bar:24} {percent:>3} %  {eta} left  {msg}";

/// A progress bar on stderr, in expected seconds. Hidden if stderr is not a terminal.
pub struct Steps(Option<ProgressBar>);

impl Steps {
    /// A bar over `seconds`, of which `done` have passed.
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

    /// Prints a line above the bar.
    pub fn say(&self, line: String) {
        self.0.iter().for_each(|bar| bar.println(Shown::whole(&line).to_string()));
    }

    /// Shows the name of the next step.
    pub fn begin(&self, what: String) {
        self.0.iter().for_each(|bar| bar.set_message(Shown::whole(&what).to_string()));
    }

    /// Advances the bar by the expected seconds of a step.
    pub fn done(&self, seconds: f64) {
        self.0.iter().for_each(|bar| bar.inc(thousandths(seconds)));
    }

    /// Removes the bar.
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
