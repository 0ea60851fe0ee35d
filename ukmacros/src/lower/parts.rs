//! Joints, springs and forces: functions written in the language itself, so that each is short for equations that could stand in its place.
//!
//! The first arguments are points of bodies; the constraint force acts on the body of the second, in the direction in which the row grows.

mod acting;
mod carried;

pub(super) use acting::Acting;
pub(super) use carried::Carried;
use carried::Carrier;

use super::array::{Value, describe};
use super::bodies::Frame;
use super::reactions::Load;
use super::{Env, Lowering, Place};
use crate::diag::Loc;
use crate::model::{Scope, arguments};
use crate::parse::{Expr, ExprKind, own};
use proc_macro2::Ident;
use std::collections::BTreeSet;
use std::rc::Rc;
use ukalgebra::expr::Id;

/// What an argument is.
#[derive(Clone, Copy, PartialEq)]
enum Takes {
    /// A point of a body.
    Point,
    /// A body, or a point of one.
    Body,
    /// A direction: a vector that is not zero.
    Direction,
    Number,
    /// A number that is not zero.
    Length,
    /// A vector in space; in the plane a number.
    Moment,
    /// A vector.
    Force,
    /// A 3×3 matrix.
    Turn,
}

/// The world that a part is of: the plane, space, or both.
#[derive(Clone, Copy, PartialEq)]
enum Home {
    Plane,
    Space,
    Both,
}

/// What a part is good for.
enum Meaning {
    /// Rows, one after the other, and the names of those of a joint that has several; and along what the first ones push q for a multiplier
    /// of 1, where that is not along the axes.
    Rows(
        &'static [&'static str],
        &'static str,
        &'static [&'static str],
    ),
    /// A term of V.
    Energy(&'static str),
    /// What has this velocity is pushed by this force; and what of the velocity points have by moving in their bodies, where the force acts
    /// on these.
    Push(
        &'static str,
        &'static str,
        &'static [(&'static str, &'static str)],
    ),
}

/// An argument of a part.
struct Argument {
    name: &'static str,
    takes: Takes,
    /// What it is measured in, where that is not told by what it takes.
    unit: &'static str,
    /// What stands for it where it is left out, if it may be.
    default: &'static str,
}

/// A joint, or what acts with a force.
pub(super) struct Part {
    pub(super) name: &'static str,
    home: Home,
    args: &'static [Argument],
    meaning: Meaning,
}

macro_rules! parts {
    ($($name:literal $home:ident ($($arg:ident: $takes:ident $([$unit:literal])? $(= $default:literal)?),*) $meaning:ident($($text:tt)*);)*) => {
        pub(super) static PARTS: &[Part] = &[$(Part {
            name: $name,
            home: Home::$home,
            args: &[$(Argument {
                name: stringify!($arg),
                takes: Takes::$takes,
                unit: concat!($($unit)?),
                default: concat!($($default)?),
            }),*],
            meaning: Meaning::$meaning($($text)*),
        }),*];
    };
}

/// What rounding leaves of offsets, as a share of them.
const ROUNDED: f64 = 64.0 * f64::EPSILON;

/// What of the rate of the distance of p and q each has by moving in its body.
const SLIDING_ENDS: &[(&str, &str)] = &[
    ("p", "-inner(normalise(q - p), p.along(dot(p.within)))"),
    ("q", "inner(normalise(q - p), q.along(dot(q.within)))"),
];

