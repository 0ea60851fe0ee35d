//! The signals that ask a program to end (Ctrl-C, and what `kill` sends): they end a run in order.

use std::ops::ControlFlow;
use std::process;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::failure::{Failure, INTERRUPTED};
use crate::output::discard_unfinished;

/// Knows whether the user has asked the program to end, by Ctrl-C or SIGTERM.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Interrupt(());

static ASKED: AtomicBool = AtomicBool::new(false);
static CAUGHT: OnceLock<Result<(), String>> = OnceLock::new();

impl Interrupt {
    /// Notes the first signal from here on, and lets a second one end the program at once: nobody has to wait for a step that does not end.
    ///
    /// # Errors
    /// [`Failure::Failed`] if the system does not let the signal be caught.
    pub(crate) fn catch() -> Result<Self, Failure> {
        let handle = || {
            if ASKED.swap(true, Ordering::Relaxed) {
                discard_unfinished();
                process::exit(i32::from(INTERRUPTED));
            }
        };
        let caught = CAUGHT.get_or_init(|| ctrlc::set_handler(handle).map_err(|e| e.to_string()));
        match caught {
            Ok(()) => Ok(Interrupt(())),
            Err(e) => Err(Failure::Failed(format!(
                "cannot catch the interrupt signal: {e}"
            ))),
        }
    }

    /// Whether a computation goes on: not once the user has asked.
    pub(crate) fn flow(self) -> ControlFlow<()> {
        match self.is_set() {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    }

    /// Whether the user has asked the program to end.
    pub(crate) fn is_set(self) -> bool {
        ASKED.load(Ordering::Relaxed)
    }
}
