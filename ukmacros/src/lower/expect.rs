//! What has to be of which dimension, and what is said where it is not.

use super::array::Value;
use super::units::{Clash, Measured};
use super::{Env, Lowering};
use crate::diag::Loc;
use crate::parse::{Expr, ExprKind};
use Measured::{Number, Unknown};
use ukalgebra::expr::Kind;
use ukalgebra::expr::{Id, Symbol};
use ukunits::{Dimension, Unit};

impl<'m> Lowering<'m> {
    /// The value of `e`, whose dimensions are looked at.
    pub(super) fn measured(&mut self, e: &Expr, env: &Env<'m>) -> Value {
        let Some(dimensions) = &mut self.dimensions else {
            return self.value_of(e, env);
        };
        let factor = std::mem::take(&mut dimensions.factor);
        // What was made since without an expression of its own is not the modeller's.
        dimensions.see(&self.graph);
        dimensions.clash = None;
        dimensions.factor = factor && matches!(e.kind, ExprKind::Group(_) | ExprKind::Neg(_));
        let value = self.value_of(e, env);
        let Some(dimensions) = &mut self.dimensions else {
            return value;
        };
        dimensions.factor = false;
        dimensions.see(&self.graph);
        if let Some(clash) = dimensions.clash.take() {
            let argument = match &e.kind {
                ExprKind::Call(_, args) => args.first().map(|first| first.loc),
                _ => None,
            };
            let (loc, message) = match clash {
                Clash::Terms(a, b) => (e.loc, adds(b, a, false)),
                Clash::Arguments(func, a, b) => (
                    e.loc,
                    format!("arguments of `{}` are {a} and {b}", func.row().name),
                ),
                Clash::Argument(func, found) => (
                    argument.unwrap_or(e.loc),
                    format!("`{}` takes a plain number, found {found}", func.row().name),
                ),
            };
            dimensions.diag.error(loc, message);
        }
        match value {
            Value::Scalar(id) if !factor => match self.graph.as_const(id) {
                Some(x) if x != 0.0 => {
                    let symbol = dimensions.symbol(x, Unknown, None);
                    Value::Scalar(self.graph.symbol(symbol))
                }
                _ => value,
            },
            _ => value,
        }
    }

    /// Numbers in a unit: in SI from here on.
    pub(super) fn quantity(
        &mut self,
        e: &Expr,
        numbers: &Expr,
        unit: &Unit,
        env: &Env<'m>,
    ) -> Value {
        let value = self.value(numbers, env);
        if let Some(dimensions) = &mut self.dimensions {
            let (measured, text) = (Measured::known(unit.dimension(), true), unit.to_string());
            return value.map(|id| {
                let number = dimensions.value_of(id, &self.graph).unwrap_or(f64::NAN);
                let symbol = dimensions.symbol(number, measured, Some(text.clone()));
                self.graph.symbol(symbol)
            });
        }
        let numbers = value.entries().iter().map(|id| self.graph.as_const(*id));
        let Some(numbers) = numbers.collect::<Option<Vec<f64>>>() else {
            let message = "a unit stands behind numbers, such as `0.3 [m]`; what depends on parameters has the unit that follows from theirs";
            return self.error(e.loc, message);
        };
        let mut numbers = numbers.into_iter();
        value.map(|_| {
            let number = numbers.next().unwrap_or_default();
            self.graph.constant(unit.to_si(number))
        })
    }

    /// What is lowered next is a factor: a number there is a plain one.
    pub(super) fn factor_next(&mut self) {
        if let Some(dimensions) = &mut self.dimensions {
            dimensions.factor = true;
        }
    }

    /// What is known of the dimension of `id`.
    pub(super) fn dimension(&mut self, id: Id) -> Measured {
        let dimensions = self.dimensions.as_mut();
        dimensions.map_or(Unknown, |d| d.of(id, &self.graph))
    }

    /// Enters the dimensions of the next parameters, whose defaults are these.
    pub(super) fn measure_parameters(&mut self, defaults: &[Id], count: usize) {
        for k in 0..count {
            let measured = defaults.get(k).map_or(Unknown, |id| self.dimension(*id));
            if let Some(dimensions) = &mut self.dimensions {
                dimensions.params.push(measured.declared());
            }
        }
    }

