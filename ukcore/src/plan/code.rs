//! Emitted functions laid out to be read.

use std::iter::Peekable;
use std::str::CharIndices;

/// Columns of a line.
const WIDTH: usize = 100;
/// Columns of one level.
const INDENT: usize = 4;

/// The text of an emitted function ([`Mechanism::CODE`](crate::Mechanism::CODE)) with each statement on a line of its own; what is longer
/// than 100 columns is broken at the outermost operators. Nothing but spaces is changed.
#[must_use]
pub fn laid_out(text: &str) -> String {
    let tokens: Vec<&str> = Tokens(text.char_indices().peekable(), text).collect();
    let body = tokens.iter().position(|token| *token == "{");
    let body = body.unwrap_or(tokens.len());
    let mut out = Line::of(&tokens[..body]).text;
    let end = tokens.len().saturating_sub(1);
    if body + 1 >= end {
        out += " {}\n";
        return out;
    }
    out += " {\n";
    let (mut start, mut depth) = (body + 1, 0);
    for at in body + 1..end {
        match tokens[at] {
            "(" | "[" | "{" => depth += 1,
            ")" | "]" | "}" => depth -= 1,
            _ => {}
        }
        // The braces of an early exit end it.
        let exit = tokens[at] == "}" && tokens[start] == "if";
        if depth == 0 && (tokens[at] == ";" || exit || at + 1 == end) {
            Line::of(&tokens[start..=at]).wrap(&mut out);
            start = at + 1;
        }
    }
    out += "}\n";
    out
}

/// Rust's tokens, as far as emitted code has them.
struct Tokens<'a>(Peekable<CharIndices<'a>>, &'a str);

impl<'a> Iterator for Tokens<'a> {
    type Item = &'a str;

    fn next(&mut self) -> Option<&'a str> {
        while self.0.next_if(|(_, c)| c.is_whitespace()).is_some() {}
        let (start, first) = self.0.next()?;
        let mut last = first;
        let mut end = |tokens: &mut Self, goes_on: &dyn Fn(char, char) -> bool| {
            while let Some((_, c)) = tokens.0.next_if(|(_, c)| goes_on(last, *c)) {
                last = c;
            }
        };
        match first {
            '"' => {
                end(self, &|_, c| c != '"');
                self.0.next();
            }
            // A point belongs to a number, the sign of an exponent too.
            '0'..='9' => end(self, &|last, c| {
                word(c) || c == '.' || (last == 'e' && "+-".contains(c))
            }),
            c if word(c) => end(self, &|_, c| word(c)),
            ':' => drop(self.0.next_if(|(_, c)| *c == ':')),
            '-' => drop(self.0.next_if(|(_, c)| *c == '>')),
            _ => {}
        }
        let end = self.0.peek().map_or(self.1.len(), |(at, _)| *at);
        Some(&self.1[start..end])
    }
}

fn word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// A statement on one line, and where it may be broken.
#[derive(Default)]
struct Line {
    text: String,
    /// Positions of spaces, and how deep inside: products are deeper than sums.
    breaks: Vec<(usize, usize)>,
    depth: usize,
    /// Whether the text is between `<` and `>`, where nothing is broken.
    generic: bool,
    last: Last,
}

/// What the line ends with.
#[derive(Default, Clone, Copy, PartialEq, Eq)]
enum Last {
    /// Nothing, or an opening bracket: nothing goes between.
    #[default]
    Open,
    /// `let`, `mut` and the like: a space, whatever follows.
    Keyword,
    /// A name, a number, a closing bracket.
    Value,
    /// An operator between two values, or what is written like one.
    Operator,
    /// What belongs to what follows: a sign, `&`, `.`, `::`, `<`.
    Prefix,
    Comma,
    Colon,
}

impl Line {
    fn of(tokens: &[&str]) -> Self {
        let mut line = Line::default();
        tokens.iter().for_each(|token| line.token(token));
        line
    }

