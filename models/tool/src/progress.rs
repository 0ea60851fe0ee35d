//! Progress on standard error, of what takes longer than a second, and only where somebody watches.

use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// What is over sooner needs no bar.
const PATIENCE: Duration = Duration::from_secs(1);
/// Redraws a second; more only flickers.
const REDRAWS: u8 = 10;
/// Positions of a bar: the width of a terminal is resolved.
const RESOLUTION: f64 = 1000.0;

/// A progress bar that appears after a second; clones share it. Nothing is drawn where standard error is no terminal.
#[derive(Debug, Clone)]
pub struct Progress {
    bar: ProgressBar,
    started: Instant,
}

impl Progress {
    /// A bar with `what` before it, which is not shown yet.
    pub fn new(what: &str) -> Self {
        let bar =
            ProgressBar::with_draw_target(Some(RESOLUTION as u64), ProgressDrawTarget::hidden());
        bar.set_style(
            ProgressStyle::with_template("{prefix} [{bar:32}] {percent:>3} %  {msg}  {elapsed}")
                .unwrap_or_else(|_| ProgressStyle::default_bar())
                .progress_chars("=> "),
        );
        bar.set_prefix(what.to_owned());
        Progress {
            bar,
            started: Instant::now(),
        }
    }

    /// Moves the bar to the part done, from 0 to 1, and writes behind it what is being done.
    pub fn set(&self, fraction: f64, message: impl FnOnce() -> String) {
        if self.started.elapsed() < PATIENCE {
            return;
        }
        self.bar
            .set_position((fraction.clamp(0.0, 1.0) * RESOLUTION) as u64);
        self.bar.set_message(message());
        if self.bar.is_hidden() {
            self.bar
                .set_draw_target(ProgressDrawTarget::stderr_with_hz(REDRAWS));
        }
    }

    /// Removes the bar from the screen.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}
