//! No input makes the macro panic.

use super::expand;
use ukalgebra::expr::Random;

/// Pieces that declarations are made of, and some that they are not.
const PIECES: [&str; 131] = [
    "pub",
    "T",
    "{",
    "}",
    "(",
    ")",
    "[",
    "]",
    "const",
    "N",
    ":",
    "usize",
    "=",
    "3",
    ";",
    "params",
    "m",
    "1.0",
    ",",
    "coords",
    "x",
    "y",
    "x[N]",
    "let",
    "f",
    "|a|",
    "a",
    "mass",
    "x: m",
    "kinetic",
    "force",
    "potential",
    "holonomic",
    "nonholonomic",
    "nonideal",
    "output",
    "integral",
    "reaction(c)",
    "moment(c)",
    "friction(dot(x), 1.0)",
    "for i in 0..N",
    "for",
    "in",
    "..",
    "dot(x)",
    "sin",
    "sq",
    "^",
    "**",
    "+",
    "-",
    "*",
    "/",
    "t",
    "PI",
    "c: x = 1.0",
    "sum(0..3, |i| i)",
    "///doc\n",
    "#[a]",
    "\"s\"",
    "'a'",
    "i64::MAX",
    "p[N][2]",
    "p",
    "p[1]",
    "[0]",
    "[x, y]",
    "[[x, y], [1.0, m]]",
    "inner(",
    "cross(",
    "norm(p)",
    "normalise",
    ".transpose()",
    "rot(x)",
    "rotx(t)",
    "rotz",
    "sq(p)",
    "dot(p)",
    "next(0)",
    "|i, j|",
    "let next = |i| i + 1;",
    "let { for i in 0..N { d[i][0] = x } }",
    "d",
    "for j in 0..2",
    "p: 1.0",
    "c[0][1]: p = d",
    "k[2][2] = [[1.0, 2.0], [3.0, 4.0]]",
    "#[allow(dead_code)]",
    "bodies { planar b { mass: m, inertia: 1.0 } }",
    "bodies { for i in 0..N { planar c[i] { mass: m } } }",
    "spatial s { mass: 1, inertia: [1, 1, 1], centre: [0, m, 0] }",
    "gravity { [0, -9.81] }",
    "forces",
    "dissipation { sq(b.omega) }",
    "b",
    "b.at([1, 0])",
    "b.along(",
    "ground.at([0, 0])",
    "ground",
    ".angle",
    ".omega",
    "b.x: 1.0",
    "pin(",
    "c: pin(b.at([1, 0]), ground.at([x, 0]))",
    "hinge(s.at([0, 0, 0]), ground.at([0, 0, 0]), [1, 0, m])",
    "spring(b.at([0, 0]), ground.at([0, 1]), 1, 1)",
    "torque(b, 1)",
    "tree { c: pin(ground.at([0, 0]), b.at([0, 1])) }",
    "tree",
    "j: hinge(ground.at([0, 0, 0]), s.at([0, m, 0]), [1, 0, 0])",
    "j[i]: slider(c[i].at([0, m]), b.at([x, 0]), [1, 0])",
    "j.angle",
    "j[0].slide: dot(j.angle)",
    "parts { leg[2]: Leg { l: m } }",
    "leg[1].shin[0]",
    "leg[0].shin[1].angle: leg[1].tip[0]",
    "@parts [{ Leg } { pub Leg { params { l = 1.0 } bodies { planar shin[2] { mass: l, inertia: 1 } } let tip = shin[0].at([l, 0]); } } { }]",
    "#[ukcore(part)]",
    "[m]",
    "[kg m^2]",
    "2.0 [N",
    "m = 1.0 [kg]",
    "x [m/s]",
    "[-]",
    "start s(p = 30 [deg]) {",
    "near",
    "until 2.0",
    "dot(b.centre) near",
    "draw {",
    "trace(b.at([1, 0]))",
    "text([x, y], \"s\")",
];

