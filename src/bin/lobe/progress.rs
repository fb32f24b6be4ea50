//! [`Bar`]: progress of a render on the terminal.

use std::fmt::Write;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use indicatif::{ProgressBar, ProgressState, ProgressStyle};
use lobe::render::Progress;

const TEMPLATE: &str = "{bar:32} {percent:>3} %  {rate}  {eta} left{msg}";

/// A progress bar on stderr. Hidden if stderr is not a terminal.
pub struct Bar {
    bar: ProgressBar,
    rays: Arc<AtomicU64>,
}

impl Bar {
    /// A bar over this number of pixels.
    pub fn new(pixels: u64) -> Self {
        let rays = Arc::new(AtomicU64::new(0));
        let counted = Arc::clone(&rays);
        let rate = move |state: &ProgressState, to: &mut dyn Write| {
            let rays = counted.load(Ordering::Relaxed) as f64;
            let _ = write!(to, "{:.2} Mrays/s", rays / state.elapsed().as_secs_f64() / 1e6);
        };
        let style = ProgressStyle::with_template(TEMPLATE)
            .unwrap_or_else(|_| ProgressStyle::default_bar())
            .with_key("rate", rate);
        Self { bar: ProgressBar::new(pixels).with_style(style), rays }
    }

    /// Shows this progress. The bar limits how often it is drawn.
    pub fn update(&self, progress: Progress) {
        self.rays.store(progress.rays, Ordering::Relaxed);
        // The number of pixels falls when a new pass begins.
        if progress.pixels < self.bar.position() {
            self.bar.reset_eta();
            self.bar
                .set_message(format!(" in this pass; {} samples per pixel done", progress.samples));
        }
        self.bar.set_position(progress.pixels);
    }

    /// Removes the bar.
    pub fn clear(&self) {
        self.bar.finish_and_clear();
    }
}
