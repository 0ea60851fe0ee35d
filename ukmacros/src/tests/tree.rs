//! Bodies that hang on joints of the tree: what they cost, their names, and mistakes.

use super::errors::check as check_errors;
use super::{analysis, coordinates, system};

fn operations(source: &str) -> usize {
    let analysis = analysis(source.parse().expect("tokens"));
    assert!(analysis.solve.is_ok(), "a straight line");
    analysis.costs.acceleration.counts().iter().sum()
}

/// An arm as that of `arm!` in `tests/src/machines.rs`, whose velocities are written by hand.
#[test]
fn arms_of_the_tree_cost_what_they_cost_by_hand() {
    let arm = |n: usize| {
        operations(&format!(
            "pub Arm {{ const N: usize = {n}; params {{ m = 1.0, l = 0.5, inertia[3] = [0.01, 0.03, 0.03], g = 9.81 }} \
             let axis = [[0, 0, 1], [0, 1, 0], [0, 1, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]; \
             bodies {{ spatial link[N] {{ mass: m, inertia: inertia, centre: [l / 2, 0, 0] }} }} gravity {{ [0, 0, -g] }} \
             tree {{ joint[0]: hinge(ground.at([0, 0, 0]), link[0].at([0, 0, 0]), axis[0]); \
             for i in 1..N {{ joint[i]: hinge(link[i - 1].at([l, 0, 0]), link[i].at([0, 0, 0]), axis[i - 6 * (i / 6)]) }} }} }}"
        ))
    };
    let (six, twelve) = (arm(6), arm(12));
    assert!(six <= 1320 && twelve <= 4486, "{six}, {twelve}");
}

/// Two hinges and a weld between.
fn welded(turn: &str, axes: &str) -> usize {
    let body = "{ mass: 1, inertia: [0.1, 0.2, 0.3], centre: [0.5, 0, 0] }";
    operations(&format!(
        "pub T {{ bodies {{ spatial a {body} spatial b {body} spatial c {body} }} gravity {{ [0, 0, -9.81] }} \
         tree {{ h: hinge(ground.at([0, 0, 0]), a.at([0, 0, 0]), {axes}) k: weld(a.at([1, 0, 0]), b.at([0, 0, 0]), {turn}) \
         j: hinge(b.at([1, 0, 0]), c.at([0, 0, 0]), {axes}) }} }}"
    ))
}

/// About an axis that is askew in one body or in both.
#[test]
fn hinges_askew_cost_little_more_than_straight_ones() {
    let turn = "[[0, -1, 0], [1, 0, 0], [0, 0, 1]]";
    let cost = |axes: &str| welded(turn, axes);
    assert!(cost("[0, 0, 1]") <= 53);
    assert!(cost("[0.6, 0, 0.8], [0, 0, 1]") <= 100);
    assert!(cost("[1, 2, 3], [3, 1, 2]") <= 325);
}

#[test]
fn chains_of_the_tree_cost_what_they_have_bodies() {
    let chain = |n: usize| {
        operations(&format!(
            "pub Chain {{ const N: usize = {n}; params {{ m = 1.0, l = 0.5, j = 0.02, g = 9.81 }} \
             bodies {{ planar link[N] {{ mass: m, inertia: j, centre: [l / 2, 0] }} }} gravity {{ [0, -g] }} \
             tree {{ base: pin(ground.at([0, 0]), link[0].at([0, 0])); \
             for i in 1..N {{ joint[i]: pin(link[i - 1].at([l, 0]), link[i].at([0, 0])) }} }} }}"
        ))
    };
    let counts = [4, 8, 12].map(chain);
    assert!(
        10 * (counts[2] - counts[1]) <= 14 * (counts[1] - counts[0]),
        "{counts:?}"
    );
}

#[test]
fn coordinates_of_bodies_and_joints_stand_in_order() {
    let (system, model) = system(
        "pub T { bodies { planar base { mass: 1, inertia: 1 } for i in 0..4 { spatial arm[i] { mass: 1, inertia: [1, 1, 1] } } } coords { x } \
         mass { x: 1 } tree { for i in 1..3 { joint[i]: hinge(arm[i - 1].at([1, 0, 0]), arm[i].at([0, 0, 0]), [0, 0, 1]) } \
         last[7]: cylinder(ground.at([0, 0, 0]), arm[3].at([0, 0, 0]), [0, 0, 1]) } force { joint[1].angle: dot(joint[2].angle), last[7].slide: 1 } }",
    );
    let names = coordinates(&model);
    let bodies = [
        "x",
        "base.x",
        "base.y",
        "base.angle",
        "arm[0].x",
        "arm[0].y",
        "arm[0].z",
        "arm[0].e0",
        "arm[0].e1",
        "arm[0].e2",
        "arm[0].e3",
    ];
    assert_eq!(names[..11], bodies);
    assert_eq!(
        names[11..],
        [
            "joint[1].angle",
            "joint[2].angle",
            "last[7].slide",
            "last[7].angle"
        ]
    );
    assert_eq!(system.force.keys().copied().collect::<Vec<_>>(), [11, 13]);
    let families: Vec<String> = model.coords.iter().map(|f| f.name.to_string()).collect();
    assert!(
        families.contains(&"joint_1_angle".to_owned()),
        "{families:?}"
    );
}

