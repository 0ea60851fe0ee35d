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

/// A chain of `n` links with its members declared by loops.
pub(super) fn chain(n: usize) -> String {
    format!(
        "pub Chain {{ const N: usize = {n}; params {{ l = 0.1, g = 9.81, m = 1.0 }} coords {{ x[N], y[N] }} \
         mass {{ for i in 0..N {{ x[i]: m, y[i]: m }} }} potential {{ sum(0..N, |i| m * g * y[i]) }} \
         holonomic {{ top: sq(x[0]) + sq(y[0]) = sq(l) \
         for i in 1..N {{ link[i]: sq(x[i] - x[i - 1]) + sq(y[i] - y[i - 1]) = sq(l) }} }} }}"
    )
}

#[test]
#[ignore = "a measurement: cargo test -p ukmacros -- --ignored growth --nocapture"]
fn growth() {
    let sizes = std::env::var("SIZES").unwrap_or("100 200 400 800".to_owned());
    println!("{:>8} {:>10} {:>14}", "members", "s", "ms per member");
    for n in sizes.split_whitespace() {
        let n: usize = n.parse().expect("a size");
        let start = Instant::now();
        let (code, errors) = crate::expand(chain(n).parse().expect("tokens"));
        assert!(errors.is_empty() && !code.is_empty());
        let time = start.elapsed().as_secs_f64();
        println!("{n:>8} {time:>10.2} {:>14.3}", 1e3 * time / n as f64);
    }
}

/// Operations of declarations in files, and how long their analysis takes.
#[test]
#[ignore = "a measurement: FILES='a.txt b.txt' cargo test -p ukmacros -- --ignored work --nocapture"]
fn work() {
    let files = std::env::var("FILES").unwrap_or_default();
    for path in files.split_whitespace() {
        let source = std::fs::read_to_string(path).expect("a declaration");
        let start = Instant::now();
        let analysis = super::analysis(source.parse().expect("tokens"));
        let time = start.elapsed().as_secs_f64();
        let costs = analysis.costs;
        for (what, of) in [
            ("dynamics", costs.dynamics),
            ("acceleration", costs.acceleration),
            ("correction", costs.correction),
        ] {
            println!("{path}: {what} {:?}", of.counts());
        }
        println!("{path}: {time:.2} s, {:?}", analysis.solve.err());
    }
}
