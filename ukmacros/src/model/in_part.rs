//! Names in parts, as `leg[2].foot[0].x`, and what they are called in the whole.

use super::scope::Scope;
use super::types::Name;
use crate::diag::{Diagnostics, suggest};
use crate::parse::Expr;
use proc_macro2::Ident;
use ukalgebra::expr::indexed;

/// What a name in a part is called in the whole.
pub(crate) struct InPart {
    pub(crate) name: Ident,
    pub(crate) indices: Vec<Expr>,
    /// How many names before it, and itself.
    pub(crate) used: usize,
}

/// An error that is reported.
pub(crate) struct Reported;

impl Scope<'_> {
    /// What a name in a part is called here, with its indices, and how many of the `segments` that takes: nothing where the first names no
    /// part, an error where they lead nowhere.
    pub(crate) fn in_part(
        &self,
        segments: &[(Ident, Vec<Expr>)],
        diag: &Diagnostics,
    ) -> Option<Result<InPart, Reported>> {
        let (first, _) = segments.first()?;
        let mut base = first.to_string();
        if !matches!(self.model.names.get(&base), Some(Name::Part)) {
            return None;
        }
        let mut shown = base.clone();
        // What names in the part begin with, that of the part itself first: of what all members have together their indices are left out.
        let mut prefixes = vec![String::new()];
        let with = |prefixes: &[String], own: &str, indices: &str| {
            let both = |before: &String| {
                [
                    format!("{before}{own}{indices}_"),
                    format!("{before}{own}_"),
                ]
            };
            prefixes.iter().flat_map(both).collect::<Vec<String>>()
        };
        let whole = self.model.shown(&base);
        let mut around: Vec<&str> = whole.split('.').collect();
        let mut own = around.pop().unwrap_or_default().to_owned();
        for part in around {
            let name = part.split('[').next().unwrap_or_default();
            let indices = part[name.len()..].replace('[', "_").replace(']', "");
            prefixes = with(&prefixes, name, &indices);
        }
        for (at, (name, indices)) in segments.iter().enumerate() {
            let members = self.model.part_families.get(&base)?;
            let chosen: Option<Vec<i64>> = indices.iter().map(|i| self.integer(i, diag)).collect();
            let Some(chosen) = chosen else {
                return Some(Err(Reported));
            };
            shown = indexed(shown, &chosen);
            if !members.contains(&chosen) {
                let of = members.iter().map(|member| indexed(&base, member));
                let of = of.take(4).collect::<Vec<_>>().join("`, `");
                let message = format!("there is no part `{shown}`; there are `{of}`");
                diag.error(name.span(), message);
                return Some(Err(Reported));
            }
            let member = chosen
                .iter()
                .fold(base.clone(), |name, i| format!("{name}_{i}"));
            let Some((next, further)) = segments.get(at + 1) else {
                let message =
                    format!("`{shown}` is a part; choose what belongs to it, `{shown}.name`");
                diag.error(name.span(), message);
                return Some(Err(Reported));
            };
            prefixes = with(&prefixes, &own, &member[base.len()..]);
            let full = format!("{member}_{next}");
            let known = |name: &String| self.model.shown.contains_key(name);
            if self.model.part_families.contains_key(&full) {
                shown = format!("{shown}.{next}");
                base = full;
                own = next.to_string();
                continue;
            }
            let mut names = prefixes.iter().map(|prefix| format!("{prefix}{next}"));
            let Some(found) = names.find(known) else {
                let names = self.model.shown.keys();
                let names = names.filter_map(|name| name.strip_prefix(&format!("{member}_")));
                let end = suggest(&next.to_string(), names, "see where it is declared");
                diag.error(next.span(), format!("part `{shown}` has no `{next}`{end}"));
                return Some(Err(Reported));
            };
            return Some(Ok(InPart {
                name: Ident::new(&found, next.span()),
                indices: further.clone(),
                used: at + 2,
            }));
        }
        None
    }

    /// The integer constant of a part that `e` names, `leg[0].N`; nothing where it names none.
    pub(super) fn constant_of_a_part(
        &self,
        e: &Expr,
        diag: &Diagnostics,
    ) -> Option<Result<Expr, Reported>> {
        let segments = e.segments()?;
        match self.in_part(&segments, diag)? {
            Err(reported) => Some(Err(reported)),
            Ok(found) => {
                let whole = found.used == segments.len() && found.indices.is_empty();
                let integer = self.model.integers.contains_key(&found.name.to_string());
                (whole && integer).then(|| Ok(Expr::name(found.name)))
            }
        }
    }
}