/// A declaration that works, to be damaged.
const WHOLE: &str = "pub T { const N: usize = 3; params { m = 1.0, k[N] = 2.0 } coords { x[N], y } let f = |a| a * m; \
    mass { for i in 0..N { x[i]: m } y: m } force { y: f(dot(y)) } potential { sum(0..N, |i| 0.5 * k[i] * sq(x[i])) } \
    holonomic { for i in 0..N - 1 { c[i]: sq(x[i + 1] - x[i]) = sin(t) } d: [x[0], y] = [y * 2.0, x[1]] } \
    nonholonomic { e: dot(x[0]) = y * dot(y) } nonideal { y: -dot(y) } output { o = hypot(x[0], y) } }";

/// One of vectors, to be damaged.
const VECTORS: &str = "pub T { const N: usize = 2; params { m[N] = [1.0, 2.0], r[N][3] = 0.5 } coords { p[N][3], a[N], s } \
    let next = |i| (i + 1) - N * ((i + 1) / N); let at = |i, v| p[i] + rotz(a[i]) * v; let { for i in 0..N { d[i] = at(i, r[next(i)]) } } \
    kinetic { for i in 0..N { 0.5 * m[i] * sq(dot(p[i])) } 0.5 * sq(dot(a)) + 0.5 * sq(dot(s)) } force { p[1]: cross(d[0], dot(p[0])), a: [t, s] } \
    holonomic { pin: d[0] = d[1] + [s, 0, t]; for i in 0..N { c[i][0]: norm(p[i]) = inner(transpose(rot(s))[0], a) } } \
    nonideal { p[0]: -normalise(dot(p[0])) } output { o = d, e = (rot(t) * a)[1] } }";

/// One of bodies, to be damaged.
const BODIES: &str = "pub T { const N: usize = 2; params { m[N] = [1.0, 2.0], l = 0.5, g = 9.81 } bodies { for i in 0..N { planar link[i] { \
    mass: m[i], inertia: 0.1, centre: [l / 2, 0] } } spatial top { mass: 1, inertia: [1, 1, 1.5] } } gravity { [0, -g, 0] } \
    holonomic { o: pin(ground.at([0, 0]), link[0].at([0, 0])); for i in 0..N - 1 { knee[i]: pin(link[i].at([l, 0]), link[i + 1].at([0, 0])) } \
    foot: hinge(ground.at([0, 0, 0]), top.at([0, l, 0]), [0, 1, 0]) motor: turn(ground, link[0]) = sin(t) } forces { spring(link[1].at([l, 0]), \
    ground.at([1, 0]), 2, 1) torque(top, [0, t, 0]) } dissipation { sq(link[1].omega) } nonideal { link[0].angle: friction(link[0].omega, norm(reaction(o)) + abs(reaction(motor))) } \
    output { tip = dot(link[1].at([l, 0])), s = top.spin, f = reaction(knee[0]), d = reaction(foot.tilt0), m = moment(foot) } integral { w = reaction(motor) * t } }";

/// One of a tree, to be damaged.
const TREE: &str = "pub T { const N: usize = 2; params { l = 0.5, g = 9.81 } bodies { planar link[N] { mass: 1, inertia: 0.1, centre: [l / 2, 0] } \
    for i in 0..3 { spatial top[i] { mass: 1, inertia: [1, 1, 1.5] } } } gravity { [0, -g, 0] } tree { knee[0]: pin(ground.at([0, 0]), link[0].at([0, 0])) \
    knee[1]: slot(link[0].at([l, 0]), link[1].at([0, 0]), [1, l]); arm: hinge(ground.at([0, 0, 0]), top[0].at([0, l, 0]), [0, 1, 0]) \
    hand: ball(top[0].at([0, 0, l]), top[1].at([0, l, 0])) screw: screw(top[1].at([0, 0, 0]), top[2].at([0, 0, 0]), [1, 0, 0], l) } \
    holonomic { loop_: pin(link[1].at([l, 0]), ground.at([1, 0])) motor: arm.angle = sin(t) } force { knee[1].slide: -dot(knee[0].angle) } \
    output { tip = dot(link[1].at([l, 0])), s = top[2].spin } }";

