//! The generated code side by side with code written by hand, in one run.
//!
//! `cargo bench -p tests` measures everything in two minutes, `cargo bench -p tests -- uchain` the groups whose name contains
//! `uchain`. Each group has as its reference the fastest of those written by hand. Figures also go to `speed.json` in cargo's directory
//! for temporary files (`target/tmp`).

#![forbid(unsafe_code)]

mod accelerations;
mod bricard;
mod chain;
mod dense;
mod fish;
mod four_bars;
mod harness;
#[cfg(feature = "large")]
mod legs;
mod many;
mod mechanisms;
mod recursive;
mod runs;

use std::path::Path;

use serde_json::Value;

type Measure = fn() -> Vec<Value>;

/// Groups by the beginning of their names.
const GROUPS: [(&str, Measure); 14] = [
    ("acceleration/uchain17", || vec![accelerations::uchain17()]),
    ("acceleration/uchain65", || vec![accelerations::uchain65()]),
    ("acceleration/fish", || vec![accelerations::fish()]),
    ("acceleration/fourbars40", || {
        vec![accelerations::fourbars40()]
    }),
    ("acceleration/arm", accelerations::arms),
    ("acceleration/hinges", accelerations::hinges),
    ("acceleration/legs", accelerations::legs),
    ("acceleration/bricard", || vec![accelerations::bricard()]),
    ("acceleration/bodies12", || vec![accelerations::bodies12()]),
    ("acceleration/slider_crank", || {
        vec![accelerations::slider_crank()]
    }),
    ("acceleration/rigid_body", || {
        vec![accelerations::rigid_body()]
    }),
    ("lanes/uchain17", || vec![runs::lanes()]),
    ("run/uchain17", runs::uchain17),
    ("ensemble/uchain17", || vec![runs::ensemble()]),
];

fn main() -> std::io::Result<()> {
    // Cargo itself adds `--bench`.
    let wanted: Vec<String> = std::env::args()
        .skip(1)
        .filter(|a| !a.starts_with("--"))
        .collect();
    let mut all = Vec::new();
    for (name, measure) in GROUPS {
        if wanted.is_empty() || wanted.iter().any(|w| name.contains(w.as_str())) {
            all.extend(measure());
        }
    }
    if all.is_empty() {
        let names: Vec<&str> = GROUPS.iter().map(|(name, _)| *name).collect();
        println!("no group contains that; there are {}", names.join(", "));
        return Ok(());
    }
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join("speed.json");
    std::fs::write(&file, serde_json::to_string_pretty(&all)?)?;
    println!("\nwritten to {}", file.display());
    Ok(())
}
