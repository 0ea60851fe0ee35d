//! Theo Jansen's leg and walkers.

use catalogue::{JansenLeg, Walker};
use std::f64::consts::TAU;
use tests::{Random, assert_close, hunted};
use ukcore::{Mechanism, Simulation, State, assemble};

catalogue::legs! {
    /// Twelve legs.
    Twelve, 6, 2
}

/// How Jansen puts a leg together.
const JANSEN: [bool; 3] = [true, false, false];

/// A point of the plane.
type Point = [f64; 2];

/// The joints of a leg besides its hip: crank pin, knee above, lower joint, outer end of the upper triangle, heel, toe.
type Joints = [Point; 6];

/// Legs by compass and ruler.
trait Legs: Mechanism {
    /// Numbers of pairs, and of legs in each.
    const NUMBERS: [usize; 2];

    /// The joints of leg (n, s) with the crank at `angle`, rad: the knee on the left of the line from hip to crank pin where
    /// `left[0]`, the lower joint where `left[1]`, the heel on the left of that from the outer end to the lower joint where
    /// `left[2]`; of legs with s = 1 seen in the mirror. `None` where bars do not reach. Jansen's is [`JANSEN`].
    fn joints(&self, angle: f64, leg: (usize, usize), left: [bool; 3]) -> Option<Joints>;

    /// The crank at `angle`, rad, and the bodies of the legs where `joints`, drawn as well as may be, have them: (n, s) to joints.
    fn drawn(&self, angle: f64, joints: impl FnMut(usize, usize) -> Joints) -> State;
}

macro_rules! drawn {
    ($($name:ty),*) => {$(
        impl Legs for $name {
            const NUMBERS: [usize; 2] = [Self::PAIRS, Self::SIDES];

            fn joints(&self, angle: f64, (n, s): (usize, usize), left: [bool; 3]) -> Option<Joints> {
                let side = 1.0 - 2.0 * s as f64;
                let (sin, cos) = (angle + TAU / 3.0 * n as f64).sin_cos();
                let (hip, pin) = ([-self.a, -self.l], [side * self.m * cos, self.m * sin]);
                let knee = meet(hip, self.b, pin, self.j, left[0])?;
                let low = meet(hip, self.c, pin, self.k, left[1])?;
                let outer = meet(hip, self.d, knee, self.e, true)?;
                let heel = meet(outer, self.f, low, self.g, left[2])?;
                let toe = meet(low, self.i, heel, self.h, true)?;
                Some([pin, knee, low, outer, heel, toe].map(|[x, y]| [side * x, y]))
            }

            fn drawn(&self, angle: f64, mut joints: impl FnMut(usize, usize) -> Joints) -> State {
                let mut state = State::zeros::<Self>();
                state.q[Self::CRANK_ANGLE] = angle;
                for n in 0..Self::PAIRS {
                    for s in 0..Self::SIDES {
                        let [pin, knee, low, outer, heel, toe] = joints(n, s);
                        let hip = [self.a * (2.0 * s as f64 - 1.0), -self.l];
                        let mut enter = |x: usize, from: Point, to: Point, corners: &[Point]| {
                            [state.q[x], state.q[x + 1]] = centre(corners);
                            state.q[x + 2] = (to[1] - from[1]).atan2(to[0] - from[0]);
                        };
                        enter(Self::BAR_J_X[n][s], pin, knee, &[pin, knee]);
                        enter(Self::BAR_K_X[n][s], pin, low, &[pin, low]);
                        enter(Self::BAR_C_X[n][s], hip, low, &[hip, low]);
                        enter(Self::BAR_F_X[n][s], outer, heel, &[outer, heel]);
                        enter(Self::THIGH_X[n][s], hip, knee, &[hip, knee, outer]);
                        enter(Self::FOOT_X[n][s], low, heel, &[low, heel, toe]);
                    }
                }
                state
            }
        }
    )*};
}

drawn!(JansenLeg, Walker, Twelve);

