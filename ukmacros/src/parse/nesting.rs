//! How deep a declaration is nested, found by counting tokens: parsing recurses, and must not begin what its stack cannot hold.

use proc_macro2::{Delimiter, Group, Span, TokenStream, TokenTree};

/// Deeper nesting is refused. Parsing takes some 10 kB of stack a level where it is not optimised; compilers have 8 MB, test threads 2.
const MAX_NESTING: usize = 100;

/// The place where `tokens` are nested too deeply, if they are.
pub(super) fn too_deep(tokens: &TokenStream) -> Option<Span> {
    level(tokens, 0)
}

/// `tokens` with the contents of its braces left out: the head of a declaration.
pub(super) fn head(tokens: TokenStream) -> TokenStream {
    tokens
        .into_iter()
        .map(|token| match token {
            TokenTree::Group(g) if g.delimiter() == Delimiter::Brace => {
                Group::new(Delimiter::Brace, TokenStream::new()).into()
            }
            other => other,
        })
        .collect()
}

/// What `syn` recurses on within one pair of delimiters. Operators between operands do not count: it reads them in a loop.
#[derive(Clone, Copy, Default)]
struct Open {
    /// Signs, methods, calls and indices: until the next operator.
    affixes: usize,
    /// `a = b = c`: until the next entry or comma.
    assignments: usize,
    /// Closures, generic arguments, keywords: until the next entry.
    rest: usize,
}

impl Open {
    fn sum(self) -> usize {
        self.affixes + self.assignments + self.rest
    }
}

/// Looks as [`too_deep`] does, at tokens inside of `depth` others.
fn level(tokens: &TokenStream, depth: usize) -> Option<Span> {
    let mut open = Open::default();
    // Whether the token before ends an operand, and whether it is the `#` of an attribute or the `'` of a lifetime.
    let (mut operand, mut prefix) = (false, false);
    for token in tokens.clone() {
        let before = std::mem::replace(&mut operand, true);
        let prefixed = std::mem::replace(&mut prefix, false);
        match &token {
            TokenTree::Ident(_) if prefixed => operand = false,
            TokenTree::Group(g) => {
                let inside = level(&g.stream(), depth + open.sum() + 1);
                if inside.is_some() {
                    return inside;
                }
                operand = !prefixed;
                open.affixes += usize::from(before);
            }
            TokenTree::Literal(_) if before => open = Open::default(),
            TokenTree::Literal(_) => {}
            TokenTree::Ident(name) => {
                let keyword = syn::parse2::<syn::Ident>(token.clone().into()).is_err();
                // No expression goes on with a name behind an operand: the next entry begins.
                if before && (!keyword || ["for", "let", "const"].iter().any(|k| name == k)) {
                    open = Open::default();
                }
                if name == "as" {
                    open.affixes += 1;
                } else {
                    open.rest += usize::from(keyword);
                }
                operand = !keyword;
            }
            TokenTree::Punct(p) => {
                operand = false;
                match p.as_char() {
                    '+' | '-' | '*' | '/' if before => open.affixes = 0,
                    ';' => open = Open::default(),
                    '#' => {
                        prefix = true;
                        if before {
                            open = Open::default();
                        }
                    }
                    ',' => (open.affixes, open.assignments) = (0, 0),
                    ':' => open.affixes = 0,
                    '=' => (open.affixes, open.assignments) = (0, open.assignments + 1),
                    '|' | '<' => open.rest += 1,
                    '\'' => prefix = true,
                    // The end of an operand.
                    '>' => operand = before,
                    _ => open.affixes += 1,
                }
            }
        }
        if depth + open.sum() > MAX_NESTING {
            return Some(token.span());
        }
    }
    None
}