parts! {
    "pin" Plane (p: Point, q: Point) Rows(&["q - p"], "x y", &[]);
    "weld" Plane (p: Point, q: Point, angle: Number["rad"] = "0") Rows(&["q - p", "q.angle - p.angle - angle"], "x y angle", &[]);
    "slider" Plane (p: Point, q: Point, d: Direction, angle: Number["rad"] = "0")
        Rows(&["inner(p.along(normal(d)), q - p)", "q.angle - p.angle - angle"], "normal angle", &["p.along(normal(d))"]);
    "slot" Plane (p: Point, q: Point, d: Direction) Rows(&["inner(p.along(normal(d)), q - p)"], "", &["p.along(normal(d))"]);
    "gear" Plane (a: Body, b: Body, r: Number, s: Number, carrier: Body = "ground")
        Rows(&["r * (a.angle - carrier.angle) + s * (b.angle - carrier.angle)"], "", &[]);
    "rack" Plane (p: Point, q: Point, d: Direction, r: Number["m"])
        Rows(&["inner(p.along(normalise(d)), q - p) + r * (q.angle - p.angle)"], "", &["p.along(normalise(d))"]);
    "wheel" Plane (p: Point, q: Point, d: Direction, r: Number["m"]) Rows(&[
        "inner(p.along(normal(d)), q - p) - r",
        "inner(p.along(normalise(d)), q - p) + r * (q.angle - p.angle)",
    ], "normal rolling", &["p.along(normal(d))", "p.along(normalise(d))"]);
    "turn" Plane (a: Body, b: Body) Rows(&["b.angle - a.angle"], "", &[]);
    "rod" Both (p: Point, q: Point, l: Length["m"]) Rows(&["sq(q - p) - sq(l)"], "", &["2 * (q - p)"]);
    "ball" Space (p: Point, q: Point) Rows(&["q - p"], "x y z", &[]);
    "hinge" Space (p: Point, q: Point, u: Direction, w: Direction = "u")
        Rows(&["q - p", "inner(p.along(normals(u)[0]), q.along(normalise(w)))", "inner(p.along(normals(u)[1]), q.along(normalise(w)))"], "x y z tilt0 tilt1", &[]);
    "universal" Space (p: Point, q: Point, u: Direction, w: Direction)
        Rows(&["q - p", "inner(p.along(normalise(u)), q.along(normalise(w)))"], "x y z cross", &[]);
    "cylinder" Space (p: Point, q: Point, u: Direction, w: Direction = "u") Rows(&[
        "inner(p.along(normals(u)[0]), q - p)",
        "inner(p.along(normals(u)[1]), q - p)",
        "inner(p.along(normals(u)[0]), q.along(normalise(w)))",
        "inner(p.along(normals(u)[1]), q.along(normalise(w)))",
    ], "n0 n1 tilt0 tilt1", &["p.along(normals(u)[0])", "p.along(normals(u)[1])"]);
    "slider" Space (p: Point, q: Point, u: Direction, turn: Turn = "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]") Rows(&[
        "inner(p.along(normals(u)[0]), q - p)",
        "inner(p.along(normals(u)[1]), q - p)",
        "inner(p.along([1, 0, 0]), q.along(transpose(turn) * [0, 1, 0]))",
        "inner(p.along([0, 1, 0]), q.along(transpose(turn) * [0, 0, 1]))",
        "inner(p.along([0, 0, 1]), q.along(transpose(turn) * [1, 0, 0]))",
    ], "n0 n1 xy yz zx", &["p.along(normals(u)[0])", "p.along(normals(u)[1])"]);
    "weld" Space (p: Point, q: Point, turn: Turn = "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]") Rows(&[
        "q - p",
        "inner(p.along([1, 0, 0]), q.along(transpose(turn) * [0, 1, 0]))",
        "inner(p.along([0, 1, 0]), q.along(transpose(turn) * [0, 0, 1]))",
        "inner(p.along([0, 0, 1]), q.along(transpose(turn) * [1, 0, 0]))",
    ], "x y z xy yz zx", &[]);
    "drive" Space (a: Body, b: Body, u: Direction, angle: Number["rad"])
        Rows(&["inner(a.along(cos(angle) * normals(u)[1] - sin(angle) * normals(u)[0]), b.along(normals(u)[0]))"], "", &[]);
    "screw" Space (p: Point, q: Point, u: Direction, lead: Number["m"]) Rows(&[
        "inner(p.along(normalise(u)), dot(q - p) - cross(p.omega, q - p) - lead / (2 * PI) * (q.omega - p.omega))",
    ], "", &["p.along(normalise(u))"]);
    "disc" Space (q: Point, u: Direction, r: Number["m"]) Rows(&["q[2] - r * sqrt(sq(q.along(normalise(u))[0]) + sq(q.along(normalise(u))[1]))"], "", &["[0, 0, 1]"]);
    "rolls" Space (q: Point, u: Direction, r: Number["m"]) Rows(&[
        "inner([1, 0, 0], dot(q) + cross(q.omega, r / sqrt(sq(q.along(normalise(u))[0]) + sq(q.along(normalise(u))[1])) * (q.along(normalise(u))[2] * q.along(normalise(u)) - [0, 0, 1])))",
        "inner([0, 1, 0], dot(q) + cross(q.omega, r / sqrt(sq(q.along(normalise(u))[0]) + sq(q.along(normalise(u))[1])) * (q.along(normalise(u))[2] * q.along(normalise(u)) - [0, 0, 1])))",
    ], "x y", &["[1, 0, 0]", "[0, 1, 0]"]);
    "spring" Both (p: Point, q: Point, k: Number["N/m"], l: Number["m"]) Energy("0.5 * k * sq(norm(q - p) - l)");
    "turning_spring" Plane (a: Body, b: Body, k: Number["N m"], angle: Number["rad"]) Energy("0.5 * k * sq(b.angle - a.angle - angle)");
    "damper" Both (p: Point, q: Point, c: Number["N s/m"])
        Push("dot(norm(q - p))", "-c * dot(norm(q - p))", SLIDING_ENDS);
    "turning_damper" Both (a: Body, b: Body, c: Number["N m s"]) Push("b.omega - a.omega", "-c * (b.omega - a.omega)", &[]);
    "force" Both (p: Point, f: Force["N"]) Push("dot(p)", "f", &[("p", "p.along(dot(p.within))")]);
    "force" Both (p: Point, q: Point, f: Number["N"])
        Push("dot(norm(q - p))", "f", SLIDING_ENDS);
    "torque" Both (b: Body, m: Moment["N m"]) Push("b.omega", "m", &[]);
    "torque" Both (a: Body, b: Body, m: Moment["N m"]) Push("b.omega - a.omega", "m", &[]);
}

