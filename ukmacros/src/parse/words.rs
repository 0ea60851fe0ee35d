//! Names that Rust keeps to itself, or has none of.

use crate::diag::Diagnostics;
use proc_macro2::{Delimiter, Group, Ident, Literal, Spacing, Span, TokenStream, TokenTree};
use std::collections::BTreeSet;

/// Reserved words of Rust that have no meaning in a declaration, and so can only be meant as names.
const RESERVED: &str = "abstract become box do enum extern final macro mod override priv static trait try type typeof unsized virtual where yield";

/// Reserved words that have a meaning, in a declaration or to those who write one: they are meant as names where only names stand.
const MEANING: &str = "Self as async await break const continue crate dyn else false fn for if impl in let loop match move mut pub ref return self struct super true unsafe use while";

/// Where tokens stand.
#[derive(Clone, Copy, PartialEq)]
enum Level {
    /// In braces: sections, or entries of one.
    Entries,
    /// In the braces of `coords`, where names stand alone.
    Coords,
    /// In the parentheses behind the name of a start.
    Options,
    Other,
}

/// `tokens` with names in the place of words that are none, each of which is reported where it stands first.
pub(super) fn free(tokens: TokenStream, diag: &Diagnostics) -> TokenStream {
    let mut names = BTreeSet::new();
    find(&tokens, Level::Entries, &mut names);
    if names.is_empty() {
        return tokens;
    }
    let mut freeing = Freeing {
        names,
        told: BTreeSet::new(),
        diag,
    };
    freeing.level(tokens, Level::Entries)
}

/// Whether `name` stands in the place of a reserved word, of which that has been told.
pub(crate) fn is_freed(name: &str) -> bool {
    let word = name.strip_suffix('_');
    word.is_some_and(|word| is_among(RESERVED, word) || is_among(MEANING, word))
}

fn is_among(words: &str, name: &str) -> bool {
    words.split(' ').any(|word| name == word)
}

/// Whether Rust has this name: it tells of others, such as pictures, by itself, but hands them on.
fn is_name(name: &str) -> bool {
    name.is_ascii() || syn::parse_str::<TokenStream>(name).is_ok()
}

/// The words in `tokens` in whose place names are put.
fn find(tokens: &TokenStream, level: Level, names: &mut BTreeSet<String>) {
    let tokens: Vec<TokenTree> = tokens.clone().into_iter().collect();
    let mut bars = false;
    for (at, token) in tokens.iter().enumerate() {
        match token {
            TokenTree::Group(group) => find(&group.stream(), inside(&tokens, at), names),
            TokenTree::Punct(p) => bars ^= p.as_char() == '|',
            TokenTree::Ident(name) => {
                let text = name.to_string();
                let declared =
                    (is_among(MEANING, &text) || text == "_") && declares(&tokens, at, level, bars);
                let raw = text.starts_with("r#") && !in_path(&tokens, at);
                if declared || raw || is_among(RESERVED, &text) || !is_name(&text) {
                    names.insert(text);
                }
            }
            TokenTree::Literal(literal) => {
                if is_numbered(literal) && declares(&tokens, at, level, bars) {
                    names.insert(literal.to_string());
                }
            }
        }
    }
}

/// Whether this is a number with letters behind it.
fn is_numbered(literal: &Literal) -> bool {
    let text = literal.to_string();
    let letters = text.trim_start_matches(|c: char| c.is_ascii_digit());
    let number = ["e", "E", "x", "f64", "usize"];
    letters.len() < text.len()
        && letters.starts_with(|c: char| c.is_alphabetic() || c == '_')
        && (letters == "x" || !number.iter().any(|start| letters.starts_with(start)))
}

/// Where what is in the group at this place stands.
fn inside(tokens: &[TokenTree], at: usize) -> Level {
    let before = |k: usize| at.checked_sub(k).map(|at| &tokens[at]);
    let TokenTree::Group(group) = &tokens[at] else {
        return Level::Other;
    };
    match group.delimiter() {
        Delimiter::Brace if is_word(before(1), &["coords"]) => Level::Coords,
        Delimiter::Brace => Level::Entries,
        Delimiter::Parenthesis if is_word(before(2), &["start"]) => Level::Options,
        _ => Level::Other,
    }
}

fn is_word(token: Option<&TokenTree>, words: &[&str]) -> bool {
    matches!(token, Some(TokenTree::Ident(name)) if words.iter().any(|word| name == word))
}

fn is_sign(token: Option<&TokenTree>, signs: &[char]) -> bool {
    matches!(token, Some(TokenTree::Punct(p)) if signs.contains(&p.as_char()))
}

fn is_group(token: Option<&TokenTree>, delimiters: &[Delimiter]) -> bool {
    matches!(token, Some(TokenTree::Group(group)) if delimiters.contains(&group.delimiter()))
}

/// Whether `::` is beside the word at this place.
fn in_path(tokens: &[TokenTree], at: usize) -> bool {
    let pair = |first: Option<usize>| {
        first.is_some_and(|i| is_sign(tokens.get(i), &[':']) && is_sign(tokens.get(i + 1), &[':']))
    };
    pair(at.checked_sub(2)) || pair(Some(at + 1))
}

