//! What accelerations of some mechanisms cost, in operations: how that grows with their size, and with the coordinates they are declared
//! in.

use super::analysis;
use proc_macro2::TokenStream;

/// The declaration in the branch of the macro `name` of `tests/src/machines.rs` that has `mark`, with `values` in place of its arguments.
fn declaration(name: &str, mark: &str, values: &[(&str, &str)]) -> TokenStream {
    let text = include_str!("../../../tests/src/machines.rs");
    let (_, text) = text
        .split_once(&format!("macro_rules! {name} {{"))
        .expect("a macro");
    let (text, _) = text.split_once("\n}\n").expect("its end");
    let mut branches = text.split("ukcore::multibody! {").skip(1);
    let found = branches.find(|branch| branch.contains(mark));
    let branch = found.expect("a declaration with the mark");
    let (branch, _) = branch.split_once("\n        }\n").expect("its end");
    let filled = values.iter().fold(branch.to_owned(), |text, (from, to)| {
        text.replace(&format!("$({from})*"), to).replace(from, to)
    });
    filled.parse().expect("tokens")
}

/// Operations of q̈ by straight line.
fn operations(tokens: TokenStream) -> usize {
    let analysis = analysis(tokens);
    assert!(analysis.solve.is_ok(), "a straight line");
    analysis.costs.acceleration.counts().iter().sum()
}

#[test]
fn arms_cost_what_they_have_hinges() {
    let [six, twelve, all] = ["6", "12", "24"]
        .map(|n| operations(declaration("arm", "", &[("$name", "Arm"), ("$n", n)])));
    let least = six <= 1000 && twelve <= 3790 && all <= 8800;
    assert!(least, "{six}, {twelve}, {all}");
    assert!(10 * all <= 26 * twelve, "{six}, {twelve}, {all}");
}

#[test]
fn planar_chains_cost_as_bodies_little_more_than_in_angles() {
    let cost = |name, n| {
        operations(declaration(
            "planar_chain",
            name,
            &[(name, "Chain"), ("$n", n)],
        ))
    };
    let [bodies, angles] = ["$bodies", "$angles"].map(|name| cost(name, "12"));
    assert!(bodies <= 1140 && angles <= 810, "{bodies}, {angles}");
    let twice = cost("$bodies", "24");
    assert!(10 * twice <= 21 * bodies, "{bodies}, {twice}");
}

#[test]
fn slider_crank_costs_as_bodies_what_it_costs_in_angles() {
    let bodies = operations(super::golden::declarations()["SliderCrank"].clone());
    let angles = operations(declaration("crank_and_rod", "", &[("$name", "Crank")]));
    assert!(10 * bodies <= 13 * angles, "{bodies}, {angles}");
}

#[test]
fn legs_on_one_shaft_cost_what_legs_with_angles_of_their_own_cost() {
    let cost = |coords, force, shaft, angle| {
        let common = [("$name", "Legs"), ("$n", "12"), ("$mass", "th: jc")];
        let own = [
            ("$coords", coords),
            ("$force", force),
            ("$shaft", shaft),
            ("$angle", angle),
        ];
        operations(declaration("legs", "", &[&common[..], &own].concat()))
    };
    let one = cost("th", "th: torque - drag * dot(th)", "", "th");
    let link = "for n in 1..LEGS { shaft[n]: th[n] = th[n - 1] }";
    let own = cost(
        "th[LEGS]",
        "th[0]: torque - drag * dot(th[0])",
        link,
        "th[n]",
    );
    assert!(one <= 6250 && one <= own, "{one}, {own}");
}

/// Bodies in space, one joined to the next by `joint`.
fn spatial_chain(n: usize, joint: &str) -> TokenStream {
    let text = format!(
        "pub Chain {{ const N: usize = {n}; params {{ m = 1.0, along = 0.01, across = 0.03, l = 0.5 }} gravity {{ [0, 0, -9.81] }} \
         bodies {{ for i in 0..N {{ spatial b[i] {{ mass: m, inertia: [along, across, across], centre: [l / 2, 0, 0] }} }} }} \
         holonomic {{ {joint}; for i in 1..N {{ j[i]: {} }} }} }}",
        joint
            .replace("first: ", "")
            .replace("ground.at([0, 0, 0])", "b[i - 1].at([l, 0, 0])")
            .replace("b[0]", "b[i]")
    );
    text.parse().expect("tokens")
}

