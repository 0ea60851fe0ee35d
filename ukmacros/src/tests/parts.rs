//! Declarations within declarations: the whole is what it would be if all stood in it, and mistakes are told where the part is declared.

use super::errors::check_after;
use super::{coordinates, expand, system};
use ukalgebra::expr::{Id, Point, eval};

const LEG: &str = "@parts [{ Leg } { pub Leg { const N: usize = 2; params { l = 0.5, m[2] = [1.0, 2.0], k = 2 * l } \
    bodies { for i in 0..N { planar shin[i] { mass: m[i], inertia: 0.1, centre: [l / 2, 0] } } } gravity { [0, -1] } \
    let tip = shin[1].at([l, 0]); let turn = |i, a| a * shin[i].along([1, 0]); \
    holonomic { knee: pin(shin[0].at([l, 0]), shin[1].at([0, 0])) } forces { turning_spring(shin[0], shin[1], k, 0) } \
    output { tip = tip + turn(0, 0.1) } } } { }]";

#[test]
fn parts_are_what_stands_in_them() {
    let (parts, model) = system(&format!(
        "{LEG} pub Walker {{ params {{ size = 0.7, m = 3.0 }} bodies {{ planar trunk {{ mass: m, inertia: 1 }} }} gravity {{ [0, -9.81] }} \
         parts {{ for i in 0..2 {{ leg[i]: Leg {{ l: size + i / 10.0 }} }} tail: Leg }} \
         holonomic {{ for i in 0..2 {{ hip[i]: pin(trunk.at([i, 0]), leg[i].shin[0].at([0, 0])) }} base: pin(trunk.at([0, 1]), tail.shin[0].at([0, 0])) }} \
         force {{ leg[1].shin[0].angle: 1.0, tail.shin[1].x: leg[0].m[1] }} output {{ reach = norm(leg[1].tip - trunk.centre) + tail.l }} }}"
    ));
    let (whole, same) = system(
        "pub Walker { params { size = 0.7, m = 3.0, lm[2] = [1.0, 2.0], tl = 0.5, tm[2] = [1.0, 2.0], tk = 2 * tl } bodies { planar trunk { mass: m, inertia: 1 } \
         for i in 0..2 { planar a[i] { mass: lm[i], inertia: 0.1, centre: [size / 2, 0] } } \
         for i in 0..2 { planar b[i] { mass: lm[i], inertia: 0.1, centre: [(size + 0.1) / 2, 0] } } \
         for i in 0..2 { planar c[i] { mass: tm[i], inertia: 0.1, centre: [tl / 2, 0] } } } gravity { [0, -9.81] } \
         holonomic { hip0: pin(trunk.at([0, 0]), a[0].at([0, 0])) hip1: pin(trunk.at([1, 0]), b[0].at([0, 0])) base: pin(trunk.at([0, 1]), c[0].at([0, 0])) \
         k0: pin(a[0].at([size, 0]), a[1].at([0, 0])) k1: pin(b[0].at([size + 0.1, 0]), b[1].at([0, 0])) k2: pin(c[0].at([tl, 0]), c[1].at([0, 0])) } \
         forces { turning_spring(a[0], a[1], 2 * size, 0) turning_spring(b[0], b[1], 2 * (size + 0.1), 0) turning_spring(c[0], c[1], tk, 0) } \
         force { b[0].angle: 1.0, c[1].x: lm[1] } output { reach = norm(b[1].at([size + 0.1, 0]) - trunk.centre) + tl, \
         ta = a[1].at([size, 0]) + 0.1 * a[0].along([1, 0]), tb = b[1].at([size + 0.1, 0]) + 0.1 * b[0].along([1, 0]), tc = c[1].at([tl, 0]) + 0.1 * c[0].along([1, 0]) } }",
    );
    let n = model.coord_elements.len();
    assert_eq!(n, same.coord_elements.len());
    let (q, v): (Vec<f64>, Vec<f64>) = (0..n)
        .map(|i| 1.7 * i as f64)
        .map(|x| (x.sin(), x.cos()))
        .unzip();
    let values = |system: &ukalgebra::expr::System| -> Vec<f64> {
        let mut ids: Vec<Id> = system.constraints.iter().map(|c| c.phi).collect();
        ids.extend(system.potential);
        ids.extend(system.mass.values().map(|(m, _)| *m));
        ids.extend(system.force.values());
        ids.extend(system.outputs.iter().map(|o| o.value));
        let point = Point {
            t: 0.3,
            q: &q,
            v: &v,
            params: &system.defaults,
            ..Point::NOWHERE
        };
        eval(&system.graph, &ids, &point)
    };
    let (found, expected) = (values(&parts), values(&whole));
    assert_eq!(found.len(), expected.len());
    for (a, b) in found.iter().zip(&expected) {
        assert!((a - b).abs() < 1e-13, "{found:?} is not {expected:?}");
    }
    let names = coordinates(&model);
    assert_eq!(
        names[3..7],
        [
            "leg[0].shin[0].x",
            "leg[0].shin[0].y",
            "leg[0].shin[0].angle",
            "leg[0].shin[1].x"
        ]
    );
    assert_eq!(names[15], "tail.shin[0].x");
    let rows: Vec<String> = parts.constraints.iter().map(|c| c.item.text()).collect();
    assert_eq!(
        rows[6..],
        [
            "leg[0].knee.x",
            "leg[0].knee.y",
            "leg[1].knee.x",
            "leg[1].knee.y",
            "tail.knee.x",
            "tail.knee.y"
        ]
    );
    let params: Vec<&str> = model
        .param_elements
        .iter()
        .map(|p| p.name.as_str())
        .collect();
    assert_eq!(
        params,
        [
            "size",
            "m",
            "leg.m[0]",
            "leg.m[1]",
            "tail.l",
            "tail.m[0]",
            "tail.m[1]",
            "tail.k"
        ]
    );
}

