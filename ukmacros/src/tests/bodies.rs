//! Bodies: joints are the equations that their documentation shows, bodies cost what coordinates by hand cost, and mistakes are told.

use super::errors::check as check_errors;
use super::vectors::check;
use super::{analysis, coordinates, system};
use ukalgebra::analysis::Operations;
use ukalgebra::expr::{Id, Point, eval};

/// Planar bodies a and b, and parameters.
const PLANE: &str = "params { r = 0.2, s = 0.1, l = 1.3 } bodies { planar a { mass: 1, inertia: 2, centre: [r, 0] } planar b { mass: 3, inertia: 4 } } \
    let p = a.at([l, s]); let q = b.at([0, r]);";

/// Spatial bodies a and b, and parameters.
const SPACE: &str = "params { r = 0.2, s = 0.1, l = 1.3 } bodies { spatial a { mass: 1, inertia: [1, 2, 2.5], centre: [r, 0, s] } \
    spatial b { mass: 3, inertia: [2, 2, 3, 0, s, 0] } } let p = a.at([l, s, 0]); let q = b.at([0, r, r]);";

/// Expects a joint to be an equation written by hand, in bodies of the `home`: its rows have these values at any state.
#[track_caller]
fn check_rows(home: &str, joint: &str, rows: &str) {
    let values = |equation: &str| -> Vec<f64> {
        let (system, model) = system(&format!("pub T {{ {home} holonomic {{ c: {equation} }} }}"));
        let n = model.coord_elements.len();
        // Any numbers do.
        let numbers = |k: usize| (0..n).map(|i| (1.7 * (i + n * k) as f64).sin()).collect();
        let (q, v): (Vec<f64>, Vec<f64>) = (numbers(0), numbers(1));
        let point = Point {
            t: 0.3,
            q: &q,
            v: &v,
            ..Point::of_parameters(&system.defaults)
        };
        let rows: Vec<Id> = system.constraints.iter().map(|c| c.phi).collect();
        eval(&system.graph, &rows, &point)
    };
    let (short, long) = (values(joint), values(&format!("{rows} = 0")));
    assert_eq!(short.len(), long.len(), "{joint}");
    for (a, b) in short.iter().zip(&long) {
        assert!((a - b).abs() < 1e-14, "{joint}: {short:?} is not {long:?}");
    }
}

#[test]
fn planar_joints_are_equations() {
    check_rows(PLANE, "pin(p, q)", "q - p");
    check_rows(PLANE, "pin(ground.at([l, 0]), q)", "q - [l, 0]");
    check_rows(PLANE, "slot(p, q, [1, 0])", "inner(a.along([0, 1]), q - p)");
    check_rows(
        PLANE,
        "slot(p, q, [0, 2])",
        "inner(a.along([-1, 0]), q - p)",
    );
    check_rows(PLANE, "turn(a, b)", "b.angle - a.angle");
    check_rows(PLANE, "gear(a, b, r, s)", "r * a.angle + s * b.angle");
    check_rows(
        PLANE,
        "gear(a, ground, r, s, b)",
        "r * (a.angle - b.angle) - s * b.angle",
    );
    check_rows(PLANE, "rod(p, q, l)", "sq(q - p) - sq(l)");
    check_rows(
        PLANE,
        "slider(p, q, [1, 0])",
        "[inner(a.along([0, 1]), q - p), b.angle - a.angle]",
    );
    check_rows(
        PLANE,
        "weld(p, q, r)",
        "[q[0] - p[0], q[1] - p[1], b.angle - a.angle - r]",
    );
    let roll = "inner(a.along([1, 0]), q - p) + r * (b.angle - a.angle)";
    check_rows(PLANE, "rack(p, q, [3, 0], r)", roll);
    let height = "inner(a.along([0, 1]), q - p) - r";
    check_rows(
        PLANE,
        "wheel(p, q, [3, 0], r)",
        &format!("[{height}, {roll}]"),
    );
}

