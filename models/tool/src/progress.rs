//! Progress on standard error, of what takes longer than a second, and only where somebody watches.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// What is over sooner needs no bar.
const PATIENCE: Duration = Duration::from_secs(1);
/// Redraws a second; more only flickers.
const REDRAWS: u8 = 10;
/// Positions of a bar: the width of a terminal is resolved.
const RESOLUTION: f64 = 1000.0;

/// A progress bar that appears after a second; clones share it. Nothing is drawn where standard error is no terminal.
#[derive(Debug, Clone)]
pub struct Progress(ProgressBar);

impl Progress {
    /// A bar with `what` before it, which is not shown yet.
    pub fn new(what: &str) -> Self {
        let style =
            ProgressStyle::with_template("{prefix} [{bar:32}] {percent:>3} %  {msg}  {elapsed}")
                .unwrap_or_else(|_| ProgressStyle::default_bar());
        let hidden = ProgressDrawTarget::hidden();
        let bar = ProgressBar::with_draw_target(Some(RESOLUTION as u64), hidden)
            .with_style(style.progress_chars("=> "))
            .with_prefix(what.to_owned());
        Progress(bar)
    }

    /// Moves the bar to the part done, from 0 to 1, and writes behind it what is being done.
    pub fn set(&self, fraction: f64, message: impl FnOnce() -> String) {
        let bar = &self.0;
        if bar.elapsed() < PATIENCE {
            return;
        }
        bar.set_position((fraction.clamp(0.0, 1.0) * RESOLUTION) as u64);
        bar.set_message(message());
        if bar.is_hidden() {
            bar.set_draw_target(ProgressDrawTarget::stderr_with_hz(REDRAWS));
        }
    }

    /// Removes the bar from the screen.
    pub fn finish(&self) {
        self.0.finish_and_clear();
    }
}
