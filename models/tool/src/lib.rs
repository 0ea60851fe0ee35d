//! Tools for mechanisms declared with [`ukcore::multibody!`]: commands, pages, plots.
//!
//! [`main!`] beside a declaration makes a program of it, with the commands `list`, `run`, `sweep`, `animate`, `modes`, `diagnose`,
//! `inverse`, `kinematics`, `explain`, `report` and `stability`:
//!
//! ```no_run
//! ukcore::multibody! {
//!     /// A cart on a spring with a pendulum hanging from it; y points up.
//!     pub Cart {
//!         params { big = 2.0, m = 1.0, l = 0.5, k = 40.0, g = 9.81 }
//!         coords { s, x, y }
//!         mass { s: big, x: m, y: m }
//!         potential { 0.5 * k * sq(s), m * g * y }
//!         holonomic { rod: sq(x - s) + sq(y) = sq(l) }
//!         output { swing = atan2(x - s, -y) }
//!         start released(angle = 0.9) { s = 0.0; x near l * sin(angle); y near -l * cos(angle) }
//!         draw { spring([-1.0, 0.0], [s, 0.0]) line([s, 0.0], [x, y]) circle([x, y], 0.05) trace([x, y]) }
//!     }
//! }
//!
//! uktool::main!(Cart);
//! ```
//!
//! `cargo run -- run cart --set angle=50deg --until 2 --csv -` then prints its motion, and `cargo run -- animate cart` makes a page that
//! shows it. A mechanism that implements [`ukcore::model::Model`] has further starts and references of its own besides.
//!
//! Programs of other shape call functions: [`list`](list::list), [`run`](run::run), [`sweep`](sweep::sweep),
//! [`animate`](animate::animate), [`modes`](modes::modes), [`diagnose`](diagnose::diagnose), [`inverse`](inverse::inverse),
//! [`kinematics`](kinematics::kinematics), [`explain`](explain::explain), [`report`](report::report) and
//! [`stability`](stability::stability) take models as [`Entry`], or cases, and their arguments; [`plot`] draws charts and [`html`] makes
//! pages.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod animate;
mod columns;
pub mod command;
mod curves;
pub mod diagnose;
pub mod drift;
pub mod explain;
pub mod failure;
pub mod html;
mod interrupt;
pub mod inverse;
pub mod kinematics;
pub mod list;
pub mod modes;
pub mod motion;
pub mod numbers;
pub mod output;
#[cfg(feature = "parquet")]
mod parquet;
pub mod plot;
pub mod progress;
pub mod report;
pub mod run;
pub mod runs;
pub mod scene;
pub mod stability;
mod summary;
pub mod sweep;
pub mod units;
mod ways;

pub use ukcore::model::Entry;

/// The whole of a program for the mechanisms declared beside it: a `main` function with all commands of the [crate].
///
/// The mechanisms are called like their types, in lower case and with dashes (`Cart` as `cart`, `UChain` as `u-chain`), and have the starts
/// that they declare; unless they implement [`ukcore::model::Model`] and say more of themselves. See the [crate] for an example.
#[macro_export]
macro_rules! main {
    ($($mechanism:ty),+ $(,)?) => {
        fn main() -> ::std::process::ExitCode {
            $crate::command::main(&[$($crate::entry!($mechanism)),+])
        }
    };
}

pub use ukcore::entry;
