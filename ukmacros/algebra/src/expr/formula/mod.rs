//! Expressions as a reader writes them: a tree between the graph and a page, with its text. Its typeset form is in [`mathml`], rows that
//! differ in their indices alone are put together in [`families`].

mod families;
mod mathml;

pub use families::{Block, Letters, families};

use std::fmt;

/// An expression to be read.
#[derive(Clone, Debug)]
pub enum Formula {
    /// A number that is not negative.
    Number(f64),
    Name(Name),
    /// The rate of a coordinate.
    Rate(Name),
    Negative(Box<Formula>),
    /// Terms, and whether each is taken away.
    Sum(Vec<(bool, Formula)>),
    /// Factors above and below the line; one at least is above it.
    Product(Vec<Formula>, Vec<Formula>),
    Power(Box<Formula>, u32),
    Call(&'static str, Vec<Formula>),
    /// Two sides that are compared, and what holds where the first is not greater, and where it is.
    Select(Box<[Formula; 4]>),
    /// An entry of a vector or matrix.
    Entry(&'static str, Vec<Name>),
    Equal(Box<[Formula; 2]>),
    /// An equation, and the name of the constraint that it is.
    Labelled(Name, Box<Formula>),
}

/// A name with its indices: `link[3].x`.
#[derive(Clone, Debug)]
pub struct Name(Vec<Part>);

#[derive(Clone, Debug)]
enum Part {
    Word(String),
    Index(Index),
}

/// An index: a number, or one that follows from letters that run.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Index {
    constant: i64,
    /// Letters with what stands before them.
    letters: Vec<(String, i64)>,
}

/// How tightly the outermost operator of an expression binds.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Precedence {
    Sum,
    Sign,
    Product,
    Power,
    Atom,
}

impl Formula {
    pub fn number(x: f64) -> Self {
        Formula::Number(x.abs()).signed(x)
    }

    pub fn name(text: &str) -> Self {
        Formula::Name(Name::from(text))
    }

    /// The formula with the sign of `c`.
    pub fn signed(self, c: f64) -> Self {
        match c < 0.0 {
            true => Formula::Negative(Box::new(self)),
            false => self,
        }
    }

    pub fn equal(self, other: Formula) -> Self {
        Formula::Equal(Box::new([self, other]))
    }

    fn precedence(&self) -> Precedence {
        match self {
            Formula::Sum(_) | Formula::Equal(_) | Formula::Labelled(..) => Precedence::Sum,
            Formula::Negative(_) => Precedence::Sign,
            Formula::Product(..) => Precedence::Product,
            Formula::Power(_, exponent) if *exponent != 2 => Precedence::Power,
            Formula::Number(x) if number(*x).contains('/') => Precedence::Product,
            _ => Precedence::Atom,
        }
    }

    /// Calls `f` with each index, in the order of the text.
    fn each_index(&mut self, f: &mut impl FnMut(&mut Index)) {
        let mut names = |names: &mut [Name]| {
            for name in names {
                for part in &mut name.0 {
                    if let Part::Index(index) = part {
                        f(index);
                    }
                }
            }
        };
        match self {
            Formula::Number(_) => {}
            Formula::Name(name) | Formula::Rate(name) => names(std::slice::from_mut(name)),
            Formula::Entry(_, all) => names(all),
            Formula::Labelled(name, inner) => {
                names(std::slice::from_mut(name));
                inner.each_index(f);
            }
            Formula::Negative(inner) | Formula::Power(inner, _) => inner.each_index(f),
            Formula::Sum(terms) => terms.iter_mut().for_each(|(_, term)| term.each_index(f)),
            Formula::Product(above, below) => {
                let factors = above.iter_mut().chain(below);
                factors.for_each(|factor| factor.each_index(f));
            }
            Formula::Call(_, all) => all.iter_mut().for_each(|one| one.each_index(f)),
            Formula::Select(all) => all.iter_mut().for_each(|one| one.each_index(f)),
            Formula::Equal(sides) => sides.iter_mut().for_each(|side| side.each_index(f)),
        }
    }
}

impl From<&str> for Name {
    fn from(text: &str) -> Self {
        let mut parts = Vec::new();
        let mut rest = text;
        while let Some((before, inner)) = rest.split_once('[') {
            let Some((digits, after)) = inner.split_once(']') else {
                break;
            };
            let Ok(constant) = digits.parse() else {
                break;
            };
            if !before.is_empty() {
                parts.push(Part::Word(before.to_owned()));
            }
            parts.push(Part::Index(Index {
                constant,
                letters: Vec::new(),
            }));
            rest = after;
        }
        if !rest.is_empty() {
            parts.push(Part::Word(rest.to_owned()));
        }
        Name(parts)
    }
}