/// Parts of one home, and what does the same in the other.
const COUNTERPARTS: &[(&str, &str)] = &[
    ("pin", "`ball`, or `hinge` about one axis"),
    ("turn", "`drive`"),
    ("slot", "`cylinder`"),
    ("wheel", "`disc`, with `rolls`"),
    ("ball", "`pin`"),
    ("hinge", "`pin`"),
    ("drive", "`turn`"),
    ("cylinder", "`slot`"),
    ("disc", "`wheel`"),
    ("rolls", "`wheel`"),
];

impl Part {
    /// How many arguments it takes at least, and at most.
    fn arity(&self) -> (usize, usize) {
        let least = self.args.iter().filter(|arg| arg.default.is_empty());
        (least.count(), self.args.len())
    }

    /// Whether it is a joint: rows, which may stand wherever equations do.
    pub(super) fn joins(&self) -> bool {
        matches!(self.meaning, Meaning::Rows(..))
    }

    /// The part as it is written, with its arguments.
    fn usage(&self) -> String {
        let args = self.args.iter().map(|arg| match arg.default.is_empty() {
            true => arg.name.to_owned(),
            false => format!("[{}]", arg.name),
        });
        format!("`{}({})`", self.name, args.collect::<Vec<_>>().join(", "))
    }
}

/// The rows of a joint, which know their names.
pub(super) struct Joint {
    pub(super) rows: Value,
    /// The names of the rows, as many as there are rows; none where the only row goes by the name of the joint.
    pub(super) names: Vec<&'static str>,
    /// The load on the second body, where the joint is between bodies.
    pub(super) load: Option<Load>,
    /// The rows where one body carries both.
    pub(super) carried: Option<Carried>,
}

/// The names of all joints.
pub(super) fn joints() -> String {
    let parts = PARTS.iter().filter(|part| part.joins());
    let names: BTreeSet<String> = parts.map(|part| format!("`{}`", part.name)).collect();
    names.into_iter().collect::<Vec<_>>().join(", ")
}

