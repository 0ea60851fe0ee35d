//! Units: what is accepted, what is refused, and what becomes of them.

use super::errors::check;
use super::expand;
use ukalgebra::expr::Random;

#[track_caller]
fn accepted(body: &str) -> String {
    let (code, errors) = expand(&format!("pub T {{ {body} }}"));
    let errors: Vec<&str> = errors.iter().map(|e| e.message.as_str()).collect();
    assert!(errors.is_empty(), "{body}: {errors:#?}");
    code.to_string()
}

/// The units in the code, in its order: of parameters, coordinates, outputs, options, integrals.
#[track_caller]
fn units_of(body: &str) -> String {
    let code = accepted(body);
    let mut found = String::new();
    for (at, _) in code
        .match_indices("unit : \"")
        .chain(code.match_indices("coordinate_units : & ["))
    {
        let rest = &code[at..];
        let end = rest.find(['}', ']']).unwrap_or(rest.len());
        let texts: Vec<&str> = rest[..end].split('"').skip(1).step_by(2).collect();
        found += &format!("{} ", texts.join(" | "));
    }
    found.trim_end().to_owned()
}

#[test]
fn numbers_are_in_si() {
    let code = accepted(
        "const G: f64 = 981 [cm/s^2]; params { l = 300 [mm], a = 30 [deg], w = 60 [rpm], j[2] = [1.0, 2] [g m^2], f = 2 * PI * 50 [1/s] } \
         coords { x [m] } mass { x: 1 } force { x: -9 [mN/mm] * x + 1.5 [kg] * G } output { o [mm] = x }",
    );
    for text in [
        "l : 0.3 ,",
        "a : 0.5235987755982988",
        "w : 6.28318530717958",
        "j : [0.001 , 0.002]",
        "f : 314.159265358979",
    ] {
        assert!(
            code.contains(text),
            "{text}: {}",
            &code[code.find("fn default").unwrap()..][..300]
        );
    }
    for text in ["14.715 - 9*x", "14.715", "G : f64 = 9.81", "1000"] {
        assert!(code.contains(text), "{text}");
    }
}

#[test]
fn constants_called_like_units_are_indices() {
    // Sizes, members beside others, entries of vectors by loops, by functions and by what is no unit; units of numbers.
    for body in [
        "const N: usize = 2; coords { x[N] } mass { x: 1 } force { x[0]: 3 [N] * sign(x[1]) }",
        "const N: usize = 2; params { k[N] = [100, 120] [N/m], j[N] = [1, 2] [kg m^2] } coords { x[N] [m] } mass { x: j[0] / (1 [m^2]) } output { f [N/m] = k[1] }",
        "const m: usize = 2; params { a[2] = [1, 2] [m^2], j[2] = [1, 2] [kg m^2] } coords { x[m] } mass { x: 1 } output { o = j[1] / a[0] }",
        "params { m = 2, N = 3 } coords { x [m], y[s], f [N] } mass { x: m, y: N, f: 1 } output { o [m] = x, pull[N * s] = 1 * f * y }",
        "const N: usize = 2; coords { x[N + 1] } mass { x: 1 } output { for i in 0..N { y[i] = x[i] } y[N] = x[N] }",
        "const N: usize = 2; coords { x[N] } mass { x: 1 } force { for J in 0..2 { x[J]: [1.0, 2.0][J] } }",
        "const N: usize = 2; coords { x[N] } mass { x: 1 } force { x[0]: [1.0, 2.0][N - 1] }",
        "const N: usize = 2; coords { x[N + 1] } mass { x: 1 } force { x[0]: sum(0..2, |J| [1.0, 2.0][J] * x[J]) }",
    ] {
        accepted(body);
    }
}