#[test]
fn bodies_in_space_cost_what_they_are_many() {
    let free = "pub Free { bodies { spatial b { mass: 1, inertia: [1, 2, 2.5] } } }";
    let free = operations(free.parse().expect("tokens"));
    // The same without a centre, in a quaternion whose angular velocity is written out, in parentheses.
    let turning = operations(super::golden::declarations()["RigidBody"].clone());
    assert!(free <= 150 && turning <= 116, "{free}, {turning}");
    let balls = "first: ball(ground.at([0, 0, 0]), b[0].at([0, 0, 0]))";
    let hinges = "first: hinge(ground.at([0, 0, 0]), b[0].at([0, 0, 0]), [0, 1, 0])";
    for (joint, each) in [(balls, [460, 480]), (hinges, [680, 840])] {
        let [six, twelve, all] = [6, 12, 24].map(|n| operations(spatial_chain(n, joint)));
        let least = six <= 6 * each[0] && twelve <= 12 * each[1];
        assert!(least, "{joint}: {six}, {twelve}, {all}");
        // A further body costs no more the more there are.
        let grows = 10 * (all - twelve) > 21 * (twelve - six);
        assert!(!grows, "{joint}: {six}, {twelve}, {all}");
    }
}

/// One sine and cosine of time for all phases of a gait; what is turned by a coordinate, or moves at another frequency, has its own.
#[test]
fn phases_of_a_gait_cost_one_sine() {
    let functions = |drives: &str| {
        let text = format!(
            "pub Gait {{ params {{ w = 2, lag = 0.3 }} coords {{ q[6] }} mass {{ q: 1 }} holonomic {{ {drives} }} }}"
        );
        let costs = analysis(text.parse().expect("tokens")).costs;
        [costs.dynamics, costs.acceleration].map(|costs| costs.counts()[4])
    };
    let phases = "for i in 0..6 { drive[i]: q[i] = sin(w * t + 2 * PI * i / 6 - lag) }";
    assert_eq!(functions(phases), [1, 1]);
    let turned = "a: q[0] = sin(w * t), b: q[1] = cos(lag - w * t), c: q[2] = sin(-w * t - lag)";
    assert_eq!(functions(turned), [1, 1]);
    // One is left as it is.
    assert_eq!(functions("a: q[0] = sin(w * t - lag)"), [1, 1]);
    let apart = "a: q[0] = sin(w * t), b: q[1] = sin(2 * w * t + lag)";
    assert_eq!(functions(apart), [2, 2]);
    let moves = "a: q[0] = sin(q[1] + w * t), b: sin(q[1] + w * t + lag) = q[2]";
    assert_eq!(functions(moves), [2, 2]);
}

/// Coupled four-bars cost, by hand, in the null space and without a check, some 75 for each top.
#[test]
fn coupled_four_bars_cost_what_their_null_space_costs() {
    let [twenty, forty] = ["20", "40"].map(|n| {
        operations(declaration(
            "four_bars",
            "",
            &[("$name", "Bars"), ("$n", n)],
        ))
    });
    assert!(forty <= 3330, "{twenty}, {forty}");
    assert!(100 * forty <= 205 * twenty, "{twenty}, {forty}");
}

/// Operations of M, Q, c, A and b, and of q̈ by straight line.
fn both(text: &str) -> [usize; 2] {
    let costs = analysis(text.parse().expect("tokens")).costs;
    [costs.dynamics, costs.acceleration].map(|costs| costs.counts().iter().sum())
}

/// What the catalogue declares by bodies and joints costs what it costs in places and angles whose T and equations are written out, within
/// a twentieth.
#[track_caller]
fn assert_as_by_hand(by_bodies: &str, by_hand: &str) {
    let [bodies, hand] = [both(by_bodies), both(by_hand)];
    for (bodies, hand) in bodies.iter().zip(hand) {
        assert!(
            20 * bodies.abs_diff(hand) <= hand,
            "{bodies}, by hand {hand}"
        );
    }
}

/// The point `d` of a body in axes of its own, from its centre, by its place and angle.
const POINT: &str = "let point = |q, d| [q[0] + cos(q[2]) * d[0] - sin(q[2]) * d[1], q[1] + sin(q[2]) * d[0] + cos(q[2]) * d[1]];";

/// The declaration in the text of a file of the catalogue, and what it begins with, up to its bodies.
fn catalogued(text: &str) -> (String, String) {
    let (_, text) = text.split_once("ukcore::multibody! {").expect("a macro");
    let (_, text) = text.split_once("pub ").expect("a declaration");
    // Neither counts; and the start is in bodies.
    let (text, _) = text.split_once("output {").expect("outputs");
    let (head, _) = text.split_once("bodies {").expect("bodies");
    (format!("pub {text} }}"), format!("pub {head}"))
}