#[test]
fn spatial_joints_are_equations() {
    check_rows(SPACE, "ball(p, q)", "q - p");
    check_rows(SPACE, "rod(p, q, l)", "sq(q - p) - sq(l)");
    let apart = "q[0] - p[0], q[1] - p[1], q[2] - p[2]";
    let across = |u: &str, w: &str| format!("inner(a.along({u}), b.along({w}))");
    let (x, y, z) = ("[1, 0, 0]", "[0, 1, 0]", "[0, 0, 1]");
    let hinge = format!("[{apart}, {}, {}]", across(x, z), across(y, z));
    check_rows(SPACE, "hinge(p, q, [0, 0, 2])", &hinge);
    let turned = format!("[{apart}, {}, {}]", across(x, y), across(y, y));
    check_rows(SPACE, "hinge(p, q, [0, 0, 1], [0, 1, 0])", &turned);
    let universal = format!("[{apart}, {}]", across(x, z));
    check_rows(SPACE, "universal(p, q, [1, 0, 0], [0, 0, 1])", &universal);
    let place = format!("inner(a.along({x}), q - p), inner(a.along({y}), q - p)");
    let cylinder = format!("[{place}, {}, {}]", across(x, z), across(y, z));
    check_rows(SPACE, "cylinder(p, q, [0, 0, 1])", &cylinder);
    let fixed = format!("{}, {}, {}", across(x, y), across(y, z), across(z, x));
    check_rows(SPACE, "weld(p, q)", &format!("[{apart}, {fixed}]"));
    check_rows(
        SPACE,
        "slider(p, q, [0, 0, 1])",
        &format!("[{place}, {fixed}]"),
    );
    let driven = "inner(a.along([-sin(t), cos(t), 0]), b.along([1, 0, 0]))";
    check_rows(SPACE, "drive(a, b, [0, 0, 1], t)", driven);
}

#[test]
fn what_acts_is_energies_and_generalised_forces() {
    // Pictures differ: only joints and what acts tell where bodies are joined.
    let both = |entries: &str, sections: &str| {
        check(
            &format!("{PLANE} forces {{ {entries} }} draw {{ }}"),
            &format!("{PLANE} {sections} draw {{ }}"),
        );
    };
    both(
        "spring(p, q, l, s)",
        "potential { 0.5 * l * sq(norm(q - p) - s) }",
    );
    both(
        "turning_spring(a, b, l, s)",
        "potential { 0.5 * l * sq(b.angle - a.angle - s) }",
    );
    both("torque(b, s)", "force { b.angle: s }");
    both(
        "torque(a, b, s * t)",
        "force { a.angle: -s * t, b.angle: s * t }",
    );
    both(
        "turning_damper(ground, b, s)",
        "force { b.angle: -s * b.omega }",
    );
    let drag = "-s * (b.omega - a.omega)";
    both(
        "turning_damper(a, b, s)",
        &format!("force {{ a.angle: -({drag}), b.angle: {drag} }}"),
    );
    both("force(b.at([0, 0]), [s, l])", "force { b.x: s, b.y: l }");
    check(
        &format!("{PLANE} dissipation {{ s * t * dot(b.x) }}"),
        &format!("{PLANE} force {{ b.x: -s * t }}"),
    );
    check(
        &format!("{PLANE} gravity {{ [0, -9.81, 0] }}"),
        &format!("{PLANE} gravity {{ [0, -9.81] }}"),
    );
    check(
        &format!("{PLANE} gravity {{ [0, -9.81] }}"),
        &format!("{PLANE} potential {{ 9.81 * a.y + 3 * 9.81 * b.y }}"),
    );
}

/// Operations of the straight-line solve, and of M, Q, c, A and b.
fn operations(source: &str) -> [Operations; 3] {
    let costs = analysis(format!("pub T {{ {source} }}").parse().expect("tokens")).costs;
    [costs.dynamics, costs.acceleration, costs.correction]
}

