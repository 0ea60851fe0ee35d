//! Compiler from declarations of constrained mechanical systems to the code of their dynamics. Used through `ukcore`.
//!
//! Layers, each using only those before it: `diag` (errors), `parse` (tokens to syntax tree), `model` (names, families, loops),
//! `expr` (hash-consed graph, derivatives), `analysis` (M, Q, A, b; structure; checks; order of computation), `emit` (Rust).

mod analysis;
mod diag;
mod emit;
mod expr;
mod model;
mod parse;

#[cfg(test)]
mod tests;

use proc_macro2::TokenStream;

/// Declares a mechanism and emits its dynamics.
///
/// The declaration becomes a struct of its parameters with an implementation of `ukcore::Mechanism`: straight-line code for
/// M, Q, A, b (and c) of Zhao, Zhen & Chen 2013, eqs. 1, 5 and 8. Constraints are differentiated symbolically, twice, when the
/// macro runs; the emitted type's own documentation shows the result.
///
/// ```
/// ukcore::multibody! {
///     /// A pendulum of length l hanging from a spring.
///     pub SpringPendulum {
///         params {
///             /// Mass of the bob, kg
///             m = 1.0,
///             l = 1.0, g = 9.81, k = 50.0,
///         }
///         coords { s, x, y }                                   // support, bob; y points up
///         mass { s: 0.2 * m, x: m, y: m }
///         potential { m * g * y, 0.2 * m * g * s, 0.5 * k * sq(s) }
///         holonomic { rod: sq(x) + sq(y - s) = sq(l) }
///         output { angle = atan2(x, s - y) }
///     }
/// }
/// assert_eq!((SpringPendulum::Y, SpringPendulum::default().k), (2, 50.0));
/// ```
///
/// # Sections
///
/// All are optional but `coords` or `bodies`, and, without bodies, one of `mass`, `kinetic` or `holonomic`. Entries are separated by commas,
/// which may be left out where the next entry starts with a name. `for i in a..b { … }` repeats entries in every section, and may be nested. Families and loops
/// have at most 5000 members. A family may have several indices: `p[N][3]`; the last runs fastest.
///
/// | section | entries | meaning |
/// | --- | --- | --- |
/// | `const N: usize = 17;` | | an integer (or `f64`) known at compile time |
/// | `params` | `m = 1.0`, `k[N] = 2.0`, `r[2][3] = [[1, 0, 0], [0, 1, 0]]` | parameters with defaults, a family's one for all members or one for each; public `f64` fields (arrays for families), changeable at run time |
/// | `coords` | `x[N]`, `p[N][3]`, `th` | coordinates q: scalars and families; inside a `for`, `x[i]` declares one member |
/// | `bodies` | `planar link[i] { mass: m, inertia: j, centre: [a, 0] }` | [bodies](#bodies), which have coordinates, kinetic energy and weight |
/// | `gravity` | `[0, -g]` | the acceleration of free fall of all bodies, a vector of the plane or of space |
/// | `let` | `let d = x - y;`, `let f = \|u, v\| u * v;`, `let { for i in 0..N { d[i] = … } }` | names for values, functions, families of values |
/// | `mass` | `x: m`, `p: m`, `(x, y): m12` | entries of M(q, t), taken literally as in eq. 1; entries for one place add up; a family has one mass for all members, or a vector of them |
/// | `kinetic` | `0.5 * m * sq(dot(x))` | instead of `mass`: terms of T(q, q̇, t); M = ∂²T/∂q̇² and the velocity terms of Lagrange's equations are derived |
/// | `force` | `x: -c * dot(x)`, `p[i]: -c * dot(p[i])` | generalised forces Q; entries for one coordinate add up; a vector of coordinates takes a vector |
/// | `forces` | `spring(p, q, k, l)` | what [acts on bodies](#what-acts-on-bodies) |
/// | `dissipation` | `0.5 * c * sq(dot(x))` | terms of Rayleigh's R(q, q̇, t); −∂R/∂q̇ goes into Q |
/// | `potential` | `m * g * y` | terms of V(q, t); −∂V/∂q goes into Q |
/// | `holonomic` | `rod: sq(x) + sq(y) = sq(l)`, `joint: [a, b] = [c, d]`, `knee: pin(p, q)` | φ(q, t) = 0 (eq. 3); a vector equation gives one constraint for each component; redundant equations are welcome, but the same one under two names is taken for a slip, an error |
/// | `nonholonomic` | `blade: dot(x) * sin(th) = dot(y) * cos(th)` | φ(q, q̇, t) = 0 (eq. 4), linear in q̇ or not |
/// | `nonideal` | `x: -mu * n * sign(dot(x))` | the force c of eq. 8, which may do work in virtual displacements; entries as of `force` |
/// | `output` | `fall = y[0]` | quantities to report, of q, q̇, t |
/// | `draw` | `line(p, q)` | [shapes](#pictures) of the mechanism's picture |
/// | `start` | `released(angle = 0.5) { th = angle; x near 1.0; dot(th) = 0.0 }` | a [start](#starts); there may be several |
///
/// # Expressions
///
/// Rust's grammar. Numbers, `PI`, the time `t`, names, members `x[i + 1]`, `+ - * /`, `dot(q)` for a velocity (of an expression of q and
/// t: its total time derivative), `sum(0..N, |i| …)`, and in
/// function or method form: `sqrt sin cos tan asin acos atan sinh cosh tanh asinh acosh atanh exp ln abs sign atan2 min max hypot powf`,
/// `sq`, `recip` and `powi`. A power is `x.powi(2)` (exponents from −64 to 64) or `sq(x)`, never `x ^ 2`. Parentheses around a sum are
/// kept in the emitted arithmetic. Sums and products may be as long as they like, but are nested at most 100 deep.
///
/// abs and sign have derivative sign and 0 (0 at 0); min and max follow the branch taken. Where the equations of motion depend on one of
/// them, the function whose sign decides its branch is a switch: it stands in `T::SPEC.switches`, and simulations step onto its zeros.
/// So does the length that they divide by in v/|v|, as `dot(x) / hypot(dot(x), dot(y))`: a run that comes to rest there is told of it.
/// sqrt at 0, asin, acos and atanh at ±1, acosh at 1, ln and negative powers at 0, atan2 and hypot at (0, 0) have no finite derivative:
/// evaluating there is reported as an error at run time.
///
/// # Vectors and matrices
///
/// `[a, b]` is a vector, `[[a, b], [c, d]]` a matrix by rows. The name of a family is the vector, or matrix, of its members where it stands
/// without an index, and `p[i]` is the row i of `p[N][3]`. `v[0]` is a component of any vector: of a name, of a function's result, of an
/// expression in parentheses; `m[1][2]` an entry of a matrix. What is written with vectors is short for the same in components, and costs
/// what that costs: products with constant zeros and ones vanish, and an equation of vectors is one constraint for each component.
///
/// | expression | meaning |
/// | --- | --- |
/// | `u + v`, `u - v`, `-v` | by components, of one shape; the number 0, as a sum over nothing is, fits any |
/// | `k * v`, `v * k`, `v / k` | with a number |
/// | `m * v`, `m * n` | of a matrix with a vector, or with a matrix |
/// | `dot(v)` | the total time derivative, by components |
/// | `sq(v)` | vᵀv, as `sq` of a number is its square |
/// | `inner(u, v)` | uᵀv |
/// | `norm(v)`, `normalise(v)` | √(vᵀv), and v/√(vᵀv), which is not defined where v = 0 |
/// | `cross(u, v)` | u × v of vectors of 3; of vectors of 2 the number u₀v₁ − u₁v₀ |
/// | `rotx(a)`, `roty(a)`, `rotz(a)` | the 3×3 matrices that turn vectors by the angle a (right-handed) about a coordinate axis |
/// | `rot(a)` | the 2×2 matrix that turns vectors by the angle a, from x towards y |
/// | `transpose(m)` | mᵀ |
/// | `normal(v)` | the unit vector of the plane at a right angle to v, to its left |
/// | `normals(v)` | two unit vectors of space at right angles to v and to each other, right-handed with v as the third |
///
/// All of them have a method form, too: `u.cross(v)`. Their names are not reserved: a coordinate or constraint may be called `norm`, and a
/// function declared as `let inner = …` takes the place of this one.
///
/// # Functions
///
/// `let f = |u, v| …;` names a function. Its arguments and its result are numbers, vectors or matrices of any shape, and stand for their
/// values: `f` applied to vectors of 2 and of 3 is two functions. Arguments hide whatever has their names outside, as those of `sum` do.
/// A function sees what is declared, not the loop variables around its use. It may apply other functions, but not itself.
///
/// An argument that is an integer may serve as an index: with `let apart = |i, j| norm(p[i] - p[j]);`, `apart(0, i + 1)` is a distance. A
/// function made of integers alone, its arguments, constants and functions like it declared before it, is an integer itself, and stands
/// in indices, ranges and exponents: with `let next = |i| (i + 1) - N * ((i + 1) / N);`, `x[next(i)]` is the neighbour in a ring.
///
/// ```
/// use ukcore::{Simulation, State, assemble};
///
/// ukcore::multibody! {
///     /// A brick that hangs from a spherical joint in a corner: place of its centre, unit quaternion (a, im) from body to space.
///     pub Brick {
///         params { m = 2.0, inertia[3] = [0.05, 0.04, 0.02], corner[3] = [0.1, 0.2, 0.3], g = 9.81 }
///         coords { p[3], a, im[3] }
///         let turned = |v| v + 2 * a * cross(im, v) + 2 * cross(im, cross(im, v));
///         let omega = 2 * (a * dot(im) - dot(a) * im - cross(im, dot(im)));   // in axes of the body
///         let diagonal = |d| [[d[0], 0, 0], [0, d[1], 0], [0, 0, d[2]]];
///         kinetic { 0.5 * m * sq(dot(p)), 0.5 * inner(omega, diagonal(inertia) * omega) }
///         potential { m * g * p[2] }
///         holonomic { unit: sq(a) + sq(im) = 1, joint: p + turned(corner) = 0 }
///         output { spin = norm(omega) }
///     }
/// }
/// let guess = State { t: 0.0, q: vec![0.1, 0.0, -0.3, 1.0, 0.0, 0.0, 0.0], v: vec![0.0; 7] };
/// let start = assemble(Brick::default(), guess, &[])?;
/// let run = Simulation::new(Brick::default()).tolerance(1e-10).start(start).until(1.0)?;
/// assert!(run.energy_drift() < 1e-9);
/// assert_eq!((Brick::IM, Brick::JOINT), ([4, 5, 6], [1, 2, 3]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Bodies
///
/// A rigid body has a frame, in which its points and directions are given. `centre` is its centre of mass in that frame, the origin if left
/// out. Its coordinates are the place of its **centre of mass** in axes of the ground, and its orientation:
///
/// | body | coordinates | mass and inertia |
/// | --- | --- | --- |
/// | `planar arm { mass: m, inertia: j, centre: [a, b] }` | `arm.x`, `arm.y`, `arm.angle` from x towards y | about the centre of mass; where one is left out it is 0, and constraints decide |
/// | `spatial top { mass: m, inertia: [i, j, k], centre: [a, b, c] }` | `top.x`, `top.y`, `top.z`, and the Euler parameters `top.e0`, `top.e1`, `top.e2`, `top.e3`: the unit quaternion that turns its axes from those of the ground, (1, 0, 0, 0) where they agree | about the centre of mass, in axes of the body: principal moments, or `[xx, yy, zz, xy, xz, yz]` or the matrix of 3×3, with the signs of the inertia tensor (xy = −∫ x y dm) |
///
/// With the centre of mass as its place, the mass matrix of planar bodies is diagonal and constant, and points depend on that place with
/// unit coefficients. A spatial body brings the constraint `top.unit`, e₀² + e₁² + e₂² + e₃² = 1, and its kinetic energy makes M that of
/// `kinetic`; a guess of a start needs an orientation, e₀ = 1 say. Constants of the type are `T::ARM_X`, `T::ARM_ANGLE`, `T::TOP_E0`,
/// `T::TOP_UNIT`, arrays for families of bodies. An inertia that no rigid body has is an error: of the declaration by the defaults of the
/// parameters, else of the run.
///
/// In expressions all vectors are in axes of the ground. `p` and `d` are vectors in the frame of the body:
///
/// | expression | meaning |
/// | --- | --- |
/// | `arm.at(p)` | the point p of the body, a vector; `dot(arm.at(p))` is its velocity |
/// | `arm.along(d)` | the direction d of the body, a vector |
/// | `arm.centre` | the centre of mass, a vector |
/// | `arm.angle`, `arm.x`, … | a coordinate; in `mass`, `force` and `nonideal` entries are given to it as `arm.angle: -c * arm.omega` |
/// | `arm.omega` | the angular velocity: a number in the plane, a vector in space |
/// | `top.spin` | the angular velocity in axes of the spatial body |
/// | `arm.axes` | the matrix that turns vectors from the body's axes to those of the ground |
/// | `ground.at(p)`, `ground.along(d)` | p and d themselves, as of a body that does not move; its `angle` and `omega` are 0 |
///
/// # Joints
///
/// A joint is short for rows: `knee: pin(p, q)` is `knee: q - p = 0`, and gives `knee[0]` and `knee[1]`. What stands in this table is what
/// differentiation sees and what `explain` shows. `p` and `q` are points as `thigh.at([l, 0])` gives them, and know their body. Directions
/// are given in the frame of the body of `p`, and are the same numbers in that of `q` unless told otherwise; they need not be unit vectors,
/// nor are they zero. **Multipliers act on the second body**: λ pushes the body of `q` in the direction in which the row grows, and that of `p`
/// against it. Of a row that is a distance, λ is the force; of `rod` it is half the force over the length.
///
/// | planar joint | rows |
/// | --- | --- |
/// | `pin(p, q)` | `q - p` |
/// | `weld(p, q, [angle])` | `q - p`, `q.angle - p.angle - angle`, the angle 0 if left out |
/// | `slider(p, q, d, [angle])` | `inner(p.along(normal(d)), q - p)`, `q.angle - p.angle - angle`: q slides on the line through p along d, without turning |
/// | `slot(p, q, d)` | `inner(p.along(normal(d)), q - p)`: q slides on that line, and may turn |
/// | `wheel(p, q, d, r)` | `inner(p.along(normal(d)), q - p) - r`, `inner(p.along(normalise(d)), q - p) + r * (q.angle - p.angle)`: a wheel of radius r about q rolls on that line, to its left |
/// | `rack(p, q, d, r)` | the second row of `wheel`: a pinion about q on a rack along d |
/// | `gear(a, b, r, s)` | `r * a.angle + s * b.angle`: bodies of radii r and s roll on each other outside; with s < 0 one inside the other |
/// | `turn(a, b)` | `b.angle - a.angle`; a motor is `motor: turn(a, b) = w * t` |
/// | `rod(p, q, l)` | `sq(q - p) - sq(l)`, in space, too |
///
/// With `n = normals(u)` and `u`, `w` of unit length:
///
/// | spatial joint | rows |
/// | --- | --- |
/// | `ball(p, q)` | `q - p` |
/// | `hinge(p, q, u, [w])` | `q - p`, `inner(p.along(n[k]), q.along(w))` for k = 0, 1: both turn about u, which is w in the second body |
/// | `universal(p, q, u, w)` | `q - p`, `inner(p.along(u), q.along(w))`: u of the first body is at a right angle to w of the second |
/// | `cylinder(p, q, u, [w])` | `inner(p.along(n[k]), q - p)`, `inner(p.along(n[k]), q.along(w))`: q slides along u and turns about it |
/// | `slider(p, q, u, [turn])` | `inner(p.along(n[k]), q - p)`, and the last three rows of `weld` |
/// | `weld(p, q, [turn])` | `q - p`; `inner(p.along(x), q.along(y))`, likewise of y and z, of z and x: `turn` is the matrix that turns axes of the second body to those of the first, the identity if left out |
/// | `drive(a, b, u, angle)` | `inner(a.along(cos(angle) * n[0] + sin(angle) * n[1]), b.along(n[1]))`: a motor for a hinge about u, at any number of turns |
/// | `screw(p, q, u, lead)` | under `nonholonomic`, beside `cylinder`: the velocity along u is lead/2π times that of turning |
/// | `disc(q, u, r)` | `q[2] - r * sqrt(1 - sq(q.along(u)[2]))`: a disc of radius r about q with axis u touches the plane z = 0 |
/// | `rolls(q, u, r)` | under `nonholonomic`, beside `disc`: the point of the disc that touches has no velocity along x and y |
///
/// Rows of directions at right angles are met, too, where a body is turned over; the nearest state to the guess decides. A function of the
/// declaration may be a joint, too: with `let hook = |p, q| pin(p, q + [0, h]);`, `c: hook(p, q)` is one.
///
/// # What acts on bodies
///
/// | entry of `forces` | meaning |
/// | --- | --- |
/// | `spring(p, q, k, l)` | the potential ½ k (‖q − p‖ − l)² |
/// | `turning_spring(a, b, k, angle)` | of planar bodies ½ k (b.angle − a.angle − angle)² |
/// | `damper(p, q, c)` | the force c d‖q − p‖/dt that pulls p and q together |
/// | `turning_damper(a, b, c)` | the moment −c (b.omega − a.omega) on b, and the opposite one on a |
/// | `force(p, F)` | the force F at the point p, a vector in axes of the ground |
/// | `force(p, q, F)` | the force F, a number, that pushes p and q apart |
/// | `torque(b, M)` | the moment M on b: a number in the plane, a vector in axes of the ground in space |
/// | `torque(a, b, M)` | the moment M on b, and the opposite one on a |
///
/// A force or moment F on what has the velocity v goes into Q as (∂v/∂q̇)ᵀ F.
///
/// ```
/// use ukcore::{Simulation, State, assemble};
///
/// ukcore::multibody! {
///     /// A four-bar linkage with a turning spring between coupler and rocker.
///     pub FourBar {
///         params { l[3] = [0.5, 2.0, 1.5], m = 1.0, span = 2.0, k = 3.0, g = 9.81 }
///         bodies { for i in 0..3 { planar bar[i] { mass: m, inertia: m * sq(l[i]) / 12.0, centre: [l[i] / 2.0, 0] } } }
///         gravity { [0, -g] }
///         holonomic {
///             o: pin(ground.at([0, 0]), bar[0].at([0, 0]))
///             p: pin(bar[0].at([l[0], 0]), bar[1].at([0, 0]))
///             q: pin(bar[1].at([l[1], 0]), bar[2].at([l[2], 0]))
///             r: pin(ground.at([span, 0]), bar[2].at([0, 0]))
///         }
///         forces { turning_spring(bar[1], bar[2], k, 1.0) }
///         output { tip = bar[1].at([1.0, 0.3]), crank = bar[0].angle }
///     }
/// }
/// let mut guess = State { t: 0.0, q: vec![0.0; 9], v: vec![0.0; 9] };
/// for (bar, angle) in FourBar::BAR_ANGLE.into_iter().zip([1.0, 0.3, 1.4]) {
///     guess.q[bar] = angle;
/// }
/// let start = assemble(FourBar::default(), guess, &["bar[0].angle"])?;
/// let run = Simulation::new(FourBar::default()).start(start).tolerance(1e-10).until(1.0)?;
/// assert!(run.energy_drift() < 1e-8);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # What is emitted
///
/// For `pub T { … }`: `struct T` with its parameters as public fields, `Default`, `Clone`, `Debug`, `PartialEq`; `T::N` for constant `N`;
/// index constants `T::X` for coordinate `x` (`[usize; N]` for families, `[[usize; 3]; N]` for `p[N][3]`; θ stays `T::θ`, which Θ looks
/// like), `T::ROD` for the row of constraint `rod`, `T::OUT_FALL` for output `fall`. Families of constraints and outputs have theirs if
/// their indices are 0, 1, 2, … and their members are numbers, or vectors of one length; the names of all stand in `T::SPEC`. Two names
/// that would become one constant are an error. Further, `impl ukcore::Mechanism for T`.
///
/// A parameter, or what is declared by `let`, that no expression names is reported by the lint `dead_code` in the compiler's own words, as
/// a field that is never read, a constant or function that is never used; but not where its name begins with `_`. `#[allow(dead_code)]`
/// before the type's name silences it.
///
/// What is emitted names the crate `::ukcore`. Where it has another name, or is reached through another crate, the declaration says so
/// before the type: `#[ukcore(crate = my::path::to::ukcore)]`.
///
/// # Grammar
///
/// ```text
/// declaration = docs, ["#[ukcore(crate = path)]"], {"#[allow(lints)]"}, [vis], NAME, "{", { section }, "}" ;
/// section     = "const", NAME, ":", ("usize" | "f64"), "=", expr, ";"
///             | "let", NAME, "=", (expr | function), ";"
///             | "let", block(key, "=", (expr | function))
///             | "params", block(docs, key, "=", expr)
///             | "coords", block(docs, key)
///             | "bodies", block(docs, ("planar" | "spatial"), key, "{", { ("mass" | "inertia" | "centre"), ":", expr, [","] }, "}")
///             | "mass", block((place | "(", place, ",", place, ")"), ":", expr)
///             | ("gravity" | "kinetic" | "potential" | "dissipation" | "forces"), block(expr)
///             | ("force" | "nonideal"), block(place, ":", expr)
///             | ("holonomic" | "nonholonomic"), block(key, ":", expr, ["=", expr])
///             | "output", block(docs, key, "=", expr) ;
/// block(e)    = "{", { (e | "for", NAME, "in", expr, "..", expr, "{", { e }, "}"), ["," | ";"] }, "}" ;
/// key         = NAME, { "[", expr, "]" } ;
/// place       = key, [".", NAME] ;
/// function    = "|", NAME, { ",", NAME }, "|", expr ;
/// ```
///
/// # Starts
///
/// `start name(option = 1.0, …) { … }` says where a motion begins, by parameters and the options of the start, which are called like no
/// parameter. `x = value` holds a coordinate and `dot(x) = value` its velocity; `x near value` is a guess, from which the constraints may
/// move it. All else is near 0, a spatial body near the orientation in which its axes are those of the ground. The state nearest to that, in
/// the mass metric, which satisfies all constraints is the start: with several branches it is the one that the guesses are near.
///
/// ```
/// ukcore::multibody! {
///     /// A crank with a rod that slides through a fixed eye; y points up.
///     pub Crank {
///         params { r = 0.3, eye = 1.0, g = 9.81 }
///         coords { crank, rod, x, y }
///         mass { crank: 0.1, rod: 0.2, x: 1.0, y: 1.0 }
///         potential { g * y }
///         holonomic {
///             pin: [x, y] = r * [cos(crank), sin(crank)],
///             eye_line: (eye - x) * sin(rod) = -y * cos(rod),
///         }
///         /// crank at an angle, turning
///         start turning(
///             /// Angle of the crank, rad
///             angle = 0.5,
///             /// Its angular velocity, rad/s
///             speed = 2.0,
///         ) {
///             crank = angle;
///             dot(crank) = speed;
///             rod near 0.0
///         }
///     }
/// }
/// # fn main() -> Result<(), ukcore::Error> {
/// let start = Crank::default().start("turning", &[("angle", 1.0)].into())?;
/// assert_eq!((start.q[Crank::CRANK], start.v[Crank::CRANK]), (1.0, 2.0));
/// assert!((start.q[Crank::Y] - 0.3 * 1.0_f64.sin()).abs() < 1e-15);
/// # Ok(())
/// # }
/// ```
///
/// `T::SPEC.starts` lists them; programs made by `uktool::main!` take them by `--start`, and options by `--set`.
///
/// # Pictures
///
/// Bodies and joints have a picture by themselves: lines through the points where bodies are joined, springs, rods, places on the ground. `draw`
/// takes its place. Points are vectors of the plane or of space, of q, q̇, t and parameters; what is declared first is at the back.
///
/// | shape | meaning |
/// | --- | --- |
/// | `line(p, q)`, `polyline(p, q, r, …)` | a line through points |
/// | `circle(c, r)` | a circle about a point; in space a sphere |
/// | `spring(p, q)` | a zigzag from one to the other |
/// | `trace(p)` | the path that a point has gone |
/// | `text(p, "driver")` | a text beside a point |
///
/// ```
/// ukcore::multibody! {
///     /// A pendulum; y points up.
///     pub Pendulum {
///         params { l = 1.0, g = 9.81 }
///         coords { a }
///         let bob = l * [sin(a), -cos(a)];
///         kinetic { 0.5 * sq(dot(bob)) }
///         potential { g * bob[1] }
///         draw { line([0, 0], bob) circle(bob, 0.1 * l) trace(bob) }
///     }
/// }
/// use ukcore::Mechanism as _;
/// let mut numbers = [0.0; 9];
/// Pendulum::default().prepared().drawing(0.0, &[0.0], &[0.0], &mut numbers);
/// assert_eq!(numbers, [0.0, 0.0, 0.0, -1.0, 0.0, -1.0, 0.1, 0.0, -1.0]);
/// ```
///
/// Programs made by `uktool::main!` show it: `animate pendulum` writes a page on which the motion is played.
///
/// `expr` is Rust's expression grammar. Errors point at the token at fault; after an error the type still exists, so that one mistake gives
/// one message.
#[proc_macro]
pub fn multibody(input: proc_macro::TokenStream) -> proc_macro::TokenStream {
    expand(input.into()).0.into()
}

