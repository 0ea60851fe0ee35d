//! Declarations of random mechanisms.

use std::fmt::Write as _;
use ukalgebra::expr::Random;

/// Particles in a plane with links in trees and loops; some with rods between them that share inertia, some driven, some followed by
/// massless pointers.
pub(super) fn declaration(random: &mut Random) -> String {
    let n = 2 + random.below(5);
    let mut text = format!("pub T {{ const N: usize = {n}; params {{ k = 0.7, ");
    for i in 0..n {
        let _ = write!(text, "m{i} = {}, ", random.between(0.3, 1.3));
    }
    let pointer = random.below(3) == 0;
    let _ = write!(
        text,
        "}} coords {{ x[N], y[N], {} }}",
        if pointer { "th" } else { "" }
    );
    if random.below(2) == 0 {
        text += " kinetic { ";
        for i in 0..n {
            let _ = write!(text, "0.5 * m{i} * (sq(dot(x[{i}])) + sq(dot(y[{i}]))), ");
        }
        for i in 1..n {
            if random.below(2) == 0 {
                let j = random.below(i);
                for c in ["x", "y"] {
                    let _ = write!(
                        text,
                        "k / 6.0 * (sq(dot({c}[{j}])) + dot({c}[{j}]) * dot({c}[{i}]) + sq(dot({c}[{i}]))), "
                    );
                }
            }
        }
        text += "}";
    } else {
        text += " mass { ";
        for i in 0..n {
            let _ = write!(text, "x[{i}]: m{i}, y[{i}]: m{i}, ");
        }
        text += "}";
    }
    text +=
        " force { for i in 0..N { y[i]: -k * dot(y[i]) - 9.8, x[i]: x[i] * y[i] } } holonomic { ";
    // A tree of links, the first to the ground; then loops as long as they leave freedom.
    let mut freedom = 2 * n;
    for i in 0..n {
        if random.below(4) == 0 {
            continue;
        }
        let end = match i {
            0 => "sq(x[0] - 0.2) + sq(y[0] + 0.1)".to_owned(),
            _ => {
                let j = random.below(i);
                format!("sq(x[{i}] - x[{j}]) + sq(y[{i}] - y[{j}])")
            }
        };
        let _ = write!(text, "tree{i}: {end} = k, ");
        freedom -= 1;
    }
    for extra in 0..random.below(3) {
        let (i, j) = (random.below(n), random.below(n));
        if i != j && freedom > 2 {
            let _ = write!(
                text,
                "loop{extra}: x[{i}] * {} + y[{j}] * x[{j}] = sin(x[{i}]) , ",
                random.between(0.3, 1.3)
            );
            freedom -= 1;
        }
    }
    if random.below(3) == 0 && freedom > 1 {
        let _ = write!(text, "driven: y[{}] = 0.3 * sin(2.0 * t), ", n - 1);
    }
    if pointer {
        let _ = write!(text, "pointer: 2.0 * th = x[0] * y[{}], ", n - 1);
    }
    text + "} }"
}

/// Parameters of n parts, a mass `m` and an `other` inertia of each.
fn inertias(random: &mut Random, n: usize, other: char) -> String {
    let mut text = String::new();
    for i in 0..n {
        let [m, j] = [(); 2].map(|()| random.between(0.3, 1.3));
        let _ = write!(text, "m{i} = {m}, {other}{i} = {j}, ");
    }
    text
}

/// Bodies in a plane, pinned in trees and loops at points given by numbers and parameters, some welded, geared or driven; and point masses
/// on bodies, by their velocities as they are given by those of the body.
pub(super) fn bodies(random: &mut Random) -> String {
    let n = 2 + random.below(4);
    let mut text = format!("pub T {{ const N: usize = {n}; params {{ r = 0.4, ");
    text += &inertias(random, n, 'j');
    text += "} coords { x[N], y[N], th[N] } kinetic { ";
    for i in 0..n {
        let _ = write!(
            text,
            "0.5 * m{i} * (sq(dot(x[{i}])) + sq(dot(y[{i}]))) + 0.5 * j{i} * sq(dot(th[{i}])), "
        );
        if random.below(3) == 0 {
            let (a, b) = (random.between(0.3, 1.3), random.between(0.3, 1.3));
            let _ = write!(
                text,
                "0.2 * (sq(dot(x[{i}]) - {a} * sin(th[{i}]) * dot(th[{i}])) + sq(dot(y[{i}]) + {b} * cos(th[{i}]) * dot(th[{i}]))), "
            );
        }
    }
    text += "} force { for i in 0..N { y[i]: -9.8 - dot(y[i]), th[i]: x[i] } } holonomic { ";
    let mut freedom = 3 * n;
    let mut pin = |text: &mut String, i: usize, j: Option<usize>, name: &str| {
        let (a, b) = (random.between(0.3, 1.3), random.between(0.3, 1.3));
        let other = match j {
            Some(j) => format!("[x[{j}] + {b} * cos(th[{j}]), y[{j}] + r * sin(th[{j}])]"),
            None => format!("[{b}, r]"),
        };
        let _ = write!(
            text,
            "{name}: [x[{i}] - {a} * cos(th[{i}]), y[{i}] - {a} * sin(th[{i}])] = {other}, "
        );
        random.below(12)
    };
    for i in 0..n {
        let to = i.checked_sub(1);
        let draw = pin(&mut text, i, to, &format!("pin{i}"));
        freedom -= 2;
        if draw == 0 && i > 0 {
            let _ = write!(text, "gear{i}: r * th[{i}] = 0.7 * th[{}], ", i - 1);
            freedom -= 1;
        } else if draw == 1 {
            let _ = write!(text, "driven{i}: th[{i}] = 0.3 * sin(2.0 * t), ");
            freedom -= 1;
        } else if draw < 5 && freedom > 3 + 3 * (n - 1 - i) {
            pin(&mut text, i, None, &format!("closing{i}"));
            freedom -= 2;
        }
    }
    text + "} }"
}

