//! Units: whether the declaration adds metres to seconds.
//!
//! The declaration is lowered once more, for this alone, with a symbol in the place of each number that has a unit or may have one. What has no
//! unit is unknown, and fits anything. A number is a plain one where it is a factor (`0.5 * m`); where it stands by itself (`x + 2`,
//! `[0.3, 0]`, `let g = 9.81`) it may be of anything. Units of what the language itself knows, such as those of time and of the coordinates of
//! bodies, count against those that are declared alone: where none are declared nothing is refused.

use super::array::Value;
use super::system::Kind;
use super::{Env, Lowering, lower_with};
use crate::diag::{Diagnostics, Loc};
use crate::expr::functions::Func;
use crate::expr::graph::{Graph, Id, Node, Symbol};
use crate::model::Model;
use crate::parse::{Declaration, Expr, ExprKind};
use std::collections::HashMap;
use ukunits::{Dimension, Unit};

/// What is known of a value's dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Measured {
    /// A number that is made of numbers: of no dimension as a factor, of any as a term.
    Number,
    Unknown,
    Known {
        dimension: Dimension,
        /// A unit that is declared is among what it follows from.
        declared: bool,
    },
}

use Measured::{Known, Number, Unknown};

/// Two dimensions that should be one.
#[derive(Clone, Copy)]
enum Clash {
    Terms(Dimension, Dimension),
    /// The arguments of this function should be of one.
    Arguments(Func, Dimension, Dimension),
    /// The argument of this function should be a plain number.
    Argument(Func, Dimension),
}

/// What units say of a graph.
pub(super) struct Dimensions<'m> {
    diag: &'m Diagnostics,
    /// Of parameters.
    params: Vec<Measured>,
    /// Of what stands for numbers and options: symbols behind those of the `first` parameters.
    symbols: Vec<Measured>,
    first: usize,
    coordinates: Vec<Measured>,
    /// Of what multipliers belong to, by the constraint's position.
    rows: Vec<Measured>,
    /// By the places of nodes.
    nodes: Vec<Measured>,
    /// What stands for a number of this value and this unit.
    numbers: HashMap<(u64, Option<String>), usize>,
    /// The values of these.
    values: HashMap<usize, f64>,
    clash: Option<Clash>,
    /// What is lowered next is a factor.
    factor: bool,
}

/// Units that follow from those declared.
#[derive(Default)]
pub(crate) struct Units {
    /// Of parameters; empty where none is known.
    pub(crate) params: Vec<String>,
}

/// Checks units, and finds those of parameters.
pub(crate) fn units(decl: &Declaration, model: &Model, diag: &Diagnostics) -> Units {
    if !model.units || !diag.is_empty() {
        return Units::default();
    }
    let quiet = Diagnostics::default();
    model.repetitions.set(0);
    model.applications.set(0);
    let coordinates = model.coord_elements.iter().map(|element| {
        let dimension = element.unit.as_ref()?.dimension();
        Some((dimension, element.family < model.plain))
    });
    let coordinates = coordinates.map(|known| match known {
        Some((dimension, declared)) => Measured::known(dimension, declared),
        None => Unknown,
    });
    let dimensions = Dimensions {
        diag,
        params: Vec::new(),
        symbols: Vec::new(),
        first: model.param_elements.len(),
        coordinates: coordinates.collect(),
        rows: Vec::new(),
        nodes: Vec::new(),
        numbers: HashMap::new(),
        values: HashMap::new(),
        clash: None,
        factor: false,
    };
    let (_, dimensions) = lower_with(decl, model, &quiet, Some(dimensions));
    let params = dimensions.map(|d| d.params).unwrap_or_default();
    let params = model.param_elements.iter().zip(params);
    let params = params.map(|(element, measured)| match measured {
        Known {
            dimension,
            declared: true,
        } => {
            let default = element.default.as_ref();
            let written = default.and_then(|preset| written(&preset.value, dimension));
            written.unwrap_or_else(|| match dimension {
                Dimension::NUMBER => String::new(),
                other => other.to_string(),
            })
        }
        _ => String::new(),
    });
    Units {
        params: params.collect(),
    }
}

/// The unit in SI of a default, if it is a number with one.
pub(super) fn unit_of(default: &Expr) -> Option<String> {
    match &default.kind {
        ExprKind::Quantity(_, unit) => Some(unit.si()),
        ExprKind::Neg(inner) | ExprKind::Group(inner) => unit_of(inner),
        ExprKind::Chain(first, rest) => {
            let mut operands = std::iter::once(&**first).chain(rest.iter().map(|(_, e)| e));
            operands.find_map(unit_of)
        }
        _ => None,
    }
}

