//! What bodies have by themselves: kinetic energy, weight, and unit quaternions.

use super::array::{Value, describe};
use super::bodies::Frame;
use super::{Env, Lowering, Place};
use crate::diag::Loc;
use crate::model::{Scope, Variable};
use crate::parse::{Body, Declaration, Expr, ExprKind};
use proc_macro2::Ident;
use ukalgebra::expr::{Constraint, ConstraintRef, Kind};
use ukalgebra::expr::{Id, Symbol};
use ukalgebra::expr::{Point, eval};
use ukunits::Dimension;

/// What all bodies have by themselves.
#[derive(Default)]
pub(super) struct OfBodies {
    /// Coordinates with their masses, and where these are declared.
    pub(super) diagonal: Vec<(usize, Id, Loc)>,
    /// Terms of the kinetic energy, but for those of `diagonal`.
    pub(super) turning: Vec<(f64, Id)>,
    /// The place where the first body is declared whose part of M changes.
    pub(super) changing: Option<Loc>,
    pub(super) potential: Vec<(f64, Id)>,
    pub(super) units: Vec<Constraint>,
    /// [`System::inertias`](super::System::inertias).
    pub(super) inertias: Vec<(String, Vec<Id>)>,
}

impl<'m> Lowering<'m> {
    /// What the bodies of the declaration have by themselves.
    pub(super) fn of_bodies(&mut self, decl: &Declaration, top: &Scope<'m>) -> OfBodies {
        let mut out = OfBodies::default();
        let gravity = self.gravity(decl, top);
        for position in 0..self.bodies.len() {
            let declared = self.bodies[position].as_ref();
            let Some((body, variables)) = declared.map(|d| (d.body.clone(), d.variables.clone()))
            else {
                continue;
            };
            let Some(frame) = self.frame(position) else {
                continue;
            };
            let loc = body.key.loc;
            let spatial = frame.dimension() == Some(3);
            let freely = self.turns_freely(position);
            // A link that only joins others, where no quaternion turns it.
            let written = [&body.mass, &body.inertia].map(|e| e.as_ref().is_some_and(zeros));
            let empty = spatial && written == [true, true];
            let heavy = spatial && (freely || !empty);
            let mass = self.not_negative(body.mass.as_ref(), "mass", heavy, &variables);
            if let Some(energy) = self.hung_energy(&frame, mass) {
                out.changing = out.changing.or(Some(loc));
                out.turning.extend(energy);
            }
            let own = self.model.own[position];
            if spatial {
                out.changing = out.changing.or(Some(loc));
                self.needs(&body);
                let places = own.map_or(0..0, |first| first..first + 3);
                out.diagonal.extend(places.map(|i| (i, mass, loc)));
                if !empty {
                    let whole = (mass, freely);
                    let inertia = self.turning(&body, &variables, &frame, whole, &mut out.turning);
                    let given = inertia.map(|rows| [vec![mass], rows].concat());
                    out.inertias
                        .extend(given.map(|given| (frame.to_string(), given)));
                }
                if let Some(first) = own {
                    let indices = &self.model.body_elements[position].indices;
                    out.units
                        .push(self.unit(&body.key.name, indices, first + 3, loc));
                }
            } else {
                let inertia =
                    self.not_negative(body.inertia.as_ref(), "inertia", false, &variables);
                match own {
                    Some(first) => out.diagonal.extend(
                        (first..)
                            .zip([mass, mass, inertia])
                            .map(|(i, m)| (i, m, loc)),
                    ),
                    None => {
                        let rate = self.rate(&frame);
                        let square = self.graph.square(rate);
                        out.turning.push((0.5, self.graph.mul(inertia, square)));
                    }
                }
            }
            if let Some((gravity, e)) = &gravity
                && !self.weigh(&frame, mass, gravity, *e, &mut out)
            {
                break;
            }
        }
        for joint in &self.model.joints {
            if joint.kind.coordinates.len() == 4 {
                let (name, loc) = (&joint.key, joint.key.span().into());
                out.units
                    .push(self.unit(name, &joint.indices, joint.first, loc));
            }
        }
        out.diagonal.retain(|(_, m, _)| !self.graph.is_zero(*m));
        out.potential.retain(|(_, id)| !self.graph.is_zero(*id));
        out
    }

