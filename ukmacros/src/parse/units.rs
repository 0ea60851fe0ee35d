//! Units, found before anything else is read, since `[kg m^2]` is no expression of Rust.
//!
//! Brackets behind a number hold a unit. Behind a name or a vector they do where they can be no index: indices are made of constants, loop
//! variables and arguments, none of which is called like a unit that is meant; where a constant is, behind a vector of which it would
//! choose an entry, that is told. The unit's text takes the place of what is in the brackets.

use super::item::Measure;
use crate::diag::{Diagnostics, suggest};
use proc_macro2::{Delimiter, Group, Literal, Span, TokenStream, TokenTree};
use quote::ToTokens as _;
use syn::parse::ParseStream;
use ukunits::{Refusal, Unit};

/// `tokens` with the contents of brackets that hold units as texts; nothing where there are none.
pub(super) fn mark(tokens: &TokenStream, diag: &Diagnostics) -> Option<TokenStream> {
    let mut integers = Vec::new();
    constants(tokens, &mut integers);
    let mut marking = Marking {
        constants: integers.len(),
        integers,
        quoted: false,
        diag,
    };
    marking.level(tokens)
}

/// Names behind `const`.
fn constants(tokens: &TokenStream, found: &mut Vec<String>) {
    let mut declares = false;
    for token in tokens.clone() {
        match &token {
            TokenTree::Group(group) => constants(&group.stream(), found),
            TokenTree::Ident(name) if declares => found.push(name.to_string()),
            _ => {}
        }
        declares = matches!(&token, TokenTree::Ident(name) if name == "const");
    }
}

/// What stands before a token.
#[derive(Clone, Copy, PartialEq)]
enum Before {
    Number,
    /// `[a, b]`.
    Vector,
    Operand,
    Other,
}

struct Marking<'d> {
    /// Names that an index may be made of: of constants, and of the loops and functions around.
    integers: Vec<String>,
    /// How many of them are constants: the first.
    constants: usize,
    /// Whether a text in brackets is reported.
    quoted: bool,
    diag: &'d Diagnostics,
}

impl Marking<'_> {
    /// Marks units as [`mark`] does. Groups without units stay as they are, since the spans of their delimiters do not survive another
    /// group.
    fn level(&mut self, tokens: &TokenStream) -> Option<TokenStream> {
        let outside = self.integers.len();
        let (mut before, mut changed, mut bars) = (Before::Other, false, false);
        // A loop's variable, on the way to its braces.
        let (mut declares, mut variable) = (false, None);
        let mut out: Vec<TokenTree> = Vec::new();
        let mut rest = tokens.clone().into_iter().peekable();
        while let Some(token) = rest.next() {
            let stands = std::mem::replace(&mut before, Before::Other);
            let named = std::mem::take(&mut declares);
            match &token {
                TokenTree::Group(group) => {
                    let bracket = group.delimiter() == Delimiter::Bracket;
                    before = match bracket && stands == Before::Other {
                        true => Before::Vector,
                        false => Before::Operand,
                    };
                    let braces = group.delimiter() == Delimiter::Brace;
                    let variable = variable.take_if(|_| braces);
                    let inside = self.integers.len();
                    self.integers.extend(variable);
                    // A vector that a start tells of, behind an entry without its comma.
                    if bracket
                        && stands != Before::Other
                        && let Some(text) = quoted(group)
                    {
                        // Left out, and told once.
                        if !std::mem::replace(&mut self.quoted, true) {
                            let message =
                                format!("a unit has no quotes, nor has an index: `[{text}]`");
                            self.diag.damage(group.span(), message);
                        }
                        changed = true;
                        continue;
                    }
                    let stands = match rest.peek() {
                        Some(TokenTree::Ident(next)) if next == "near" => Before::Other,
                        Some(TokenTree::Punct(next))
                            if next.as_char() == '=' && stands == Before::Number =>
                        {
                            Before::Other
                        }
                        _ => stands,
                    };
                    let stream = self.group(group, stands);
                    self.integers.truncate(inside);
                    if let Some(stream) = stream {
                        let mut new = Group::new(group.delimiter(), stream);
                        new.set_span(group.span());
                        out.push(new.into());
                        changed = true;
                        continue;
                    }
                }
                TokenTree::Ident(name) => {
                    before = Before::Operand;
                    declares = name == "for";
                    if named {
                        variable = Some(name.to_string());
                    } else if bars {
                        self.integers.push(name.to_string());
                    }
                }
                TokenTree::Literal(_) => before = Before::Number,
                TokenTree::Punct(p) => match p.as_char() {
                    '|' => bars = !bars,
                    // Here a function ends.
                    ',' | ';' if !bars => self.integers.truncate(outside),
                    _ => {}
                },
            }
            out.push(token);
        }
        self.integers.truncate(outside);
        changed.then(|| out.into_iter().collect())
    }

    /// What becomes of the contents of a group.
    fn group(&mut self, group: &Group, before: Before) -> Option<TokenStream> {
        let inside = group.stream();
        let holds = group.delimiter() == Delimiter::Bracket
            && match before {
                Before::Number => true,
                Before::Vector => is_unit(&inside, &self.integers) || self.hidden(group),
                Before::Operand => is_unit(&inside, &self.integers),
                Before::Other => false,
            };
        match holds {
            true => Some(text(group, self.diag)),
            false => self.level(&inside),
        }
    }

    /// Whether these are the brackets of a unit behind a vector, but for a constant that is called like it, which is told.
    fn hidden(&self, group: &Group) -> bool {
        let inside = group.stream();
        let inner = &self.integers[self.constants..];
        let hidden = is_unit(&inside, inner) && Unit::parse(&inside.to_string()).is_ok();
        if hidden {
            let message = format!(
                "`[{inside}]` behind a vector is read as an index, since a constant is called like the unit; rename the constant"
            );
            self.diag.error(group.span(), message);
        }
        hidden
    }
}

