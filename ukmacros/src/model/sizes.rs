//! Units that may be meant as the sizes of families: `x[N]` with a parameter, or nothing, that is called `N`.

use super::types::{Model, Name};
use crate::diag::Diagnostics;
use crate::parse::{Block, Declaration, Key, Measure};
use std::collections::HashSet;

/// Refuses units that have no space before their brackets where the name in these is declared, or may be meant as a constant that is not
/// there: what is read as a coordinate in newtons would be one where many are meant.
pub(super) fn refuse(decl: &Declaration, model: &Model, diag: &Diagnostics) {
    let mut values = HashSet::new();
    for block in &decl.lets {
        block.each(&mut |binding| values.extend([binding.key.name.to_string()]));
    }
    let tell = |key: &Key, loose: bool| {
        let Some(Measure {
            size: Some(size),
            loc,
            ..
        }) = &key.measure
        else {
            return;
        };
        let what = match model.names.get(size) {
            Some(Name::Param(_)) => format!("`{size}` is a parameter"),
            Some(Name::Float(_)) => format!("`{size}` is an `f64`"),
            Some(_) => format!("`{size}` is declared as something else"),
            None if values.contains(size) => format!("`{size}` is a value"),
            None if loose && size.chars().all(char::is_uppercase) => {
                format!("no constant is called `{size}`")
            }
            None => return,
        };
        let message = format!(
            "{what}: the size of a family is a constant, `const {size}: usize = 3;`; a unit has a space before it, `{} [{size}]`",
            key.name
        );
        // What is said of its members follows from it.
        diag.damage(*loc, message);
    };
    let each = |blocks: &[Block<crate::parse::Entry>]| {
        let blocks = blocks.iter();
        blocks.for_each(|block| block.each(&mut |entry| tell(&entry.key, false)));
    };
    let coords = decl.coords.iter();
    // What is reported may well be a force.
    coords.for_each(|block| block.each(&mut |coord| tell(&coord.key, true)));
    each(&decl.outputs);
    each(&decl.integrals);
}