#[test]
fn open_parameters_of_parts_of_parts_are_known_in_families() {
    const TRAIN: &str = "@parts [{ Train } { pub Train { params { k = 3 } parts { st[2]: Stage { j: 2 } } force { st[1].a: st[1].c * k } output { one = st[1].c + st[0].n[1], given = st[1].j } } } \
        { { Stage } { pub Stage { const N: usize = 2; params { j = 0.1, c = 0.01, n[N] = 1 } parts { sub[3]: Sub } coords { a } mass { a: j } force { a: -c * sub[2].d * dot(a) } } } \
        { { Sub } { pub Sub { params { d = 5, e = 6 } coords { b } mass { b: e } } } { } } }]";
    for body in [
        "parts { tr[2]: Train } output { a = tr[0].st[1].c, b = tr[1].st[1].j, c = tr[0].st[0].sub[2].d + tr[1].st[1].sub[0].e, d = tr[0].k }",
        "parts { tr: Train } output { a = tr.st[1].c, b = tr.st[1].j, c = tr.st[0].sub[2].d }",
        "parts { for i in 0..2 { tr[i]: Train { k: i } } } output { a = tr[0].st[1].c, b = tr[1].st[1].j, c = tr[0].st[0].sub[2].d, d = tr[0].k }",
    ] {
        let source = format!("{TRAIN} pub T {{ {body} }}");
        let (_, found) = expand(&source);
        let told: Vec<&str> = found.iter().map(|e| e.message.as_str()).collect();
        assert!(told.is_empty(), "{body}: {told:#?}");
    }
}

#[test]
fn parts_have_parts() {
    let source = "@parts [{ Leg } { pub Leg { params { l = 0.5 } bodies { planar shin { mass: 1, inertia: 0.1 } } parts { foot[2]: crate::Foot { r: l / 3 } } \
        holonomic { for i in 0..2 { ankle[i]: pin(shin.at([l, i]), foot[i].sole.at([0, 0])) } } } } \
        { { crate::Foot } { pub Foot { params { r = 0.1, c = 2.0 } bodies { planar sole { mass: 1, inertia: r * c } } output { o = sole.x } } } { } }] \
        pub T { params { l = 0.9 } parts { leg[2]: Leg { l } } output { o = leg[1].foot[0].sole.angle, r = leg[0].foot[1].r } force { leg[1].foot[0].sole.angle: 1 } }";
    let (system, model) = system(source);
    let names = coordinates(&model);
    assert_eq!(
        names[..4],
        [
            "leg[0].shin.x",
            "leg[0].shin.y",
            "leg[0].shin.angle",
            "leg[0].foot[0].sole.x"
        ]
    );
    let params: Vec<&str> = model
        .param_elements
        .iter()
        .map(|p| p.name.as_str())
        .collect();
    assert_eq!(params, ["l", "leg.foot.c"]);
    assert_eq!(system.force.keys().copied().collect::<Vec<_>>(), [14]);
    let point = Point {
        params: &system.defaults,
        ..Point::NOWHERE
    };
    let r = system
        .outputs
        .iter()
        .find(|o| o.item.text() == "r")
        .expect("an output");
    assert!((eval(&system.graph, &[r.value], &point)[0] - 0.3).abs() < 1e-15);
}