#[test]
fn units_are_handed_on() {
    let found = units_of(
        "params { l = 300 [mm], a = 30 [deg], k = 2 [kN/mm], c = 1.0, n = 2 [-], i = 2 [kg] * sq(0.3 [m]), t1 = 3 * k * l * l, b[2] = [1, 2] [N m/rad] } \
         coords { x [m], y, e[2] [-] } mass { x: 1, y: 1, e: 1 } output { o [mm] = x, u = y } integral { w [kJ] = k * x * dot(x) } \
         start s(a0 = 90 [deg], b0 = 1) { x = 0.1 [m] }",
    );
    assert_eq!(
        found,
        "m | mm rad | deg N/m | kN/mm  |   |  kg m^2 |  J |  N m/rad |  N m/rad |  mm  rad | deg  |  kJ m |  |  |"
    );
    let code = accepted(
        "params { /// Length\nl = 1 [mm] } coords { x [m] } mass { x: 1 } output { o [deg] = x / l }",
    );
    for text in [
        "Unit: m.",
        "Position in q of coordinate `x`, in m.",
        "Position of output `o`, in deg.",
    ] {
        assert!(code.contains(text), "{text}");
    }
}

#[test]
fn multipliers_do_work_on_their_rows() {
    let told = |body: &str| {
        let code = accepted(body);
        let (_, units) = code.split_once("multiplier_units : & [").expect("units");
        let (units, _) = units.split_once(']').expect("their end");
        units.replace('"', "").replace(" ,", ",")
    };
    let body = "bodies { planar a { mass: 1 [kg], inertia: 1 } } \
        holonomic { p: pin(ground.at([0, 0]), a.at([1, 0])), motor: turn(ground, a) = 2 [rad/s] * t, rod: sq(a.x) + sq(a.y) = 1, plain: sq(a.x) / sq(a.y) = 1 } \
        nonholonomic { roll: dot(a.x) = 0.1 [m] * dot(a.angle) }";
    assert_eq!(told(body), "N, N, N m, N/m, N m, N");
    let bare = ["[kg]", "[m]", "[rad/s]"]
        .iter()
        .fold(body.to_owned(), |text, unit| text.replace(unit, ""));
    assert_eq!(told(&bare), "");
    // Rows of directions are plain numbers, whatever turns them.
    let space = "bodies { spatial b { mass: 1 [kg], inertia: [1, 1, 1] } spatial c { mass: 1, inertia: [1, 1, 1] } } \
        tree { axle: hinge(ground.at([0, 0, 0]), b.at([0, 0, 0]), [0, 0.6, 0.8]) } \
        holonomic { on: hinge(b.at([1, 0, 0]), c.at([0, 0, 0]), [0, 0, 1]), motor: drive(ground, b, [0, 0.6, 0.8], 2 * t), next: drive(b, c, [0, 0, 1], 2 * t) }";
    assert_eq!(told(space), ", N, N, N, N m, N m, N m, N m");
    // Rows that are left out leave those behind them their units.
    let planar = "bodies { spatial b { mass: 1 [kg], inertia: [1, 1, 1] } spatial c { mass: 1, inertia: [1, 1, 1] } spatial d { mass: 1, inertia: [1, 1, 1] } } \
        tree { o: hinge(ground.at([0, 0, 0]), b.at([0, 0, 0]), [0, 1, 2]) p: hinge(b.at([1, 0, 0]), c.at([0, 0, 0]), [0, 1, 2]) s: slider(ground.at([0, 0, 0]), d.at([0, 0, 0]), [0, 0, 1]) } \
        holonomic { q: hinge(ground.at([1.5, 0, 0]), c.at([1, 0, 0]), [0, 1, 2]), turn: o.angle = 1 [rad/s] * t, lift: s.slide = 1 [m/s] * t }";
    assert_eq!(told(planar), ", , , N m, N");
    let unknown = "coords { x [m], y } mass { x: 1, y: 1 } holonomic { c: y = sq(y) }";
    assert_eq!(told(unknown), "");
}

#[test]
fn bodies_have_units_where_some_are_declared() {
    let body = "bodies { planar a { mass: 1, inertia: 1 } spatial b { mass: 1, inertia: [1, 1, 1] } planar c { mass: 1, inertia: 1 } } \
         tree { j: slot(ground.at([0, 0]), c.at([0, 0]), [1, 0]) } output { o MARK = a.x }";
    let found = units_of(&body.replace("MARK", "[m]"));
    assert_eq!(found, "m m | m | rad | m | m | m |  |  |  |  | m | rad");
    assert_eq!(units_of(&body.replace("MARK", "")), "");
}

