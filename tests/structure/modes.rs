//! Modes about rest positions and steady motions, against closed forms.

mod defective;
mod graded;
mod kinked;

use tests::{assert_all_close, assert_close, at, at_rest};
use ukcore::studies::Mode;
use ukcore::{Error, Mechanism, equilibrium, modes};

ukcore::multibody! {
    /// Masses in a row between two walls, with springs between neighbours.
    pub Row {
        const N: usize = 6;
        params { m = 0.7, k = 30.0, c = 0.0 }
        coords { x[N] }
        mass { x: m }
        potential { 0.5 * k * sq(x[0]), 0.5 * k * sq(x[N - 1]) for i in 1..N { 0.5 * k * sq(x[i] - x[i - 1]) } }
        dissipation { for i in 0..N { 0.5 * c * sq(dot(x[i])) } }
    }
}

ukcore::multibody! {
    /// Two points on rods, the second rod declared `again`, with a turn of the first as an angle; y points up.
    pub Double {
        params { m = 1.3, l = 0.8, g = 9.81, c = 0.0 }
        coords { x1, y1, x2, y2, turn }
        mass { x1: m, y1: m, x2: m, y2: m }
        potential { m * g * (y1 + y2) }
        dissipation { 0.5 * c * (sq(dot(x1)) + sq(dot(y1))), 0.5 * c * (sq(dot(x2)) + sq(dot(y2))) }
        holonomic {
            upper: sq(x1) + sq(y1) = sq(l)
            lower: sq(x2 - x1) + sq(y2 - y1) = sq(l)
            again: 2.0 * (sq(x2 - x1) + sq(y2 - y1)) = 2.0 * sq(l)
            angle: x1 * cos(turn) = -y1 * sin(turn)
        }
    }
}

ukcore::multibody! {
    /// Chaplygin's sleigh: a blade, and the centre of mass a before it.
    pub Sleigh {
        params { m = 2.0, j = 0.3, a = 0.4 }
        coords { x, y, th }
        let centre = [x, y] + a * [cos(th), sin(th)];
        kinetic { 0.5 * m * sq(dot(centre)), 0.5 * j * sq(dot(th)) }
        nonholonomic { blade: dot(x) * sin(th) = dot(y) * cos(th) }
    }
}

fn frequencies(modes: &[Mode]) -> Vec<f64> {
    modes.iter().map(|mode| mode.frequency).collect()
}

/// ω_k = 2 √(k/m) sin(k π/(2 (N + 1))), with the shape sin(i k π/(N + 1)).
#[test]
fn a_row_of_masses_has_its_closed_form() {
    let row = Row::default();
    let found = modes(&row, &at_rest(&[0.0; Row::N])).expect("at rest");
    let count = Row::N + 1;
    let angle = |k: usize| std::f64::consts::PI * k as f64 / count as f64;
    let expected: Vec<f64> = (1..count)
        .map(|k| 2.0 * (row.k / row.m).sqrt() * (0.5 * angle(k)).sin())
        .collect();
    assert_all_close("frequencies", &frequencies(&found), &expected, 1e-12);
    for (mode, k) in found.iter().zip(1..) {
        assert_close("growth", mode.growth, 0.0, 1e-12);
        let shape = |i: usize| ((i + 1) as f64 * angle(k)).sin();
        let leader = Row::SPEC.coords.iter().position(|c| *c == mode.leader);
        let most = shape(leader.expect("a coordinate"));
        for (i, [re, im]) in mode.shape.iter().enumerate() {
            assert_close("shape", *re, shape(i) / most, 1e-10);
            assert_close("phase", *im, 0.0, 1e-10);
        }
    }
}

