//! The interrupt signal (Ctrl-C): it ends a run in order.

use std::process;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::failure::{Failure, INTERRUPTED};

/// Whether the user has asked for an end.
#[derive(Debug, Clone)]
pub(crate) struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// From here on the first interrupt is noted, and a second one ends the program at once: nobody has to wait for a step that does not end.
    ///
    /// # Errors
    /// [`Failure::Failed`] if the system does not let the signal be caught.
    pub(crate) fn catch() -> Result<Self, Failure> {
        let asked = Arc::new(AtomicBool::new(false));
        let flag = Arc::clone(&asked);
        ctrlc::set_handler(move || {
            if flag.swap(true, Ordering::Relaxed) {
                process::exit(i32::from(INTERRUPTED));
            }
        })
        .map_err(|e| Failure::Failed(format!("cannot catch the interrupt signal: {e}")))?;
        Ok(Interrupt(asked))
    }

    /// Whether it has come.
    pub(crate) fn is_set(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}