/// The pipeline.
fn expand(input: TokenStream) -> (TokenStream, diag::Diagnostics) {
    let diag = diag::Diagnostics::default();
    let Some(mut decl) = parse::parse(input, &diag) else {
        return (diag.to_tokens(), diag);
    };
    let before = diag.len();
    let model = model::resolve(&mut decl, expr::Func::all().map(|f| f.row().name), &diag);
    // Where names are missing because of an error, what follows from that is not reported.
    let quiet = diag::Diagnostics::default();
    let trusted = !diag.damaged() && diag.len() == before;
    let heard = if trusted { &diag } else { &quiet };
    let mut system = expr::lower(&decl, &model, heard);
    let constants = analysis::constants(&model, &system, heard);
    if let Some(analysis) = analysed(&decl, &model, &mut system, &diag) {
        let code = emit::emit(&decl, &model, &system, &constants, &analysis);
        return (code, diag);
    }
    let mut tokens = diag.to_tokens();
    tokens.extend(emit::fallback(&decl, &model, &system, &constants));
    (tokens, diag)
}

/// What is known about a mechanism, if there is no error.
fn analysed(
    decl: &parse::Declaration,
    model: &model::Model,
    system: &mut expr::System,
    diag: &diag::Diagnostics,
) -> Option<analysis::Analysis> {
    if !diag.is_empty() {
        return None;
    }
    let n = model.coord_elements.len();
    let dynamics = analysis::derive(system, n);
    analysis::check(system, &dynamics, model, diag);
    if !diag.is_empty() {
        return None;
    }
    let mut defects = Vec::new();
    if cfg!(debug_assertions) {
        let wrong = analysis::verify(system, &dynamics, n).into_iter();
        defects.extend(wrong.map(|what| format!("wrong derivatives of {what}")));
    }
    let analysis = analysis::analyse(system, model, dynamics);
    let changed = analysis.defect.iter();
    defects.extend(changed.map(|k| format!("value {k} changed by hoisting")));
    for defect in defects {
        let message = format!("defect in `multibody!`: {defect}; please report it");
        diag.error(decl.name.span(), message);
    }
    diag.is_empty().then_some(analysis)
}
