//! The mechanisms of the catalogue against what is published of them, or known in closed form.

mod andrews;
mod arm;
mod bicycle;
mod bricard;
mod freedoms;
mod governor;
mod heavy_top;
mod jansen;
mod pose;
mod rolling_disc;
mod stewart;

use std::process::Command;

use nalgebra::DMatrix;
use ukcore::model::StartOptions;
use ukcore::{Linearisation, Mechanism, Simulation, State, Trajectory};

#[test]
fn every_mechanism_is_whole() {
    catalogue::entries().iter().for_each(tests::assert_whole);
}

/// The page that plays a motion has numbers alone: one that is none would be `null` there.
#[test]
fn every_mechanism_has_an_animation() {
    let out = tempfile::tempdir().expect("a directory");
    for entry in catalogue::entries() {
        let page = out.path().join(&entry.id);
        let mut animate = Command::new(env!("CARGO_BIN_EXE_catalogue"));
        animate.args(["animate", &entry.id, "--until", "0.01", "--pictures", "3"]);
        let done = animate.arg("--out").arg(&page).output().expect("it starts");
        let told = String::from_utf8_lossy(&done.stderr);
        assert!(
            done.status.success() && told.is_empty(),
            "{}: {told}",
            entry.id
        );
        let page = std::fs::read_to_string(&page).expect("a page");
        let (_, data) = page.split_once("id=\"data\">").expect("its data");
        let (data, _) = data.split_once("</script>").expect("an end");
        let data = data.replace("\"ended\":null", "");
        assert!(
            data.contains("\"pictures\":[[") && !data.contains("null"),
            "{}: {data}",
            entry.id
        );
    }
}

/// The first start that is declared.
fn start<M: Mechanism>(mechanism: &M) -> State {
    let start = mechanism
        .prepared()
        .start(M::SPEC.starts[0].name, &StartOptions::new());
    start.unwrap_or_else(|e| panic!("{}: {e}", M::SPEC.name))
}

/// The derivatives of velocities and accelerations by coordinates and velocities.
fn slopes<M: Mechanism>(mechanism: &M, state: &State) -> DMatrix<f64> {
    let (found, n) = (Linearisation::at(mechanism, state), state.q.len());
    let found = found.expect("smooth");
    let mut slopes = DMatrix::zeros(2 * n, 2 * n);
    slopes.view_mut((0, n), (n, n)).fill_with_identity();
    let by_both = [found.by_position, found.by_velocity].concat();
    slopes.rows_mut(n, n).copy_from_slice(&by_both);
    slopes
}

/// A run from the default start to `end`, with samples each `every`, s.
fn run<M: Mechanism>(tolerance: f64, every: f64, end: f64) -> Trajectory {
    let mechanism = M::default();
    let start = start(&mechanism);
    Simulation::new(mechanism)
        .tolerance(tolerance)
        .start(start)
        .every(every)
        .until(end)
        .unwrap_or_else(|e| panic!("{}: {e}", M::SPEC.name))
}