/// The point at the distance r from p and s from q, to the left of the way from p to q or to its right.
fn meet(p: Point, r: f64, q: Point, s: f64, left: bool) -> Option<Point> {
    let [dx, dy] = [q[0] - p[0], q[1] - p[1]];
    let square = dx * dx + dy * dy;
    let along = (square + r * r - s * s) / (2.0 * square);
    let across = (r * r / square - along * along).sqrt();
    let across = if left { across } else { -across };
    let place = [
        p[0] + along * dx - across * dy,
        p[1] + along * dy + across * dx,
    ];
    (!across.is_nan()).then_some(place)
}

/// The centre of mass of uniform bars from each corner to the next.
fn centre(corners: &[Point]) -> Point {
    let next = corners.iter().cycle().skip(1);
    let bars = corners.iter().zip(next).map(|([x, y], [u, v])| {
        let length = (u - x).hypot(v - y);
        [length, length * (x + u) / 2.0, length * (y + v) / 2.0]
    });
    let [length, x, y] = bars.fold([0.0; 3], |s, b| [s[0] + b[0], s[1] + b[1], s[2] + b[2]]);
    [x / length, y / length]
}

/// Over a turn of the crank the toe is where circles about the joints have it.
#[test]
fn toes_go_where_compass_and_ruler_have_them() {
    fn check<M: Legs>(crank: usize, toe: impl Fn(f64) -> Vec<f64>) {
        let run = super::run::<M>(1e-10, 0.1, 2.0);
        let angle = |q: &[f64]| q[crank];
        assert!(angle(run.last().expect("the end").q) > TAU, "a whole turn");
        for (sample, found) in run.samples().zip(run.outputs()) {
            tests::assert_all_close("toes", &found, &toe(angle(sample.q)), 1e-9);
        }
    }
    check::<JansenLeg>(JansenLeg::CRANK_ANGLE, |angle| {
        let joints = JansenLeg::default().joints(angle, (0, 0), JANSEN);
        joints.expect("bars reach")[5].to_vec()
    });
    check::<Walker>(Walker::CRANK_ANGLE, |angle| {
        let legs = (0..6).map(|leg| {
            let joints = Walker::default().joints(angle, (leg / 2, leg % 2), JANSEN);
            joints.expect("bars reach")[5]
        });
        legs.flatten().collect()
    });
}

/// A walk of twelve legs: how far its samples are off the constraints, and the turns of the crank.
fn walk(end: f64, samples: u32) -> (f64, f64) {
    let walker = Twelve::default();
    let start = super::start(&walker);
    let run = Simulation::new(walker)
        .start(start)
        .every(end / f64::from(samples))
        .until(end)
        .unwrap_or_else(|e| panic!("{e}"));
    let residuals = run.residuals();
    let off = residuals.iter().map(|r| r.position).fold(0.0, f64::max);
    (
        off,
        run.last().expect("the end").q[Twelve::CRANK_ANGLE] / TAU,
    )
}

#[test]
fn twelve_legs_walk() {
    let (off, turns) = walk(2.0, 20);
    assert!(off < 1e-10 && turns > 1.0, "{off:e}, {turns}");
}

#[test]
#[ignore = "long: cargo test --release -p catalogue hunt -- --ignored --nocapture"]
fn hunt_twelve_legs_walk_on() {
    let (off, turns) = walk(1000.0, 1000);
    println!("1000 s, {turns:.1} turns: loops within {off:e}");
    assert!(off < 1e-10 && turns > 100.0, "{off:e}, {turns}");
}

