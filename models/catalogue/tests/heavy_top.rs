//! The heavy top.

use catalogue::HeavyTop;
use models::elliptic;
use tests::{assert_all_close, assert_close};

#[test]
fn it_turns_as_the_literature_says() {
    let run = super::run::<HeavyTop>(1e-11, 0.2, 0.2);
    let last = run.last().expect("the end");
    let published = [-0.70828, 0.43878, 0.54573, 0.0894];
    assert_all_close("quaternion at 0.2 s", &last.q[3..], &published, 1e-5);
}

/// Height u of the axis: u̇² = (b² − β u)(1 − u²) − (b − a u)² from u = 0 (Whittaker, Analytical Dynamics, §71).
#[test]
fn its_nutation_is_that_of_elliptic_functions() {
    let top = HeavyTop::default();
    let inertia = top.across + top.m * top.l * top.l;
    let start = super::start(&top);
    let omega = crate::pose::Pose::of(&start.q, &start.v, HeavyTop::TOP_X).omega;
    let (a, b) = (top.along * omega.y / inertia, omega.z);
    let beta = 2.0 * top.m * top.g * top.l / inertia;
    let (sum, product) = ((a * a + b * b) / beta, 2.0 * a * b / beta - 1.0);
    let root = (0.25 * sum * sum - product).sqrt();
    let (low, high) = (0.5 * sum - root, 0.5 * sum + root);
    let (m, rate) = (-low / (high - low), 0.5 * (beta * (high - low)).sqrt());
    let quarter = elliptic::complete(m);
    assert_close("period", 2.0 * quarter / rate, 0.745_206_947_616_769, 1e-9);
    let run = super::run::<HeavyTop>(1e-11, 0.05, 2.0);
    let heights = run.output("height").expect("declared");
    for (t, height) in run.times().iter().zip(heights) {
        let (sn, ..) = elliptic::jacobi(quarter + rate * t, m);
        assert_close("height of the axis", height, low * (1.0 - sn * sn), 1e-8);
    }
}