/// One of parts, to be damaged.
const PARTS: &str = "@parts [{ Leg } { pub Leg { const N: usize = 2; params { l = 0.5, m[2] = [1.0, 2.0], k = 2 * l } bodies { for i in 0..N { \
    planar shin[i] { mass: m[i], inertia: 0.1 } } } let tip = shin[1].at([l, 0]); tree { knee: pin(shin[0].at([l, 0]), shin[1].at([0, 0])) } \
    output { tip = tip + sum(0..N, |i| m[i]) * [1, 0] } } } { }] pub T { params { size = 0.7 } bodies { planar trunk { mass: 1, inertia: 1 } } \
    parts { for i in 0..2 { leg[i]: Leg { l: size + i / 10.0 } } tail: Leg } tree { for i in 0..2 { hip[i]: pin(trunk.at([i, 0]), leg[i].shin[0].at([0, 0])) } } \
    force { leg[1].knee.angle: 1.0, tail.shin[0].x: leg[0].m[1] } output { reach = norm(leg[1].tip - trunk.centre) + tail.l } \
    start s(a = 1.0) { leg[0].knee.angle = a; hip[1].angle near 2; dot(tail.shin[0].x) = 1 } }";

/// One with units, to be damaged.
const UNITS: &str = "pub T { const N: usize = 2; const G: f64 = 9.81 [m/s^2]; params { m = 1.0 [kg], l[N] = [300, 2] [mm], k = 2 [N/m], c = 0.1 [N s/m], tau = 1 [N m] } \
    coords { x [m], a[N] [rad] } bodies { planar b { mass: m, inertia: m * sq(l[0]) / 12, centre: [l[1] / 2, 0] } } gravity { [0, -G] } let f = |u, s| u * s; \
    mass { x: m + 2 [g], a: m * sq(l[1]) } force { x: -c * dot(x) - f(k, x) } potential { m * 9.81 [m/s^2] * x, 0.5 * k * sq(x - 3 [mm]) } \
    holonomic { r: sq(x) + sq(b.x) = sq(l[0] + 2) + x * l[1]; p: [b.y, x] = [l[0] * sin(a[1]), l[1]] } forces { torque(b, tau) spring(b.at([0.1, 0]), ground.at([0, 0]), k, 1 [cm]) } \
    nonideal { a[0]: friction(dot(a[0]), 1 [mm] * norm(reaction(p))) } output { o [mm] = x, w [rpm] = b.omega } integral { e [mJ] = tau * b.omega } \
    start s(p0 = 30 [deg], v = (1 + 2) [m/s]) { a[0] = p0; dot(x) near v; b.x near 1 } }";

/// One with starts and a picture, to be damaged.
const DRAWN: &str = "pub T { const N: usize = 2; params { l = 0.5 } bodies { for i in 0..N { planar link[i] { mass: 1, inertia: 0.1, centre: [l / 2, 0] } } } \
    holonomic { o: pin(ground.at([0, 0]), link[0].at([0, 0])); p: pin(link[0].at([l, 0]), link[1].at([0, 0])) } let tip = link[1].at([l, 0]); \
    /// Drawn out\n start out(/// Angle\n a = 30 [deg], v = 1.0) until 2.0 { link[0].angle = a; for i in 0..N { dot(link[i].angle) = v - i } [link[1].x, link[1].y] near l * [1, sin(a)] } \
    start down { link[1].centre near [0, -l]; dot(link[1].centre) near 0; link[0].omega = 1 } \
    draw { for i in 0..N { line(link[i].at([0, 0]), link[i].at([l, 0])) } polyline([0, 0], link[0].centre, tip) circle(tip, l / 5) spring(tip, [1, 0]) trace(tip) text(tip, \"tip\") } }";

