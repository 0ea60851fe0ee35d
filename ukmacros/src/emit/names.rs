//! Names of variables and constants, from those of the source.

use crate::model::Model;
use std::collections::{HashMap, HashSet};
use ukalgebra::expr::{Graph, Id, Map, Node, Symbol};

/// Names that emitted functions use themselves, or that Rust reserves.
const TAKEN: &str = "given residual t q v lit sum safe kinetic potential prepared mass force nonideal jacobian rhs phi rate outputs integrands drawing switching out as \
    break const continue crate else enum extern false fn for if impl in let loop match mod move mut pub ref return self static struct \
    super trait true type unsafe use where while async await dyn abstract become box do final macro override priv typeof try gen yield \
    virtual unsized";

/// Longest composed name.
const LONGEST: usize = 32;

/// An identifier for `text` such as `x[3]`: `x_3`.
pub(super) fn plain(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        if c.is_alphanumeric() {
            out.push(c);
        } else if !out.is_empty() && !out.ends_with('_') {
            out.push('_');
        }
    }
    let trimmed = out.trim_end_matches('_');
    match trimmed.chars().next() {
        None => "value".to_owned(),
        Some(c) if c.is_numeric() => format!("n_{trimmed}"),
        Some(_) => trimmed.to_owned(),
    }
}

/// What stands in `prepared`, in this order.
#[derive(Clone, Copy, Default)]
pub(super) struct Slots<'a> {
    /// What depends on parameters only.
    pub(super) values: &'a [Id],
    /// Switching functions, for the branches that they are held in.
    pub(super) switches: &'a [Id],
    /// Names of what is given behind the parameters.
    pub(super) options: &'a [String],
}

impl Slots<'_> {
    pub(super) fn symbols(&self) -> impl Iterator<Item = Symbol> + use<> {
        let values = (0..self.values.len()).map(Symbol::Prepared);
        values.chain((0..self.switches.len()).map(Symbol::Branch))
    }
}

/// Variables of one emitted function.
pub(super) struct Namer<'a> {
    graph: &'a Graph,
    hints: &'a Map<Id, String>,
    symbols: HashMap<Symbol, String>,
    variables: Map<Id, String>,
    reciprocals: Map<Id, String>,
    taken: HashSet<String>,
    /// How often each was wished for again.
    repeated: HashMap<String, usize>,
}

impl<'a> Namer<'a> {
    pub(super) fn new(
        graph: &'a Graph,
        model: &Model,
        constraints: usize,
        hints: &'a Map<Id, String>,
        prepared: Slots<'_>,
    ) -> Self {
        let mut namer = Namer {
            graph,
            hints,
            symbols: HashMap::new(),
            variables: Map::default(),
            reciprocals: Map::default(),
            taken: TAKEN.split(' ').map(str::to_owned).collect(),
            repeated: HashMap::new(),
        };
        namer.symbols.insert(Symbol::Time, "t".to_owned());
        let mut enter = |symbol: Symbol, text: &str| {
            let name = namer.fresh(&snake(text));
            namer.symbols.insert(symbol, name);
        };
        for (i, coordinate) in model.coord_elements.iter().enumerate() {
            enter(Symbol::Coord(i), &coordinate.name);
        }
        for (i, coordinate) in model.coord_elements.iter().enumerate() {
            enter(Symbol::Velocity(i), &format!("dot_{}", coordinate.name));
        }
        for i in 0..constraints {
            enter(Symbol::Residual(i), &format!("residual_{i}"));
        }
        for (i, parameter) in model.param_elements.iter().enumerate() {
            enter(Symbol::Param(i), &parameter.name);
        }
        for (k, option) in prepared.options.iter().enumerate() {
            enter(Symbol::Param(model.param_elements.len() + k), option);
        }
        for (i, value) in prepared.values.iter().enumerate() {
            let name = match (graph.node(*value), hints.get(value)) {
                // The prepared values that are parameters take their names.
                (Node::Symbol(s), _) => namer.symbols[s].clone(),
                (_, Some(hint)) => namer.fresh(&snake(hint)),
                _ => {
                    let wish = namer.describe(*value).filter(|name| name.len() <= LONGEST);
                    namer.fresh(&wish.unwrap_or_else(|| "prepared_part".to_owned()))
                }
            };
            namer.symbols.insert(Symbol::Prepared(i), name);
        }
        for (i, function) in prepared.switches.iter().enumerate() {
            let own = hints.get(function).map(|hint| snake(hint));
            let wish = own.or_else(|| namer.describe(*function));
            let wish = wish.filter(|name| name.len() <= LONGEST);
            let wish = wish.unwrap_or_else(|| i.to_string());
            let name = namer.fresh(&format!("held_{wish}"));
            namer.symbols.insert(Symbol::Branch(i), name);
        }
        namer
    }