/// The dimension of where the part called `name` is used, as its bodies tell it, or else points of the ground; without either it is where
/// the part lives.
fn dimension(name: &Ident, values: &[Value]) -> usize {
    let of_bodies = values.iter().find_map(|value| match value {
        Value::Body(body) => body.dimension(),
        Value::Point(point) => point.body.dimension(),
        _ => None,
    });
    let of_ground = values.iter().find_map(|value| match value {
        Value::Point(point) => Some(point.place.entries().len()),
        _ => None,
    });
    let mut named = PARTS.iter().filter(|part| name == part.name);
    let spatial = named.all(|part| part.home == Home::Space);
    let known = of_bodies.or(of_ground);
    known.unwrap_or(if spatial { 3 } else { 2 })
}

/// Which of the bodies among `values` lives elsewhere than the first, in words, and where it stands.
fn mixed(values: &[Value]) -> Option<(usize, String)> {
    let body = |value: &Value| match value {
        Value::Body(body) => Some(body.clone()),
        Value::Point(point) => Some(point.body.clone()),
        _ => None,
    };
    let bodies = values.iter().enumerate();
    let mut bodies = bodies.filter_map(|(k, value)| Some((k, body(value)?)));
    let (_, first) = bodies.find(|(_, body)| body.dimension().is_some())?;
    let home = first.dimension();
    let (k, other) = bodies.find(|(_, body)| body.dimension().is_some_and(|n| Some(n) != home))?;
    let kinds = if home == Some(3) {
        ("spatial", "planar")
    } else {
        ("planar", "spatial")
    };
    let message = format!("`{first}` is {} and `{other}` is {}", kinds.0, kinds.1);
    Some((k, message))
}

/// The part called `name` that takes so many arguments in a space of this dimension; or why there is none.
fn chosen(name: &Ident, dimension: usize, count: usize) -> Result<&'static Part, String> {
    let (home, here, there) = match dimension {
        3 => (Home::Space, "in space", "planar"),
        _ => (Home::Plane, "in the plane", "spatial"),
    };
    let (at_home, elsewhere): (Vec<&Part>, Vec<&Part>) = PARTS
        .iter()
        .filter(|part| name == part.name)
        .partition(|part| part.home == Home::Both || part.home == home);
    let fits = |part: &&&Part| {
        let (least, most) = part.arity();
        (least..=most).contains(&count)
    };
    if let Some(part) = at_home.iter().find(fits) {
        return Ok(part);
    }
    let usages = |parts: &[&Part]| {
        let usages: Vec<String> = parts.iter().map(|part| part.usage()).collect();
        usages.join(" or ")
    };
    if !at_home.is_empty() {
        let (usages, found) = (usages(&at_home), arguments(count));
        return Err(format!("it is written {usages}, found {found}"));
    }
    let other = COUNTERPARTS.iter().find(|(one, _)| name == one);
    let other = other.map_or(String::new(), |(_, other)| format!(", where it is {other}"));
    let usages = usages(&elsewhere);
    Err(format!(
        "`{name}` joins {there} bodies: {usages}; these are {here}{other}"
    ))
}

/// Whether a value is what is taken in a space of this dimension, and what that is.
fn taken(takes: Takes, value: &Value, dimension: usize) -> (bool, String) {
    match takes {
        Takes::Point => (
            matches!(value, Value::Point(p) if p.place.shape() == [dimension]),
            "a point of a body, such as `link.at([0, 0])` or `ground.at([0, 0])`".to_owned(),
        ),
        Takes::Body => (
            matches!(value, Value::Body(_) | Value::Point(_)),
            "a body".to_owned(),
        ),
        Takes::Direction | Takes::Force => (value.shape() == [dimension], describe(&[dimension])),
        Takes::Moment if dimension != 2 => (value.shape() == [3], describe(&[3])),
        Takes::Number | Takes::Length | Takes::Moment => (
            value.shape().is_empty() && !matches!(value, Value::Body(_)),
            describe(&[]),
        ),
        Takes::Turn => (value.shape() == [3, 3], describe(&[3, 3])),
    }
}