    /// What stands for an option whose default is `default`, where units are looked at.
    pub(super) fn measured_option(&mut self, default: Id) -> Option<Symbol> {
        let measured = self.dimension(default);
        let dimensions = self.dimensions.as_mut()?;
        Some(dimensions.option(measured))
    }

    /// Reports `id`, which stands at `loc`, where it is not of the dimension `expected` of `what`.
    pub(super) fn expect(&mut self, id: Id, expected: Measured, what: &str, loc: Loc) {
        let found = self.dimension(id);
        if let Err((expected, found)) = expected.with(found) {
            let remedy = remedy(expected, found);
            let message = format!("expected {expected}, {what}, found {found}{remedy}");
            self.complain(id, loc, message);
        }
    }

    /// Reports `id`, which stands at `loc`, where its dimension is not that of the rate in time of `expected`.
    pub(super) fn expect_rate(&mut self, id: Id, expected: Measured, what: &str, loc: Loc) {
        let found = self.dimension(id).times(Measured::of(Dimension::TIME));
        if let Err((expected, found)) = expected.with(found) {
            let message = format!("expected {expected}, {what}, found {found} in all");
            self.complain(id, loc, message);
        }
    }

    /// Reports numbers of `value` that are not of this dimension.
    pub(super) fn expect_all(&mut self, value: &Value, dimension: Dimension, what: &str, loc: Loc) {
        for id in value.entries() {
            self.expect(*id, Measured::of(dimension), what, loc);
        }
    }

    /// Reports numbers of `value`, which `what` names, that are not of this `unit`'s dimension.
    pub(super) fn expect_unit(&mut self, value: &Value, unit: &str, what: &str, loc: Loc) {
        let dimension = Unit::parse(unit).map(|unit| unit.dimension());
        let expected = dimension.map_or(Unknown, Measured::of);
        for id in value.entries() {
            if let Err((expected, found)) = expected.with(self.dimension(*id)) {
                let remedy = remedy(expected, found);
                self.complain(
                    *id,
                    loc,
                    format!("{what} is in {unit}, found {found}{remedy}"),
                );
            }
        }
    }

    /// Reports what is given for a parameter of a part, where its `default` is of another dimension.
    pub(super) fn fits(&mut self, value: &Value, default: &Value, loc: Loc) {
        let defaults = default.entries().iter().cycle();
        for (id, default) in value.entries().iter().zip(defaults) {
            let expected = self.dimension(*default);
            self.expect(*id, expected, "as the default of this parameter is", loc);
        }
    }

    /// Reports terms that cannot be added; true if it does.
    pub(super) fn terms_clash(&mut self, terms: &[(f64, Value, Loc)]) -> bool {
        let mut sums: Vec<Measured> = Vec::new();
        for (sign, value, loc) in terms {
            for (k, id) in value.entries().iter().enumerate() {
                let next = self.dimension(*id);
                if sums.len() <= k {
                    sums.resize(k + 1, Number);
                }
                match sums[k].with(next) {
                    Ok(same) => sums[k] = same,
                    Err((before, next)) => {
                        self.complain(*id, *loc, adds(next, before, *sign < 0.0));
                        return true;
                    }
                }
            }
        }
        false
    }

    /// Reports sides of an equation that cannot be equal; true if it does.
    pub(super) fn sides_clash(
        &mut self,
        left: &[(f64, Value, Loc)],
        right: &[(f64, Value, Loc)],
    ) -> bool {
        let (Some(first), Some(last)) = (right.first(), right.last()) else {
            return false;
        };
        let loc = first.2.to(last.2);
        let entries = |terms: &[(f64, Value, Loc)]| {
            let values = terms.iter().map(|(_, value, _)| value.entries().len());
            values.max().unwrap_or(0)
        };
        for k in 0..entries(left).max(entries(right)) {
            let sides = [left, right].map(|terms| {
                let ids = terms
                    .iter()
                    .filter_map(|(_, value, _)| value.entries().get(k));
                let ids: Vec<Id> = ids.copied().collect();
                let mut dimensions = ids.into_iter().map(|id| self.dimension(id));
                dimensions.try_fold(Number, Measured::with)
            });
            // What is wrong within a side is told as such.
            let [Ok(a), Ok(b)] = sides else {
                continue;
            };
            if let Err((a, b)) = a.with(b) {
                let ids = right
                    .iter()
                    .filter_map(|(_, value, _)| value.entries().get(k));
                let remedy = remedy(a, b);
                let message = format!("equates {a} with {b}{remedy}");
                ids.copied()
                    .for_each(|id| self.complain(id, loc, message.clone()));
                return true;
            }
        }
        false
    }