/// c on each mass: growth −c/2m, and √(ω² − (c/2m)²).
#[test]
fn damping_is_told() {
    let row = Row {
        c: 1.1,
        ..Row::default()
    };
    let found = modes(&row, &at_rest(&[0.0; Row::N])).expect("at rest");
    let free = modes(Row::default(), &at_rest(&[0.0; Row::N])).expect("at rest");
    let decay = 0.5 * row.c / row.m;
    for (mode, free) in found.iter().zip(&free) {
        assert_close("growth", mode.growth, -decay, 1e-12);
        let frequency = (free.frequency.powi(2) - decay * decay).sqrt();
        assert_close("frequency", mode.frequency, frequency, 1e-12);
        assert_close("damping", mode.damping(), decay / free.frequency, 1e-12);
    }
    // More than critical: two ways to die away for each of the slow ones.
    let stiff = Row {
        c: 40.0,
        ..Row::default()
    };
    let found = modes(&stiff, &at_rest(&[0.0; Row::N])).expect("at rest");
    let over = found.iter().filter(|mode| mode.frequency == 0.0).count();
    assert_eq!(found.len() + found.len() - over, 2 * Row::N);
    assert!(
        over > 0 && found.iter().all(|mode| mode.growth < 0.0),
        "{found:?}"
    );
}

/// ω² = (2 ± √2) g/l, hanging; standing on end both grow. Neither the rods nor the row too many add anything.
#[test]
fn constraints_have_no_modes_of_their_own() {
    let double = Double::default();
    let w = |sign: f64| ((2.0 + sign * 2.0_f64.sqrt()) * double.g / double.l).sqrt();
    let l = double.l;
    let hanging = modes(&double, &at_rest(&[0.0, -l, 0.0, -2.0 * l, 0.0])).expect("at rest");
    assert_all_close(
        "frequencies",
        &frequencies(&hanging),
        &[w(-1.0), w(1.0)],
        1e-11,
    );
    // The angle of the upper rod moves with its end.
    let [x1, turn] = [Double::X1, Double::TURN].map(|j| hanging[0].shape[j][0]);
    assert_close("turn", turn, x1 / l, 1e-10);
    let standing = modes(&double, &at_rest(&[0.0, l, 0.0, 2.0 * l, 0.0])).expect("at rest");
    let growths: Vec<f64> = standing.iter().map(|mode| mode.growth).collect();
    assert_all_close(
        "growth",
        &growths,
        &[-w(1.0), -w(-1.0), w(-1.0), w(1.0)],
        1e-11,
    );
    assert!(standing.iter().all(|mode| mode.frequency == 0.0));
}

/// Running straight at u, a turn dies away as exp(−m a u t/(j + m a²)): it grows where the centre of mass is behind the blade.
#[test]
fn a_sleigh_runs_straight_with_its_weight_in_front() {
    for u in [-3.0, 0.5, 2.0] {
        let sleigh = Sleigh::default();
        let state = at(&[1.0, 2.0, 0.0], &[u, 0.0, 0.0]);
        let found = modes(&sleigh, &state).expect("steady");
        let (m, j, a) = (sleigh.m, sleigh.j, sleigh.a);
        let growth = -m * a * u / (j + m * a * a);
        let near = |mode: &&Mode| (mode.growth - growth).abs() < 1e-10 && mode.frequency == 0.0;
        assert_eq!(found.iter().filter(near).count(), 1, "{found:?}");
        // Five freedoms of position and velocity; all else are places, headings and speeds that stay.
        let still = |mode: &&Mode| mode.growth.hypot(mode.frequency) < 1e-6;
        let eigenvalues = |mode: &Mode| if mode.frequency > 0.0 { 2 } else { 1 };
        let zeros: usize = found.iter().filter(still).map(eigenvalues).sum();
        assert_eq!(zeros, 4, "{found:?}");
    }
}

#[test]
fn what_does_not_stay_has_no_modes() {
    let double = Double::default();
    let l = double.l;
    let aslant = at_rest(&[0.6 * l, -0.8 * l, 0.6 * l, -1.8 * l, 0.6_f64.asin()]);
    let Err(Error::InvalidSetting { what, reason }) = modes(&double, &aslant) else {
        panic!("it falls")
    };
    assert_eq!(what, "state");
    assert!(reason.contains("accelerates by"), "{reason}");
    ukcore::multibody! { Falling { coords { y } mass { y: 1.0 } potential { 9.81 * y } } }
    assert!(modes(Falling::default(), &at_rest(&[0.0])).is_err());
}

ukcore::multibody! {
    /// A rod on a hinge in space, with the orientation near that of the ground.
    Hinged {
        params { m = 1.3, l = 0.8, g = 9.81 }
        bodies { spatial rod { mass: m, inertia: [0.01, m * sq(l) / 12, m * sq(l) / 12], centre: [0, 0, -l / 2] } }
        gravity { [0, 0, -g] }
        holonomic { root: hinge(ground.at([0, 0, 0]), rod.at([0, 0, 0]), [0, 1, 0]) }
        start tilted(angle = 0.3) { [rod.e0, rod.e2] near [cos(angle / 2), sin(angle / 2)] }
    }
}