impl<'m> Lowering<'m> {
    /// The rows of a joint.
    pub(super) fn joint(&mut self, e: &Expr, name: &Ident, args: &[Expr], env: &Env<'m>) -> Value {
        let Some((part, inner)) = self.part_of(name, args, env) else {
            return Value::Error;
        };
        let Meaning::Rows(texts, names, pushes) = part.meaning else {
            let message = format!("`{name}` acts with a force; it stands under `forces`");
            return self.error(name.span(), message);
        };
        if let [Some(first), Some(second)] = Self::ends(&inner)
            && Rc::ptr_eq(&first, &second)
        {
            let message = format!("`{name}` joins two bodies; both of these are `{first}`");
            return self.error(name.span(), message);
        }
        let mut rows: Vec<Id> = Vec::new();
        let mut shaped = false;
        for text in texts {
            let value = self.written(text, e.loc, &inner);
            shaped |= !value.shape().is_empty();
            rows.extend_from_slice(value.entries());
        }
        let rows = match rows[..] {
            [row] if !shaped => Value::Scalar(row),
            _ => Value::vector(rows),
        };
        if self.allowed_value(rows.clone(), e.loc, env).is_error() {
            return Value::Error;
        }
        let carried = self.carried_rows(&rows, &inner);
        let rows = self.without_rounding(rows, &inner, None);
        let names: Vec<&str> = names.split_whitespace().collect();
        debug_assert!(names.is_empty() || names.len() == rows.entries().len());
        self.rim(part.name, e.loc, &inner);
        let mut load = self.load(&inner);
        if let Some(load) = &mut load {
            let pushes = pushes.iter();
            let pushes = pushes.map(|text| self.written(text, e.loc, &inner).entries().to_vec());
            load.pushes = pushes.collect();
        }
        Value::Joint(Rc::new(Joint {
            rows,
            names,
            load,
            carried,
        }))
    }

    /// The rows of a joint, 0 where they are what rounding leaves of offsets along an axis that add up to the same for both of its points.
    fn without_rounding(
        &mut self,
        rows: Value,
        inner: &Env<'m>,
        carrier: Option<&Carrier>,
    ) -> Value {
        let places = inner.args.iter().filter_map(|(_, value)| match value {
            Value::Point(point) => Some(point.place.entries()),
            _ => None,
        });
        let places: Vec<Id> = places.flatten().copied().collect();
        let places = match carrier {
            Some(carrier) => self.at_rest(&places, carrier),
            None => places,
        };
        let offsets = places.iter().filter_map(|id| self.graph.as_const(*id));
        let largest = offsets.fold(0.0_f64, |most, x| most.max(x.abs()));
        rows.map(|row| match self.graph.as_const(row) {
            Some(left) if left.abs() <= ROUNDED * largest => self.graph.zero(),
            _ => row,
        })
    }

    /// The bodies that a joint with these arguments is between.
    fn ends(inner: &Env<'m>) -> [Option<Rc<Frame>>; 2] {
        let body = |name: &str| match &inner.args.iter().find(|(n, _)| n == name)?.1 {
            Value::Point(point) => Some(point.body.clone()),
            Value::Body(body) => Some(body.clone()),
            _ => None,
        };
        match body("q") {
            Some(second) => [body("p"), Some(second)],
            None => [body("a"), body("b")],
        }
    }

    /// How the load of a joint with these arguments is read.
    fn load(&self, inner: &Env<'m>) -> Option<Load> {
        let [first, second] = Self::ends(inner);
        let at = inner.args.iter().find_map(|(name, value)| match value {
            Value::Point(q) if name == "q" => Some(q.place.entries().to_vec()),
            _ => None,
        });
        let second = second?;
        let mut load = Load::between(first.as_deref(), &second, at, &self.graph)?;
        // Where the first body hangs on the second one, coordinates of that move both.
        let moving = first.as_ref().and_then(|first| first.moving.as_ref());
        let place = moving.map_or(&[][..], |moving| &moving.place[..]);
        if second.moving.is_some() && load.moves(place, &self.graph) {
            load.orientation.clear();
        }
        Some(load)
    }

    /// The value of a text of the table; what is wrong with it is wrong with what stands at `loc`.
    pub(super) fn written(&mut self, text: &str, loc: Loc, env: &Env<'m>) -> Value {
        let e = own(text);
        let before = (self.diag.len(), self.units_told());
        self.written = true;
        let mut terms = Vec::new();
        self.chain(&e, 1.0, env, &mut terms);
        let value = self.total(&terms, true);
        self.written = false;
        self.diag.relocate(before.0, loc);
        self.units_relocated(before.1, loc);
        match self.diag.len() == before.0 {
            true => value,
            false => Value::Error,
        }
    }