/// A source that is told where the test fails.
struct Told<'a>(&'a str);

impl Drop for Told<'_> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            eprintln!("the source: {}", self.0);
        }
    }
}

fn survives(source: &str) {
    let _told = Told(source);
    if let Ok(tokens) = source.parse::<proc_macro2::TokenStream>() {
        let (code, _) = crate::expand(tokens);
        assert!(!code.is_empty(), "something is always emitted");
    }
}

#[test]
fn the_whole_declarations_compile() {
    for source in [WHOLE, VECTORS, BODIES, TREE, PARTS, UNITS, DRAWN] {
        let (_, errors) = expand(source);
        assert!(errors.is_empty(), "{errors:?}");
    }
}

#[test]
fn random_pieces() {
    let mut random = Random::new(1);
    for _ in 0..400 {
        let text: Vec<&str> = (0..random.below(40))
            .map(|_| PIECES[random.below(PIECES.len())])
            .collect();
        let text = text.join(" ");
        survives(&text);
        survives(&format!("pub T {{ {text} }}"));
        survives(&format!(
            "{} pub T {{ parts {{ leg[2]: Leg }} {text} }}",
            PIECES[112]
        ));
        survives(&format!(
            "pub T {{ coords {{ x, y }} mass {{ x: 1.0, y: 1.0 }} holonomic {{ {text} }} }}"
        ));
        survives(&format!(
            "pub T {{ coords {{ x, y }} force {{ x: {text} }} }}"
        ));
        survives(&format!(
            "pub T {{ params {{ m = 1.0 }} coords {{ x }} mass {{ x: m }} bodies {{ planar b {{ mass: m, inertia: 1 }} spatial s {{ mass: m, \
            inertia: [1, 1, 1] }} }} forces {{ {text} }} }}"
        ));
        survives(&format!(
            "pub T {{ params {{ m = 1.0 }} coords {{ x }} mass {{ x: m }} bodies {{ planar b {{ mass: m, inertia: 1 }} planar c[2] {{ mass: m, \
            inertia: 1 }} spatial s {{ mass: m, inertia: [1, 1, 1] }} }} tree {{ {text} }} }}"
        ));
        survives(&format!(
            "pub T {{ const N: usize = 2; params {{ m = 1.0 }} coords {{ x, y, p[N][2] }} let next = |i| i + 1; force {{ p[0]: {text} }} }}"
        ));
    }
}

#[test]
fn damaged_declarations() {
    let mut random = Random::new(1);
    for _ in 0..400 {
        let (at, length, piece) = (
            random.below(900),
            random.below(12),
            random.below(PIECES.len()),
        );
        for whole in [WHOLE, VECTORS, BODIES, TREE, PARTS, UNITS, DRAWN] {
            let characters: Vec<char> = whole.chars().collect();
            let at = at.min(characters.len());
            let end = (at + length).min(characters.len());
            let (before, after): (String, String) = (
                characters[..at].iter().collect(),
                characters[end..].iter().collect(),
            );
            survives(&format!("{before}{}{after}", PIECES[piece]));
        }
    }
}

#[test]
fn any_tokens() {
    let mut random = Random::new(1);
    for _ in 0..800 {
        let character = |random: &mut Random| match random.below(4) {
            0 => char::from_u32(random.below(0x11_0000) as u32)
                .filter(|c| !c.is_control())
                .unwrap_or('é'),
            _ => char::from(b' ' + random.below(95) as u8),
        };
        let text: String = (0..random.below(60))
            .map(|_| character(&mut random))
            .collect();
        survives(&text);
        survives(&format!("pub T {{ coords {{ x }} mass {{ x: {text} }} }}"));
    }
}
