//! Mechanisms of the literature, declared by bodies and joints: equations, starts and sources. What is published of their motions, or known
//! in closed form, is what the tests of this crate compare them with.
//!
//! They stand in a crate of their own because they are large: their emitted code takes longer to compile than all of the crate `models`,
//! which `cargo run --release` builds. `cargo run --release -p catalogue -- list` shows them; the other commands are those of `uktool`.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod andrews;
pub mod arm;
pub mod bicycle;
pub mod bricard;
pub mod governor;
pub mod heavy_top;
pub mod jansen;
pub mod rolling_disc;
pub mod stewart;

pub use andrews::Andrews;
pub use arm::Arm;
pub use bicycle::Bicycle;
pub use bricard::Bricard;
pub use governor::Governor;
pub use heavy_top::HeavyTop;
pub use jansen::{JansenLeg, Walker};
pub use rolling_disc::RollingDisc;
pub use stewart::Stewart;

use ukcore::{entry, model::Entry};

/// All mechanisms of the catalogue, as tools handle them.
#[must_use]
pub fn entries() -> Vec<Entry> {
    vec![
        entry!(Andrews),
        entry!(Bicycle),
        entry!(JansenLeg),
        entry!(Walker),
        entry!(Bricard),
        entry!(Governor),
        entry!(Stewart),
        entry!(HeavyTop),
        entry!(RollingDisc),
        entry!(Arm),
    ]
}