/// Indices are not units, nor units indices.
#[test]
fn indices_and_units() {
    accepted(
        "const N: usize = 3; params { l[N] = [1, 2, 3] [m], k[N][2] = 2 [N/m] } coords { x[N] [m], y[N] } let f = |s| l[s]; \
         let g = |m, h| x[m] * h; mass { for m in 0..N { x[m]: 1 } y: ([1, 2, 3][N - 1]) [kg] } \
         force { x[0]: g(1, 2 [N/m]) + sum(0..N, |s| k[s][1] * x[s]) } output { a [m] = f(2), b [1/m] = 1 / x[0] }",
    );
}

/// Whatever has no unit fits everything, and numbers by themselves, too.
#[test]
fn what_has_no_unit_is_not_refused() {
    accepted(
        "params { r = 0.5 [m], m = 1 [kg], w = 2.0 } const G: f64 = 9.81; let h0 = 0.3; \
         bodies { planar disc { mass: m, inertia: 0.5 * m * sq(r) } planar b { mass: 2, inertia: 0.3, centre: [0.1, 0] } } \
         gravity { [0, -G] } tree { a: pin(ground.at([0, 1.0]), b.at([0.3, h0])) } \
         holonomic { c: disc.x = r * disc.angle, d: disc.x = 0.5 * disc.angle, h: disc.y = 0.1 * sin(2.0 * t), e: pin(disc.at([0, 0.2]), b.at([0, 2 * h0])) } \
         forces { spring(b.at([0.1, 0.2]), ground.at([1.0, r]), 20, 0.3) torque(b, 3 * w) } nonideal { disc.x: friction(disc.x.dot(), 0.1 * norm(reaction(e))) } \
         output { tip = b.at([1, h0]), n = r + 2, p = r * w + m * h0, q = max(r, 0.1) }",
    );
    accepted(
        "params { k = 2.0, g = 9.81 } coords { x, y } mass { x: k, y: g } potential { 0.5 * k * sq(x), t, g } \
         holonomic { c: sq(x) + y = sin(t) + 3 } output { a = t + x + k, b [deg] = x }",
    );
}

/// A closed chain, everything with its units.
#[test]
fn a_linkage_with_all_its_units() {
    accepted(
        "params { l[3] = [0.5, 2.0, 1.5] [m], m = 1.0 [kg], span = 2.0 [m], k = 3.0 [N m/rad], g = 9.81 [m/s^2], c = 0.1 [N s/m], torque = 0.5 [N m], \
         s = 100 [N/m], mu = 0.1 [-], d = 1 [N m s], force = 2 [N] } \
         bodies { for i in 0..3 { planar bar[i] { mass: m, inertia: m * sq(l[i]) / 12.0, centre: [l[i] / 2.0, 0] } } } gravity { [0, -g] } \
         holonomic { o: pin(ground.at([0, 0]), bar[0].at([0, 0])) p: pin(bar[0].at([l[0], 0]), bar[1].at([0, 0])) \
         q: pin(bar[1].at([l[1], 0]), bar[2].at([l[2], 0])) r: pin(ground.at([span, 0]), bar[2].at([0, 0])) } \
         forces { turning_spring(bar[1], bar[2], k, 1.0) torque(bar[0], torque) damper(bar[1].at([1.0, 0.3]), ground.at([span, 1]), c) \
         spring(bar[0].centre_of(), ground.at([0, 0]), s, 0.3) turning_damper(bar[0], bar[1], d) force(bar[1].at([0, 0]), [force, 0]) } let centre_of = |b| b.at([l[0], 0]); \
         dissipation { 0.5 * d * sq(bar[2].omega) } nonideal { bar[0].angle: friction(bar[0].omega, mu * 0.01 [m] * norm(reaction(o))) } \
         output { tip [mm] = bar[1].at([1.0, 0.3]), load [N] = norm(reaction(p)), crank [deg] = bar[0].angle, w [rpm] = bar[0].omega, arm [N] = reaction(q.x) } \
         integral { work [J] = torque * bar[0].omega } \
         start open(crank = 60 [deg]) { bar[0].angle = crank; bar[1].angle near 0.3; dot(bar[0].angle) = 10 [rpm] }",
    );
}