/// Bodies in space, each joined to one before it or to the ground, some in loops, with inertia about any axes.
pub(super) fn spatial(random: &mut Random) -> String {
    let n = 1 + random.below(3);
    let mut text = String::from("pub T { params { r = 0.3 } bodies { ");
    for i in 0..n {
        let (m, j, k) = (
            random.between(0.3, 1.3),
            1.0 + random.between(0.3, 1.3),
            1.0 + random.between(0.3, 1.3),
        );
        let products = match random.below(2) {
            0 => String::new(),
            _ => format!(", {}, 0.02, -0.03", 0.1 * random.between(0.3, 1.3)),
        };
        let _ = write!(
            text,
            "spatial b{i} {{ mass: {m}, inertia: [{j}, {k}, {}{products}], centre: [r, 0.1, 0] }} ",
            0.5 * (j + k)
        );
    }
    text += "} gravity { [0, 0, -9.81] } holonomic { ";
    let mut freedom = 6 * n;
    for i in 0..n {
        let to = match random.below(i + 1) {
            0 => "ground".to_owned(),
            j => format!("b{}", j - 1),
        };
        let (p, q) = (
            format!("{to}.at([r, 0.2, 0])"),
            format!("b{i}.at([0, 0, 0.1])"),
        );
        let (rows, joint) = match random.below(5) {
            0 => continue,
            1 => (3, format!("ball({p}, {q})")),
            4 => (6, format!("weld({p}, {q})")),
            2 => (5, format!("hinge({p}, {q}, [0, 0.6, 0.8])")),
            _ => (4, format!("universal({p}, {q}, [1, 0, 0], [0, 1, 0])")),
        };
        freedom -= rows;
        let _ = write!(text, "j{i}: {joint}, ");
    }
    let (p, q) = (
        "ground.at([0.4, 0.3, 0.2])",
        format!("b{}.at([r, 0, 0])", n - 1),
    );
    let _ = match random.below(3) {
        0 if freedom > 3 => write!(text, "closing: ball({p}, {q}), "),
        1 if freedom > 1 => write!(text, "closing: rod({p}, {q}, 0.7), "),
        _ => Ok(()),
    };
    text + "} }"
}

/// Points in a plane on rods about fixed points, coupled by rods in chains and trees; some with another inertia in each direction, some
/// with inertia that rods share; with springs, a slider, a crank that is driven.
pub(super) fn linkage(random: &mut Random) -> String {
    let n = 2 + random.below(6);
    let mut text = format!("pub T {{ const N: usize = {n}; params {{ ");
    text += &inertias(random, n, 'k');
    text += "} coords { x[N], y[N] } kinetic { ";
    for i in 0..n {
        let other = if random.below(3) == 0 { "k" } else { "m" };
        let _ = write!(
            text,
            "0.5 * m{i} * sq(dot(x[{i}])) + 0.5 * {other}{i} * sq(dot(y[{i}])), "
        );
        if i > 0 && random.below(2) == 0 {
            for c in ["x", "y"] {
                let before = i - 1;
                let _ = write!(
                    text,
                    "k{i} / 6.0 * (sq(dot({c}[{before}])) + dot({c}[{before}]) * dot({c}[{i}]) + sq(dot({c}[{i}]))), "
                );
            }
        }
    }
    text += "} force { for i in 0..N { y[i]: -9.8 - dot(y[i]), x[i]: x[i] * y[i] } } holonomic { ";
    let mut freedom = 2 * n;
    for i in 0..n {
        let (a, b) = (random.between(0.3, 1.3), random.between(0.3, 1.3));
        let row = match random.below(6) {
            0 => continue,
            1 => format!("slide{i}: {a} * x[{i}] + {b} * y[{i}] = sin(t), "),
            2 => format!("bent{i}: sin(x[{i}]) + {a} * y[{i}] * x[{i}] = {b}, "),
            _ => format!("crank{i}: sq(x[{i}] - {a}) + sq(y[{i}] + {b}) = 1.0, "),
        };
        text += &row;
        freedom -= 1;
    }
    for i in 1..n {
        if freedom > 1 && random.below(4) > 0 {
            let j = if random.below(3) == 0 {
                random.below(i)
            } else {
                i - 1
            };
            let _ = write!(
                text,
                "coupler{i}: sq(x[{i}] - x[{j}]) + sq(y[{i}] - y[{j}]) = 1.0, "
            );
            freedom -= 1;
        }
    }
    text + "} }"
}