/// Sketches whose joints are up to `spread` off, m, put together with the crank held: how many could be, and how many are as near as the
/// nearest of all ways to put each leg together.
fn sketches<M: Legs>(spread: f64, draws: u64) -> (u64, u64) {
    let mechanism = M::default();
    let n = M::SPEC.n();
    let mut mass = vec![0.0; n * n];
    let prepared = mechanism.prepared::<f64>();
    prepared.mass_matrix(0.0, &vec![0.0; n], &mut mass);
    let mut random = Random::new(12);
    let [pairs, sides] = M::NUMBERS;
    let (mut assembled, mut nearest, mut seconds) = (0, 0, 0.0);
    for _ in 0..draws {
        let angle = TAU / 2.0 * random.signed();
        let sketch = mechanism.drawn(angle, |n, s| {
            let joints = mechanism.joints(angle, (n, s), JANSEN).expect("bars reach");
            joints.map(|p| p.map(|x| x + spread * random.signed()))
        });
        let began = std::time::Instant::now();
        let found = assemble(&mechanism, &sketch, &["crank.angle"]);
        seconds += began.elapsed().as_secs_f64();
        let Ok(found) = found else {
            continue;
        };
        assembled += 1;
        // In the mass metric, angles by the shorter way round.
        let far = |state: &State| -> f64 {
            let squares = (0..n).map(|j| {
                let off = state.q[j] - sketch.q[j];
                let angle = M::SPEC.coords[j].ends_with(".angle");
                let turns = if angle { (off / TAU).round() } else { 0.0 };
                mass[j * n + j] * (off - TAU * turns).powi(2)
            });
            squares.sum()
        };
        // Each leg in the way that is the nearest where the others are as Jansen has them.
        let mut best = vec![vec![JANSEN; sides]; pairs];
        for (n, s) in (0..pairs * sides).map(|leg| (leg / sides, leg % sides)) {
            let ways = (0..8_u8).map(|k| [k & 1 == 0, k & 2 != 0, k & 4 != 0]);
            let drawn = ways.filter_map(|way| {
                let joints = mechanism.joints(angle, (n, s), way)?;
                let state = mechanism.drawn(angle, |other, side| match (other, side) == (n, s) {
                    true => joints,
                    false => (mechanism.joints(angle, (other, side), JANSEN)).expect("bars reach"),
                });
                Some((way, far(&state)))
            });
            let least = drawn.min_by(|a, b| a.1.total_cmp(&b.1));
            best[n][s] = least.expect("Jansen's way").0;
        }
        let best = mechanism.drawn(angle, |n, s| {
            let joints = mechanism.joints(angle, (n, s), best[n][s]);
            joints.expect("bars reach")
        });
        nearest += u64::from((far(&found) - far(&best)).abs() < 1e-9 * far(&best));
    }
    let each = 1e3 * seconds / draws as f64;
    let legs = pairs * sides;
    println!(
        "{legs} legs, joints {spread} m off: {assembled} of {draws} assembled, {nearest} in the nearest way, {each:.0} ms each"
    );
    (assembled, nearest)
}

#[test]
fn legs_are_assembled_from_a_sketch() {
    assert_eq!(sketches::<Twelve>(0.04, 5), (5, 5));
    assert_eq!(sketches::<Twelve>(0.4, 5), (5, 5));
    assert_eq!(sketches::<JansenLeg>(0.4, 60), (60, 60));
}

#[test]
#[ignore = "long: cargo test --release -p catalogue hunt -- --ignored --nocapture"]
fn hunt_twelve_legs_are_assembled_from_sketches() {
    let draws = hunted(200);
    for spread in [0.02, 0.04, 0.1, 0.2, 0.4] {
        assert_eq!(sketches::<Twelve>(spread, draws), (draws, draws));
        let legs = 5 * draws;
        assert_eq!(sketches::<JansenLeg>(spread, legs), (legs, legs));
    }
}

/// Without torque and drag the energy stays.
#[test]
fn a_leg_that_nothing_drives_keeps_its_energy() {
    let leg = JansenLeg {
        torque: 0.0,
        drag: 0.0,
        ..JansenLeg::default()
    };
    let start = super::start(&leg);
    let run = Simulation::new(leg)
        .tolerance(1e-11)
        .start(start)
        .until(5.0)
        .expect("a run");
    assert_close("energy", run.energy_drift(), 0.0, 1e-8);
}
