//! Emitted functions as text to read.

use proc_macro2::{Delimiter, Spacing, TokenStream, TokenTree};

/// Columns of a line.
const WIDTH: usize = 100;
/// Columns of one level.
const INDENT: usize = 4;

/// A function: its signature, and its statements one below the other.
pub(super) fn function(signature: &TokenStream, body: &TokenStream) -> String {
    let mut out = Line::of(signature.clone()).text;
    if body.is_empty() {
        out += " {}\n";
        return out;
    }
    out += " {\n";
    let mut statement = TokenStream::new();
    for token in body.clone() {
        let ends = match &token {
            TokenTree::Punct(p) => p.as_char() == ';',
            // An early exit.
            TokenTree::Group(g) => {
                let first = statement.clone().into_iter().next();
                let branch = matches!(first, Some(TokenTree::Ident(word)) if word == "if");
                branch && g.delimiter() == Delimiter::Brace
            }
            _ => false,
        };
        statement.extend([token]);
        if ends {
            Line::of(std::mem::take(&mut statement)).wrap(&mut out);
        }
    }
    if !statement.is_empty() {
        Line::of(statement).wrap(&mut out);
    }
    out += "}\n";
    out
}

/// A statement on one line, and where it may be broken.
#[derive(Default)]
struct Line {
    text: String,
    /// Positions of spaces, and how deep inside: products are deeper than sums.
    breaks: Vec<(usize, usize)>,
    depth: usize,
    /// Between `<` and `>`, where nothing is broken.
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
    fn of(tokens: TokenStream) -> Self {
        let mut line = Line::default();
        line.tokens(tokens);
        line
    }

    fn tokens(&mut self, tokens: TokenStream) {
        let mut tokens = tokens.into_iter().peekable();
        while let Some(token) = tokens.next() {
            match token {
                TokenTree::Group(group) => self.group(group.delimiter(), group.stream()),
                TokenTree::Ident(name) => {
                    let name = name.to_string();
                    let keyword = ["let", "mut", "fn"].contains(&name.as_str());
                    self.space();
                    self.put(&name, if keyword { Last::Keyword } else { Last::Value });
                }
                TokenTree::Literal(number) => {
                    self.space();
                    self.put(&number.to_string(), Last::Value);
                }
                TokenTree::Punct(first) => {
                    let mut operator = first.as_char().to_string();
                    if first.spacing() == Spacing::Joint
                        && let Some(TokenTree::Punct(second)) = tokens.peek()
                        && ["::", "->"].contains(&format!("{operator}{second}").as_str())
                    {
                        operator.push(second.as_char());
                        tokens.next();
                    }
                    self.punctuation(&operator);
                }
            }
        }
    }

    fn group(&mut self, delimiter: Delimiter, inner: TokenStream) {
        let (open, close) = match delimiter {
            Delimiter::Parenthesis => ("(", ")"),
            Delimiter::Bracket => ("[", "]"),
            Delimiter::Brace => (" { ", " }"),
            Delimiter::None => return self.tokens(inner),
        };
        // A call or an index belongs to what is before it.
        if self.last != Last::Value {
            self.space();
        }
        self.put(open, Last::Open);
        self.depth += 1;
        self.tokens(inner);
        self.depth -= 1;
        self.put(close, Last::Value);
    }

    fn punctuation(&mut self, operator: &str) {
        let after_value = self.last == Last::Value;
        match operator {
            "," => self.put(",", Last::Comma),
            ";" => self.put(";", Last::Value),
            ":" => self.put(":", Last::Colon),
            "." => self.put(".", Last::Prefix),
            ">" => {
                self.generic = false;
                self.put(">", Last::Value);
            }
            "<" => {
                self.generic = true;
                self.put("<", Last::Prefix);
            }
            "::" => {
                if !after_value {
                    self.space();
                }
                self.put("::", Last::Prefix);
            }
            "'" | "&" => {
                self.space();
                self.put(operator, Last::Prefix);
            }
            _ if !after_value => {
                self.space();
                self.put(operator, Last::Prefix);
            }
            _ => {
                match operator {
                    "+" | "-" => self.breaks.push((self.text.len(), 2 * self.depth)),
                    "*" | "/" => self.breaks.push((self.text.len(), 2 * self.depth + 1)),
                    _ => {}
                }
                self.text.push(' ');
                self.put(operator, Last::Operator);
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
    use super::function;

    #[test]
    fn what_is_printed_is_what_is_emitted() {
        let body = "let [x, _] = *::ukcore::emitted::exact::<S, 2>(q, \"q\"); let lit = S::from_f64; let (sin_x, cos_x) = (-x).sin_cos(); \
            out[0] = -(x + lit(-0.5)) * sin_x / (x * cos_x); let safe = S::select_le(x, cos_x, lit(1.0), lit(0.0)); if safe.is_zero() { return safe; } safe";
        let signature =
            "fn f<S: ::ukcore::Scalar>(t: S, q: &[S], out: &mut ::ukcore::Terms<'_, S>) -> S";
        let (signature, body) = (
            signature.parse().expect("tokens"),
            body.parse().expect("tokens"),
        );
        let text = "\
fn f<S: ::ukcore::Scalar>(t: S, q: &[S], out: &mut ::ukcore::Terms<'_, S>) -> S {
    let [x, _] = *::ukcore::emitted::exact::<S, 2>(q, \"q\");
    let lit = S::from_f64;
    let (sin_x, cos_x) = (-x).sin_cos();
    out[0] = -(x + lit(-0.5)) * sin_x / (x * cos_x);
    let safe = S::select_le(x, cos_x, lit(1.0), lit(0.0));
    if safe.is_zero() { return safe; }
    safe
}
";
        assert_eq!(function(&signature, &body), text);
    }

    #[test]
    fn long_statements_are_broken_far_out() {
        let sum = "alpha * (beta + gamma) + ".repeat(8) + "delta";
        let body = format!("let sum = {sum};").parse().expect("tokens");
        let text = function(&"fn f()".parse().expect("tokens"), &body);
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
