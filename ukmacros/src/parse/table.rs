//! Declarations that others are made of, on their way: a macro sees its own input only, so the declaration of a part is asked for by a
//! macro of the part's name, which calls this one again with the part's tokens before those of the declaration:
//! `@parts [{path} {tokens} {parts of the part} …] declaration`. Tokens in which there is an error, which is told, begin with `!`; a
//! declaration that is no part hands on a `?` alone.

use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// A declaration, as `path` names it.
#[derive(Clone)]
pub(crate) struct Known {
    path: String,
    /// Whether the declaration is a part.
    pub(crate) is_part: bool,
    /// Whether there is an error in the declaration, which is told.
    pub(crate) faulty: bool,
    pub(crate) declaration: TokenStream,
    /// The declarations that it is made of.
    pub(crate) parts: TokenStream,
}

/// The declarations that are known so far.
#[derive(Clone, Default)]
pub(crate) struct Table {
    known: Vec<Known>,
    /// The tokens as they came.
    pub(crate) tokens: TokenStream,
}

/// The text of a path, without the spaces that depend on its way here.
fn text(path: &TokenStream) -> String {
    path.to_string().split_whitespace().collect()
}

impl Table {
    /// A table from the tokens between its brackets.
    pub(crate) fn parse(tokens: TokenStream) -> Self {
        let groups = tokens.clone().into_iter().filter_map(|tree| match tree {
            TokenTree::Group(group) => Some(group.stream()),
            _ => None,
        });
        let groups: Vec<TokenStream> = groups.collect();
        let known = groups.chunks_exact(3).map(|three| {
            let mut declaration = three[1].clone().into_iter().peekable();
            let mut marked = |sign: char| {
                let mark =
                    |tree: &TokenTree| matches!(tree, TokenTree::Punct(p) if p.as_char() == sign);
                declaration.next_if(mark).is_some()
            };
            Known {
                path: text(&three[0]),
                is_part: !marked('?'),
                faulty: marked('!'),
                declaration: declaration.collect(),
                parts: three[2].clone(),
            }
        });
        Table {
            known: known.collect(),
            tokens,
        }
    }

    /// The declaration that `path` names, if it is known.
    pub(crate) fn find(&self, path: &TokenStream) -> Option<&Known> {
        let path = text(path);
        self.known.iter().find(|known| known.path == path)
    }
}

/// The table before a declaration, and the declaration.
pub(crate) fn split(tokens: TokenStream) -> (Table, TokenStream) {
    let mut rest = tokens.clone().into_iter();
    let head = [rest.next(), rest.next(), rest.next()];
    match head {
        [
            Some(TokenTree::Punct(at)),
            Some(TokenTree::Ident(word)),
            Some(TokenTree::Group(table)),
        ] if at.as_char() == '@' && word == "parts" && table.delimiter() == Delimiter::Bracket => {
            (Table::parse(table.stream()), rest.collect())
        }
        _ => (Table::default(), tokens),
    }
}
