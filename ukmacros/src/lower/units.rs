//! Units: whether the declaration adds metres to seconds.
//!
//! The declaration is lowered once more, for this alone, with a symbol in the place of each number that has a unit or may have one. What
//! has no unit is unknown, and fits anything. A number is a plain one where it is a factor (`0.5 * m`); where it stands by itself (`x + 2`,
//! `[0.3, 0]`, `let g = 9.81`) it may be of anything. Units of what the language itself knows, such as those of time and of the coordinates
//! of bodies, count against those that are declared alone: where none are declared nothing is refused.

use super::lower_with;
use crate::diag::Diagnostics;
use crate::model::Model;
use crate::parse::{Declaration, Expr, ExprKind};
use std::collections::HashMap;
use ukalgebra::expr::Func;
use ukalgebra::expr::{Graph, Id, Node, Symbol};
use ukalgebra::expr::{NamedUnit, System};
use ukunits::{Dimension, Unit};

/// What is known of a value's dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Measured {
    /// A number that is made of numbers: of no dimension as a factor, of any as a term.
    Number,
    Unknown,
    /// The dimension, and whether a unit that is declared is among what it follows from.
    Known(Dimension, bool),
}

use Measured::{Known, Number, Unknown};

/// Two dimensions that should be one.
#[derive(Clone, Copy)]
pub(super) enum Clash {
    Terms(Dimension, Dimension),
    /// The arguments of this function should be of one.
    Arguments(Func, Dimension, Dimension),
    /// The argument of this function should be a plain number.
    Argument(Func, Dimension),
}

/// What units say of a graph.
pub(super) struct Dimensions<'m> {
    pub(super) diag: &'m Diagnostics,
    /// The dimensions of parameters.
    pub(super) params: Vec<Measured>,
    /// The dimensions of what stands for numbers, with these, and for options: symbols behind those of the `first` parameters.
    symbols: Vec<(Measured, Option<f64>)>,
    first: usize,
    pub(super) coordinates: Vec<Measured>,
    /// The dimensions of what multipliers belong to, by the constraint's position.
    pub(super) rows: Vec<Measured>,
    /// The dimensions of nodes, by their places.
    pub(super) nodes: Vec<Measured>,
    /// What stands for a number of this value and this unit.
    numbers: HashMap<(u64, Option<String>), Symbol>,
    pub(super) clash: Option<Clash>,
    /// What is lowered next is a factor.
    pub(super) factor: bool,
}

