//! Independent computations on all cores, results in input order.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// `f` of every item. `done` hears, on whichever thread finishes an item, how many are finished.
pub(crate) fn map<I: Sync, O: Send>(
    items: &[I],
    f: impl Fn(&I) -> O + Sync,
    done: impl Fn(usize) + Sync,
) -> Vec<O> {
    let next = AtomicUsize::new(0);
    let results: Mutex<Vec<(usize, O)>> = Mutex::new(Vec::with_capacity(items.len()));
    let work = || {
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            let Some(item) = items.get(index) else { return };
            let result = f(item);
            // A poisoned lock still holds whole results: another thread's panic is propagated by the scope.
            let mut results = results
                .lock()
                .unwrap_or_else(std::sync::PoisonError::into_inner);
            results.push((index, result));
            done(results.len());
        }
    };
    let threads = thread::available_parallelism().map_or(1, |n| n.get().min(items.len()));
    thread::scope(|scope| {
        for _ in 1..threads {
            scope.spawn(work);
        }
        work();
    });
    let mut results = results
        .into_inner()
        .unwrap_or_else(std::sync::PoisonError::into_inner);
    results.sort_by_key(|(index, _)| *index);
    results.into_iter().map(|(_, result)| result).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_come_in_input_order() {
        let items: Vec<usize> = (0..100).collect();
        let count = AtomicUsize::new(0);
        let squares = map(
            &items,
            |i| i * i,
            |_| {
                count.fetch_add(1, Ordering::Relaxed);
            },
        );
        assert_eq!(squares, items.iter().map(|i| i * i).collect::<Vec<_>>());
        assert_eq!(count.into_inner(), 100);
        assert!(map(&[] as &[u8], |i| *i, |_| ()).is_empty());
    }
}