#[test]
fn bodies_cost_what_coordinates_by_hand_cost() {
    let chain = |n: usize| {
        format!("const N: usize = {n}; params {{ m = 1.0, j = 0.1, l = 1.0, g = 9.81 }}")
    };
    let bodies = "bodies { for i in 0..N { planar link[i] { mass: m, inertia: j, centre: [l / 2, 0] } } } gravity { [0, -g] } \
        holonomic { top: pin(ground.at([0, 0]), link[0].at([0, 0])); \
        for i in 0..N - 1 { knee[i]: pin(link[i].at([l, 0]), link[i + 1].at([0, 0])) } }";
    let by_hand = "coords { for i in 0..N { x[i], y[i], th[i] } } mass { x: m, y: m, th: j } potential { for i in 0..N { m * g * y[i] } } \
        let end = |i, s| [x[i] + s * l / 2 * cos(th[i]), y[i] + s * l / 2 * sin(th[i])]; \
        holonomic { top: end(0, -1) = 0; for i in 0..N - 1 { knee[i]: end(i + 1, -1) = end(i, 1) } }";
    for n in [1, 2, 6] {
        let head = chain(n);
        assert_eq!(
            operations(&format!("{head} {bodies}")),
            operations(&format!("{head} {by_hand}")),
            "{n} links"
        );
    }
    let slider = "params { r = 1.0, l = 3.0, m = 1.0, j = 0.1, g = 9.81 }";
    let bodies = "bodies { planar crank { mass: m, inertia: j, centre: [r / 2, 0] } planar rod { mass: m, inertia: j, centre: [l / 2, 0] } \
        planar piston { mass: m } } gravity { [0, -g] } holonomic { main: pin(ground.at([0, 0]), crank.at([0, 0])), \
        big: pin(crank.at([r, 0]), rod.at([0, 0])), small: pin(rod.at([l, 0]), piston.at([0, 0])), \
        bore: slider(ground.at([0, 0]), piston.at([0, 0]), [1, 0]) }";
    let by_hand = "coords { x1, y1, a, x2, y2, b, x3, y3, c } mass { x1: m, y1: m, a: j, x2: m, y2: m, b: j, x3: m, y3: m } \
        potential { m * g * (y1 + y2 + y3) } holonomic { main: [x1 - r / 2 * cos(a), y1 - r / 2 * sin(a)] = 0, \
        big: [x2 - l / 2 * cos(b), y2 - l / 2 * sin(b)] = [x1 + r / 2 * cos(a), y1 + r / 2 * sin(a)], \
        small: [x3, y3] = [x2 + l / 2 * cos(b), y2 + l / 2 * sin(b)], bore: [y3, c] = 0 }";
    let [of_bodies, of_hand] = [bodies, by_hand].map(|s| operations(&format!("{slider} {s}")));
    assert_eq!(of_bodies, of_hand);
}

#[test]
fn bodies_have_names_arguments_and_indices() {
    let head = "params { l = 2.0 } bodies { for i in 0..2 { for j in 0..2 { planar leg[i][j] { mass: 1 + i, inertia: 1 + j } } } planar a { \
        mass: 1, inertia: 1 } }";
    let same = |short: &str, long: &str| {
        check(
            &format!("{head} {short} draw {{ }}"),
            &format!("{head} {long} draw {{ }}"),
        )
    };
    let long = "holonomic { c: pin(a.at([0, 0]), leg[1][0].at([l, 0])) }";
    same(
        "let tip = |i, j| leg[i][j].at([l, 0]); holonomic { c: pin(a.at([0, 0]), tip(1, 0)) }",
        long,
    );
    same(
        "let at = |i, j| leg[i][j].at([l, 0]); holonomic { c: pin(a.at([0, 0]), at(1, 0)) }",
        long,
    );
    same(
        "let own = leg[1][0]; holonomic { c: pin(a.at([0, 0]), own.at([l, 0])) }",
        long,
    );
    same(
        "let { for i in 0..2 { own[i] = leg[i][0] } } holonomic { c: pin(a.at([0, 0]), own[1].at([l, 0])) }",
        long,
    );
    same(
        "let hook = |body| pin(a.at([0, 0]), body.at([l, 0])); holonomic { c: hook(leg[1][0]) }",
        long,
    );
    // Parts mean what they say, whatever functions are called.
    check_rows(
        &format!("{head} let inner = |u, v| 7 * t; let normal = |v| v; let b = leg[1][0];"),
        "slot(a.at([0, 0]), b.at([l, 0]), [1, 0])",
        "cross(a.along([1, 0]), b.at([l, 0]) - a.at([0, 0]))",
    );
    let tip = "let _tip = (leg[1][0]).at([l, 0]);";
    same(
        &format!("{tip} force {{ a.x: _tip.x * _tip.angle }}"),
        &format!("{tip} force {{ a.x: leg[1][0].x * leg[1][0].angle }}"),
    );
}

