//! Errors: collected, located, reported together.

use proc_macro2::{Delimiter, Group, Ident, Literal, Punct, Spacing, Span, TokenStream, TokenTree};
use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, BTreeSet};

pub(crate) use ukalgebra::Loc;

/// The range that `tokens` cover; the macro call itself if there are none.
pub(crate) fn located(tokens: &impl quote::ToTokens) -> Loc {
    let mut iter = tokens.to_token_stream().into_iter();
    let Some(first) = iter.next() else {
        return Span::call_site().into();
    };
    let start = first.span();
    let end = iter.last().map_or(start, |t| t.span());
    Loc { start, end }
}

/// Whether both stand at one place: spans cannot be compared, but they can be printed.
pub(crate) fn is_same(a: Span, b: Span) -> bool {
    format!("{a:?}") == format!("{b:?}")
}

/// An error at a place.
#[derive(Clone, Debug)]
pub(crate) struct Diagnostic {
    pub(crate) loc: Loc,
    pub(crate) message: String,
}

/// Collects errors, so that one run of the compiler shows them all.
#[derive(Default)]
pub(crate) struct Diagnostics {
    found: RefCell<Vec<Diagnostic>>,
    damaged: Cell<bool>,
    joined: RefCell<Vec<(Loc, Loc)>>,
}

impl Diagnostics {
    /// Records an error that leaves names undeclared: what follows from that is not the user's mistake.
    pub(crate) fn damage(&self, loc: impl Into<Loc>, message: impl Into<String>) {
        self.error(loc, message);
        self.doubt();
    }

    /// Names may be missing because of an error that is recorded already.
    pub(crate) fn doubt(&self) {
        self.damaged.set(true);
    }

    /// Whether names are missing because of an error.
    pub(crate) fn damaged(&self) -> bool {
        self.damaged.get()
    }

    /// Notes that nothing stands between a term and what is next to it on its line.
    pub(crate) fn join(&self, term: Loc, next: impl Into<Loc>) {
        self.joined.borrow_mut().push((term, next.into()));
    }

    /// What is next to this term, with nothing between.
    pub(crate) fn next_to(&self, term: Loc) -> Option<Loc> {
        let joined = self.joined.borrow();
        let found = joined
            .iter()
            .find(|(first, _)| is_same(first.start, term.start));
        found.map(|(_, next)| *next)
    }

    /// Records an error, unless the same one is recorded for the same place (in a function that is called twice, say).
    pub(crate) fn error(&self, loc: impl Into<Loc>, message: impl Into<String>) {
        let (loc, message) = (loc.into(), message.into());
        let mut found = self.found.borrow_mut();
        let same_place = |l: Loc| is_same(l.start, loc.start) && is_same(l.end, loc.end);
        let same = |d: &Diagnostic| d.message == message && same_place(d.loc);
        if !found.iter().any(same) {
            found.push(Diagnostic { loc, message });
        }
    }

    /// Records what `syn` found wrong.
    pub(crate) fn syntax(&self, error: &syn::Error) {
        for e in error.clone() {
            self.damage(e.span(), e.to_string());
        }
    }

    /// Moves the errors from number `from` on to `loc`, of which the first is left: the others follow from it.
    pub(crate) fn relocate(&self, from: usize, loc: Loc) {
        let mut found = self.found.borrow_mut();
        found.truncate(from + 1);
        found.iter_mut().skip(from).for_each(|d| d.loc = loc);
    }

    /// Leaves of the errors from number `from` on those that differ in what they say.
    pub(crate) fn distinct(&self, from: usize) {
        let mut found = self.found.borrow_mut();
        let mut told = BTreeSet::new();
        let late = found.split_off(from);
        let late = late.into_iter();
        found.extend(late.filter(|d| told.insert(d.message.clone())));
    }