/// What is not known yet is asked for, with what is.
#[test]
fn parts_are_asked_for() {
    let (code, errors) = expand("pub T { parts { leg[2]: legs::Leg } }");
    assert!(errors.is_empty());
    let asked = "legs :: Leg ! { (:: ukcore :: multibody) (legs :: Leg) [] pub T { parts { leg [2] : legs :: Leg } } }";
    let plain = |text: &str| -> String { text.split_whitespace().collect() };
    assert_eq!(plain(&code.to_string()), plain(asked));
    let (code, _) =
        expand("#[ukcore(part)] pub(crate) Leg { bodies { planar a { mass: 1, inertia: 1 } } }");
    let text = code.to_string();
    assert!(
        text.contains("macro_rules ! __part_Leg_") && !text.contains("macro_export"),
        "{text}"
    );
    let (code, _) =
        expand("#[ukcore(part)] pub Leg { bodies { planar a { mass: 1, inertia: 1 } } }");
    assert!(code.to_string().contains("macro_export"));
}

/// What a part declares by `let` may be used by those that it is a part of alone.
#[test]
fn what_parts_declare_is_not_unused() {
    let told = |attribute: &str| {
        let source = format!(
            "{attribute} pub P {{ params {{ m = 1.0 }} coords {{ x }} mass {{ x: 1 }} let f = |u| 2 * u; let d = 2 * x; }}"
        );
        let code = expand(&source).0.to_string();
        ["const d : ()", "fn f ()", "m : ()"].map(|item| code.contains(item))
    };
    assert_eq!(told(""), [true; 3]);
    assert_eq!(told("#[ukcore(part)]"), [false, false, true]);
}

/// An option that no guess uses is told in its start, whatever another start, or the rest of the declaration, calls so.
#[test]
fn options_of_a_start_that_no_guess_uses_are_told() {
    let source = "pub P { coords { x } mass { x: 1 } let f = |spare| 2 * spare; force { x: f(t) } start go(from = 0.3, spare = 2.0, _kept = 1.0) { x = from } \
         start stay(spare = 1.0) { x near spare } }";
    let (code, errors) = expand(source);
    assert!(errors.is_empty());
    let code = code.to_string();
    assert!(code.contains("struct go { spare : () }"), "{code}");
    assert!(!code.contains("struct stay"));
}

/// A declaration that is no part says so to the whole, which tells the remedy, and no more.
#[test]
fn what_is_no_part_is_told() {
    let (code, errors) = expand("pub Leg { bodies { planar a { mass: 1, inertia: 1 } } }");
    assert!(errors.is_empty());
    let text = code.to_string();
    assert!(text.contains("{ ? }") && !text.contains("macro_export"));
    check_after(
        "@parts [{ Leg } { ? } { }] ",
        "parts { for i in 0..2 { leg[i]: «Leg» { l: 1 } } } tree { hip: pin(ground.at([0, 0]), leg[1].a.at([0, 0])) } \
         force { leg[0].a.x: 1 } output { o = leg[1].a.angle + leg[0].f(1) }",
        &["`Leg` is no part; write `#[ukcore(part)]` before `Leg` where it is declared"],
    );
}

/// Functions of parts are called as what else belongs to them, and in parts of parts, whatever is called so outside.
#[test]
fn functions_of_parts() {
    let outputs = |source: &str| -> Vec<f64> {
        let (system, model) = system(source);
        let q: Vec<f64> = (0..model.coord_elements.len())
            .map(|i| (1.7 * i as f64).sin())
            .collect();
        let ids: Vec<Id> = system.outputs.iter().map(|o| o.value).collect();
        let point = Point {
            q: &q,
            params: &system.defaults,
            ..Point::NOWHERE
        };
        eval(&system.graph, &ids, &point)
    };
    let source = format!(
        "{LEG} pub T {{ gravity {{ [0, -1] }} parts {{ leg[2]: Leg }} let turn = |i, a| a * i; let of = |a| leg[1].turn(0, a); output {{ \
         called = leg[1].turn(1, 0.3) - 0.3 * leg[1].shin[1].along([1, 0]), summed = sum(0..2, |i| leg[i].turn(i, 2.0)) - \
         2.0 * leg[0].shin[0].along([1, 0]) - 2.0 * leg[1].shin[1].along([1, 0]), within = of(0.5) - 0.5 * leg[1].shin[0].along([1, 0]), own = turn(2, 3.0) - 6.0 }} }}"
    );
    let values = outputs(&source);
    let differences = &values[..7];
    assert!(differences.iter().all(|x| x.abs() < 1e-15), "{values:?}");
    let nested = "@parts [{ Leg } { pub Leg { coords { x } mass { x: 1 } parts { foot[2]: Foot } let f = |u| -u; output { a = foot[1].f(x) + f(x) } } } \
        { { Foot } { pub Foot { params { r = 0.5 } coords { y } mass { y: 1 } let f = |u| r * u + y; } } { } }] \
        pub T { parts { leg: Leg } let f = 7.0; output { b = leg.foot[1].f(leg.x) - leg.x - leg.foot[1].y + f } }";
    let [b, a] = outputs(nested)[..] else {
        panic!("two outputs")
    };
    let x = |i: i32| (1.7 * f64::from(i)).sin();
    assert!((a - (x(2) - 0.5 * x(0))).abs() < 1e-15, "{a}");
    assert!((b - (7.0 - 0.5 * x(0))).abs() < 1e-15, "{b}");
}

