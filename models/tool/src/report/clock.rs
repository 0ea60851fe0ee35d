//! Time that a computation takes.

use std::time::Duration;

/// What [`now`] measures.
#[cfg(unix)]
pub(super) const KIND: &str = "CPU time of the thread";
/// What [`now`] measures.
#[cfg(not(unix))]
pub(super) const KIND: &str = "wall time";

/// CPU time that this thread has used so far: what other programs take does not count.
#[cfg(unix)]
pub(super) fn now() -> Duration {
    use rustix::time::{ClockId, clock_gettime};
    let time = clock_gettime(ClockId::ThreadCPUTime);
    Duration::try_from(time).unwrap_or_default()
}

/// Wall time since the first call.
#[cfg(not(unix))]
pub(super) fn now() -> Duration {
    use std::sync::OnceLock;
    use std::time::Instant;
    static START: OnceLock<Instant> = OnceLock::new();
    START.get_or_init(Instant::now).elapsed()
}

/// `work` and the time that it takes, s.
pub(super) fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = now();
    let result = work();
    (result, now().saturating_sub(start).as_secs_f64())
}