/// Nothing but dimensions is told of in the second look, so that no loop ends there early.
#[test]
fn the_second_look_goes_through_all_of_it() {
    let (source, wrong) = (
        "params { for i in 0..30 { k[i] = 2.0 [N/m], j[i] = (1 + i) [N/m] } } coords { for i in 0..30 { x[i] [m] } } \
        mass { for i in 0..30 { x[i]: 1 } } force { for i in 0..30 { x[i]: -k[i] * x[i] + j[i] * 0.1 [m] } } output { o [N] = ",
        "k[29] * x[29]",
    );
    accepted(&format!("{source}{wrong} }}"));
    let (_, errors) = expand(&format!("pub T {{ {source}{wrong} * x[0] }} }}"));
    assert_eq!(errors.len(), 1, "{errors:?}");
}

/// What is nested as deeply as may be is looked at without more stack than there is.
#[test]
fn deep_nesting() {
    let mut body =
        "params { l = 1 [m] } coords { x [m] } mass { x: 1 } let f0 = |u| u + x;".to_owned();
    for k in 1..90 {
        body += &format!("let f{k} = |u| (f{}(u) + 2 * (l - u));", k - 1);
    }
    accepted(&format!("{body} output {{ o [m] = f89(x) }}"));
    let inner = "(l + ".repeat(40) + "x" + &")".repeat(40);
    accepted(&format!(
        "params {{ l = 1 [m] }} coords {{ x [m] }} mass {{ x: 1 }} output {{ o [mm] = {inner} }}"
    ));
}

/// What the messages about plain numbers propose is accepted, of numbers and of vectors.
#[test]
fn plain_numbers_are_given_a_unit_by_a_factor() {
    let body = "params { m = 1 [kg], phi = 30 [deg] } bodies { planar a { mass: m, inertia: 1 } } coords { x [m] } mass { x: m }";
    let of = |factor: &str| {
        [
            format!("{body} output {{ o = a.at(«[cos(phi), sin(phi)]{factor}») }}"),
            format!("{body} holonomic {{ c: x = «2 * cos(phi + a.angle){factor}» }}"),
            format!("{body} output {{ o = x + «phi{factor}» }}"),
            format!(
                "{body} holonomic {{ c: rod(ground.at([0, 0]), a.at([0, 0]), «sin(phi){factor}») }}"
            ),
        ]
    };
    let remedy = "; behind a plain number `* 1 [m]` gives it the unit";
    for (refused, message) in of("").iter().zip([
        "expected m, a place, found a plain number",
        "equates m with a plain number",
        "adds a plain number to m",
        "`l` of `rod(p, q, l)` is in m, found a plain number",
    ]) {
        check(refused, &[&format!("{message}{remedy}")]);
    }
    for mended in of(" * 1 [m]") {
        accepted(&mended.replace(['«', '»'], ""));
    }
}