    fn token(&mut self, token: &str) {
        let after_value = self.last == Last::Value;
        match token {
            "(" | "[" => {
                // A call or an index belongs to what is before it.
                if !after_value {
                    self.space();
                }
                self.put(token, Last::Open);
                self.depth += 1;
            }
            "{" => {
                self.put(" { ", Last::Open);
                self.depth += 1;
            }
            ")" | "]" | "}" => {
                self.depth -= 1;
                self.put(if token == "}" { " }" } else { token }, Last::Value);
            }
            "," => self.put(token, Last::Comma),
            ";" => self.put(token, Last::Value),
            ":" => self.put(token, Last::Colon),
            "." => self.put(token, Last::Prefix),
            ">" => {
                self.generic = false;
                self.put(token, Last::Value);
            }
            "<" => {
                self.generic = true;
                self.put(token, Last::Prefix);
            }
            "::" => {
                if !after_value {
                    self.space();
                }
                self.put(token, Last::Prefix);
            }
            "'" | "&" => {
                self.space();
                self.put(token, Last::Prefix);
            }
            "let" | "mut" | "fn" | "return" | "if" => {
                self.space();
                self.put(token, Last::Keyword);
            }
            _ if token.starts_with(|c| word(c) || c == '"') => {
                self.space();
                self.put(token, Last::Value);
            }
            _ if !after_value => {
                self.space();
                self.put(token, Last::Prefix);
            }
            _ => {
                match token {
                    "+" | "-" => self.breaks.push((self.text.len(), 2 * self.depth)),
                    "*" | "/" => self.breaks.push((self.text.len(), 2 * self.depth + 1)),
                    _ => {}
                }
                self.text.push(' ');
                self.put(token, Last::Operator);
            }
        }
    }

    fn put(&mut self, text: &str, last: Last) {
        self.text += text;
        self.last = last;
    }

    /// A space where one is due after what was written last.
    fn space(&mut self) {
        match self.last {
            Last::Open | Last::Prefix => return,
            Last::Comma if !self.generic => self.breaks.push((self.text.len(), 2 * self.depth)),
            // The last resort.
            Last::Operator if self.text.ends_with('=') => {
                self.breaks.push((self.text.len(), usize::MAX));
            }
            Last::Comma | Last::Keyword | Last::Operator | Last::Colon | Last::Value => {}
        }
        self.text.push(' ');
    }

    /// Appends the statement, broken where it is too long: as far out as the second half of a line allows.
    fn wrap(&self, out: &mut String) {
        let (mut start, mut indent) = (0, INDENT);
        loop {
            let room = WIDTH - indent;
            let rest = &self.text[start..];
            let ahead = self.breaks.iter().filter(|(at, _)| *at > start);
            let fits = |at: usize| self.text[start..at].chars().count() <= room;
            let fitting: Vec<(usize, usize)> = ahead.copied().filter(|(at, _)| fits(*at)).collect();
            let late = fitting.iter().filter(|(at, _)| at - start > room / 2);
            let best = late.min_by_key(|(at, depth)| (*depth, std::cmp::Reverse(*at)));
            let place = best.or(fitting.last());
            let place = place.filter(|_| rest.chars().count() > room);
            *out += &" ".repeat(indent);
            let Some((at, _)) = place else {
                *out += rest;
                out.push('\n');
                return;
            };
            *out += &self.text[start..*at];
            out.push('\n');
            start = at + 1;
            indent = 2 * INDENT;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::laid_out;

    #[test]
    fn each_statement_has_its_line() {
        let text = "fn f < S : ukcore :: Scalar > (t : S , q : & [S], out : & mut ukcore::Terms < '_ , S >) -> S { \
            let [x, _] = * ukcore::emitted::exact::<S, 2>(q, \"q\"); let lit = S :: from_f64 ; let (sin_x, cos_x) = (- x).sin_cos(); \
            out [0] = -(x + lit(-0.5)) * sin_x / (x * cos_x); let safe = S::select_le(x, cos_x, lit(1e-7), lit(0.0)); \
            if safe . is_zero () { return safe ; } safe }";
        let expected = "\
fn f<S: ukcore::Scalar>(t: S, q: &[S], out: &mut ukcore::Terms<'_, S>) -> S {
    let [x, _] = *ukcore::emitted::exact::<S, 2>(q, \"q\");
    let lit = S::from_f64;
    let (sin_x, cos_x) = (-x).sin_cos();
    out[0] = -(x + lit(-0.5)) * sin_x / (x * cos_x);
    let safe = S::select_le(x, cos_x, lit(1e-7), lit(0.0));
    if safe.is_zero() { return safe; }
    safe
}
";
        assert_eq!(laid_out(text), expected);
        assert_eq!(laid_out("fn f (x : S) { }"), "fn f(x: S) {}\n");
    }

    #[test]
    fn long_statements_are_broken_far_out() {
        let sum = "alpha * (beta + gamma) + ".repeat(8) + "delta";
        let text = laid_out(&format!("fn f() {{ let sum = {sum}; }}"));
        assert!(text.lines().all(|line| line.len() <= 100), "{text}");
        let broken: Vec<&str> = text.lines().skip(2).take(2).collect();
        assert!(
            broken
                .iter()
                .all(|line| line.starts_with("        + alpha") || *line == "}"),
            "{text}"
        );
    }
}
