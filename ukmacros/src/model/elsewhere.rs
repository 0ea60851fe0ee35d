//! Names that other programs have for what has another name here.

/// Names, as many as there are, and what stands here for what they mean.
const NAMES: &[(&str, &str)] = &[
    // Joints.
    (
        "revolute rotational rotary swivel",
        "it is `pin` in the plane and `hinge` in space",
    ),
    ("prismatic translational sliding linear", "it is `slider`"),
    ("spherical ball_joint ball_and_socket", "it is `ball`"),
    ("cylindrical", "it is `cylinder`"),
    ("fixed rigid fix clamp_joint", "it is `weld`"),
    ("helical", "it is `screw`"),
    ("cardan hooke", "it is `universal`"),
    (
        "distance rigid_link bar",
        "what keeps a distance is `rod(p, q, l)`",
    ),
    ("planar_joint point_on_line", "a point on a line is `slot`"),
    // What acts.
    ("moment", "it is `torque`"),
    (
        "torsion_spring torsional_spring rotational_spring rotary_spring angular_spring",
        "it is `turning_spring`",
    ),
    (
        "torsion_damper torsional_damper rotational_damper rotary_damper angular_damper",
        "it is `turning_damper`",
    ),
    (
        "spring_damper springdamper",
        "write a `spring` and a `damper`",
    ),
    // Bodies.
    (
        "point pos position location place to_world to_ground",
        "the point p of a body is `body.at(p)`",
    ),
    (
        "dir direction vec to_world_dir",
        "the direction d of a body is `body.along(d)`",
    ),
    (
        "vel velocity",
        "the velocity of the point p of a body is `dot(body.at(p))`",
    ),
    // Functions.
    (
        "log",
        "the natural logarithm is `ln(x)`, that to base 10 `ln(x) / ln(10)`",
    ),
    ("log10 lg", "it is `ln(x) / ln(10)`"),
    ("log2", "it is `ln(x) / ln(2)`"),
    ("exp2", "it is `powf(2, x)`"),
    ("cbrt", "it is `powf(x, 1.0 / 3.0)`"),
    ("sgn", "it is `sign`"),
    ("square sqr pow2", "it is `sq`"),
    ("arcsin", "it is `asin`"),
    ("arccos", "it is `acos`"),
    ("arctan", "it is `atan`"),
    ("arctan2", "it is `atan2`"),
    ("fabs", "it is `abs`"),
    ("clamp", "it is `max(a, min(b, x))`"),
    ("heaviside step", "it is `(1 + sign(x)) / 2`"),
    (
        "der diff derivative ddt",
        "the derivative by time is `dot(x)`",
    ),
    ("length magnitude mag len", "that of a vector is `norm(v)`"),
    ("normalize unit_vector", "it is `normalise`"),
    (
        "to_radians radians",
        "an angle in degrees is written `30 [deg]`",
    ),
    (
        "to_degrees degrees",
        "an output is in degrees where that is declared: `swing [deg] = a`",
    ),
    (
        "floor ceil round trunc fract",
        "no function here jumps from whole number to whole number",
    ),
];

/// What to write for this `name`; nothing where it is not known to mean something.
pub(crate) fn elsewhere(name: &str) -> Option<&'static str> {
    let found = NAMES
        .iter()
        .find(|(names, _)| names.split(' ').any(|other| other == name));
    found.map(|(_, here)| *here)
}