    fn fresh(&mut self, wish: &str) -> String {
        let mut name = wish.to_owned();
        while !self.taken.insert(name.clone()) {
            let k = self.repeated.entry(wish.to_owned()).or_insert(1);
            *k += 1;
            name = format!("{wish}_{k}");
        }
        name
    }

    pub(super) fn symbol(&self, symbol: Symbol) -> &str {
        &self.symbols[&symbol]
    }

    /// The variable that holds `id`, if it has one.
    pub(super) fn variable(&self, id: Id) -> Option<&str> {
        self.variables.get(&id).map(String::as_str)
    }

    /// Makes a variable for `id`, named for what it is, or else for its `purpose`.
    pub(super) fn declare(&mut self, id: Id, purpose: &str) -> String {
        let wish = match self.hints.get(&id) {
            Some(hint) => snake(hint),
            None => self.compose(id).unwrap_or_else(|| purpose.to_owned()),
        };
        let name = self.fresh(&wish);
        self.variables.insert(id, name.clone());
        name
    }

    /// The variable that holds 1/`id`, if there is one.
    pub(super) fn reciprocal(&self, id: Id) -> Option<&str> {
        self.reciprocals.get(&id).map(String::as_str)
    }

    /// Makes a variable for 1/`id`.
    pub(super) fn declare_reciprocal(&mut self, id: Id, purpose: &str) -> String {
        let of = self.atom(id).unwrap_or_else(|| purpose.to_owned());
        let name = self.fresh(&format!("per_{of}"));
        self.reciprocals.insert(id, name.clone());
        name
    }

    /// A name made of the names of the operands, if short.
    fn compose(&self, id: Id) -> Option<String> {
        let name = match self.graph.node(id) {
            Node::Call(func, args) => {
                let args: Option<Vec<String>> = args.iter().map(|a| self.atom(*a)).collect();
                format!("{}_{}", func.row().name, args?.join("_"))
            }
            Node::Sum(c, terms) if c.get() == 0.0 && terms.len() == 2 => {
                let (a, b) = (terms[0], terms[1]);
                if a.0.get() != 1.0 || b.0.get().abs() != 1.0 {
                    return None;
                }
                let word = if b.0.get() > 0.0 { "plus" } else { "minus" };
                format!("{}_{word}_{}", self.atom(a.1)?, self.atom(b.1)?)
            }
            Node::Product(factors) => {
                let parts = factors.iter().map(|(base, e)| power(self.atom(*base)?, *e));
                parts.collect::<Option<Vec<String>>>()?.join("_")
            }
            Node::Scale(c, inner) if c.get() == 2.0 => format!("twice_{}", self.atom(*inner)?),
            _ => return None,
        };
        (name.len() <= LONGEST).then_some(name)
    }

    /// A name made of the names of all symbols below.
    fn describe(&self, id: Id) -> Option<String> {
        let name = match self.graph.node(id) {
            Node::Symbol(s) => self.symbols[s].clone(),
            Node::Held(inner) => self.describe(*inner)?,
            Node::Scale(c, inner) => {
                let times = match c.get() {
                    0.5 => "half",
                    2.0 => "twice",
                    -1.0 => "minus",
                    _ => "times",
                };
                format!("{times}_{}", self.describe(*inner)?)
            }
            Node::Product(factors) => {
                let parts = factors
                    .iter()
                    .map(|(base, e)| power(self.describe(*base)?, *e));
                parts.collect::<Option<Vec<String>>>()?.join("_")
            }
            Node::Sum(c, terms) if c.get() == 0.0 && terms.len() <= 3 => {
                let parts: Option<Vec<String>> =
                    terms.iter().map(|(_, term)| self.describe(*term)).collect();
                parts?.join("_and_")
            }
            Node::Call(func, args) if args.len() == 1 => {
                format!("{}_{}", func.row().name, self.describe(args[0])?)
            }
            _ => return None,
        };
        (name.len() <= 2 * LONGEST).then_some(name)
    }

    fn atom(&self, id: Id) -> Option<String> {
        match self.graph.node(id) {
            Node::Symbol(s) => Some(self.symbols[s].clone()),
            _ => self.variables.get(&id).cloned(),
        }
    }
}

/// The name of a power of `base`, if it has one.
fn power(base: String, exponent: i32) -> Option<String> {
    match exponent {
        1 => Some(base),
        2 => Some(format!("sq_{base}")),
        -1 => Some(format!("per_{base}")),
        _ => None,
    }
}

/// The name in lower case; θ and Θ in one crate are reported as look-alikes.
fn snake(text: &str) -> String {
    plain(text).replace('Θ', "theta").to_lowercase()
}
