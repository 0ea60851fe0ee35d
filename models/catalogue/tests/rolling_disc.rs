//! The rolling disc.

use crate::pose::Pose;
use catalogue::RollingDisc;
use std::f64::consts::PI;
use tests::assert_close;
use ukcore::Simulation;

#[test]
fn it_stays_on_its_circle() {
    let (tilt, precession) = (1.1_f64, 2.0);
    let disc = RollingDisc::default();
    let start = super::start(&disc);
    let omega = Pose::of(&start.q, &start.v, RollingDisc::DISC_X).omega;
    let spin = omega.z * tilt.cos() + omega.y * tilt.sin();
    assert_close("spin", spin, -3.177_452_701_121_622, 1e-12);
    let radius = -disc.r * spin / precession;
    assert_close("radius of the circle", radius, 0.794_363_175, 1e-9);
    let run = Simulation::new(disc)
        .tolerance(1e-11)
        .dense()
        .start(start)
        .every(0.1)
        .until(3.0)
        .expect("a run");
    for sample in run.samples() {
        let height = sample.q[RollingDisc::DISC_Z];
        assert_close("height", height, 0.5 * tilt.sin(), 1e-8);
        let speed = sample.v[RollingDisc::DISC_X].hypot(sample.v[RollingDisc::DISC_Y]);
        assert_close("speed on the circle", speed, precession * radius, 1e-8);
    }
    let half = run.at(PI / precession).expect("half a turn");
    let across = half.q[RollingDisc::DISC_X].hypot(half.q[RollingDisc::DISC_Y]);
    assert_close("across the circle", across, 2.0 * radius, 1e-7);
}