#[test]
fn operations_are_linear_in_bodies() {
    let count = |n: usize| {
        let [dynamics, acceleration, _] = operations(&format!(
            "const N: usize = {n}; bodies {{ planar link[N] {{ mass: 1, inertia: 0.1, centre: [0.5, 0] }} }} gravity {{ [0, -9.81] }} \
             holonomic {{ top: pin(ground.at([0, 0]), link[0].at([0, 0])); \
             for i in 0..N - 1 {{ knee[i]: pin(link[i].at([1, 0]), link[i + 1].at([0, 0])) }} }}"
        ));
        [dynamics, acceleration].map(|o| o.counts().iter().sum::<usize>())
    };
    let ([d8, _], [d16, a16], [d24, a24], [_, a32]) = (count(8), count(16), count(24), count(32));
    assert_eq!(d16 - d8, d24 - d16, "M, Q, c, A and b");
    assert!(a32 - a24 <= (a24 - a16) * 11 / 10, "{a16} {a24} {a32}");
}

#[test]
fn names_of_coordinates_and_rows() {
    let (system, model) = system(
        "pub T { bodies { for i in 0..2 { planar link[i] { mass: 1, inertia: 1 }, spatial cube[i] { mass: 1, inertia: [1, 1, 1] } } } \
         holonomic { c: pin(link[0].at([1, 0]), link[1].at([0, 0])), d: ball(cube[0].at([1, 0, 0]), cube[1].at([0, 0, 0])) } }",
    );
    let names = coordinates(&model);
    assert_eq!(
        names[..6],
        [
            "link[0].x",
            "link[0].y",
            "link[0].angle",
            "link[1].x",
            "link[1].y",
            "link[1].angle"
        ]
    );
    assert_eq!(
        names[6..13],
        [
            "cube[0].x",
            "cube[0].y",
            "cube[0].z",
            "cube[0].e0",
            "cube[0].e1",
            "cube[0].e2",
            "cube[0].e3"
        ]
    );
    let rows: Vec<String> = system.constraints.iter().map(|c| c.item.text()).collect();
    assert_eq!(
        rows,
        [
            "cube[0].unit",
            "cube[1].unit",
            "c.x",
            "c.y",
            "d.x",
            "d.y",
            "d.z"
        ]
    );
}