cases! {
    check;
    // Sums and equations.
    added: "params { a = 1 [m/s^2] } coords { x [m] } mass { x: 1 } output { o = x + «a» }" => "adds m/s^2 to m";
    subtracted: "params { a = 1 [N] } coords { x [m] } mass { x: 1 } output { o = x - 2 - «3 * a» + x }" => "subtracts N from m";
    told_once: "coords { x [m] } mass { x: 1 } force { x: -x - «2 [N]» }" => "subtracts N from m";
    sides: "params { l = 1 [m] } coords { x [m], y [m] } mass { x: 1, y: 1 } holonomic { c: sq(x) + sq(y) = «l» }" => "equates m^2 with m";
    components: "params { l = 1 [m] } coords { x [m], y [m] } mass { x: 1, y: 1 } holonomic { d: [x, y] = «[l, sq(l)]» }" => "equates m with m^2";
    rates: "coords { x [m], y [m] } mass { x: 1, y: 1 } nonholonomic { c: dot(x) = «y» }" => "equates m/s with m";
    within_an_operation: "params { a[2] = [1 [m], 2 [kg]] } coords { x [m] } mass { x: 1 } output { o = «norm(a)» }" => "adds kg^2 to m^2";
    of_a_function: "let f = |u| u + «x»; coords { x [m] } mass { x: 1 } output { o = f(dot(x)) }" => "adds m to m/s";
    // Functions.
    sine_of_a_length: "params { l = 1 [m] } coords { x } mass { x: 1 } force { x: sin(«2 * l») }" => "`sin` takes a plain number, found m";
    exponential: "params { tau = 1 [s] } coords { x } mass { x: 1 } output { o = exp(-t / tau), p = exp(«-tau») }" => "`exp` takes a plain number, found s";
    angle_of_two: "params { l = 1 [m], m = 1 [kg] } coords { x } mass { x: 1 } output { o = «atan2(l, m)» }" => "arguments of `atan2` are m and kg";
    power: "params { l = 4 [m] } coords { x } mass { x: 1 } output { o [m^1.5] = l.powf(1.5), p [m] = «l.powf(0.5)», q [s] = «sqrt(l)» }" => "expected m, as `[m]` says, found m^0.5", "expected s, as `[s]` says, found m^0.5";
    // Numbers: plain ones as factors.
    number_as_a_factor: "params { m = 1 [kg] } coords { y [m] } mass { y: m } potential { m * 9.81 [m/s^2] * y, «m * 9.81 * y» }" => "expected J, an energy, found kg m";
    constant_with_a_unit: "const G: f64 = 9.81 [m/s]; params { m = 1 [kg] } coords { y [m] } mass { y: m } potential { «m * G * y» }" => "expected J, an energy, found kg m^2/s";
    // Sections.
    kinetic: "params { m = 1 [kg] } coords { y [m] } kinetic { «m * dot(y)» }" => "expected J, an energy, found kg m/s";
    dissipation: "params { c = 1 [N s/m] } coords { y [m] } mass { y: 1 } dissipation { 0.5 * c * sq(dot(y)), «c * dot(y)» }" => "expected W, a dissipated power, found N";
    mass: "params { j = 1 [kg m^2], i = 1 [kg m^2] } coords { y [m], a [rad] } mass { a: j, y: «j», (y, a): «i» }" => "expected kg, a mass for these coordinates, found kg m^2", "expected kg m, a mass for these coordinates, found kg m^2";
    force: "params { f = 1 [N] } coords { y [m], a [rad] } mass { y: 1, a: 1 } force { y: f, a: «f» }" => "expected J, the force on this coordinate, found N";
    nonideal: "params { mu = 1 [-] } coords { y [m] } mass { y: 1 } nonideal { y: «-mu * sign(dot(y))» }" => "expected N, the force on this coordinate, found a plain number";
    gravity: "params { g = 9.81 [m/s] } bodies { planar a { mass: 1, inertia: 1 } } gravity { «[0, -g]» }" => "expected m/s^2, an acceleration, found m/s";
    body: "params { l = 1 [m], m = 1 [kg] } bodies { planar a { mass: m, inertia: «m», centre: «[m * l, 0]» } }" => "expected kg m^2, the inertia of a body, found kg", "expected m, a place, found kg m";
    spatial_body: "params { m = 1 [kg] } bodies { spatial a { mass: 2 * m, inertia: «[m, m, m]» } }" => "expected kg m^2, the inertia of a body, found kg";
    place: "params { m = 1 [kg] } bodies { planar a { mass: m, inertia: 1 } } output { o = a.at(«[2 * m, 0]») }" => "expected m, a place, found kg";
    place_of_a_joint: "params { j = 1 [kg m^2] } bodies { planar a { mass: 1, inertia: j } } tree { c: pin(ground.at(«[j, 0]»), a.at([0, 0])) }" => "expected m, a place, found kg m^2";
    rod: "params { l = 1 [m^2] } bodies { planar a { mass: 1, inertia: 1 } } holonomic { c: rod(ground.at([0, 0]), a.at([0, 0]), «l») }" => "`l` of `rod(p, q, l)` is in m, found m^2";
    spring: "params { k = 1 [N] } bodies { planar a { mass: 1, inertia: 1 } } forces { spring(ground.at([0, 0]), a.at([0, 0]), «k», 0.1) }" => "`k` of `spring(p, q, k, l)` is in N/m, found N";
    damper: "params { c = 1 [N] } bodies { planar a { mass: 1, inertia: 1 } } forces { damper(ground.at([0, 0]), a.at([0, 0]), «c») }" => "`c` of `damper(p, q, c)` is in N s/m, found N";
    torque: "params { f = 1 [N] } bodies { planar a { mass: 1, inertia: 1 } } forces { force(a.at([0, 0]), [f, f]) torque(a, «f») }" => "`m` of `torque(b, m)` is in N m, found N";
    start: "params { l = 1 [m] } coords { x [m], y [m] } mass { x: 1, y: 1 } start s(v = 1 [m/s]) { x = «v»; dot(x) = v; y near «2 * l * l»; dot(y) = 1 }" => "expected m, as this coordinate is, found m/s", "found m^2";
    start_of_a_body: "bodies { planar a { mass: 1, inertia: 1 } } start s(v = 1 [rpm]) { a.angle = 30 [deg]; dot(a.angle) = v; a.x = «2 [rad]» }" => "expected m, as this coordinate is, found a plain number";
    output_unit: "coords { x [m] } mass { x: 1 } output { o [mm] = x, p [N] = «x» }" => "expected N, as `[N]` says, found m";
    integral_unit: "params { f = 1 [N] } coords { x [m] } mass { x: 1 } integral { w [J] = f * dot(x), v [W] = «f * dot(x)» }" => "expected W, as `[W]` says, found J in all";
    reaction: "coords { x [m], y [m] } mass { x: 1, y: 1 } holonomic { c: x = y } output { f [N] = reaction(c), g [J] = «reaction(c)» }" => "expected J, as `[J]` says, found N";
    // Units themselves.
    unknown_unit: "params { l = 1 [«mtr»] } coords { x [m] } mass { x: l }" => "unknown unit `mtr`";
    inch: "params { l = 1 [«in»] } coords { x } mass { x: l }" => "unknown unit `in`; one is `25.4 [mm]`";
    short_unit: "params { l = 1 [«hg»] } coords { x } mass { x: l }" => "unknown unit `hg`; a unit is a product of powers of kg, m, s";
    unit_in_capitals: "params { l = 1 [«RAD»], f = 1 [«NM»] } coords { x } mass { x: l * f }" => "unknown unit `RAD`; did you mean `rad`?", "unknown unit `NM`; did you mean `Nm`?";
    unknown_unit_far_from_all: "params { l = 1 [«parsecs»] } coords { x [m] } mass { x: l }" => "unknown unit `parsecs`; a unit is a product of powers of kg, m, s";
    unknown_unit_of_an_option: "coords { x [m] } mass { x: 1 } start a(b = 1.0 [«metres»]) { x = b }" => "unknown unit `metres`";
    unknown_beside_known: "params { l = 1 [kg «mtr»] } coords { x [m] } mass { x: 1 }" => "unknown unit `mtr`";
    hertz: "params { f = 1 «[Hz]» } coords { x [m] } mass { x: 1 }" => "a hertz may be meant as a turn a second or as 1/s";
    two_readings: "params { c = 1 «[N/m s]» } coords { x [m] } mass { x: 1 }" => "`/m s` has two readings; write `/m/s`, or `s` before the `/`";
    scaled_coordinate: "coords { x «[mm]», a «[deg]» } mass { x: 1, a: 1 }" => "equations have coordinates in SI units: write `[m]`; an output may be in `[mm]`", "write `[rad]`";
    unit_behind_a_divisor: "params { a = PI / «6 [rad]», b = (PI / 6) [rad], c = 1 / (2 [m]) } coords { x } mass { x: a * b * c }" => "a unit belongs to the number before it, here a divisor";
    number_beside_a_quantity: "params { a = «1» + 2 [mm], b = 0 + 2 [mm] } coords { x } mass { x: a * b }" => "a number without a unit beside one that has one";
    unit_of_a_name: "params { l = 1, r = 2 * «l» [m] } coords { x } mass { x: r }" => "a unit stands behind numbers, such as `0.3 [m]`";
    unit_of_an_expression: "params { l = 1, r = «(2 * l) [m]» } coords { x } mass { x: r }" => "what depends on parameters has the unit that follows from theirs";
    unit_at_the_wrong_name: "params { l «[m]» = 1 } coords { x } mass { x: l }" => "a unit stands behind numbers, as in `l = 0.3 [m]`";
    constant_like_a_unit_behind_a_vector: "const N: usize = 1; params { f[2] = [0.5, 2.0] «[N]» } coords { x } mass { x: f[0] } force { x: f[1] }" => "`[N]` behind a vector is read as an index, since a constant is called like the unit; rename the constant";
    constant_like_a_unit_of_an_output: "const N: usize = 2; coords { x[N] } mass { x: 1 } output { pull[«N»] = x[0] }" => "`pull[N]` is one member of a family: `N` is the constant here, and no unit; rename the constant";
    constant_like_a_unit_of_an_integral: "const J: usize = 2; coords { x } mass { x: 1 } integral { work[«J»] = x }" => "`work[J]` is one member of a family";
    constant_like_a_unit_behind_a_quotient: "const N: usize = 2; params { f = (1 / 3.0) [«N»] } coords { x } mass { x: f }" => "`N` is the constant here, and no unit; rename the constant";
    parameter_for_a_size: "params { N = 3 } coords { x«[N]» } mass { x: N }" => "`N` is a parameter: the size of a family is a constant, `const N: usize = 3;`; a unit has a space before it, `x [N]`";
    members_of_a_parameter_for_a_size: "params { N = 3, m = 1 } coords { x«[N]» } mass { for i in 0..N { x[i]: m } } force { x[1]: 1 }" => "`N` is a parameter: the size of a family is a constant";
    parameter_for_a_second_size: "params { m = 3 } coords { x[2]«[m]», y [m] } mass { x: m, y: m }" => "`m` is a parameter: the size of a family is a constant";
    value_for_a_size: "let N = 3; coords { x«[N]» } mass { x: N }" => "`N` is a value: the size of a family is a constant";
    coordinate_for_a_size: "coords { m, x«[m]» } mass { m: 1, x: 1 }" => "`m` is declared as something else: the size of a family is a constant";
    size_that_is_nowhere: "coords { x«[N]» } mass { x: 1 }" => "no constant is called `N`: the size of a family is a constant, `const N: usize = 3;`; a unit has a space before it, `x [N]`";
    parameter_for_an_index: "params { N = 3 } coords { x } mass { x: N } output { o«[N]» = x, p [N] = 1 * x }" => "`N` is a parameter: the size of a family is a constant";
    parameter_for_the_size_of_parameters: "params { N = 3, k«[N]» = 2 } coords { x } mass { x: k * N }" => "a unit stands behind numbers, as in `l = 0.3 [m]`, and behind names of coordinates, outputs and integrals where these are declared; an index is a constant, `const N: usize = 3;`, or a variable of a loop";
    name_of_a_constant: "const s: f64 = 2.0; coords { x[«s»] } mass { x: 1 }" => "`s` is not an integer constant or loop variable; a unit is written so where no constant";
}