/// Bodies of the tree are drawn from joint to joint, as others are.
#[test]
fn pictures_know_joints_of_the_tree() {
    let bodies = "pub T { bodies { planar a { mass: 1, inertia: 1 } planar b { mass: 1, inertia: 1, centre: [0.5, 0] } }";
    let joints =
        "{ c: pin(ground.at([0, 0]), a.at([0, 0])), d: pin(a.at([1, 0]), b.at([0, 0])) } }";
    let kinds = |section: &str| {
        let (system, _) = system(&format!("{bodies} {section} {joints}"));
        let shapes = system.drawing.shapes.iter();
        let kinds = shapes.map(|shape| (format!("{:?}", shape.kind), shape.numbers.len()));
        kinds.collect::<Vec<_>>()
    };
    assert_eq!(kinds("tree"), kinds("holonomic"));
    assert_eq!(kinds("tree").len(), 3);
}

cases! {
    check_errors;
    no_call: "bodies { planar a { mass: 1, inertia: 1 } } tree { c: «a» }" => "a joint of the tree is written `name: pin(p, q)`; joints of the tree are `pin`";
    no_name: "bodies { planar a { mass: 1, inertia: 1 } } tree { «pin»(ground.at([0, 0]), a.at([0, 0])) }" => "a joint needs a name";
    no_joint: "bodies { planar a { mass: 1, inertia: 1 } } tree { c: «pinn»(ground.at([0, 0]), a.at([0, 0])) }" => "no joint of the tree is called `pinn`; did you mean `pin`?";
    too_few_indices: "bodies { planar a[2][2] { mass: 1, inertia: 1 } } tree { c: pin(ground.at([0, 0]), «a[0]».at([0, 0])) }" => "bodies of `a` take 2 indices";
    rod_in_the_tree: "bodies { planar a { mass: 1, inertia: 1 } } tree { c: «rod»(ground.at([0, 0]), a.at([0, 0]), 1) }" => "no joint of the tree is called `rod`";
    equation_in_the_tree: "bodies { planar a { mass: 1, inertia: 1 } } tree { c: pin(ground.at([0, 0]), a.at([0, 0])) «=» t }" => "a joint of the tree says what is free, and has no `=`";
    one_argument: "bodies { planar a { mass: 1, inertia: 1 } } tree { c: «pin»(a.at([0, 0])) }" => "a joint of the tree joins points of two bodies";
    unknown_body: "bodies { planar arm { mass: 1, inertia: 1 } } tree { c: pin(ground.at([0, 0]), «arn».at([0, 0])) }" => "`arn` is not a body; did you mean `arm`?";
    body_by_a_name: "bodies { planar a { mass: 1, inertia: 1 } } let p = a.at([0, 0]); tree { c: pin(ground.at([0, 0]), «p») }" => "a joint of the tree names its bodies where it stands";
    ground_hangs: "bodies { planar a { mass: 1, inertia: 1 } } tree { c: pin(a.at([0, 0]), «ground.at([0, 0])») }" => "hangs on it, which the ground does not";
    hangs_twice: "bodies { planar a { mass: 1, inertia: 1 } } tree { c: pin(ground.at([0, 0]), a.at([0, 0])), d: pin(ground.at([1, 0]), «a.at([1, 0])») }" => "`a` hangs on the joint `c` already; what closes a loop goes under `holonomic`";
    hangs_on_itself: "bodies { planar a { mass: 1, inertia: 1 } } tree { c: pin(a.at([0, 0]), «a.at([1, 0])») }" => "`a` cannot hang on itself";
    circle: "bodies { planar a[3] { mass: 1, inertia: 1 } } tree { for i in 0..3 { c[i]: pin(a[i].at([0, 0]), «a[i + 1 - 3 * ((i + 1) / 3)].at([1, 0])») } }" => "hangs on itself by other joints";
    planar_in_space: "bodies { spatial a { mass: 1, inertia: [1, 1, 1] } } tree { c: «pin»(ground.at([0, 0, 0]), a.at([0, 0, 0])) }" => "`pin` joins planar bodies; in space joints of the tree are `ball`";
    plane_and_space: "bodies { planar a { mass: 1, inertia: 1 } spatial b { mass: 1, inertia: [1, 1, 1] } } tree { c: ball(«a.at([0, 0])», b.at([0, 0, 0])) }" => "`a` is planar and `b` is spatial";
    length_of_the_first_point: "bodies { spatial a { mass: 1, inertia: [1, 1, 1] } } tree { c: ball(ground.at(«[0, 0]»), a.at([0, 0, 0])) }" => "expected a vector of 3, found a vector of 2";
    arguments_of_a_hinge: "bodies { spatial a { mass: 1, inertia: [1, 1, 1] } } tree { c: «hinge»(ground.at([0, 0, 0]), a.at([0, 0, 0])) }" => "it is written `hinge(p, q, u, [w])`, found 2 arguments";
    direction_zero: "bodies { spatial a { mass: 1, inertia: [1, 1, 1] } } tree { c: hinge(ground.at([0, 0, 0]), a.at([0, 0, 0]), «[0, 0, 0]») }" => "is a direction; it must not be zero";
    no_rotation: "bodies { spatial a { mass: 1, inertia: [1, 1, 1] } } tree { c: weld(ground.at([0, 0, 0]), a.at([0, 0, 0]), «[[1, 0, 0], [0, 1, 0], [0, 0, 2]]») } coords { x } mass { x: 1 }" => "`turn` of a joint of the tree is a rotation";
    point_that_moves: "bodies { planar a { mass: 1, inertia: 1 } } tree { c: pin(ground.at([«t», 0]), a.at([0, 0])) }" => "where a joint of the tree sits does not change";
    point_of_itself: "bodies { planar a { mass: 1, inertia: 1 } } coords { x } mass { x: 1 } tree { c: weld(ground.at(«a».centre), a.at([0, 0])) }" => "where `a` sits cannot depend on `a` itself";
    joint_as_a_value: "bodies { planar a { mass: 1, inertia: 1 } } tree { c: pin(ground.at([0, 0]), a.at([0, 0])) } force { c.angle: «c» }" => "`c` is a joint of the tree; its coordinates are `c.angle`";
    unknown_coordinate: "bodies { planar a { mass: 1, inertia: 1 } } tree { c: pin(ground.at([0, 0]), a.at([0, 0])) } force { c.«angel»: 1 }" => "joint `c` has no coordinate `angel`; did you mean `angle`?";
    coordinate_of_a_body_that_hangs: "bodies { planar a { mass: 1, inertia: 1 } } tree { c: pin(ground.at([0, 0]), a.at([0, 0])) } force { a.«angle»: 1 }" => "`a` hangs on a joint of the tree: its coordinates are those of the joint, `c.angle`; what acts on it goes under `forces`";
    start_of_a_body_that_hangs: "bodies { planar a { mass: 1, inertia: 1 } } tree { c: pin(ground.at([0, 0]), a.at([0, 0])) } start s { a.«angle» = 1 }" => "`a` hangs on a joint of the tree: a start gives the coordinates of the joint, `c.angle`";
    turning_of_a_body_that_hangs: "bodies { spatial a { mass: 1, inertia: [1, 1, 1] } } tree { c: hinge(ground.at([0, 0, 0]), a.at([0, 0, 0]), [1, 0, 0]) } start s { a.«spin» = [1, 0, 0] }" => "a start gives the coordinates of the joint, `c.angle` and their rates by `dot`, no `spin` of the body";
    quaternion_of_a_body_that_hangs: "bodies { spatial a { mass: 1, inertia: [1, 1, 1] } } tree { c: ball(ground.at([0, 0, 0]), a.at([0, 0, 0])) } output { o = a.«e0» }" => "has no quaternion; its orientation is `a.axes`";
    joint_twice: "bodies { planar a[2] { mass: 1, inertia: 1 } } tree { for i in 0..2 { «c»: pin(ground.at([0, 0]), a[i].at([0, 0])) } }" => "`c` is declared twice; in a loop, index it: `c[i]`";
    joint_and_constraint: "bodies { planar a { mass: 1, inertia: 1 } } tree { c: pin(ground.at([0, 0]), a.at([0, 0])) } holonomic { «c»: a.x = t }" => "`c` is declared twice";
    joint_and_body: "bodies { planar a { mass: 1, inertia: 1 } } tree { «a»: pin(ground.at([0, 0]), a.at([0, 0])) }" => "`a` is declared twice";
    member_without_the_coordinate: "bodies { planar a[2] { mass: 1, inertia: 1 } } tree { c[0]: pin(ground.at([0, 0]), a[0].at([0, 0])), c[1]: slider(ground.at([0, 0]), a[1].at([0, 0]), [1, 0]) } force { «c[1].angle»: 1 }" => "`c[1]` has no coordinate `angle`";
    member_out_of_range: "bodies { planar a { mass: 1, inertia: 1 } } tree { c[0]: pin(ground.at([0, 0]), a.at([0, 0])) } force { c[«1»].angle: 1 }" => "index 1 is out of range";
    mass_beside_the_tree: "bodies { planar a { mass: 1, inertia: 1 } } tree { c: pin(ground.at([0, 0]), a.at([0, 0])) } coords { x } mass { «x»: 1 + t }" => "beside spatial bodies and those of a tree a mass that changes goes under `kinetic`";
}