/// What is wrong in a part is told where that is declared, and only there.
#[test]
fn errors_of_a_part_are_told_once() {
    let (code, errors) =
        expand("#[ukcore(part)] pub P { bodies { planar a { mass: 1, inertia: no } } }");
    assert!(
        errors.len() == 1 && code.to_string().contains("{ ! #"),
        "{code}"
    );
    let source = "@parts [{ P } { ! pub P { bodies { planar a { mass: 1, inertia: no } } } } { }] pub T { parts { p[3]: P } output { o = p[1].a.x } }";
    let (code, errors) = expand(source);
    let text = code.to_string();
    assert!(
        errors.is_empty() && text.contains("struct T") && text.contains("P_2_A_ANGLE"),
        "{text}"
    );
}

/// What a type gives member by member stays its own, and parts are counted before they are made.
#[test]
fn what_cannot_be_given_or_made_is_told() {
    let leg = "@parts [{ P } { pub P { params { for i in 0..2 { r[i] = 1.0 + i } } coords { x } mass { x: r[0] + r[1] } } } { }] pub T {";
    for (parts, message) in [
        (
            "p: P { r: [1, 2] }",
            "`r` is declared member by member in `P` and cannot be given",
        ),
        (
            "p[1000]: P, r[10]: P",
            "these are more than 1000 parts in all",
        ),
    ] {
        let (_, errors) = expand(&format!("{leg} parts {{ {parts} }} }}"));
        let told: Vec<String> = errors.iter().map(|error| error.message.clone()).collect();
        assert!(told.len() == 1 && told[0].contains(message), "{told:?}");
    }
}

fn check_with_leg(marked: &str, messages: &[&str]) {
    check_after(LEG, marked, messages);
}