/// Writes random expressions, with a parameter for each leaf. Dimensions are exponents of kg, m and s.
struct Writer {
    random: Random,
    params: Vec<[i32; 3]>,
}

impl Writer {
    fn dimension(&mut self) -> [i32; 3] {
        std::array::from_fn(|_| self.random.below(5) as i32 - 2)
    }

    /// A new parameter of the dimension `d`.
    fn param(&mut self, d: [i32; 3]) -> String {
        self.params.push(d);
        format!("p{}", self.params.len() - 1)
    }

    /// An expression of the dimension `d`, at most `depth` operations deep.
    fn text(&mut self, d: [i32; 3], depth: usize) -> String {
        if depth == 0 || self.random.below(4) == 0 {
            return match (self.random.below(12), d) {
                (0..4, [0, 1, 0]) => "x".to_owned(),
                (0..4, [0, 1, -1]) => "dot(x)".to_owned(),
                (0..4, [0, 0, 1]) => "t".to_owned(),
                (11, _) => format!("(0.5 * {} + 2)", self.param(d)),
                _ => self.param(d),
            };
        }
        let depth = depth - 1;
        match self.random.below(6) {
            0 => format!("({} - {})", self.text(d, depth), self.text(d, depth)),
            1 => {
                let by = self.dimension();
                let rest = std::array::from_fn(|k| d[k] - by[k]);
                format!("{} * {}", self.text(rest, depth), self.text(by, depth))
            }
            2 => {
                let by = self.dimension();
                let whole = std::array::from_fn(|k| d[k] + by[k]);
                format!("{} / ({})", self.text(whole, depth), self.text(by, depth))
            }
            3 if d.iter().all(|e| e % 2 == 0) => {
                format!("sq({})", self.text(d.map(|e| e / 2), depth))
            }
            3 => format!("sqrt({})", self.text(d.map(|e| 2 * e), depth)),
            4 => {
                let f = ["max", "hypot", "min"][self.random.below(3)];
                format!("{f}({}, {})", self.text(d, depth), self.text(d, depth))
            }
            _ => format!("{} * cos({})", self.param(d), self.text([0; 3], depth)),
        }
    }