/// ω² = 3 g/(2 l) but for the rod's thickness; the first of its quaternion has no inertia where it is 1, and does not move.
#[test]
fn bodies_in_space_have_shapes() {
    let rod = Hinged::default();
    for angle in [0.0, 1e-9, 1e-3, 0.3] {
        let start = rod.start("tilted", &[("angle", angle)].into()).unwrap();
        let found = ukcore::equilibrium(&rod, &start, &[]).unwrap();
        let modes = modes(&rod, &found.state).unwrap();
        assert_eq!(modes.len(), 1);
        assert_close("ω", modes[0].frequency, (1.5 * 9.81 / 0.8_f64).sqrt(), 1e-7);
        let shape = |i: usize| modes[0].shape[i][0].hypot(modes[0].shape[i][1]);
        let turn = shape(Hinged::ROD_E2);
        assert!(
            shape(Hinged::ROD_E0) < 1e-6 * turn,
            "{angle}: {:?}",
            modes[0]
        );
        // Half a radian of the quaternion is a radian of the rod, and moves its centre by half its length.
        assert_close("x", shape(Hinged::ROD_X) / turn, 2.0 * 0.4, 1e-6);
    }
}

ukcore::multibody! {
    /// Peaucellier's inversor, whose point `p` goes straight: seven rods, and nothing that acts.
    pub Inversor {
        params { long = 1.0, short = 0.4, e = 0.4 }
        coords { c[2], u[2], v[2], p[2] }
        mass { c: 1.0, u: 0.7, v: 1.3, p: 2.0 }
        let o = [-e, 0.0];
        holonomic {
            crank: sq(c) = sq(e)
            ou: sq(u - o) = sq(long), ov: sq(v - o) = sq(long)
            cu: sq(u - c) = sq(short), cv: sq(v - c) = sq(short)
            pu: sq(u - p) = sq(short), pv: sq(v - p) = sq(short)
        }
        start turned(angle = 0.0) {
            [c[0], c[1]] near e * [cos(angle), sin(angle)];
            u near [0.5, 0.4]; v near [0.5, -0.4]; p near [0.65, 1.05 * tan(angle / 2)]
        }
    }
}

ukcore::multibody! {
    /// Two masses on a line with a spring between them, which nothing holds.
    pub Adrift {
        params { k = 3.0 }
        coords { x, y }
        mass { x: 1.0, y: 2.0 }
        potential { 0.5 * k * sq(x - y - 1.0) }
    }
}

ukcore::multibody! {
    /// A mass in syrup on a weak spring, and one on a stiff spring.
    pub Syrup {
        params { k = 3.0, weak = 1e-8, c = 2.0 }
        coords { w, z }
        mass { w: 1.0, z: 1.0 }
        potential { 0.5 * k * sq(w), 0.5 * weak * sq(z) }
        force { z: -c * dot(z) }
    }
}