/// The unit of this dimension that a number in `e` has, in SI.
pub(super) fn written(e: &Expr, dimension: Dimension) -> Option<String> {
    match &e.kind {
        ExprKind::Quantity(_, unit) => {
            (unit.dimension().without_angle() == dimension).then(|| unit.si())
        }
        ExprKind::Neg(inner) | ExprKind::Group(inner) => written(inner, dimension),
        ExprKind::Chain(first, rest) => {
            let mut operands = std::iter::once(&**first).chain(rest.iter().map(|(_, e)| e));
            operands.find_map(|e| written(e, dimension))
        }
        ExprKind::Vector(components) => components.iter().find_map(|e| written(e, dimension)),
        _ => None,
    }
}

impl Measured {
    pub(super) fn known(dimension: Dimension, declared: bool) -> Self {
        Known {
            dimension: dimension.without_angle(),
            declared,
        }
    }

    /// What the language knows by itself.
    pub(super) fn of(dimension: Dimension) -> Self {
        Measured::known(dimension, false)
    }

    fn times(self, other: Measured) -> Self {
        match (self, other) {
            (Number, known) | (known, Number) => known,
            (
                Known {
                    dimension,
                    declared,
                },
                Known {
                    dimension: by,
                    declared: too,
                },
            ) => Measured::known(dimension.times(by), declared || too),
            _ => Unknown,
        }
    }

    fn power(self, exponent: f64) -> Self {
        match self {
            Known {
                dimension,
                declared,
            } => dimension
                .power(exponent)
                .map_or(Unknown, |d| Measured::known(d, declared)),
            other => other,
        }
    }

    pub(super) fn per(self, other: Measured) -> Self {
        self.times(other.power(-1.0))
    }

    /// What both are, if they may be one; both, if not.
    fn with(self, other: Measured) -> Result<Self, (Dimension, Dimension)> {
        match (self, other) {
            (Number | Unknown, Known { .. }) | (Number, Unknown) => Ok(other),
            (_, Number | Unknown) => Ok(self),
            (
                Known {
                    dimension: a,
                    declared,
                },
                Known {
                    dimension: b,
                    declared: too,
                },
            ) => match (a == b, declared || too) {
                (true, either) => Ok(Measured::known(a, either)),
                (false, true) => Err((a, b)),
                (false, false) => Ok(Unknown),
            },
        }
    }
}

impl Dimensions<'_> {
    /// Looks at all nodes that are new.
    fn see(&mut self, g: &Graph) {
        for node in g.nodes_from(self.nodes.len()) {
            let measured = self.of_node(node, g).unwrap_or_else(|clash| {
                self.clash.get_or_insert(clash);
                Unknown
            });
            self.nodes.push(measured);
        }
    }

    /// Of a value.
    fn of(&mut self, id: Id, g: &Graph) -> Measured {
        self.see(g);
        self.nodes[id.index()]
    }

    fn of_node(&self, node: &Node, g: &Graph) -> Result<Measured, Clash> {
        let at = |id: &Id| self.nodes[id.index()];
        let same = |ids: &mut dyn Iterator<Item = &Id>| {
            let mut all = ids.map(at);
            all.try_fold(Number, Measured::with)
        };
        let terms = |(a, b)| Clash::Terms(a, b);
        Ok(match node {
            Node::Const(_) => Number,
            Node::Symbol(symbol) => self.of_symbol(*symbol),
            Node::Sum(_, list) => same(&mut list.iter().map(|(_, id)| id)).map_err(terms)?,
            Node::Scale(_, id) | Node::Held(id) => at(id),
            Node::Product(factors) => factors.iter().fold(Number, |product, (id, power)| {
                product.times(at(id).power(f64::from(*power)))
            }),
            Node::Select([a, b, then, otherwise]) => {
                same(&mut [a, b].into_iter()).map_err(terms)?;
                same(&mut [then, otherwise].into_iter()).map_err(terms)?
            }
            Node::Call(func, args) => match func.row().name {
                "sqrt" => at(&args[0]).power(0.5),
                "abs" => at(&args[0]),
                "min" | "max" | "hypot" | "sign" | "atan2" => {
                    let of = same(&mut args.iter());
                    let of = of.map_err(|(a, b)| Clash::Arguments(*func, a, b))?;
                    let ratio = ["sign", "atan2"].contains(&func.row().name);
                    if ratio { of.per(of) } else { of }
                }
                "powf" => {
                    plain(*func, at(&args[1]))?;
                    match (at(&args[0]), self.value_of(args[1], g)) {
                        (base, Some(exponent)) => base.power(exponent),
                        (base, None) => plain(*func, base).unwrap_or(Unknown),
                    }
                }
                _ => {
                    let mut plain = args.iter().map(|id| plain(*func, at(id)));
                    plain.try_fold(Number, |all, one| Ok(all.times(one?)))?
                }
            },
        })
    }

    fn of_symbol(&self, symbol: Symbol) -> Measured {
        let at = |list: &[Measured], i: usize| list.get(i).copied().unwrap_or(Unknown);
        let time = Measured::of(Dimension::TIME);
        match symbol {
            Symbol::Param(i) => match i.checked_sub(self.first) {
                None => at(&self.params, i),
                Some(i) => at(&self.symbols, i),
            },
            Symbol::Coord(i) => at(&self.coordinates, i),
            Symbol::Velocity(i) => at(&self.coordinates, i).per(time),
            Symbol::Time => time,
            Symbol::Multiplier(row) => Measured::of(Dimension::ENERGY).per(at(&self.rows, row)),
            Symbol::Residual(_) | Symbol::Prepared(_) | Symbol::Branch(_) => Unknown,
        }
    }

    /// The symbol that stands for the number `x`.
    fn symbol(&mut self, x: f64, measured: Measured, unit: Option<String>) -> Symbol {
        let next = self.first + self.symbols.len();
        let known = self.numbers.entry((x.to_bits(), unit)).or_insert(next);
        if *known == next {
            self.symbols.push(measured);
            self.values.insert(next, x);
        }
        Symbol::Param(*known)
    }
}

