//! Places in the text of a declaration.

use proc_macro2::Span;

/// The source range of something: its first and its last token (stable Rust cannot join spans).
#[derive(Clone, Copy, Debug)]
pub struct Loc {
    pub start: Span,
    pub end: Span,
}

impl From<Span> for Loc {
    fn from(span: Span) -> Self {
        Loc {
            start: span,
            end: span,
        }
    }
}

impl Loc {
    /// The range from the start of this to the end of `end`.
    pub fn to(self, end: Loc) -> Self {
        Loc {
            start: self.start,
            end: end.end,
        }
    }
}
