//! The tools of `uktool` for the catalogue: `cargo run --release -p catalogue -- list`.

#![forbid(unsafe_code)]

use catalogue::{
    Andrews, Arm, Bicycle, Bricard, Governor, HeavyTop, JansenLeg, RollingDisc, Stewart, Walker,
};

uktool::main!(
    Andrews,
    Bicycle,
    JansenLeg,
    Walker,
    Bricard,
    Governor,
    Stewart,
    HeavyTop,
    RollingDisc,
    Arm,
);