/// The text that stands in these brackets by itself, which would be taken for a unit that is read already.
fn quoted(group: &Group) -> Option<String> {
    let tokens: Vec<TokenTree> = group.stream().into_iter().collect();
    let [TokenTree::Literal(text)] = &tokens[..] else {
        return None;
    };
    let text = text.to_string();
    let inside = text.strip_prefix('"')?.strip_suffix('"')?;
    Some(inside.to_owned())
}

/// Whether this is written as a unit, and can be no index.
fn is_unit(tokens: &TokenStream, integers: &[String]) -> bool {
    let tokens: Vec<TokenTree> = tokens.clone().into_iter().collect();
    if let [TokenTree::Punct(only)] = &tokens[..] {
        return only.as_char() == '-';
    }
    let names = tokens.iter().filter_map(|token| match token {
        TokenTree::Ident(name) => Some(name.to_string()),
        _ => None,
    });
    let names: Vec<String> = names.collect();
    let power = |token: &TokenTree| matches!(token, TokenTree::Punct(p) if p.as_char() == '^');
    let allowed = |token: &TokenTree| match token {
        TokenTree::Ident(_) | TokenTree::Literal(_) => true,
        TokenTree::Punct(p) => ['*', '/', '^', '-'].contains(&p.as_char()),
        TokenTree::Group(_) => false,
    };
    let beside = |pair: &[TokenTree]| matches!(pair, [TokenTree::Ident(_), TokenTree::Ident(_)]);
    let no_index = tokens.iter().any(power) || tokens.windows(2).any(beside);
    !names.is_empty()
        && tokens.iter().all(allowed)
        && (no_index
            || names.iter().all(|name| ukunits::is_known(name))
                && names.iter().any(|name| !integers.contains(name)))
}

/// The unit in these brackets as a text; an empty one where it is in error, which is told.
fn text(group: &Group, diag: &Diagnostics) -> TokenStream {
    let text = group.stream().to_string();
    let told = |span: Span, message: String| {
        diag.error(span, message);
        "".to_owned()
    };
    let inside = |name: &str| {
        let same = |token: &TokenTree| matches!(token, TokenTree::Ident(ident) if ident == name);
        let token = group.stream().into_iter().find(same);
        token.map_or(group.span(), |token| token.span())
    };
    let unit = match Unit::parse(&text) {
        Ok(_) => text,
        Err(Refusal::Unknown(name)) => {
            let remedy = "a unit is a product of powers of kg, m, s, rad, deg, N, J and others, such as `[kg m^2]`";
            let alike = |unit: &&str| name.chars().count() > 2 || unit.eq_ignore_ascii_case(&name);
            let end = match ukunits::elsewhere(&name) {
                Some(here) => format!("; one is `{here}`"),
                // Short names are all alike.
                None => suggest(&name, ukunits::names().filter(alike), remedy),
            };
            told(inside(&name), format!("unknown unit `{name}`{end}"))
        }
        Err(refusal) => told(group.span(), refusal.to_string()),
    };
    let mut literal = Literal::string(&unit);
    literal.set_span(group.span());
    TokenTree::Literal(literal).into()
}

/// Refuses a unit without brackets behind a number: a name that nothing is said of.
pub(super) fn bare(number: &syn::ExprLit, input: ParseStream<'_>) -> syn::Result<()> {
    let Some((name, rest)) = input.cursor().ident() else {
        return Ok(());
    };
    let says = |c| matches!(c, '=' | ':' | '.');
    let is_said = rest.punct().is_some_and(|(sign, _)| says(sign.as_char()))
        || rest.group(Delimiter::Bracket).is_some();
    if is_said || Unit::parse(&name.to_string()).is_err() {
        return Ok(());
    }
    let number = number.to_token_stream();
    let message = format!("a unit stands in brackets: `{number} [{name}]`");
    Err(syn::Error::new(name.span(), message))
}

/// The unit that comes next, behind what ends at `before`, if one does; nothing inside where it is in error.
pub(super) fn next(input: ParseStream<'_>, before: Span) -> Option<Option<Measure>> {
    let inside = |input: ParseStream<'_>| {
        let inner;
        let bracket = syn::bracketed!(inner in input);
        let text: syn::LitStr = inner.parse()?;
        Ok((text.value(), bracket.span))
    };
    if !input.peek(syn::token::Bracket) || inside(&input.fork()).is_err() {
        return None;
    }
    let (text, span) = inside(input).ok()?;
    let touches = before.end() == span.open().start();
    let name = |text: &String| touches && text.chars().all(char::is_alphabetic);
    let measure = |unit| Measure {
        unit,
        loc: span.join().into(),
        size: Some(text.clone()).filter(name),
    };
    Some(Unit::parse(&text).ok().map(measure))
}