/// A displacement that costs nothing has an eigenvalue of exactly 0, twice, whatever rounding makes of it; what is slow has not.
#[test]
fn what_costs_nothing_is_told_from_what_is_slow() {
    let inversor = Inversor::default();
    for angle in [0.0, 0.4, -0.7] {
        let start = inversor
            .start("turned", &[("angle", angle)].into())
            .unwrap();
        let found = ukcore::equilibrium(&inversor, &start, &[]).unwrap();
        assert_eq!(
            found.stability,
            ukcore::studies::Stability::Neutral,
            "{angle}"
        );
        assert_all_close("where it was", &found.state.q, &start.q, 1e-14);
        let modes = modes(&inversor, &found.state).unwrap();
        let values: Vec<_> = modes.iter().map(|m| (m.growth, m.frequency)).collect();
        assert_eq!(values, [(0.0, 0.0); 2], "{angle}");
    }
    let values = |modes: Vec<Mode>| -> Vec<[f64; 2]> {
        modes.iter().map(|m| [m.growth, m.frequency]).collect()
    };
    // In seconds, in years, in nanoseconds.
    for pace in [1.0_f64, 1e-10, 1e9] {
        let k = 3.0 * pace * pace;
        let adrift = modes(Adrift { k }, &at_rest(&[1.0, 0.0])).unwrap();
        let adrift = values(adrift);
        assert_eq!(adrift[..2], [[0.0; 2]; 2]);
        assert_all_close(
            "vibration",
            &adrift[2],
            &[0.0, pace * 4.5_f64.sqrt()],
            1e-12 * pace,
        );
        let (weak, c) = (1e-8 * pace * pace, 2.0 * pace);
        let found = values(modes(Syrup { k, weak, c }, &at_rest(&[0.0; 2])).unwrap());
        // λ² + c λ + weak = 0, of which the smaller root is the other one's share of the product.
        let fast = -0.5 * (c + (c * c - 4.0 * weak).sqrt());
        assert_eq!(
            (found.len(), found[1][1], found[2][0]),
            (3, 0.0, 0.0),
            "{found:?}"
        );
        let told = [found[0][0], found[1][0], found[2][1]];
        for (told, expected) in told.into_iter().zip([fast, weak / fast, k.sqrt()]) {
            assert!((told / expected - 1.0).abs() < 1e-7, "{found:?}");
        }
    }
}

ukcore::multibody! {
    /// Two pairs of masses on springs and one mass in syrup, none of them held, and one that turns freely.
    pub Loose {
        params { k = 3.0, c = 2.0 }
        coords { u, x, w, y, z, th }
        mass { u: 1.0, x: 2.0, w: 0.7, y: 1e-3, z: 1.3, th: 5.0 }
        potential { 0.5 * k * sq(x - y - 1.0), 0.5 * k * sq(u - w) }
        dissipation { 0.5 * c * sq(dot(z)) }
    }
}

/// Displacements that cost nothing are told each by itself, twice where it can go on.
#[test]
fn what_costs_nothing_is_told_once_each() {
    let found = modes(Loose::default(), &at_rest(&[0.3, 1.2, 0.3, 0.2, 0.7, 2.0])).unwrap();
    assert_eq!(found.len(), 12 - 2);
    let still: Vec<&Mode> = found.iter().filter(|mode| mode.size() == 0.0).collect();
    assert_eq!(still.len(), 7);
    let moving = |mode: &Mode| -> Vec<usize> {
        let moves = |i: &usize| mode.shape[*i][0].hypot(mode.shape[*i][1]) > 1e-12;
        (0..6).filter(moves).collect()
    };
    let mut all: Vec<Vec<usize>> = still.into_iter().map(moving).collect();
    all.sort();
    // What can go on by itself counts twice; in syrup it does not.
    let twice = |moving: &[usize]| [moving.to_vec(), moving.to_vec()];
    let pairs = [twice(&[0, 2]), twice(&[1, 3])].concat();
    let free = twice(&[5]).to_vec();
    assert_eq!(all, [pairs, vec![vec![4]], free].concat());
}

/// Double pendulums of bars, with springs and dampers in their joints, that do not touch each other.
macro_rules! pendulums {
    ($name:ident, $copies:literal) => {
        ukcore::multibody! {
            pub $name {
                const N: usize = $copies;
                params { m = 0.02 [kg], l = 0.045 [m], k = 0.05 [N m], c = 0.001 [N m s], g = 9.81 [m/s^2] }
                bodies {
                    for i in 0..N {
                        planar a[i] { mass: m, inertia: m * sq(l) / 12, centre: [l / 2, 0] }
                        planar b[i] { mass: m, inertia: m * sq(l) / 12, centre: [l / 2, 0] }
                    }
                }
                gravity { [0, -g] }
                tree {
                    for i in 0..N { root[i]: pin(ground.at([0, 0]), a[i].at([0, 0])) knee[i]: pin(a[i].at([l, 0]), b[i].at([0, 0])) }
                }
                forces {
                    for i in 0..N {
                        turning_spring(ground, a[i], k, 1.0) turning_damper(ground, a[i], c)
                        turning_spring(a[i], b[i], k, 0.1) turning_damper(a[i], b[i], c)
                    }
                }
            }
        }
    };
}

pendulums!(One, 1);
pendulums!(Two, 2);
pendulums!(Four, 4);
pendulums!(Eight, 8);

