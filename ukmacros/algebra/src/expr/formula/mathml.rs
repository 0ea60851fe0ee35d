//! Formulas typeset, as MathML: browsers show it without a script.

use super::families::Run;
use super::{Block, Formula, Index, Name, Part, Precedence, number};
use std::fmt::Write as _;

/// The space between factors.
const SPACE: &str = "<mspace width=\"0.17em\"/>";

impl Block {
    /// The rows, a line of the source for each; the first ends with the values of letters.
    pub fn mathml(&self) -> Vec<String> {
        let runs: String = self.runs.iter().map(run).collect();
        let ends = [runs.as_str()].into_iter().chain(std::iter::repeat(""));
        let rows = self.rows.iter().zip(ends);
        rows.map(|(row, end)| format!("<math>{}{end}</math>", formula(row)))
            .collect()
    }
}

fn run(run: &Run) -> String {
    let Run { letter, from, to } = run;
    format!(
        "<mspace width=\"2em\"/><mi>{letter}</mi><mo>=</mo><mn>{from}</mn><mo>…</mo><mn>{to}</mn>"
    )
}

fn formula(f: &Formula) -> String {
    match f {
        Formula::Number(x) => numeral(*x),
        Formula::Name(n) => name(n, false),
        Formula::Rate(n) => name(n, true),
        Formula::Negative(inner) => format!("<mo>−</mo>{}", wrapped(inner, Precedence::Product)),
        Formula::Sum(terms) => {
            let sign = |k: usize, minus: bool| match (k, minus) {
                (0, false) => "",
                (_, true) => "<mo>−</mo>",
                (_, false) => "<mo>+</mo>",
            };
            let terms = terms.iter().enumerate();
            let terms = terms.map(|(k, (minus, term))| {
                sign(k, *minus).to_owned() + &wrapped(term, Precedence::Product)
            });
            terms.collect()
        }
        Formula::Product(above, below) if below.is_empty() => product(above),
        Formula::Product(above, below) => {
            format!(
                "<mfrac>{}{}</mfrac>",
                row(&product(above)),
                row(&product(below))
            )
        }
        Formula::Power(base, exponent) => {
            let base = row(&wrapped(base, Precedence::Atom));
            format!("<msup>{base}<mn>{exponent}</mn></msup>")
        }
        Formula::Call("sqrt", args) => format!("<msqrt>{}</msqrt>", list(args)),
        Formula::Call("abs", args) => format!("<mo>|</mo>{}<mo>|</mo>", list(args)),
        Formula::Call(function, args) => {
            format!("<mi>{function}</mi><mo>(</mo>{}<mo>)</mo>", list(args))
        }
        Formula::Select(all) => {
            let [a, b, then, otherwise] = all.each_ref().map(formula);
            format!(
                "<mo>(</mo>{then}<mtext> where </mtext>{a}<mo>≤</mo>{b}<mtext>, else </mtext>{otherwise}<mo>)</mo>"
            )
        }
        Formula::Entry(letter, names) => {
            let names: Vec<String> = names.iter().map(|n| name(n, false)).collect();
            format!(
                "<msub><mi>{letter}</mi>{}</msub>",
                row(&names.join("<mo>,</mo>"))
            )
        }
        Formula::Equal(sides) => {
            let [left, right] = sides.each_ref().map(formula);
            format!("{left}<mo>=</mo>{right}")
        }
        Formula::Labelled(label, equation) => {
            let label = escaped(&label.to_string());
            format!(
                "<mtext>{label}:</mtext><mspace width=\"1em\"/>{}",
                formula(equation)
            )
        }
    }
}

/// One element.
fn row(content: &str) -> String {
    match content.matches("</").count() {
        1 => content.to_owned(),
        _ => format!("<mrow>{content}</mrow>"),
    }
}

fn list(args: &[Formula]) -> String {
    let args: Vec<String> = args.iter().map(formula).collect();
    args.join("<mo>,</mo>")
}

fn product(factors: &[Formula]) -> String {
    match factors {
        [one] => formula(one),
        _ => {
            let factors = factors.iter().map(|f| wrapped(f, Precedence::Power));
            factors.collect::<Vec<_>>().join(SPACE)
        }
    }
}