cases! {
    check_with_leg;
    unknown_parameter: "gravity { [0, -1] } parts { leg: Leg { «size»: 1 } }" => "`Leg` has no parameter `size`; they are `l`, `m`, `k`";
    constant_given: "gravity { [0, -1] } parts { leg: Leg { «N»: 1 } }" => "`N` is a constant of `Leg`, the same in all parts";
    given_twice: "gravity { [0, -1] } parts { leg: Leg { l: 1, «l»: 2 } }" => "`l` is given twice";
    given_that_moves: "gravity { [0, -1] } parts { leg: Leg { l: «t» } }" => "a parameter of a part does not change with the motion";
    given_of_a_shape: "gravity { [0, -1] } parts { leg: Leg { m: «[1, 2, 3]» } }" => "expected a vector of 2, found a vector of 3";
    given_unknown: "gravity { [0, -1] } parts { leg: Leg { m: «mass» } }" => "unknown name `mass`";
    given_by_an_equals_sign: "gravity { [0, -1] } parts { leg: Leg { k «=» 3, l = 1 } }" => "here stands `:`, as in `k: 1.0`";
    given_as_a_vector: "gravity { [0, -1] } parts { leg[3]: Leg { l: «[40, 50] [mm]» } }" => "`l` is a number, found a vector of 2; a value for each part is given in a loop";
    no_type: "parts { «leg» }" => "a part needs the type that it is: `leg: Leg`";
    in_itself: "parts { leg: «T» }" => "`T` cannot be a part of itself";
    no_gravity: "parts { leg: «Leg» }" => "`Leg` has `gravity`, and this declaration, of which it is a part, has none";
    part_twice: "gravity { [0, -1] } parts { leg: Leg, «leg»: Leg }" => "`leg` is declared twice";
    part_and_coordinate: "gravity { [0, -1] } coords { «leg» } mass { leg: 1 } parts { leg: Leg }" => "`leg` is declared twice";
    part_as_a_value: "gravity { [0, -1] } parts { leg[2]: Leg } output { o = «leg»[1] }" => "`leg[1]` is a part; choose what belongs to it";
    parts_as_a_value: "gravity { [0, -1] } parts { leg[2]: Leg } output { o = «leg» }" => "`leg` is a part; choose what belongs to it";
    no_such_part: "gravity { [0, -1] } parts { leg[2]: Leg } output { o = «leg»[2].tip }" => "there is no part `leg[2]`; there are `leg[0]`, `leg[1]`";
    constant_of_a_part: "gravity { [0, -1] } parts { leg[2]: Leg } coords { x[leg[0].N + 1], y } mass { for i in 0..leg[1].N + 1 { x[i]: 1 } y: 1 } output { n = leg[0].m[leg[1].N - 1] * leg[0].N * y.powi(leg[0].N), o = x[leg[0].«M»] }" => "part `leg[0]` has no `M`";
    value_of_a_part_as_an_index: "gravity { [0, -1] } parts { leg[2]: Leg } output { o = leg[1].m[«leg[1].l»] }" => "not an integer known at compile time";
    nothing_in_the_part: "gravity { [0, -1] } parts { leg[2]: Leg } output { o = leg[1].«tap» }" => "part `leg[1]` has no `tap`; did you mean `tip`?";
    no_such_function: "gravity { [0, -1] } parts { leg[2]: Leg } output { o = leg[1].«tarn»(0, 1.0) }" => "part `leg[1]` has no `tarn`; did you mean `turn`?";
    value_called: "gravity { [0, -1] } parts { leg[2]: Leg } output { o = leg[1].«tip»(0) }" => "`leg[1].tip` is not a function";
    function_of_no_member: "gravity { [0, -1] } parts { leg[2]: Leg } output { o = «leg»[2].turn(0, 1.0) }" => "there is no part `leg[2]`";
    arguments_of_a_function: "gravity { [0, -1] } parts { leg[2]: Leg } output { o = leg[1].«turn»(1.0) }" => "takes 2 arguments, found 1";
    function_as_a_value: "gravity { [0, -1] } parts { leg[2]: Leg } output { o = leg[1].«turn» }" => "`leg[1].turn` is a function; call it";
    vocabulary_declared: "gravity { [0, -1] } let pin = |p, q| p - q; parts { leg: «Leg» } output { o = pin(leg.tip, [0, 0]) }" => "this declares `pin`, which `Leg` uses";
    name_of_a_part_taken: "gravity { [0, -1] } parts { «leg»: Leg } coords { leg_tip } mass { leg_tip: 1 }" => "`leg.tip` is declared twice";
    wrong_in_the_whole: "gravity { [0, -1] } params { m = 0.0 } parts { «leg»[2]: Leg { l: m, m: -1 } }" => "in part `leg`: the mass of a body must not be negative";
}

/// A reaction in a part is that of its own joint; from outside it goes by the part's name.
#[test]
fn reactions_reach_into_parts() {
    let leg = LEG.replace(
        "output { tip",
        "output { load = norm(reaction(knee)) + reaction(knee.x), tip",
    );
    let source = |outer: &str| {
        format!(
            "{leg} pub Pair {{ params {{ l = 0.3 }} gravity {{ [0, -1] }} parts {{ for i in 0..2 {{ leg[i]: Leg {{ l: l }} }} }} \
             holonomic {{ for i in 0..2 {{ hip[i]: pin(ground.at([i, 0]), leg[i].shin[0].at([0, 0])) }} }} output {{ {outer} }} }}"
        )
    };
    let (system, _) = system(&source(
        "for i in 0..2 { again[i] = norm(reaction(leg[i].knee)) + reaction(leg[i].knee.x) }",
    ));
    let outputs = system.outputs.iter();
    let values: Vec<Id> = outputs
        .filter(|o| !o.item.text().ends_with("tip[0]") && !o.item.text().ends_with("tip[1]"))
        .map(|o| o.value)
        .collect();
    let [a, b, again_a, again_b] = values[..] else {
        panic!("four outputs, not {}", values.len())
    };
    let mut both = [[a, b], [again_a, again_b]];
    both.iter_mut().for_each(|pair| pair.sort_unstable());
    assert!(a != b && both[0] == both[1]);
    let told = |outer: &str| {
        let (_, errors) = expand(&source(outer));
        errors
    };
    let errors = told("wrong = reaction(leg[0].kene)");
    assert_eq!(errors.len(), 1, "{errors:?}");
}