/// The modes of `copies` of a mechanism are those of one, each so often, and in each of these another copy moves alone.
fn modes_of_one(mechanism: &impl Mechanism, one: &[Mode], copies: usize) {
    let mechanism = ukcore::mechanism::Prepared::from(mechanism);
    let guess = at_rest(&vec![0.5; 2 * copies]);
    let place = ukcore::equilibrium(&mechanism, &guess, &[]).unwrap();
    assert_eq!(place.stability, ukcore::studies::Stability::Stable);
    let found = modes(&mechanism, &place.state).unwrap();
    assert_eq!(found.len(), copies * one.len());
    let size = one.iter().map(Mode::size).fold(0.0, f64::max);
    let names = mechanism.spec().coords;
    for (group, one) in found.chunks(copies).zip(one) {
        let mut alone: Vec<String> = Vec::new();
        for mode in group {
            let off = (mode.growth - one.growth).hypot(mode.frequency - one.frequency);
            assert!(off <= 1e-12 * size, "{mode:?}: {one:?}");
            let moving = names.iter().zip(&mode.shape);
            let moving = moving.filter(|(_, [re, im])| re.hypot(*im) > 1e-7);
            let copy =
                |name: &str| name[name.find('[').unwrap()..name.find(']').unwrap()].to_owned();
            let mut moving: Vec<String> = moving.map(|(name, _)| copy(name)).collect();
            moving.sort();
            moving.dedup();
            assert_eq!(moving.len(), 1, "{mode:?}");
            alone.extend(moving);
        }
        alone.sort();
        alone.dedup();
        assert_eq!(alone.len(), copies, "{alone:?}");
    }
}

#[test]
fn copies_have_the_modes_of_one() {
    for c in [0.001, 0.002, 0.0] {
        let one = One {
            c,
            ..One::default()
        };
        let place = ukcore::equilibrium(&one, &at_rest(&[0.5; 2]), &[]).unwrap();
        let found = modes(&one, &place.state).unwrap();
        assert!(found.iter().all(|mode| (mode.growth < 0.0) == (c > 0.0)));
        let [first, second] = [place.state.q[0], place.state.q[0] + place.state.q[1]];
        let (inertia, weight) = (one.m * one.l * one.l, one.m * one.g * one.l);
        let coupled = 0.5 * inertia * (first - second).cos();
        for mode in &found {
            // det(λ² M + λ C + K), in the angles of both bars against the ground.
            let rate = nalgebra::Complex::new(mode.growth, mode.frequency);
            let joint = rate * c + one.k;
            let upper =
                rate * rate * (inertia * 4.0 / 3.0) + joint * 2.0 - 1.5 * weight * first.sin();
            let lower = rate * rate * (inertia / 3.0) + joint - 0.5 * weight * second.sin();
            let beside = rate * rate * coupled - joint;
            let size = upper.norm() * lower.norm() + beside.norm_sqr();
            assert!(
                (upper * lower - beside * beside).norm() <= 1e-9 * size,
                "{mode:?}"
            );
        }
        modes_of_one(
            &Two {
                c,
                ..Two::default()
            },
            &found,
            2,
        );
        modes_of_one(
            &Four {
                c,
                ..Four::default()
            },
            &found,
            4,
        );
        modes_of_one(
            &Eight {
                c,
                ..Eight::default()
            },
            &found,
            8,
        );
    }
}

ukcore::multibody! {
    /// Points on threads of one length in space, that hang aslant of the axes.
    pub Threads {
        const N: usize = 3;
        params { l = 0.7, m = 1.3, gx = 3.1, gy = -5.7, gz = 7.3, c = 0.0 }
        coords { x[N], y[N], z[N] }
        mass { for i in 0..N { x[i]: m, y[i]: m, z[i]: m } }
        potential { for i in 0..N { -m * (gx * x[i] + gy * y[i] + gz * z[i]) } }
        dissipation { 0.5 * c * sq(dot(x[0])) }
        holonomic { for i in 0..N { thread[i]: sq(x[i]) + sq(y[i]) + sq(z[i]) = sq(l) } }
    }
}