/// What a function of a plain number gives.
fn plain(func: Func, argument: Measured) -> Result<Measured, Clash> {
    match argument {
        Known {
            dimension,
            declared: true,
        } if dimension != Dimension::NUMBER => Err(Clash::Argument(func, dimension)),
        Known { declared, .. } => Ok(Measured::known(Dimension::NUMBER, declared)),
        other => Ok(other),
    }
}

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
        let mut values = Vec::new();
        for id in value.entries() {
            let number = match (self.graph.as_const(*id), &self.dimensions) {
                (None, Some(dimensions)) => dimensions.value_of(*id, &self.graph),
                (number, _) => number,
            };
            let Some(x) = number else {
                let message = "a unit stands behind numbers, such as `0.3 [m]`; what depends on parameters has the unit that follows from theirs";
                return self.error(e.loc, message);
            };
            values.push(unit.to_si(x));
        }
        let mut values = values.into_iter();
        value.map(|_| {
            let x = values.next().unwrap_or_default();
            match &mut self.dimensions {
                Some(dimensions) if x != 0.0 => {
                    let measured = Measured::known(unit.dimension(), true);
                    let symbol = dimensions.symbol(x, measured, Some(unit.to_string()));
                    self.graph.symbol(symbol)
                }
                _ => self.graph.constant(x),
            }
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
                dimensions.params.push(match measured {
                    Known { declared: true, .. } => measured,
                    _ => Unknown,
                });
            }
        }
    }

    /// What stands for an option whose default is `default`, where units are looked at.
    pub(super) fn measured_option(&mut self, default: Id) -> Option<Symbol> {
        let measured = self.dimension(default);
        let dimensions = self.dimensions.as_mut()?;
        dimensions.symbols.push(measured);
        Some(Symbol::Param(
            dimensions.first + dimensions.symbols.len() - 1,
        ))
    }

    /// Reports `id`, which stands at `loc`, where it is not of the dimension `expected` of `what`.
    pub(super) fn expect(&mut self, id: Id, expected: Measured, what: &str, loc: Loc) {
        let found = self.dimension(id);
        if let Err((expected, found)) = expected.with(found) {
            let message = format!("expected {expected}, {what}, found {found}");
            self.complain(id, loc, message);
        }
    }

    /// The same for the rate of what is expected.
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
                if self.graph.is_zero(*id) {
                    continue;
                }
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
                ids.into_iter().try_fold(Number, |side, id| {
                    let next = match self.graph.is_zero(id) {
                        true => Number,
                        false => self.dimension(id),
                    };
                    side.with(next)
                })
            });
            // What is wrong within a side is told as such.
            let [Ok(a), Ok(b)] = sides else {
                continue;
            };
            if let Err((a, b)) = a.with(b) {
                let ids = right
                    .iter()
                    .filter_map(|(_, value, _)| value.entries().get(k));
                let message = format!("equates {a} with {b}");
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

    /// Forgets what is wrong with what was made last: it is told.
    pub(super) fn told(&mut self) {
        if let Some(dimensions) = &mut self.dimensions {
            dimensions.see(&self.graph);
            dimensions.clash = None;
        }
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
}

impl Dimensions<'_> {
    /// The number that `id` stands for.
    fn value_of(&self, id: Id, g: &Graph) -> Option<f64> {
        let (c, inner) = g.unscaled(id);
        match g.node(inner) {
            Node::Symbol(Symbol::Param(i)) => self.values.get(i).map(|x| c * x),
            _ => None,
        }
    }
}

fn adds(next: Dimension, before: Dimension, minus: bool) -> String {
    match minus {
        true => format!("subtracts {next} from {before}"),
        false => format!("adds {next} to {before}"),
    }
}