    /// Enters the weight of a body; reports it, and returns false, if `gravity`, at `loc`, is too short for it.
    fn weigh(
        &mut self,
        frame: &Frame,
        mass: Id,
        gravity: &Value,
        loc: Loc,
        out: &mut OfBodies,
    ) -> bool {
        if gravity.entries().len() < frame.dimension().unwrap_or(0) {
            let message = format!(
                "expected {}, found {}: `{frame}` is spatial",
                describe(&[3]),
                describe(gravity.shape())
            );
            self.error(loc, message);
            return false;
        }
        let centre = frame.centre(&mut self.graph);
        for (g, x) in gravity.entries().iter().zip(centre.entries()) {
            let term = self.graph.product(&[(mass, 1), (*g, 1), (*x, 1)]);
            out.potential.push((-1.0, term));
        }
        true
    }

    /// The vector that `gravity` gives, with its place.
    fn gravity(&mut self, decl: &Declaration, top: &Scope<'m>) -> Option<(Value, Loc)> {
        let keyword = decl.sections.get("gravity")?.span();
        let mut terms = Vec::new();
        let (mut loc, mut third): (Option<Loc>, Option<Loc>) = (None, None);
        top.unroll(&decl.gravity, self.diag, &mut |e: &Expr, scope| {
            if let ExprKind::Vector(entries) = &e.kind
                && let [_, _, z] = &entries[..]
            {
                third = Some(z.loc);
            }
            loc = Some(loc.map_or(e.loc, |l| l.to(e.loc)));
            self.chain(e, 1.0, &Env::new(scope, Place::Gravity), &mut terms);
        });
        let value = self.total(&terms, false);
        let loc = loc.unwrap_or(keyword.into());
        if value.is_error() {
            return None;
        }
        if decl.bodies.is_empty() {
            self.error(keyword, "`gravity` is the weight of `bodies`, and there are none; the weight of coordinates goes under `potential`");
            return None;
        }
        if !matches!(value.shape(), [2 | 3]) {
            let found = describe(value.shape());
            self.error(loc, format!("expected a vector of 2 or 3, found {found}"));
            return None;
        }
        if let [_, _, z] = value.entries()
            && !self.graph.is_zero(*z)
            && self.model.body_kinds.iter().all(|body| !body.spatial)
        {
            let message = "planar bodies move along x and y: no weight of theirs acts along z; write `[0, -g]` where y points up, and no \
                 `gravity` where the plane lies level";
            self.error(third.unwrap_or(loc), message);
            return None;
        }
        self.expect_all(&value, Dimension::ACCELERATION, "an acceleration", loc);
        Some((value, loc))
    }

    /// Reports a spatial body without mass or inertia.
    fn needs(&mut self, body: &Body) {
        let missing = [("mass", &body.mass), ("inertia", &body.inertia)];
        let missing = missing.iter().find(|(_, given)| given.is_none());
        if let Some((what, _)) = missing {
            let name = &body.key.name;
            self.error(
                body.key.loc,
                format!(
                    "spatial body `{name}` has no {what}; give it: `mass: m, inertia: [i, j, k]`"
                ),
            );
        }
    }

    /// Values of `ids` by the defaults of the parameters, if all are known.
    fn by_default(&self, ids: &[Id]) -> Option<Vec<f64>> {
        let values = eval(&self.graph, ids, &Point::of_parameters(&self.defaults));
        values.iter().all(|x| x.is_finite()).then_some(values)
    }

    /// The mass or the inertia of a body: a number that is not negative, nor zero where the body is `spatial`; 0 where none is given.
    fn not_negative(
        &mut self,
        e: Option<&Expr>,
        what: &str,
        spatial: bool,
        variables: &[Variable],
    ) -> Id {
        let zero = self.graph.zero();
        let Some(e) = e else {
            return zero;
        };
        let value = self.part_of_body(e, variables);
        let dimension = match what {
            "mass" => Dimension::MASS,
            _ => Dimension::INERTIA,
        };
        self.expect_all(&value, dimension, &format!("the {what} of a body"), e.loc);
        let Some(numbers) = self.of_shape(&value, &[], e.loc) else {
            return zero;
        };
        let number = self.by_default(&numbers).map_or(1.0, |x| x[0]);
        if number < 0.0 {
            self.error(e.loc, format!("the {what} of a body must not be negative"));
        } else if spatial && number == 0.0 {
            self.error(
                e.loc,
                format!(
                    "the {what} of a spatial body must be positive: with its centre on the axis of a fixed hinge it is not felt; it is 0 \
                     where the inertia is `[0, 0, 0]`, too, and the body hangs on a joint under `tree` that has angles for coordinates: an \
                     inertia j about a hinge `h` alone is the term `0.5 * j * sq(dot(h.angle))` of `kinetic` then"
                ),
            );
        }
        numbers[0]
    }