    /// Reports what is wrong with `id`, of which nothing is known from here on: what follows from one mistake is not told.
    fn complain(&mut self, id: Id, loc: Loc, message: String) {
        if let Some(dimensions) = &mut self.dimensions {
            dimensions.diag.error(loc, message);
            for node in [id, self.graph.unscaled(id).1] {
                dimensions.nodes[node.index()] = Unknown;
            }
        }
    }

    /// Forgets what is wrong with `value`, which was made last: it is told.
    pub(super) fn told(&mut self, value: &Value) {
        if let Some(dimensions) = &mut self.dimensions {
            dimensions.see(&self.graph);
            dimensions.clash = None;
            for id in value.entries() {
                dimensions.nodes[id.index()] = Unknown;
            }
        }
    }

    /// `value` as plain numbers, where it is made of numbers of which nothing else is known.
    pub(super) fn plain_numbers(&mut self, value: Value) -> Value {
        let mut known = |id: &Id| !matches!(self.dimension(*id), Number | Unknown);
        if value.entries().iter().any(&mut known) {
            return value;
        }
        let Some(dimensions) = &mut self.dimensions else {
            return value;
        };
        let numbers = value.entries().iter();
        let numbers = numbers.map(|id| dimensions.value_of(*id, &self.graph));
        let Some(numbers) = numbers.collect::<Option<Vec<f64>>>() else {
            return value;
        };
        let mut numbers = numbers.into_iter();
        value.map(|_| self.graph.constant(numbers.next().unwrap_or_default()))
    }

    /// How many errors of units there are.
    pub(super) fn units_told(&self) -> usize {
        self.dimensions.as_ref().map_or(0, |d| d.diag.len())
    }

    /// Moves the errors of units from number `from` on to `loc`.
    pub(super) fn units_relocated(&self, from: usize, loc: Loc) {
        if let Some(dimensions) = &self.dimensions {
            dimensions.diag.relocate(from, loc);
        }
    }

    /// Enters what the last constraint, `phi`, is measured in.
    pub(super) fn measure_row(&mut self, phi: Id, kind: Kind) {
        let row = self.dimension(phi);
        let per = match kind {
            Kind::Holonomic => Number,
            Kind::Nonholonomic => Measured::of(Dimension::TIME),
        };
        let place = self.constraints.len() - 1;
        if let Some(dimensions) = &mut self.dimensions {
            dimensions.rows.resize(place, Unknown);
            dimensions.rows.push(row.times(per));
        }
    }

    /// What coordinate `i` is measured in.
    pub(super) fn of_coordinate(&self, i: usize) -> Measured {
        let dimensions = self.dimensions.as_ref();
        let measured = dimensions.and_then(|d| d.coordinates.get(i));
        measured.copied().unwrap_or(Unknown)
    }

    /// What an entry of M is measured in.
    pub(super) fn expect_mass(&mut self, (i, j): (usize, usize), id: Id, loc: Loc) {
        let rates = [i, j].map(|k| self.of_coordinate(k).rate());
        let mass = Measured::of(Dimension::ENERGY).per(rates[0]).per(rates[1]);
        self.expect(id, mass, "a mass for these coordinates", loc);
    }
}

fn adds(next: Dimension, before: Dimension, minus: bool) -> String {
    let remedy = remedy(before, next);
    match minus {
        true => format!("subtracts {next} from {before}{remedy}"),
        false => format!("adds {next} to {before}{remedy}"),
    }
}

/// What gives a plain number the unit of the other one; nothing where neither is plain.
fn remedy(a: Dimension, b: Dimension) -> String {
    let unit = match (a == Dimension::NUMBER, b == Dimension::NUMBER) {
        (true, false) => b,
        (false, true) => a,
        _ => return String::new(),
    };
    format!("; behind a plain number `* 1 [{unit}]` gives it the unit")
}