cases! {
    check_errors;
    kind_of_a_body: "bodies { «plane» a { mass: 1 } }" => "a body is `planar` or `spatial`, not `plane`";
    body_without_braces: "bodies { planar «a» } coords { x } mass { x: 1.0 }" => "a body needs what it consists of";
    part_of_a_body: "bodies { planar a { «mas»: 1, inertia: 1 } }" => "a body has no `mas`; did you mean `mass`?";
    part_twice: "bodies { planar a { mass: 1, «mass»: 2, inertia: 1 } }" => "`mass` is given twice";
    bodies_in_a_vector: "bodies { planar a[2] { mass: 1, inertia: 1 } } let { for i in 0..2 { b[i] = a[i] } } force { a[0].x: «b» }" => "`b` is no vector";
    body_in_a_sum: "bodies { planar a { mass: 1, inertia: 1 } } force { a.x: 1 + 2 * «a» }" => "`a` is a body";
    body_as_a_number: "bodies { planar a { mass: 1, inertia: 1 } } force { a.x: sin(«a») }" => "`a` is a body";
    bodies_in_brackets: "bodies { planar a { mass: 1, inertia: 1 } } force { a.x: norm([«a», «a»]) }" => "`a` is a body", "`a` is a body";
    body_as_a_value: "bodies { planar a { mass: 1, inertia: 1 } } force { a.x: «a» }" => "`a` is a body; choose a point of it";
    body_as_a_point: "bodies { planar a { mass: 1, inertia: 1 } } holonomic { c: pin(ground.at([0, 0]), «a») }" => "`q` of `pin(p, q)` is a point of a body, such as `link.at([0, 0])` or `ground.at([0, 0])`, found the body `a`";
    vector_as_a_point: "bodies { planar a { mass: 1, inertia: 1 } } holonomic { c: pin(«[0, 0]», a.at([0, 0])) }" => "found a vector of 2";
    family_of_bodies: "bodies { planar a[3] { mass: 1, inertia: 1 } } force { a[0].x: «a».angle }" => "`a` is a family of bodies; choose a member, `a[0]` to `a[2]`";
    body_out_of_range: "bodies { planar a[3] { mass: 1, inertia: 1 } } force { a[0].x: a[«3»].angle }" => "index 3 is out of range: `a` has 3 members";
    index_of_one_body: "bodies { planar a { mass: 1, inertia: 1 } } force { a.x: a[«0»].angle }" => "`a` is one body";
    unknown_field: "bodies { planar a { mass: 1, inertia: 1 } } force { a.x: a.«angel» }" => "body `a` has no `angel`; did you mean `angle`?";
    field_of_the_ground: "bodies { planar a { mass: 1, inertia: 1 } } force { a.x: ground.«x» }" => "the ground has no `x`";
    field_of_a_number: "params { m = 1.0 } coords { x } mass { x: m.«kg» }" => "no fields here";
    unknown_coordinate_of_a_body: "bodies { planar a { mass: 1, inertia: 1 } } force { a.«z»: 1 }" => "body `a` has no coordinate `z`; they are `x`, `y`, `angle`";
    body_as_a_coordinate: "bodies { planar a { mass: 1, inertia: 1 } } force { «a»: 1 }" => "`a` is a body; choose a coordinate of it: `x`, `y`, `angle`";
    field_of_a_coordinate: "coords { x } mass { x: 1 } force { x.«y»: 1 }" => "no fields here; a coordinate is written by its name alone";
    length_of_a_point: "bodies { planar a { mass: 1, inertia: 1 } } output { o = a.at(«[1, 0, 0]») }" => "`a.at` takes a vector of 2, found a vector of 3";
    point_of_a_number: "coords { x } mass { x: 1 } output { o = «x».at([1, 0]) }" => "`at` is of a body, found a number";
    spatial_joint_in_the_plane: "bodies { planar a { mass: 1, inertia: 1 } } holonomic { c: «hinge»(ground.at([0, 0]), a.at([0, 0]), [0, 0, 1]) }" => "`hinge` joins spatial bodies: `hinge(p, q, u, [w])`; these are in the plane";
    arguments_of_a_joint: "bodies { planar a { mass: 1, inertia: 1 } } holonomic { c: «rod»(ground.at([0, 0]), a.at([0, 0])) }" => "it is written `rod(p, q, l)`, found 2 arguments";
    rod_of_no_length: "bodies { planar a { mass: 1, inertia: 1 } } holonomic { c: rod(ground.at([0, 0]), a.at([0, 0]), «0.0») }" => "`l` of `rod(p, q, l)` must not be zero; what keeps two points together is `pin(p, q)`";
    rod_of_no_length_in_space: "bodies { spatial a { mass: 1, inertia: [1, 1, 1] } } holonomic { c: rod(ground.at([0, 0, 0]), a.at([0, 0, 0]), «0») }" => "what keeps two points together is `ball(p, q)`";
    rod_of_a_vector: "bodies { planar a { mass: 1, inertia: 1 } } holonomic { c: rod(ground.at([0, 0]), a.at([0, 0]), «[1, 0]») }" => "`l` of `rod(p, q, l)` is a number, found a vector of 2";
    direction_zero: "bodies { planar a { mass: 1, inertia: 1 } } holonomic { c: slot(ground.at([0, 0]), a.at([0, 0]), «[0, 0]») }" => "`d` of `slot(p, q, d)` is a direction; it must not be zero";
    unknown_joint_twice: "bodies { planar a { mass: 1, inertia: 1 } } holonomic { c: «pim»(ground.at([0, 0]), a.at([0, 0])), d: pim(ground.at([0, 0]), a.at([1, 0])) }" => "unknown function `pim`; did you mean `pin`?";
    no_joint_of_a_like_name: "bodies { planar a { mass: 1, inertia: 1 } } holonomic { c: «clutch»(ground.at([0, 0]), a.at([0, 0])) }" => "unknown function `clutch`; joints are `ball`, `cylinder`, `disc`";
    joint_in_error_with_reactions: "bodies { planar a { mass: 1, inertia: 1 } } holonomic { c: «pim»(ground.at([0, 0]), a.at([0, 0])) } output { f = norm(reaction(c)), x = reaction(c.x), m = moment(c) }" => "unknown function `pim`; did you mean `pin`?";
    joint_twice: "bodies { planar a { mass: 1, inertia: 1 } planar b { mass: 1, inertia: 1 } } holonomic { c: pin(a.at([1, 0]), b.at([0, 0])), «d»: pin(a.at([1, 0]), b.at([0, 0])) }" => "constraint `d` is the same equation as `c`; remove one";
    component_twice: "coords { x, y, z } mass { x: 1, y: 1, z: 1 } holonomic { c: [x, y] = [sin(z), cos(z)]  «d»: [x, z] = [sin(z), t] }" => "constraint `d[0]` is the same equation as `c[0]`; remove one";
    field_of_an_unknown_body: "bodies { planar arm { mass: 1, inertia: 1 } } output { o = «amr».x, p = amr.angle }" => "unknown name `amr`; did you mean `arm`?";
    parameter_of_a_struct: "params { m = 1.0 } bodies { planar arm { mass: self.«m», inertia: 1 } }" => "a parameter or coordinate is written by its name alone";
    vector_for_a_point: "bodies { spatial a { mass: 1, inertia: [1, 1, 1] } } holonomic { c: disc(«a.centre», [0, 0, 1], 0.1) }" => "`q` of `disc(q, u, r)` is a point of a body, such as";
    misspelt_body: "bodies { planar arm { mass: 1, inertia: 1 } } force { «rma».x: 1, rma.y: 1 } output { o = rma.x }" => "unknown name `rma`; did you mean `arm`?";
    no_body: "bodies { planar arm { mass: 1, inertia: 1 } } output { o = «other».x, p = other.y }" => "unknown name `other`; what has fields here is `arm`";
    function_as_a_constraint: "coords { x, y } mass { x: 1, y: 1 } holonomic { c: «norm([x, y])» }" => "a constraint is an equation: `lhs = rhs`";
    velocity_in_a_joint: "bodies { spatial a { mass: 1, inertia: [1, 1, 1] } } holonomic { c: «rolls(a.at([0, 0, 0]), [0, 0, 1], 1)» }" => "move the constraint under `nonholonomic`";
    joint_that_acts: "bodies { planar a { mass: 1, inertia: 1 } } forces { «pin»(ground.at([0, 0]), a.at([0, 0])) }" => "`pin` is a joint; it stands under `holonomic`";
    spring_in_an_equation: "bodies { planar a { mass: 1, inertia: 1 } } potential { «spring»(ground.at([0, 0]), a.at([0, 0]), 1, 1) }" => "`spring` acts with a force; it stands under `forces`";
    unknown_force: "bodies { planar a { mass: 1, inertia: 1 } } forces { «sprong»(a.at([0, 0]), a.at([0, 1]), 1, 1) }" => "nothing that acts is called `sprong`; did you mean `spring`?";
    force_on_a_coordinate: "bodies { planar a { mass: 1, inertia: 1 } } forces { a.x«:» 1 }" => "the force on a coordinate goes under `force`";
    sum_that_acts: "bodies { planar a { mass: 1, inertia: 1 } } forces { «1 + 2» }" => "what acts is written as one of `spring(p, q, k, l)`";
    force_on_the_ground: "bodies { planar a { mass: 1, inertia: 1 } } forces { «force(ground.at([0, 0]), [1, 1])» }" => "the ground does not move, so that this `force` does nothing; name a body";
    force_on_a_bead: "coords { s } mass { s: 1 } bodies { planar a { mass: 1, inertia: 1 } } forces { force(«a.at([s, 0])», [1, 1]) }" => "where this point is in `a` depends on `s`, and whether the force acts on `a` there or on what moves along with `s` is not told";
    force_on_moving_ground: "bodies { planar a { mass: 1, inertia: 1 } } forces { force(«ground.at([a.x, 0])», [1, 1]) }" => "a force on the ground moves nothing; one on what `a.x` moves is written `force { a.x: … }`";
    force_on_a_bead_of_the_tree: "bodies { planar a { mass: 1, inertia: 1 } planar b { mass: 1, inertia: 1 } } tree { sl: slider(a.at([0, 0]), b.at([0, 0]), [1, 0]) } forces { force(«a.at([sl.slide, 0])», [1, 1]) }" => "whether the force acts on `a` there or on what moves along with `sl.slide` is not told";
    force_between_moving_grounds: "bodies { planar a { mass: 1, inertia: 1 } } forces { force(«ground.at([a.x, 0])», a.at([0, 1]), 1) }" => "a force on the ground moves nothing; one on what `a.x` moves is written `force { a.x: … }`";
    force_of_a_number: "bodies { planar a { mass: 1, inertia: 1 } } forces { force(a.at([0, 0]), «1») }" => "`f` of `force(p, f)` is a vector of 2, found a number";
    spring_with_a_velocity: "bodies { planar a { mass: 1, inertia: 1 } } forces { «turning_spring(ground, a, dot(a.x), 0)» }" => "depends on coordinates and time only";
    gravity_without_bodies: "coords { x } mass { x: 1 } «gravity» { [0, -9.81] }" => "`gravity` is the weight of `bodies`, and there are none";
    gravity_of_a_place: "bodies { planar a { mass: 1, inertia: 1 } } gravity { [0, -«a».x] }" => "gravity is one vector for all places";
    gravity_in_space: "bodies { spatial a { mass: 1, inertia: [1, 1, 1] } } gravity { «[0, -1]» }" => "expected a vector of 3, found a vector of 2: `a` is spatial";
    gravity_across_the_plane: "params { g = 9.81 } bodies { planar a { mass: 1, inertia: 1 } } gravity { [0, 0, «-g»] }" => "planar bodies move along x and y: no weight of theirs acts along z; write `[0, -g]` where y points up";
    gravity_of_a_name_across_the_plane: "let w = [0, 0, -9.81]; bodies { planar a { mass: 1, inertia: 1 } } gravity { «w» }" => "planar bodies move along x and y";
    gravity_of_a_number: "bodies { planar a { mass: 1, inertia: 1 } } gravity { «-9.81» }" => "expected a vector of 2 or 3, found a number";
    mass_that_changes: "bodies { planar a { mass: 1 + «t», inertia: 1 } }" => "what a body consists of does not change";
    negative_inertia: "params { j = -1.0 } bodies { planar a { mass: 1, inertia: «j» } }" => "the inertia of a body must not be negative";
    massless_in_space: "bodies { spatial a { mass: «0», inertia: [1, 1, 1] } }" => "the mass of a spatial body must be positive: with its centre on the axis of a fixed hinge it is not felt; it is 0 where the inertia is `[0, 0, 0]`, too";
    inertia_about_a_hinge_alone: "params { j = 0.1 } bodies { spatial a { mass: «0», inertia: «[0, 0, j]» } } tree { h: hinge(ground.at([0, 0, 0]), a.at([0, 0, 0]), [0, 0, 1]) }" => "an inertia j about a hinge `h` alone is the term `0.5 * j * sq(dot(h.angle))` of `kinetic` then", "those about the others are j/2 at least, as of a disc: a body that turns about a hinge alone does not feel them";
    massless_link_in_space: "bodies { spatial a { mass: «0», inertia: [0, 0, 0] } } tree { j: ball(ground.at([0, 0, 0]), a.at([1, 0, 0])) }" => "the mass of a spatial body must be positive";
    body_with_itself: "bodies { planar a { mass: 1, inertia: 1 } } holonomic { c: «rod»(a.at([0, 0]), a.at([1, 0]), 1) }" => "`rod` joins two bodies; both of these are `a`";
    place_by_its_numbers: "bodies { planar a { mass: 1, inertia: 1 } } output { o = a.«at»(0, 0) }" => "`at` takes one vector: `body.at([1, 0])`";
    turning_joint_in_space: "bodies { spatial a { mass: 1, inertia: [1, 1, 1] } } holonomic { c: «turn»(ground, a) }" => "`turn` joins planar bodies: `turn(a, b)`; these are in space, where it is `drive`";
    no_inertia_in_space: "bodies { spatial «a» { mass: 1 } }" => "spatial body `a` has no inertia";
    inertia_of_one_number: "bodies { spatial a { mass: 1, inertia: «1» } }" => "the inertia of a spatial body is `[xx, yy, zz]`";
    inertia_of_a_thin_rod: "bodies { spatial a { mass: 1, inertia: «[0, 1, 1]» } }" => "must be positive definite; about its own axis a thin rod has a small moment";
    inertia_of_a_thin_rod_on_a_ball: "bodies { spatial a { mass: 1, inertia: «[0, 1, 1]» } } tree { j: ball(ground.at([0, 0, 0]), a.at([1, 0, 0])) }" => "it may be left out, as 0, where the rod hangs on a joint";
    inertia_of_no_thin_rod: "bodies { spatial a { mass: 1, inertia: «[0, 1, 2]» } } tree { j: universal(ground.at([0, 0, 0]), a.at([1, 0, 0]), [0, 1, 0], [0, 0, 1]) }" => "no rigid body has this inertia";
    inertia_of_nothing: "bodies { spatial a { mass: 1, inertia: «[0, 0, 1]» } } tree { j: universal(ground.at([0, 0, 0]), a.at([1, 0, 0]), [0, 1, 0], [0, 0, 1]) }" => "must be positive definite; where the moment about one axis is j, those about the others are j/2 at least, as of a disc";
    inertia_not_positive: "bodies { spatial a { mass: 1, inertia: «[1, 1, 1, 2, 0, 0]» } }" => "must be positive definite";
    inertia_of_no_body: "params { j = 3.0 } bodies { spatial a { mass: 1, inertia: «[1, 1, j]» } }" => "no rigid body has this inertia";
    inertia_not_symmetric: "bodies { spatial a { mass: 1, inertia: «[[1, 0.1, 0], [0, 1, 0], [0, 0, 1]]» } }" => "the inertia of a body is a symmetric matrix";
    planar_and_spatial: "bodies { planar a { mass: 1, inertia: 1 }, spatial «a» { mass: 1, inertia: [1, 1, 1] } }" => "`a` is declared twice";
    body_and_coordinate: "coords { a } mass { a: 1 } bodies { planar «a» { mass: 1, inertia: 1 } }" => "`a` is declared twice";
    coordinate_of_the_same_constant: "coords { a_x } mass { a_x: 1 } bodies { planar «a» { mass: 1, inertia: 1 } }" => "would both become the constant `A_X`";
    massless_body: "bodies { planar «a» { inertia: 1 } }" => "coordinates `a.x`, `a.y` have neither mass nor constraint";
    nothing_in_a_body: "bodies { planar «a» { } }" => "coordinates `a.x`, `a.y`, `a.angle` have neither mass nor constraint";
    semicolon_in_a_body: "bodies { planar a { mass: 1«;» inertia: 1 } }" => "expected identifier";
    equals_in_a_body: "bodies { planar a { mass «=» 1, inertia: 1 } }" => "here stands `:`, as in `mass: 1.0`";
    unknown_part_of_a_body: "bodies { planar a { mass: 1, «colour»: 1, inertia: 1 } }" => "a body has no `colour`; it has `mass`, `inertia` and `centre`";
    nothing_of_a_body: "bodies { planar a { mass: 1, inertia: 1 } } force { a.x: a.«colour» }" => "body `a` has no `colour`; it has `x`, `y`, `angle`";
    planar_and_spatial_members: "bodies { for i in 0..1 { planar a[i] { mass: 1, inertia: 1 } } for i in 1..2 { spatial «a»[i] { mass: 1, inertia: [1, 1, 1] } } }" => "`a` is declared planar and spatial; rename one";
    too_few_indices_of_a_body: "bodies { planar a[2][2] { mass: 1, inertia: 1 } } output { o = «a»[0].angle }" => "`a` is a family of bodies; choose a member, `a[0][0]` to `a[1][1]`";
    arguments_of_a_spring: "bodies { planar a { mass: 1, inertia: 1 } } forces { «spring»(ground.at([0, 0]), a.at([0, 0])) }" => "it is written `spring(p, q, k, l)`, found 2 arguments";
    torque_of_a_vector: "bodies { planar a { mass: 1, inertia: 1 } } forces { torque(a, «[1, 2]») }" => "is a number, found a vector of 2";
    torque_on_a_number: "bodies { planar a { mass: 1, inertia: 1 } } forces { torque(«a.angle», 1) }" => "is a body, found a number";
    radius_of_a_vector: "bodies { planar a { mass: 1, inertia: 1 } } holonomic { c: gear(ground, a, 1, «[1, 2]») }" => "is a number, found a vector of 2";
    rolling_in_the_plane: "bodies { planar a { mass: 1, inertia: 1 } } holonomic { c: «rolls»(a.at([0, 0]), [0, 1], 1) }" => "`rolls` joins spatial bodies: `rolls(q, u, r)`; these are in the plane, where it is `wheel`";
    unknown_joint: "bodies { planar a { mass: 1, inertia: 1 } } holonomic { c: «pinn»(ground.at([0, 0]), a.at([0, 0])) }" => "unknown function `pinn`; did you mean `pin`?";
}