    /// Whether the body at `position` turns in any way: by a quaternion.
    fn turns_freely(&self, position: usize) -> bool {
        let model = self.model;
        let freely = |joint: usize| model.joints[joint].kind.coordinates.len() == 4;
        model.own[position].is_some() || model.hung[position].is_some_and(freely)
    }

    /// Whether these are the moments of a thin rod, which has none about one of its axes, or of a point: hung where they cannot turn
    /// about that alone.
    fn thin(&self, moments: &Value) -> bool {
        let zeros = moments.entries().iter().filter(|j| self.graph.is_zero(**j));
        moments.shape() == [3] && matches!(zeros.count(), 1 | 3)
    }

    /// Adds ½ ωᵀJω as a sum of squares: with J = L D Lᵀ it is ½ Σ dₖ (Lᵀω)ₖ². Returns J by rows.
    fn turning(
        &mut self,
        body: &Body,
        variables: &[Variable],
        frame: &Frame,
        (mass, freely): (Id, bool),
        out: &mut Vec<(f64, Id)>,
    ) -> Option<Vec<Id>> {
        let e = body.inertia.as_ref()?;
        let spin = self.spin(frame);
        let value = self.part_of_body(e, variables);
        self.expect_all(&value, Dimension::INERTIA, "the inertia of a body", e.loc);
        let j = value.entries();
        let zero = self.graph.zero();
        // By places [row][column] of the lower triangle.
        let lower = match value.shape() {
            [3] => [[j[0], zero, zero], [zero, j[1], zero], [zero, zero, j[2]]],
            [6] => [[j[0], zero, zero], [j[3], j[1], zero], [j[4], j[5], j[2]]],
            [3, 3] => [[j[0], zero, zero], [j[3], j[4], zero], [j[6], j[7], j[8]]],
            _ if value.is_error() => return None,
            shape => {
                let found = describe(shape);
                self.error(e.loc, format!("the inertia of a spatial body is `[xx, yy, zz]`, `[xx, yy, zz, xy, xz, yz]` or a matrix of 3×3, found {found}"));
                return None;
            }
        };
        let upper = match value.shape() {
            [3, 3] => [j[1], j[2], j[5]],
            _ => [lower[1][0], lower[2][0], lower[2][1]],
        };
        let mut all = lower.concat();
        all.extend(upper);
        if let Some(numbers) = self.by_default(&all)
            && let Err(reason) = possible(&numbers, !freely && self.thin(&value))
        {
            self.error(e.loc, reason);
            return None;
        }
        let spin = spin.entries();
        let mut l = lower;
        let mut d = [zero; 3];
        for k in 0..3 {
            for i in k..3 {
                let mut terms = vec![(1.0, lower[i][k])];
                for (m, pivot) in d.iter().enumerate().take(k) {
                    let product = self
                        .graph
                        .product(&[(l[i][m], 1), (l[k][m], 1), (*pivot, 1)]);
                    terms.push((-1.0, product));
                }
                let reduced = self.graph.sum(&terms);
                match i == k {
                    true => d[k] = reduced,
                    // Of a thin rod or a point there is nothing in this column.
                    false if self.graph.is_zero(d[k]) => l[i][k] = zero,
                    false => l[i][k] = self.graph.div(reduced, d[k]),
                }
            }
        }
        for k in 0..3 {
            let mut terms = vec![(1.0, spin[k])];
            for (row, rate) in l.iter().zip(spin).skip(k + 1) {
                terms.push((1.0, self.graph.mul(row[k], *rate)));
            }
            let rate = self.graph.sum(&terms);
            let square = self.graph.square(rate);
            out.push((0.5, self.graph.mul(d[k], square)));
        }
        let [xy, xz, yz] = upper;
        let [[xx, ..], [yx, yy, _], [zx, zy, zz]] = lower;
        // Of a thin rod a run looks at the moments that it has, of a point at its mass.
        let there = |j: &Id| !self.graph.is_zero(*j);
        let one = [xx, yy, zz].into_iter().find(there).unwrap_or(mass);
        let [xx, yy, zz] = [xx, yy, zz].map(|j| if there(&j) { j } else { one });
        Some(vec![xx, xy, xz, yx, yy, yz, zx, zy, zz])
    }