fn wrapped(inner: &Formula, least: Precedence) -> String {
    // A power is not an atom here, and a name may have an index: both are one box.
    let tight = match inner {
        Formula::Number(_) => Precedence::Atom,
        Formula::Power(..) => Precedence::Power,
        other => other.precedence(),
    };
    match tight >= least {
        true => formula(inner),
        false => format!("<mo>(</mo>{}<mo>)</mo>", formula(inner)),
    }
}

fn numeral(x: f64) -> String {
    let text = number(x);
    if let Some((above, below)) = text.split_once('/') {
        return format!("<mfrac><mn>{above}</mn><mn>{below}</mn></mfrac>");
    }
    match text.split_once('e') {
        Some((digits, exponent)) => format!(
            "<mn>{digits}</mn><mo>·</mo><msup><mn>10</mn><mn>{}</mn></msup>",
            exponent.replace('-', "−")
        ),
        None => format!("<mn>{text}</mn>"),
    }
}

/// A name with its indices below it, and a dot above its last word if it is a rate.
fn name(Name(parts): &Name, rate: bool) -> String {
    let last = parts.iter().rposition(|part| matches!(part, Part::Word(_)));
    let mut out = String::new();
    let mut k = 0;
    while k < parts.len() {
        let Part::Word(text) = &parts[k] else {
            k += 1;
            continue;
        };
        let dotted = rate && last == Some(k);
        let (base, mut below) = word(text, dotted);
        let indices = parts[k + 1..].iter().map_while(|part| match part {
            Part::Index(index) => Some(index),
            Part::Word(_) => None,
        });
        k += 1;
        for one in indices {
            below.push(index(one));
            k += 1;
        }
        match below.is_empty() {
            true => out += &base,
            false => {
                out += &format!(
                    "<msub>{}{}</msub>",
                    row(&base),
                    row(&below.join("<mo>,</mo>"))
                )
            }
        }
    }
    out
}

fn index(index: &Index) -> String {
    let mut out = String::new();
    for part in index.to_string().split(' ') {
        let _ = match part {
            "+" => write!(out, "<mo>+</mo>"),
            "-" => write!(out, "<mo>−</mo>"),
            _ if part.starts_with(|c: char| c.is_ascii_digit()) => write!(out, "<mn>{part}</mn>"),
            _ => write!(out, "<mi>{part}</mi>"),
        };
    }
    out
}

/// A word of a name, which may begin with a full stop, and the number that it ends with, to stand below it.
fn word(text: &str, dotted: bool) -> (String, Vec<String>) {
    let letters = text.trim_end_matches(|c: char| c.is_ascii_digit());
    let (letters, digits) = match letters.ends_with(char::is_alphabetic) {
        true => text.split_at(letters.len()),
        false => (text, ""),
    };
    let pieces = letters
        .split('.')
        .map(|piece| format!("<mi>{}</mi>", greek(piece)));
    let mut pieces: Vec<String> = pieces.collect();
    if let Some(last) = pieces.last_mut().filter(|_| dotted) {
        *last = format!("<mover>{last}<mo>˙</mo></mover>");
    }
    // Nothing stands before the full stop that a word begins with.
    if letters.starts_with('.') {
        pieces[0].clear();
    }
    let below = (!digits.is_empty()).then(|| format!("<mn>{digits}</mn>"));
    let stop = "<mo lspace=\"0\" rspace=\"0\">.</mo>";
    (pieces.join(stop), below.into_iter().collect())
}

/// Greek letters that are written out become letters.
fn greek(word: &str) -> String {
    let letter = match word {
        "alpha" => "α",
        "beta" => "β",
        "gamma" => "γ",
        "delta" => "δ",
        "epsilon" => "ε",
        "zeta" => "ζ",
        "eta" => "η",
        "theta" => "θ",
        "kappa" => "κ",
        "lambda" => "λ",
        "mu" => "μ",
        "nu" => "ν",
        "xi" => "ξ",
        "rho" => "ρ",
        "sigma" => "σ",
        "tau" => "τ",
        "phi" => "φ",
        "chi" => "χ",
        "psi" => "ψ",
        "omega" => "ω",
        other => return escaped(other),
    };
    letter.to_owned()
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}