    /// Shows names as `shown` has them. Of the errors at one of these `places`, each with what it is, the first is left: what is wrong in a
    /// part is wrong in all its members.
    pub(crate) fn within(&self, shown: &BTreeMap<String, String>, places: &[(Loc, String)]) {
        let place = |l: &Loc| format!("{:?} {:?}", l.start, l.end);
        let places: BTreeMap<String, &str> = places
            .iter()
            .rev()
            .map(|(l, name)| (place(l), name.as_str()))
            .collect();
        let mut told = BTreeSet::new();
        self.found.borrow_mut().retain_mut(|d| {
            let Diagnostic { loc, message } = d;
            let mut text = String::new();
            for word in message.split_inclusive(|c: char| !(c.is_alphanumeric() || c == '_')) {
                let name = word.trim_end_matches(|c: char| !(c.is_alphanumeric() || c == '_'));
                text += shown.get(name).map_or(name, String::as_str);
                text += &word[name.len()..];
            }
            *message = text;
            let Some(part) = places.get(&place(loc)) else {
                return true;
            };
            let base = part.split('[').next().unwrap_or_default();
            if !message.contains(&format!("`{base}")) {
                *message = format!("in part `{base}`: {message}");
            }
            told.insert(place(loc))
        });
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.found.borrow().is_empty()
    }

    pub(crate) fn len(&self) -> usize {
        self.found.borrow().len()
    }

    /// All errors.
    #[cfg(test)]
    pub(crate) fn take(self) -> Vec<Diagnostic> {
        self.found.into_inner()
    }

    /// One `compile_error!` per error, spanning its range.
    pub(crate) fn to_tokens(&self) -> TokenStream {
        self.found.borrow().iter().flat_map(compile_error).collect()
    }
}

/// `::core::compile_error! { "message" }`, whose first and last token carry the range, which is how rustc finds it.
fn compile_error(diagnostic: &Diagnostic) -> TokenStream {
    let Loc { start, end } = diagnostic.loc;
    let at = |span: Span, mut tree: TokenTree| {
        tree.set_span(span);
        tree
    };
    let punct = |c, spacing| at(start, Punct::new(c, spacing).into());
    let literal = at(end, Literal::string(&diagnostic.message).into());
    let group = Group::new(Delimiter::Brace, literal.into());
    [
        punct(':', Spacing::Joint),
        punct(':', Spacing::Alone),
        Ident::new("core", start).into(),
        punct(':', Spacing::Joint),
        punct(':', Spacing::Alone),
        Ident::new("compile_error", start).into(),
        punct('!', Spacing::Alone),
        at(end, group.into()),
    ]
    .into_iter()
    .collect()
}

/// The end of an error message about `name`: the nearest of `names`, if less than half of it differs, or one letter of two, case ignored;
/// else the `remedy`.
pub(crate) fn suggest<'a>(
    name: &str,
    names: impl IntoIterator<Item = &'a str>,
    remedy: &str,
) -> String {
    match nearest(name, names) {
        Some(n) => format!("; did you mean `{n}`?"),
        None => format!("; {remedy}"),
    }
}

/// The one of `names` that is most like `name`, if one is like it; two neighbours exchanged, or all letters in another order, are one
/// difference.
fn nearest<'a>(name: &str, names: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let sorted = |text: &str| {
        let mut letters: Vec<char> = text.to_lowercase().chars().collect();
        letters.sort_unstable();
        letters
    };
    let distance = |n: &str| match strsim::osa_distance(&name.to_lowercase(), &n.to_lowercase()) {
        2.. if sorted(name) == sorted(n) => 1,
        distance => distance,
    };
    let names: Vec<&str> = names.into_iter().collect();
    let (d, n) = names.iter().map(|n| (distance(n), *n)).min()?;
    let length = n.chars().count().max(name.chars().count());
    let alike = 2 * d < length || d == 1 && length == 2;
    // `cosine` is more than `cos`.
    let shorter = names
        .into_iter()
        .filter(|n| n.len() > 2 && name.starts_with(n));
    alike.then_some(n).or(shorter.max_by_key(|n| n.len()))
}
