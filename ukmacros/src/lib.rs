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
///             /// Mass of the bob
///             m = 1.0 [kg],
///             l = 1.0 [m], g = 9.81 [m/s^2], k = 50.0 [N/m],
///         }
///         coords { s [m], x [m], y [m] }                       // support, bob; y points up
///         mass { s: 0.2 * m, x: m, y: m }
///         potential { m * g * y, 0.2 * m * g * s, 0.5 * k * sq(s) }
///         holonomic { rod: sq(x) + sq(y - s) = sq(l) }
///         output { angle [deg] = atan2(x, s - y) }
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
/// | `params` | `m = 1.0`, `l = 300 [mm]`, `k[N] = 2.0`, `r[2][3] = [[1, 0, 0], [0, 1, 0]]` | parameters with defaults, a family's one for all members or one for each; public `f64` fields (arrays for families), changeable at run time |
/// | `coords` | `x[N]`, `p[N][3]`, `th`, `s [m]` | coordinates q: scalars and families, with their [units](#units); inside a `for`, `x[i]` declares one member |
/// | `bodies` | `planar link[i] { mass: m, inertia: j, centre: [a, 0] }` | [bodies](#bodies), which have coordinates, kinetic energy and weight |
/// | `tree` | `knee: pin(thigh.at(p), shank.at(q))` | [joints of the tree](#joints-of-the-tree): the second body has no coordinates of its own, but those of the joint |
/// | `parts` | `leg[6]: Leg { phase: 0.2 }` | [other declarations](#parts) within this one |
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
/// | `nonideal` | `x: -mu * n * sign(dot(x))` | the force c of eq. 8, which may do work in virtual displacements; entries as of `force`; may use [reactions](#reactions) |
/// | `output` | `fall = y[0]`, `swing [deg] = th` | quantities to report, of q, q̇, t and reactions |
/// | `integral` | `work = torque * dot(th)` | quantities of q, q̇, t and reactions to be [integrated](#integrals) by time |
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
/// | `friction(v, F)` | −F v/√(vᵀv), a force of size F against the velocity v; of a number v it is −F sign(v). It is a switch where v vanishes |
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
/// in indices, ranges and exponents, where `/` rounds towards zero: with `let next = |i| (i + 1) - N * ((i + 1) / N);`, `x[next(i)]` is the
/// neighbour in a ring. In a formula it is a number like others, and a quotient of integers that is not whole is an error there.
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
/// A joint is short for rows: `knee: pin(p, q)` is `knee: q - p = 0`, with its rows called `knee.x` and `knee.y`. What stands in this table
/// is what differentiation sees and what `explain` shows. A joint of several rows names each by what it keeps; a joint of one row has its
/// own name alone, and rows of any other vector equation have numbers, `c[0]`, as `T::KNEE[0]` has for all. Messages, tables and
/// `reaction(knee.x)` use these names. `p` and `q` are points as `thigh.at([l, 0])` gives them, and know their body. Directions
/// are given in the frame of the body of `p`, and are the same numbers in that of `q` unless told otherwise; they need not be unit vectors,
/// nor are they zero. **Multipliers act on the second body**: λ pushes the body of `q` in the direction in which the row grows, and that of `p`
/// against it. Of a row that is a distance, λ is the force; of `rod` it is half the force over the length.
///
/// | planar joint | names | rows |
/// | --- | --- | --- |
/// | `pin(p, q)` | `.x`, `.y` | `q - p` |
/// | `weld(p, q, [angle])` | `.x`, `.y`, `.angle` | `q - p`, `q.angle - p.angle - angle`, the angle 0 if left out |
/// | `slider(p, q, d, [angle])` | `.normal`, `.angle` | `inner(p.along(normal(d)), q - p)`, `q.angle - p.angle - angle`: q slides on the line through p along d, without turning |
/// | `slot(p, q, d)` |  | `inner(p.along(normal(d)), q - p)`: q slides on that line, and may turn |
/// | `wheel(p, q, d, r)` | `.normal`, `.rolling` | `inner(p.along(normal(d)), q - p) - r`, `inner(p.along(normalise(d)), q - p) + r * (q.angle - p.angle)`: a wheel of radius r about q rolls on that line, to its left |
/// | `rack(p, q, d, r)` |  | the second row of `wheel`: a pinion about q on a rack along d |
/// | `gear(a, b, r, s)` |  | `r * a.angle + s * b.angle`: bodies of radii r and s roll on each other outside; with s < 0 one inside the other |
/// | `turn(a, b)` |  | `b.angle - a.angle`; a motor is `motor: turn(a, b) = w * t` |
/// | `rod(p, q, l)` |  | `sq(q - p) - sq(l)`, in space, too |
///
/// With `n = normals(u)` and `u`, `w` of unit length:
///
/// | spatial joint | names | rows |
/// | --- | --- | --- |
/// | `ball(p, q)` | `.x`, `.y`, `.z` | `q - p` |
/// | `hinge(p, q, u, [w])` | `.x`, `.y`, `.z`, `.tilt0`, `.tilt1` | `q - p`, `inner(p.along(n[k]), q.along(w))` for k = 0, 1: both turn about u, which is w in the second body |
/// | `universal(p, q, u, w)` | `.x`, `.y`, `.z`, `.cross` | `q - p`, `inner(p.along(u), q.along(w))`: u of the first body is at a right angle to w of the second |
/// | `cylinder(p, q, u, [w])` | `.n0`, `.n1`, `.tilt0`, `.tilt1` | `inner(p.along(n[k]), q - p)`, `inner(p.along(n[k]), q.along(w))`: q slides along u and turns about it |
/// | `slider(p, q, u, [turn])` | `.n0`, `.n1`, `.xy`, `.yz`, `.zx` | `inner(p.along(n[k]), q - p)`, and the last three rows of `weld` |
/// | `weld(p, q, [turn])` | `.x`, `.y`, `.z`, `.xy`, `.yz`, `.zx` | `q - p`; `inner(p.along(x), q.along(y))`, likewise of y and z, of z and x: `turn` is the matrix that turns axes of the second body to those of the first, the identity if left out |
/// | `drive(a, b, u, angle)` |  | `inner(a.along(cos(angle) * n[0] + sin(angle) * n[1]), b.along(n[1]))`: a motor for a hinge about u, at any number of turns |
/// | `screw(p, q, u, lead)` |  | under `nonholonomic`, beside `cylinder`: the velocity along u is lead/2π times that of turning |
/// | `disc(q, u, r)` |  | `q[2] - r * sqrt(1 - sq(q.along(u)[2]))`: a disc of radius r about q with axis u touches the plane z = 0 |
/// | `rolls(q, u, r)` | `.x`, `.y` | under `nonholonomic`, beside `disc`: the point of the disc that touches has no velocity along x and y |
///
/// Rows of directions at right angles are met, too, where a body is turned over; the nearest state to the guess decides. A function of the
/// declaration may be a joint, too: with `let hook = |p, q| pin(p, q + [0, h]);`, `c: hook(p, q)` is one.
///
/// # Joints of the tree
///
/// The same joint under `tree` instead of `holonomic` gives no rows. Its second body *hangs* on it: it has no coordinates of its own, and its
/// place, orientation and velocities follow from those of the first body, or the ground, and from the coordinates that the joint has. For
/// everything else it is a body as others are. Moving a joint from one section to the other is all that changes; what closes a loop stays
/// under `holonomic`, and so does a motor: `motor: knee.angle = w * t`. Each body hangs on one joint at most, and not on itself by others.
/// The coordinates of joints follow those of bodies in q:
///
/// | joint | coordinates | meaning |
/// | --- | --- | --- |
/// | `knee: pin(p, q)` | `knee.angle` | the angle of the second body less that of the first |
/// | `slider(p, q, d, [angle])` | `.slide` | the way of q from p along d |
/// | `slot(p, q, d)` | `.slide`, `.angle` | both |
/// | `hinge(p, q, u, [w])` | `.angle` | right-handed about u, 0 where `normals(u)` of the first body are `normals(w)` of the second |
/// | `cylinder(p, q, u, [w])` | `.slide`, `.angle` | the way of q from p along u, and the angle |
/// | `screw(p, q, u, lead)` | `.angle` | q is lead/2π times the angle away from p along u |
/// | `slider(p, q, u, [turn])` | `.slide` | the way of q from p along u |
/// | `universal(p, q, u, w)` | `.first`, `.second` | the angles about u of the first body and w of the second. At 0 axes of both agree, if u and w are at right angles; if not, w is brought to a right angle with u in their plane |
/// | `ball(p, q)` | `.e0` to `.e3` | the unit quaternion that turns axes of the second body from those of the first, with the constraint `.unit`; a guess of a start needs e₀ = 1, say |
/// | `weld(p, q, …)` | none | |
///
/// Constants of the type are `T::KNEE_ANGLE`, arrays where the joints that have the coordinate make up a family with indices 0, 1, 2, …, else
/// `T::KNEE_2_ANGLE`. Points are written where the joint stands, `body.at(p)`, of vectors that do not change. A body that hangs has no
/// quaternion to name, nor entries of `force`: those are its joint's, or `torque(body, M)`. Its kinetic energy is written in velocities in
/// its own axes, each by those of the body before: what elimination makes of that grows in proportion to the bodies.
///
/// ```
/// use ukcore::{Simulation, State};
///
/// ukcore::multibody! {
///     /// An arm of two hinges, the second driven; z points up.
///     pub Arm {
///         params { l = 0.5, g = 9.81 }
///         bodies { for i in 0..2 { spatial link[i] { mass: 1, inertia: [0.01, 0.03, 0.03], centre: [l / 2.0, 0, 0] } } }
///         gravity { [0, 0, -g] }
///         tree {
///             shoulder: hinge(ground.at([0, 0, 0]), link[0].at([0, 0, 0]), [0, 1, 0])
///             elbow: hinge(link[0].at([l, 0, 0]), link[1].at([0, 0, 0]), [0, 1, 0])
///         }
///         force { elbow.angle: 2.0 - 0.3 * dot(elbow.angle) }
///         output { hand = link[1].at([l, 0, 0]) }
///     }
/// }
/// let start = State { t: 0.0, q: vec![0.0; 2], v: vec![0.0; 2] };
/// let run = Simulation::new(Arm::default()).start(start).until(0.5)?;
/// assert_eq!((Arm::SHOULDER_ANGLE, Arm::ELBOW_ANGLE), (0, 1));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Parts
///
/// A declaration that says `#[ukcore(part)]` may be part of others, any number of times, in its module, its crate, and, where its type is
/// `pub`, in other crates. It is a mechanism by itself all the same. `use` brings it into scope with its type.
///
/// ```
/// mod legs {
///     ukcore::multibody! {
///         /// Two bars with a spring in the knee.
///         #[ukcore(part)]
///         pub Leg {
///             params { l = 0.5, m = 1.0, k = 3.0 }
///             bodies { planar bar[2] { mass: m, inertia: m * sq(l) / 12.0, centre: [l / 2.0, 0] } }
///             tree { knee: pin(bar[0].at([l, 0]), bar[1].at([0, 0])) }
///             forces { turning_spring(bar[0], bar[1], k, 0.4) }
///             output { toe = bar[1].at([l, 0]) }
///         }
///     }
/// }
/// use legs::Leg;
///
/// ukcore::multibody! {
///     /// A trunk on six of them; y points up.
///     pub Walker {
///         params { size = 0.4, g = 9.81 }
///         bodies { planar trunk { mass: 5, inertia: 1 } }
///         gravity { [0, -g] }
///         parts { for i in 0..6 { leg[i]: Leg { l: size, m: 1 + i / 10.0 } } }
///         tree { for i in 0..6 { hip[i]: pin(trunk.at([i / 5.0, 0]), leg[i].bar[0].at([0, 0])) } }
///         force { leg[2].knee.angle: -0.3 * dot(leg[2].knee.angle) }
///         output { reach = norm(leg[5].bar[1].at([leg[5].l, 0]) - trunk.centre) }
///     }
/// }
/// assert_eq!((Walker::default().leg_k, Walker::LEG_5_KNEE_ANGLE), (3.0, 14));
/// ```
///
/// All sections of a part are taken into the whole, under the names of the part: `leg[2].bar[0].at(p)` is a point of a body, `leg[2].knee`
/// the name of a joint or a constraint, `leg[2].l` a parameter, and so on for coordinates, constants and what `let` declares, but for
/// functions. Coordinates, rows and outputs are shown under these names; constants of the type are `T::LEG_2_KNEE_ANGLE`, fields `leg_k`.
///
/// In braces parameters of the part are given, as expressions of those of the whole: a number for all of a family, or a vector. `{ l }` is
/// short for `{ l: l }`. A parameter whose default uses one that is given follows it. **What is not given becomes a parameter of the whole**
/// with the default it has, one for all members of a family: `leg_k` above. `gravity` acts on all bodies: that of the whole replaces those
/// of parts, and must be there if they have one. A part may have parts; what they leave open is given as `{ foot_mass: 1 }`. Its
/// starts are its own.
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
/// # Reactions
///
/// `reaction(knee)` is what a constraint pushes with, under `output`, `integral`, `draw` and `nonideal`, and in functions used there. Members of
/// families are chosen as `reaction(link[2])`, rows of a joint as `reaction(knee.x)`.
///
/// | of | meaning |
/// | --- | --- |
/// | a joint between points: `pin`, `slider`, `rod`, `hinge`, `disc`, … | the force on the second body, in axes of the ground, a vector; of several rows their sum |
/// | a joint between bodies: `gear`, `turn`, `drive` | its multiplier, a number: of `turn` the moment on the second body |
/// | a row of a joint | its multiplier λ; Aᵀλ is its share in the generalised forces. Of an `angle` it is the moment on the second body; of a row e · f of a direction of the first body with one of the second the moment on the second is λ f × e |
/// | any other constraint | its multiplier, a number, or of a vector equation the vector of them: the force along what stands on its left side, less the right |
///
/// Forces act at q, on the first body, too, as its lines turn with it; of `wheel`, `rack`, `disc` and `rolls` at the point of contact.
/// They are those of **ideal constraints**: λ of M q̈ = Q + Aᵀλ, A q̈ = b, the equations without c. By eq. 8 the constraint force is this
/// ideal part and one that c determines, which does not change the first. So `nonideal { s: friction(dot(s), mu * norm(reaction(track)))
/// }` is no circle: λ is solved for, then c, then q̈.
///
/// What eq. 8 leaves out is that friction itself loads constraints. Friction at one joint is carried by others, as the force of a belt on
/// a second pulley or the tangential force of a jamming wedge on the opposite wall; in rigid bodies with dry friction these loads raise
/// friction in turn, so that λ follows from a system that need not have one solution (Painlevé). `reaction` does not contain them. It is
/// the whole force where friction acts along directions that the constraints leave free and that inertia does not couple to their rows, as
/// for particles on surfaces and wires and blocks on planes; else what is left out is of the order of μ times the reaction.
///
/// Where constraints imply each other λ is not unique: loads are shared in ways that rigid bodies do not know. All reactions of the
/// mechanism are then not a number at that state, and a run whose `nonideal` uses them ends there with an error that says so.
/// `Trajectory::multipliers` tells which are unique. Reactions are solved for on the straight line; where there is none, using one is an
/// error.
///
/// ```
/// use ukcore::{Simulation, State};
///
/// ukcore::multibody! {
///     /// A bead on a rough ring in a level plane, of radius r.
///     pub Bead {
///         params { m = 0.1, mu = 0.2, r = 0.5 }
///         coords { p[2] }
///         let drag = |v| friction(v, mu * norm(reaction(ring) * 2 * p));
///         mass { p: m }
///         holonomic { ring: sq(p) = sq(r) }
///         nonideal { p: drag(dot(p)) }
///         integral { lost = -inner(drag(dot(p)), dot(p)) }
///     }
/// }
/// let start = State { t: 0.0, q: vec![0.5, 0.0], v: vec![0.0, 2.0] };
/// let run = Simulation::new(Bead::default()).tolerance(1e-10).start(start).until(3.0)?;
/// let (end, lost) = (run.last().unwrap(), run.integral("lost")?);
/// let speed = 2.0 / (1.0 + 0.2 * 2.0 * 3.0 / 0.5); // v̇ = −μ v²/r
/// assert!((end.v[0].hypot(end.v[1]) - speed).abs() < 1e-8);
/// assert!((lost.last().unwrap() - 0.05 * (4.0 - speed * speed)).abs() < 1e-8);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Integrals
///
/// `integral { work = torque * dot(th) }` gives ∫ τ θ̇ dt since the start of a run: `Trajectory::integral("work")`, a column of its table,
/// and `Sample::integrals`, where `T::INT_WORK` is its place. Integrals are no coordinates: no equation depends on them, and the steps of
/// a run are the same with and without. Each accepted step of any method is integrated along its interpolant, to the tolerance of the run
/// beside the integral of the magnitude, kinks and jumps included; that costs the interpolant of each step, as `Simulation::dense` does.
/// No expression uses an integral. Members of ensembles have none.
///
/// # What is emitted
///
/// For `pub T { … }`: `struct T` with its parameters as public fields, `Default`, `Clone`, `Debug`, `PartialEq`; `T::N` for constant `N`;
/// index constants `T::X` for coordinate `x` (`[usize; N]` for families, `[[usize; 3]; N]` for `p[N][3]`; θ stays `T::θ`, which Θ looks
/// like), `T::ROD` for the row of constraint `rod`, `T::OUT_FALL` for output `fall`, `T::INT_WORK` for integral `work`. Families of
/// constraints, outputs and integrals have theirs if their indices are 0, 1, 2, … and their members are numbers, or vectors of one length;
/// the names of all stand in `T::SPEC` and `T::INTEGRALS`. Two names that would become one constant are an error. Further, `impl
/// ukcore::Mechanism for T`.
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
/// declaration = docs, ["#[ukcore(crate = path)]"], ["#[ukcore(part)]"], {"#[allow(lints)]"}, [vis], NAME, "{", { section }, "}" ;
/// section     = "const", NAME, ":", ("usize" | "f64"), "=", expr, ";"
///             | "let", NAME, "=", (expr | function), ";"
///             | "let", block(key, "=", (expr | function))
///             | "params", block(docs, key, "=", expr)
///             | "coords", block(docs, key, [unit])
///             | "bodies", block(docs, ("planar" | "spatial"), key, "{", { ("mass" | "inertia" | "centre"), ":", expr, [","] }, "}")
///             | "tree", block(docs, key, ":", expr)
///             | "parts", block(key, ":", path, ["{", { NAME, [":", expr], [","] }, "}"])
///             | "mass", block((place | "(", place, ",", place, ")"), ":", expr)
///             | ("gravity" | "kinetic" | "potential" | "dissipation" | "forces"), block(expr)
///             | ("force" | "nonideal"), block(place, ":", expr)
///             | ("holonomic" | "nonholonomic"), block(key, ":", expr, ["=", expr])
///             | ("output" | "integral"), block(docs, key, [unit], "=", expr)
///             | docs, "start", NAME, ["(", { docs, NAME, "=", expr, [","] }, ")"], ["until", expr], block(guess)
///             | "draw", block(NAME, "(", { (expr | STRING), [","] }, ")") ;
/// block(e)    = "{", { (e | "for", NAME, "in", expr, "..", expr, "{", { e }, "}"), ["," | ";"] }, "}" ;
/// key         = NAME, { "[", expr, "]" } ;
/// guess       = (places | "dot", "(", places, ")"), ("=" | "near"), expr ;
/// places      = place | "[", place, { ",", place }, "]" ;
/// place       = key, { ".", key } ;
/// function    = "|", NAME, { ",", NAME }, "|", expr ;
/// unit        = "[", ("-" | factor, { ["*" | "/"], factor }), "]" ;              (in an expr behind a number or a vector of numbers)
/// factor      = "1" | NAME, ["^", ["-"], NUMBER] ;
/// ```
///
/// # Starts
///
/// `start name(option = 1.0, …) { … }` says where a motion begins, by parameters and the options of the start, which are called like no
/// parameter. `x = value` holds a coordinate and `dot(x) = value` its velocity; `x near value` is a guess, from which the constraints may
/// move it. `[x, y] near l * [sin(a), -cos(a)]` and `dot([x, y]) = …` say so of several at once; of a body `arm.centre`, `dot(arm.centre)`,
/// `arm.omega` and, in its own axes, `arm.spin` are such vectors: the rates of a quaternion are those that it has where the body is found
/// to be. All else is near 0; a spatial body of whose quaternion nothing is said is near the orientation in which its axes are those of the
/// ground. From there the constraints are approached by a local search in the mass metric: with several branches its end is one that the
/// guesses are near, and the nearer they are to each other's meaning, the surer. `start name(…) until 2.0 { … }` says how long a run from
/// it is of interest, in units of time; if it does not, tools take 10.
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
///             /// Angle of the crank
///             angle = 30 [deg],
///             /// Its angular velocity
///             speed = 2.0 [rad/s],
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
/// # Units
///
/// A unit stands behind a number, `0.3 [m]`, or a vector of numbers, `[0.5, 2.0] [m]`, and behind the name of a coordinate, an output or an
/// integral where that is declared. It is a product of powers: `[kg m^2]`, `[N/mm]`, `[m/s^2]`, `[1/s]`, `[N/m^1.5]`, and `[-]` for a plain
/// number. Known are g, m, s, min, h, rad, deg, °, turn, rpm, N, Nm, J, W, Pa, and G, M, k, c, m, u, µ, n before those that take prefixes. A
/// hertz is refused: some mean a turn a second by it and some 1/s.
///
/// **Equations are in SI.** `l = 300 [mm]` is 0.3, and so is the field `l`; an angle is in radians. Coordinates are declared in units
/// without a factor. Outputs and integrals are given in the unit declared: `swing [deg] = th` is in degrees.
///
/// **Dimensions are checked**, over all sections, when the macro runs: terms and sides of equations, arguments of functions, energies,
/// forces, masses, what bodies, joints and springs are made of, starts, outputs. The radian is 1. Units are optional: what has none fits
/// everything, and where none is declared nothing is refused. A bare number is a plain one where it is a factor, as in `0.5 * m`; `m * 9.81 * y`
/// is no energy, `m * 9.81 [m/s^2] * y` is one. Where it stands by itself, as in `x + 2`, `[0.3, 0]` or `let g = 9.81;`, it may be of
/// anything.
///
/// ```compile_fail
/// ukcore::multibody! {
///     pub Bead {
///         params { m = 0.1 [kg], k = 3.0 [N/m], c = 0.2 [N s/m] }
///         coords { x [m] }
///         mass { x: m }
///         force { x: -k * x - c * x }   // error: subtracts kg m/s from N
///     }
/// }
/// ```
///
/// They are handed on: to the documentation of the type, to `T::SPEC` (`unit` of parameters, options of starts and outputs,
/// `coordinate_unit`), and to programs made by `uktool::main!`, which take `--set l=250mm` and refuse `--set l=3kg`. Brackets hold an index
/// where all that is named in them are constants, loop variables or arguments: with `const N: usize = 3;` a force is in `[kg m/s^2]`.
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
    let (table, source) = parse::split(input);
    let Some(mut decl) = parse::parse(source.clone(), &diag) else {
        return (diag.to_tokens(), diag);
    };
    if let Some(part) = model::missing(&decl, &table, &diag) {
        return (emit::ask(&decl, part, &table, &source), diag);
    }
    let parsed = diag.len();
    model::merge(&mut decl, &table, &diag);
    let before = parsed;
    let model = model::resolve(&mut decl, expr::Func::all().map(|f| f.row().name), &diag);
    // Where names are missing because of an error, what follows from that is not reported.
    let quiet = diag::Diagnostics::default();
    let faulty = decl.merged.faulty;
    let trusted = !faulty && !diag.damaged() && diag.len() == before;
    let heard = if trusted { &diag } else { &quiet };
    let mut system = expr::lower(&decl, &model, heard);
    let constants = analysis::constants(&model, &system, heard);
    if !faulty {
        expr::units(&decl, &model, &mut system, &diag);
    }
    let handed = |faulty| {
        decl.part
            .then(|| emit::part(&decl, &source, &table, faulty))
    };
    if !faulty && let Some(analysis) = analysed(&decl, &model, &mut system, &diag) {
        let mut code = emit::emit(&decl, &model, &system, &constants, &analysis);
        code.extend(handed(false));
        return (code, diag);
    }
    diag.within(&model.shown, &decl.merged.places);
    let mut tokens = diag.to_tokens();
    tokens.extend(handed(true));
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
    if let (Some(reason), Some(place)) = (&analysis.unsolved, system.reaction) {
        let message = format!(
            "reactions cannot be used here, as they are not solved for on a straight line: {reason}; ask the solution of a run for its multipliers"
        );
        diag.error(place, message);
    }
    let changed = analysis.defect.iter();
    defects.extend(changed.map(|k| format!("value {k} changed by hoisting")));
    for defect in defects {
        let message = format!("defect in `multibody!`: {defect}; please report it");
        diag.error(decl.name.span(), message);
    }
    diag.is_empty().then_some(analysis)
}