/// The text; with `#` the text without its indices, which formulas of one family have in common.
impl fmt::Display for Formula {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Formula::Number(x) => f.write_str(&number(*x)),
            Formula::Name(name) => name.fmt(f),
            Formula::Rate(name) => {
                f.write_str("dot(")?;
                name.fmt(f)?;
                f.write_str(")")
            }
            Formula::Negative(inner) => {
                f.write_str("-")?;
                inner.wrapped(Precedence::Product, f)
            }
            Formula::Sum(terms) => {
                for (k, (minus, term)) in terms.iter().enumerate() {
                    f.write_str(sign(k == 0, *minus))?;
                    term.wrapped(Precedence::Product, f)?;
                }
                Ok(())
            }
            Formula::Product(above, below) => {
                factors(above, f)?;
                match below.as_slice() {
                    [] => Ok(()),
                    [one] => {
                        f.write_str("/")?;
                        one.wrapped(Precedence::Power, f)
                    }
                    many => {
                        f.write_str("/(")?;
                        factors(many, f)?;
                        f.write_str(")")
                    }
                }
            }
            Formula::Power(base, 2) => arguments("sq", std::slice::from_ref(base), f),
            Formula::Power(base, exponent) => {
                base.wrapped(Precedence::Atom, f)?;
                write!(f, "^{exponent}")
            }
            Formula::Call(name, args) => arguments(name, args, f),
            Formula::Select(all) => {
                for (before, one) in ["(", " ≤ ", " ? ", " : "].iter().zip(all.iter()) {
                    f.write_str(before)?;
                    one.fmt(f)?;
                }
                f.write_str(")")
            }
            Formula::Entry(letter, names) => {
                f.write_str(letter)?;
                for (k, name) in names.iter().enumerate() {
                    f.write_str(if k == 0 { "[" } else { ", " })?;
                    name.fmt(f)?;
                }
                f.write_str("]")
            }
            Formula::Equal(sides) => {
                sides[0].fmt(f)?;
                f.write_str(" = ")?;
                sides[1].fmt(f)
            }
            Formula::Labelled(name, equation) => {
                name.fmt(f)?;
                f.write_str(": ")?;
                equation.fmt(f)
            }
        }
    }
}

impl Formula {
    fn wrapped(&self, least: Precedence, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.precedence() >= least {
            return fmt::Display::fmt(self, f);
        }
        f.write_str("(")?;
        fmt::Display::fmt(self, f)?;
        f.write_str(")")
    }
}

/// What stands before a term.
fn sign(first: bool, minus: bool) -> &'static str {
    match (first, minus) {
        (true, false) => "",
        (true, true) => "-",
        (false, false) => " + ",
        (false, true) => " - ",
    }
}

fn factors(factors: &[Formula], f: &mut fmt::Formatter<'_>) -> fmt::Result {
    for (k, factor) in factors.iter().enumerate() {
        f.write_str(if k == 0 { "" } else { "*" })?;
        factor.wrapped(Precedence::Power, f)?;
    }
    Ok(())
}

fn arguments<F: fmt::Display>(name: &str, args: &[F], f: &mut fmt::Formatter<'_>) -> fmt::Result {
    f.write_str(name)?;
    for (k, arg) in args.iter().enumerate() {
        f.write_str(if k == 0 { "(" } else { ", " })?;
        arg.fmt(f)?;
    }
    f.write_str(")")
}

/// A number without trailing `.0`; multiples of π and thirds to twelfths as what they are.
fn number(x: f64) -> String {
    let plain = match x == 0.0 || (1e-6..1e16).contains(&x) {
        true => format!("{x}"),
        false => format!("{x:e}"),
    };
    if plain.len() < 15 {
        return plain;
    }
    let turns = (1..=12_i32).find(|k| x == f64::from(*k) * std::f64::consts::PI);
    if let Some(turns) = turns {
        return match turns {
            1 => "π".to_owned(),
            k => format!("{k}π"),
        };
    }
    let above = |q: &i32| (x * f64::from(*q)).round();
    let part = (3..=12_i32).find(|q| x < 100.0 && x == above(q) / f64::from(*q));
    part.map_or(plain, |q| format!("{}/{q}", above(&q)))
}

impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for part in &self.0 {
            match part {
                Part::Word(word) => f.write_str(word)?,
                Part::Index(_) if f.alternate() => f.write_str("[#]")?,
                Part::Index(index) => write!(f, "[{index}]")?,
            }
        }
        Ok(())
    }
}

impl fmt::Display for Index {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut first = true;
        for (letter, factor) in &self.letters {
            f.write_str(sign(first, *factor < 0))?;
            first = false;
            match factor.abs() {
                1 => f.write_str(letter)?,
                k => write!(f, "{k}*{letter}")?,
            }
        }
        match (first, self.constant) {
            (true, constant) => write!(f, "{constant}"),
            (false, 0) => Ok(()),
            (false, constant) if constant < 0 => write!(f, " - {}", -constant),
            (false, constant) => write!(f, " + {constant}"),
        }
    }
}