/// Six frequencies √(g/l) coincide: none grows, in whatever direction they hang; nor where one thread loses energy.
#[test]
fn coinciding_frequencies_do_not_grow() {
    let mut random = tests::Random::new(11);
    for case in 0..60 {
        let g = [(); 3].map(|()| 10.0 * random.signed());
        let size = g.iter().fold(0.0_f64, |sum, x| sum.hypot(*x));
        let [gx, gy, gz] = g;
        let c = if case % 2 == 0 { 0.0 } else { 0.4 };
        let threads = Threads {
            gx,
            gy,
            gz,
            c,
            ..Threads::default()
        };
        let q = g.map(|x| [threads.l * x / size; Threads::N]).concat();
        let found = ukcore::equilibrium(&threads, &at_rest(&q), &[]).expect("it hangs");
        assert_eq!(
            found.stability,
            ukcore::studies::Stability::Stable,
            "{g:?}, {c}"
        );
        let found = modes(&threads, &found.state).expect("at rest");
        assert_eq!(found.len(), 2 * Threads::N);
        let lasting = found.iter().filter(|mode| mode.growth == 0.0);
        // The damped point swings at a right angle to the damper, too.
        assert_eq!(
            lasting.count(),
            if c > 0.0 { 5 } else { 6 },
            "{g:?}: {found:?}"
        );
        let frequency = (size / threads.l).sqrt();
        for mode in found.iter().filter(|mode| mode.growth == 0.0) {
            assert_close("frequency", mode.frequency, frequency, 1e-11 * frequency);
        }
    }
}

ukcore::multibody! {
    /// A block on a spring that rubs on a table, in the plane.
    Rubbed {
        params { m = 1.0, k = 4.0, mu = 0.3, g = 9.81 }
        coords { x, y }
        mass { x: m, y: m }
        potential { 0.5 * k * sq([x, y]) }
        nonideal { x: friction(dot([x, y]), mu * m * g)[0], y: friction(dot([x, y]), mu * m * g)[1] }
    }
}

#[test]
fn friction_without_a_direction_at_rest_is_told_with_what_helps() {
    let still = at_rest(&[0.0; 2]);
    let errors = [
        modes(Rubbed::default(), &still).map(|_| ()),
        ukcore::equilibrium(Rubbed::default(), &still, &[]).map(|_| ()),
        ukcore::Linearisation::at(Rubbed::default(), &still).map(|_| ()),
    ];
    for told in errors {
        let Err(error) = told else {
            panic!("no force has a value there")
        };
        assert!(
            matches!(&error, Error::NoDirection { terms } if terms.len() == 2),
            "{error}"
        );
        assert!(error.to_string().contains("smooth the length"), "{error}");
    }
}

ukcore::multibody! {
    /// A four-bar linkage with a turning spring between coupler and rocker, `aside` of the origin.
    Aside {
        params { crank = 0.5, coupler = 1.8, rocker = 1.5, span = 2.0, aside = 0.0, k = 3.0, g = 9.81 }
        bodies {
            planar a { mass: 1, inertia: sq(crank) / 12, centre: [crank / 2, 0] }
            planar b { mass: 1, inertia: sq(coupler) / 12, centre: [coupler / 2, 0] }
            planar c { mass: 1, inertia: sq(rocker) / 12, centre: [rocker / 2, 0] }
        }
        gravity { [0, -g] }
        holonomic {
            o: pin(ground.at([aside, -aside]), a.at([0, 0]))
            p: pin(a.at([crank, 0]), b.at([0, 0]))
            q: pin(b.at([coupler, 0]), c.at([rocker, 0]))
            r: pin(ground.at([aside + span, -aside]), c.at([0, 0]))
        }
        forces { turning_spring(b, c, k, 1) }
        start bent { a.angle = 1; b.angle near 0.5; c.angle near 1.6 }
    }
}

/// What `equilibrium` finds has modes, also far from the origin, where it is known to fewer digits.
#[test]
fn a_rest_position_far_from_the_origin_has_modes() {
    let frequency = |aside: f64| {
        let linkage = Aside {
            aside,
            ..Default::default()
        };
        let linkage = linkage.prepared();
        let start = linkage.start("bent", &[].into()).unwrap();
        let rest = equilibrium(&linkage, &start, &[]).unwrap();
        modes(&linkage, &rest.state).unwrap()[0].frequency
    };
    for aside in [1e3, -1e5, 3e5, -7e5, 1e6] {
        assert_close("frequency", frequency(aside), frequency(0.0), 1e-5);
    }
}