    /// The row that keeps the quaternion whose coordinates begin at `first` a unit: that of what is called `name`, with `indices`.
    fn unit(&mut self, name: &Ident, indices: &[usize], first: usize, loc: Loc) -> Constraint {
        let indices = indices.iter();
        let mut terms = vec![(-1.0, self.graph.one())];
        for i in first..first + 4 {
            let e = self.graph.symbol(Symbol::Coord(i));
            terms.push((1.0, self.graph.square(e)));
        }
        let phi = self.graph.sum(&terms);
        Constraint {
            item: ConstraintRef {
                base: Ident::new(&format!("{name}_unit"), name.span()),
                shown: self.model.shown(&name.to_string()).to_owned(),
                indices: indices.filter_map(|i| i64::try_from(*i).ok()).collect(),
                components: Vec::new(),
                row: Some("unit"),
            },
            kind: Kind::Holonomic,
            phi,
            loc,
        }
    }
}

/// Whether this is a zero as it is written, or a list of them.
fn zeros(e: &Expr) -> bool {
    match &e.kind {
        ExprKind::Int(0) => true,
        ExprKind::Float(x) => *x == 0.0,
        ExprKind::Quantity(..) | ExprKind::Group(_) | ExprKind::Vector(_) => {
            e.parts().into_iter().all(zeros)
        }
        _ => false,
    }
}

/// Whether a rigid body can have this inertia, by rows of the lower triangle, then the upper one: J and ½ tr J − J, the second moments of
/// its mass, are symmetric, the first positive definite, but where the body is `thin`, and the second positive semidefinite.
fn possible(numbers: &[f64], thin: bool) -> Result<(), String> {
    let [xx, _, _, yx, yy, _, zx, zy, zz, xy, xz, yz] = *numbers else {
        return Ok(());
    };
    let trace = xx + yy + zz;
    let slack = 1e-9 * trace.abs();
    let same = |a: f64, b: f64| (a - b).abs() <= slack;
    if !(same(xy, yx) && same(xz, zx) && same(yz, zy)) {
        return Err("the inertia of a body is a symmetric matrix".to_owned());
    }
    // Principal minors of a symmetric matrix of this diagonal and these off-diagonal entries.
    let minors = |[a, b, c]: [f64; 3], [d, e, f]: [f64; 3]| {
        let pairs = [a * b - d * d, a * c - e * e, b * c - f * f];
        let det = a * (b * c - f * f) - d * (d * c - e * f) + e * (d * f - b * e);
        ([a, b, c], pairs, det)
    };
    let (own, pairs, det) = minors([xx, yy, zz], [yx, zx, zy]);
    let definite = own.iter().chain(&pairs).chain([&det]).all(|x| *x > 0.0);
    let thin = thin && own.iter().all(|x| *x >= 0.0);
    if !(definite || thin) {
        let zeros = own.iter().filter(|x| **x == 0.0).count();
        let remedy = match zeros {
            2 => {
                "; where the moment about one axis is j, those about the others are j/2 at least, as of a disc: a body that turns about a \
                 hinge alone does not feel them"
            }
            1 | 3 => {
                "; about its own axis a thin rod has a small moment, m r²/2, too; it may be left out, as 0, where the rod hangs on a \
                 joint under `tree` that has angles for coordinates"
            }
            _ => "",
        };
        return Err(format!(
            "the inertia of a spatial body must be positive definite{remedy}"
        ));
    }
    let half = 0.5 * trace;
    let (own, pairs, det) = minors([half - xx, half - yy, half - zz], [-yx, -zx, -zy]);
    let least = |values: &[f64], power: i32| values.iter().all(|x| *x >= -1e-9 * trace.powi(power));
    if least(&own, 1) && least(&pairs, 2) && least(&[det], 3) {
        return Ok(());
    }
    Err(
        "no rigid body has this inertia: no principal moment exceeds the sum of the other two"
            .to_owned(),
    )
}