/// Whether what is at this place stands where a name does that is declared, or that something is said of.
fn declares(tokens: &[TokenTree], at: usize, level: Level, bars: bool) -> bool {
    let token = |at: Option<usize>| at.and_then(|at| tokens.get(at));
    let (before, next) = (token(at.checked_sub(1)), token(Some(at + 1)));
    if in_path(tokens, at) {
        return false;
    }
    if bars {
        return is_sign(before, &['|', ',']) && is_sign(next, &['|', ',']);
    }
    if is_word(before, &["for"]) {
        // Or else that is the variable.
        return !is_word(token(at.checked_sub(2)), &["for"]);
    }
    if is_sign(before, &['.']) {
        // But not behind the dots of a range.
        return !is_sign(token(at.checked_sub(2)), &['.']);
    }
    if !matches!(level, Level::Entries | Level::Coords | Level::Options) {
        return false;
    }
    let single = matches!(next, Some(TokenTree::Punct(p)) if "=:".contains(p.as_char()) && p.spacing() == Spacing::Alone);
    let braced = is_group(next, &[Delimiter::Brace]);
    let called = braced || is_group(next, &[Delimiter::Parenthesis]) || is_word(next, &["until"]);
    let indexed = is_group(next, &[Delimiter::Bracket]);
    let docs = is_group(before, &[Delimiter::Bracket]) && is_sign(token(at.checked_sub(2)), &['#']);
    let first = before.is_none()
        || docs
        || is_sign(before, &[',', ';'])
        || is_group(before, &[Delimiter::Brace]);
    let alone = next.is_none() || is_sign(next, &[',', ';']);
    is_word(before, &["planar", "spatial"]) && (braced || indexed)
        || is_word(before, &["start"]) && called
        || single && (first || !matches!(before, Some(TokenTree::Punct(_))))
        || first && (indexed || alone && matches!(tokens[at], TokenTree::Ident(_)))
        || level == Level::Coords && first && matches!(tokens[at], TokenTree::Literal(_))
}

struct Freeing<'d> {
    names: BTreeSet<String>,
    /// The words that are reported.
    told: BTreeSet<String>,
    diag: &'d Diagnostics,
}

impl Freeing<'_> {
    fn level(&mut self, tokens: TokenStream, level: Level) -> TokenStream {
        let tokens: Vec<TokenTree> = tokens.into_iter().collect();
        let mut bars = false;
        let mut out = Vec::with_capacity(tokens.len());
        for (at, token) in tokens.iter().enumerate() {
            out.push(match token {
                TokenTree::Ident(name) if self.is_meant(&tokens, at, level, bars) => {
                    let first = !self.told.contains(&name.to_string());
                    if first && at > 0 && is_sign(tokens.get(at - 1), &['.']) {
                        // Declared nowhere.
                        self.diag.doubt();
                    }
                    self.named(&name.to_string(), name.span())
                }
                TokenTree::Literal(number) if self.names.contains(&number.to_string()) => {
                    self.named(&number.to_string(), number.span())
                }
                TokenTree::Group(group) => {
                    let stream = self.level(group.stream(), inside(&tokens, at));
                    let mut out = Group::new(group.delimiter(), stream);
                    out.set_span(group.span());
                    out.into()
                }
                other => {
                    bars ^= is_sign(Some(other), &['|']);
                    other.clone()
                }
            });
        }
        out.into_iter().collect()
    }

    /// Whether the word at this place is one of those that names take the place of, and not there for what it means.
    fn is_meant(&self, tokens: &[TokenTree], at: usize, level: Level, bars: bool) -> bool {
        let text = tokens[at].to_string();
        if !self.names.contains(&text) || text.starts_with("r#") && in_path(tokens, at) {
            return false;
        }
        if !is_among(MEANING, &text) || declares(tokens, at, level, bars) {
            return true;
        }
        let next = tokens.get(at + 1);
        // The end of what stands before braces, such as those of a loop.
        let before = at.checked_sub(1).and_then(|at| tokens.get(at));
        let ends = is_sign(before, &['.', '+', '-', '*', '/']) || is_word(before, &["until"]);
        let goes_on = matches!(next, Some(TokenTree::Ident(_) | TokenTree::Literal(_)))
            || is_group(next, &[Delimiter::Brace]) && !ends
            || text == "pub"
                && is_group(next, &[Delimiter::Parenthesis])
                && matches!(tokens.get(at + 2), Some(TokenTree::Ident(_)));
        let of_a_loop = text == "in"
            && at
                .checked_sub(2)
                .is_some_and(|at| is_word(tokens.get(at), &["for"]));
        !goes_on && !of_a_loop && !in_path(tokens, at)
    }

    /// A name in the place of `text`, of which is told once.
    fn named(&mut self, text: &str, span: Span) -> TokenTree {
        let told = |what: &str, other: &str| {
            format!("`{text}` {what}; use another name, such as `{other}`")
        };
        let plain = text.strip_prefix("r#").unwrap_or(text);
        let (other, message) = if text.starts_with(|c: char| c.is_ascii_digit()) {
            let letters = text.trim_start_matches(|c: char| c.is_ascii_digit());
            let digits = &text[..text.len() - letters.len()];
            let other = format!("{letters}{digits}");
            let message = told("is no name, since it begins with a digit", &other);
            (other, message)
        } else if text == "_" {
            ("unnamed_".to_owned(), told("names nothing", "unused"))
        } else if !is_name(text) {
            // The compiler tells of it, and of all its places.
            let codes = text.chars().map(|c| match c.is_alphanumeric() {
                true => c.to_string(),
                false => format!("_{:x}", u32::from(c)),
            });
            (format!("u{}", codes.collect::<String>()), String::new())
        } else {
            let other = format!("{plain}_");
            let message = match plain == text {
                true => told("is a reserved word of Rust", &other),
                false => told("is reserved", &other),
            };
            (other, message)
        };
        if self.told.insert(text.to_owned()) && !message.is_empty() {
            self.diag.error(span, message);
        }
        Ident::new(&other, span).into()
    }
}
