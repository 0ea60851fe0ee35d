//! What the macro itself costs when a crate is compiled. A measurement, not a test: nothing is asserted of it.

use std::time::Instant;

/// Expansions of each model; the fastest counts.
const TIMES: usize = 5;

#[test]
#[ignore = "a measurement: cargo test -p ukmacros --release -- --ignored macro_cost --nocapture"]
fn macro_cost() {
    println!("{:<28} {:>10} {:>12}", "model", "ms", "characters");
    for (name, tokens) in super::golden::declarations() {
        let mut least = f64::INFINITY;
        let mut size = 0;
        for _ in 0..TIMES {
            let start = Instant::now();
            let (code, _) = crate::expand(tokens.clone());
            least = least.min(start.elapsed().as_secs_f64());
            size = code.to_string().len();
        }
        println!("{name:<28} {:>10.2} {size:>12}", 1e3 * least);
    }
}