    /// The part that is meant, and its arguments by their names.
    fn part_of(
        &mut self,
        name: &Ident,
        args: &[Expr],
        env: &Env<'m>,
    ) -> Option<(&'static Part, Env<'m>)> {
        let values: Vec<Value> = args.iter().map(|a| self.argument(a, env)).collect();
        let found = self.part_with(name, args, &values)?;
        self.note(found.0.name, &values);
        Some(found)
    }

    /// The part that is meant where its arguments have these values, and these by their names.
    pub(super) fn part_with(
        &mut self,
        name: &Ident,
        args: &[Expr],
        values: &[Value],
    ) -> Option<(&'static Part, Env<'m>)> {
        if values.iter().any(Value::is_error) {
            return None;
        }
        if let Some((k, message)) = mixed(values) {
            self.diag.error(args[k].loc, message);
            return None;
        }
        let dimension = dimension(name, values);
        let part = chosen(name, dimension, args.len());
        let part = part.inspect_err(|message| self.diag.error(name.span(), message));
        let part = part.ok()?;
        let mut inner = Env::new(&Scope::new(self.model), Place::Let);
        let mut sound = true;
        for (k, arg) in part.args.iter().enumerate() {
            let value = match values.get(k) {
                Some(value) => {
                    sound &= self.takes(part, arg, value, dimension, &args[k]);
                    match arg.takes {
                        Takes::Point | Takes::Body => value.clone(),
                        _ => self.numbers(value.clone(), args[k].loc),
                    }
                }
                None if matches!(arg.takes, Takes::Body) => {
                    self.argument(&own(arg.default), &inner)
                }
                None => self.written(arg.default, name.span().into(), &inner),
            };
            inner.args.push((arg.name.to_owned(), value));
        }
        sound.then_some((part, inner))
    }

    /// Whether an argument is what the part takes; reports it, if not.
    fn takes(
        &mut self,
        part: &Part,
        arg: &Argument,
        value: &Value,
        dimension: usize,
        e: &Expr,
    ) -> bool {
        let flat = dimension == 2;
        let Argument {
            name: arg,
            takes,
            unit,
            ..
        } = *arg;
        let (fits, expected) = taken(takes, value, dimension);
        if !fits {
            let found = match value {
                Value::Body(body) => format!("the body `{body}`"),
                Value::Point(p) => {
                    format!("a point of `{}`, {}", p.body, describe(p.place.shape()))
                }
                _ => describe(value.shape()),
            };
            let hint = match (value, &e.kind) {
                (Value::Point(_), _) if takes == Takes::Point => format!(
                    "; bodies of this kind have points in {}",
                    if flat { "the plane" } else { "space" }
                ),
                (_, ExprKind::Field(_, field)) if takes == Takes::Point && field == "centre" => {
                    "; `centre` is a vector of the ground, and `at` takes the place within the body"
                        .to_owned()
                }
                _ => String::new(),
            };
            let usage = part.usage();
            let message = format!("`{arg}` of {usage} is {expected}, found {found}{hint}");
            self.error(e.loc, message);
            return false;
        }
        let zero = value.entries().iter().all(|id| self.graph.is_zero(*id));
        if takes == Takes::Direction && zero {
            self.error(
                e.loc,
                format!(
                    "`{arg}` of {} is a direction; it must not be zero",
                    part.usage()
                ),
            );
            return false;
        }
        if takes == Takes::Length && zero {
            // Its row would have no derivative where the points meet, as they must.
            let joint = if flat { "pin" } else { "ball" };
            let message = format!(
                "`{arg}` of {} must not be zero; what keeps two points together is `{joint}(p, q)`",
                part.usage()
            );
            self.error(e.loc, message);
            return false;
        }
        if self.dimensions.is_some() && !unit.is_empty() {
            let what = format!("`{arg}` of {}", part.usage());
            self.expect_unit(value, unit, &what, e.loc);
        }
        true
    }
}