/// Checks units, and enters those of parameters, multipliers and options into `system`.
pub(crate) fn units(decl: &Declaration, model: &Model, system: &mut System, diag: &Diagnostics) {
    if !model.units || !diag.is_empty() {
        return;
    }
    let quiet = Diagnostics::default();
    model.repetitions.set(0);
    model.applications.set(0);
    let coordinates = model.coord_elements.iter().map(|element| {
        let unit = element.unit.as_ref();
        let declared = element.family < model.plain;
        // Those of quaternions have none.
        let other = match declared {
            true => Unknown,
            false => Measured::of(Dimension::NUMBER),
        };
        unit.map_or(other, |unit| Measured::known(unit.dimension(), declared))
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
        clash: None,
        factor: false,
    };
    let (measured, dimensions) = lower_with(decl, model, &quiet, Some(dimensions));
    let (params, rows) = dimensions.map(|d| (d.params, d.rows)).unwrap_or_default();
    let params = model.param_elements.iter().zip(params);
    let params = params.map(|(element, measured)| match &element.default {
        Some(preset) => measured.unit(&preset.value),
        None => NamedUnit::default(),
    });
    system.units = params.collect();
    let all = measured.constraints.iter().enumerate();
    let kept = all.filter(|(_, row)| !system.left_out.contains(&row.item.text()));
    let efforts = kept.map(|(row, _)| match rows.get(row) {
        Some(Known(dimension, _)) => dimension.effort(),
        _ => String::new(),
    });
    system.efforts = efforts.collect();
    for (start, measured) in system.starts.iter_mut().zip(measured.starts) {
        for (option, measured) in start.options.iter_mut().zip(measured.options) {
            option.unit = measured.unit;
        }
    }
}

/// The unit of this dimension that a number in `e` has.
fn written(e: &Expr, dimension: Dimension) -> Option<&Unit> {
    match &e.kind {
        ExprKind::Quantity(_, unit) => {
            (unit.dimension().without_angle() == dimension).then_some(unit)
        }
        ExprKind::Neg(_) | ExprKind::Group(_) | ExprKind::Chain(..) | ExprKind::Vector(_) => {
            let mut parts = e.parts().into_iter();
            parts.find_map(|part| written(part, dimension))
        }
        _ => None,
    }
}

impl Measured {
    pub(super) fn known(dimension: Dimension, declared: bool) -> Self {
        Known(dimension.without_angle(), declared)
    }

    /// What the language knows by itself.
    pub(super) fn of(dimension: Dimension) -> Self {
        Measured::known(dimension, false)
    }

    pub(super) fn times(self, other: Measured) -> Self {
        match (self, other) {
            (Number, known) | (known, Number) => known,
            (Known(a, declared), Known(b, too)) => Measured::known(a.times(b), declared || too),
            _ => Unknown,
        }
    }

    /// The unit of a number of it, whose default is written as this.
    pub(super) fn unit(self, default: &Expr) -> NamedUnit {
        let Known(dimension, true) = self else {
            return NamedUnit::default();
        };
        let unit = written(default, dimension);
        let written = unit.filter(|unit| !unit.is_coherent());
        NamedUnit {
            si: match (unit, dimension) {
                (Some(unit), _) => unit.si(),
                (None, Dimension::NUMBER) => String::new(),
                (None, other) => other.to_string(),
            },
            written: written.map(Unit::to_string).unwrap_or_default(),
        }
    }

    fn power(self, exponent: f64) -> Self {
        match self {
            Known(dimension, declared) => dimension
                .power(exponent)
                .map_or(Unknown, |d| Measured::known(d, declared)),
            other => other,
        }
    }

    pub(super) fn per(self, other: Measured) -> Self {
        self.times(other.power(-1.0))
    }

    /// What the rate of it is.
    pub(super) fn rate(self) -> Self {
        self.per(Measured::of(Dimension::TIME))
    }

    /// What of it is declared.
    pub(super) fn declared(self) -> Self {
        match self {
            Known(_, true) => self,
            _ => Unknown,
        }
    }

    /// What both are, if they may be one; both, if not.
    pub(super) fn with(self, other: Measured) -> Result<Self, (Dimension, Dimension)> {
        match (self, other) {
            (Number | Unknown, Known(..)) | (Number, Unknown) => Ok(other),
            (_, Number | Unknown) => Ok(self),
            (Known(a, declared), Known(b, too)) => match (a == b, declared || too) {
                (true, either) => Ok(Measured::known(a, either)),
                (false, true) => Err((a, b)),
                (false, false) => Ok(Unknown),
            },
        }
    }
}

impl Dimensions<'_> {
    /// Looks at all nodes that are new.
    pub(super) fn see(&mut self, g: &Graph) {
        for node in g.nodes_from(self.nodes.len()) {
            let measured = self.of_node(node, g).unwrap_or_else(|clash| {
                self.clash.get_or_insert(clash);
                Unknown
            });
            self.nodes.push(measured);
        }
    }

    /// The dimension of a value.
    pub(super) fn of(&mut self, id: Id, g: &Graph) -> Measured {
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
            Node::Call(func, args) => match func {
                Func::Sqrt => at(&args[0]).power(0.5),
                Func::Abs => at(&args[0]),
                Func::Min | Func::Max | Func::Hypot | Func::Sign | Func::Atan2 => {
                    let of = same(&mut args.iter());
                    let of = of.map_err(|(a, b)| Clash::Arguments(*func, a, b))?;
                    match func {
                        Func::Sign | Func::Atan2 => of.per(of),
                        _ => of,
                    }
                }
                Func::Powf => {
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
        match symbol {
            Symbol::Param(i) => match i.checked_sub(self.first) {
                None => at(&self.params, i),
                Some(i) => self.symbols.get(i).map_or(Unknown, |(of, _)| *of),
            },
            Symbol::Coord(i) => at(&self.coordinates, i),
            Symbol::Velocity(i) => at(&self.coordinates, i).rate(),
            Symbol::Time => Measured::of(Dimension::TIME),
            Symbol::Multiplier(row) => Measured::of(Dimension::ENERGY).per(at(&self.rows, row)),
            Symbol::Residual(_) | Symbol::Prepared(_) | Symbol::Branch(_) => Unknown,
        }
    }

    /// The symbol that stands for the number `x`.
    pub(super) fn symbol(&mut self, x: f64, measured: Measured, unit: Option<String>) -> Symbol {
        let key = (x.to_bits(), unit);
        if let Some(known) = self.numbers.get(&key) {
            return *known;
        }
        let symbol = self.enter(measured, Some(x));
        self.numbers.insert(key, symbol);
        symbol
    }

    /// The symbol that stands for an option whose default is this.
    pub(super) fn option(&mut self, default: Measured) -> Symbol {
        self.enter(default.declared(), None)
    }

    fn enter(&mut self, measured: Measured, number: Option<f64>) -> Symbol {
        self.symbols.push((measured, number));
        Symbol::Param(self.first + self.symbols.len() - 1)
    }

    /// The number that `id` stands for.
    pub(super) fn value_of(&self, id: Id, g: &Graph) -> Option<f64> {
        let (c, inner) = g.unscaled(id);
        match g.node(inner) {
            Node::Symbol(Symbol::Param(i)) => {
                let (_, number) = self.symbols.get(i.checked_sub(self.first)?)?;
                number.map(|x| c * x)
            }
            Node::Const(x) => Some(c * x.get()),
            _ => None,
        }
    }
}

/// What a function of a plain number gives.
fn plain(func: Func, argument: Measured) -> Result<Measured, Clash> {
    match argument {
        Known(dimension, true) if dimension != Dimension::NUMBER => {
            Err(Clash::Argument(func, dimension))
        }
        Known(_, declared) => Ok(Measured::known(Dimension::NUMBER, declared)),
        other => Ok(other),
    }
}