#[test]
fn andrews_mechanism_costs_as_bodies_what_it_costs_by_hand() {
    let text = include_str!("../../../models/catalogue/src/andrews.rs");
    let (bodies, head) = catalogued(text);
    let by_hand = format!(
        "{head} coords {{ q[7][3] }} {POINT} let at = |n, p| point(q[n], p - centre[n]); \
         mass {{ for n in 0..7 {{ q[n][0]: m[n], q[n][1]: m[n], q[n][2]: i[n] }} }} \
         let end = [at(1, [-d, 0]), at(2, [0, -ss]), at(3, [0, -e]), at(5, [zf, 0])]; \
         holonomic {{ o: at(0, [0, 0]) = 0; f: at(1, [0, 0]) = at(0, [rr, 0]); b3: at(2, [0, 0]) = b; a5: at(4, [0, 0]) = a; \
         h: at(3, [0, 0]) = at(4, [zt, 0]); a7: at(6, [0, 0]) = a; g: at(5, [0, 0]) = at(6, [0, -u]); \
         for n in 1..4 {{ e0[n - 1]: end[n] - end[0] = 0 }} }} \
         potential {{ 0.5 * c0 * sq(norm(at(2, [sd, -sc]) - c) - l0) }} force {{ q[0][2]: mom }} }}"
    );
    assert_as_by_hand(&bodies, &by_hand);
}

#[test]
fn jansens_legs_cost_as_bodies_what_they_cost_by_hand() {
    let text = include_str!("../../../models/catalogue/src/jansen.rs");
    for (pairs, sides) in [("1", "1"), ("3", "2")] {
        let text = text.replace("$(#[$doc])*", "").replace("$name", "Legs");
        let text = text.replace("$pairs;", &format!("{pairs};"));
        let (bodies, head) = catalogued(&text.replace("$sides;", &format!("{sides};")));
        let by_hand = format!(
            "{head} coords {{ shaft_at[3], q[PAIRS][SIDES][6][3] }} {POINT} \
             let middles = |s| [[j / 2, 0], [k / 2, 0], [c / 2, 0], [f / 2, 0], middle([b, 0], outer(s)), middle([g, 0], toe(s))]; \
             let masses = |s| rho * [j, k, c, f, round([b, 0], outer(s)), round([g, 0], toe(s))]; \
             let inertias = |s| rho * [j.powi(3) / 12, k.powi(3) / 12, c.powi(3) / 12, f.powi(3) / 12, \
             turning([b, 0], outer(s), middle([b, 0], outer(s))), turning([g, 0], toe(s), middle([g, 0], toe(s)))]; \
             let at = |n, s, body, p| point(q[n][s][body], p - middles(s)[body]); let pin = |n| point(shaft_at, throw(n)); \
             mass {{ shaft_at[0]: 1, shaft_at[1]: 1, shaft_at[2]: shaft; for n in 0..PAIRS {{ for s in 0..SIDES {{ for body in 0..6 {{ \
             q[n][s][body][0]: masses(s)[body], q[n][s][body][1]: masses(s)[body], q[n][s][body][2]: inertias(s)[body] }} }} }} }} \
             potential {{ gravity * shaft_at[1]; for n in 0..PAIRS {{ for s in 0..SIDES {{ for body in 0..6 {{ \
             gravity * masses(s)[body] * q[n][s][body][1] }} }} }} }} \
             force {{ shaft_at[2]: torque - drag * dot(shaft_at[2]) }} \
             holonomic {{ bearing: point(shaft_at, [0, 0]) = 0; for n in 0..PAIRS {{ for s in 0..SIDES {{ \
             throw_j[n][s]: at(n, s, 0, [0, 0]) = pin(n); throw_k[n][s]: at(n, s, 1, [0, 0]) = pin(n); \
             hip_b[n][s]: at(n, s, 4, [0, 0]) = hip(s); hip_c[n][s]: at(n, s, 2, [0, 0]) = hip(s); \
             knee[n][s]: at(n, s, 4, [b, 0]) = at(n, s, 0, [j, 0]); back[n][s]: at(n, s, 3, [0, 0]) = at(n, s, 4, outer(s)); \
             low_k[n][s]: at(n, s, 5, [0, 0]) = at(n, s, 1, [k, 0]); low_c[n][s]: at(n, s, 5, [0, 0]) = at(n, s, 2, [c, 0]); \
             heel[n][s]: at(n, s, 5, [g, 0]) = at(n, s, 3, [f, 0]) }} }} }} }}"
        );
        assert_as_by_hand(&bodies, &by_hand);
    }
}

/// Functions of one frame stand in all six rows: dividing its vectors before costs less than dividing what all rows have of them.
#[test]
fn platforms_on_legs_share_what_is_divided() {
    let text = include_str!("../../../models/catalogue/src/stewart.rs");
    let (_, text) = text.split_once("ukcore::multibody! {").expect("a macro");
    let (text, _) = text.split_once("\n}\n").expect("its end");
    let work = operations(text.parse().expect("tokens"));
    assert!(work <= 1640, "{work}");
}