    /// A declaration with the output `text` of the dimension `d`, in which the parameter `planted` has another one than it should.
    fn declaration(&self, text: &str, d: [i32; 3], planted: Option<usize>) -> String {
        let unit = |[kg, m, s]: [i32; 3]| {
            format!("kg^{kg} m^{m} s^{s}")
                .replace("kg^0 ", "")
                .replace("m^0 ", "")
                .replace("s^0", "")
        };
        let unit = |d: [i32; 3]| match d {
            [0, 0, 0] => "-".to_owned(),
            d => unit(d),
        };
        let params = self.params.iter().enumerate().map(|(k, d)| {
            let [kg, m, s] = *d;
            let d = if planted == Some(k) {
                [kg, m + 1, s]
            } else {
                *d
            };
            format!("p{k} = 1.{k} [{}]", unit(d))
        });
        let params: Vec<String> = params.collect();
        format!(
            "pub T {{ params {{ {} }} coords {{ x [m] }} mass {{ x: 1 }} output {{ o [{}] = {text} }} }}",
            params.join(", "),
            unit(d)
        )
    }
}

/// Expressions whose units are right are accepted; with one unit wrong they are not.
#[test]
fn random_expressions() {
    let mut writer = Writer {
        random: Random::new(1),
        params: Vec::new(),
    };
    for _ in 0..150 {
        writer.params.clear();
        let d = writer.dimension();
        let text = writer.text(d, 5);
        let right = writer.declaration(&text, d, None);
        let (_, errors) = expand(&right);
        assert!(
            errors.is_empty(),
            "{right}: {:?}",
            errors.iter().map(|e| &e.message).collect::<Vec<_>>()
        );
        if !writer.params.is_empty() {
            let planted = writer.random.below(writer.params.len());
            let wrong = writer.declaration(&text, d, Some(planted));
            let (_, errors) = expand(&wrong);
            assert!(!errors.is_empty(), "accepted: {wrong}");
        }
    }
}
