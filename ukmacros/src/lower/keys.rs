//! What a key names: members of families, and coordinates of the declaration, of bodies, of joints and of parts.

use super::Lowering;
use super::array::describe;
use super::bodies::FIELDS;
use crate::diag::suggest;
use crate::model::{Family, Field, Name, Scope, block};
use crate::parse::{Expr, ExprKind, Key};
use proc_macro2::Ident;
use std::borrow::Cow;
use ukalgebra::expr::indexed;

impl<'m> Lowering<'m> {
    /// Positions of the members of a family that `indices` choose, and the shape of what they make up.
    pub(super) fn member(
        &mut self,
        name: &Ident,
        indices: &[Expr],
        family: &'m Family,
        scope: &Scope<'m>,
    ) -> Option<(&'m [usize], &'m [usize])> {
        let shape = &family.shape;
        if let Some(surplus) = indices.get(shape.len()) {
            if self.is_damaged(name) {
                // Reported already.
                return None;
            }
            let message = match shape.len() {
                0 => format!("`{name}` is not a family; write it without an index"),
                1 => format!("members of `{name}` are numbers: they take one index"),
                n => format!("members of `{name}` are numbers: they take {n} indices"),
            };
            self.diag.error(surplus.loc, message);
            return None;
        }
        let chosen = self.indices(indices, scope)?;
        match block(shape, &chosen) {
            Ok(range) => Some((&family.members[range], &shape[chosen.len()..])),
            Err(wrong) => {
                let (count, members) = (family.members.len(), range_of(name, shape));
                let message = format!(
                    "index {} is out of range: `{name}` has {count} members, {members}",
                    chosen[wrong]
                );
                self.diag.error(indices[wrong].loc, message);
                None
            }
        }
    }

    /// Whether `name` is a parameter whose default is an error that is reported.
    fn is_damaged(&self, name: &Ident) -> bool {
        let Some(Name::Param(at)) = self.model.names.get(&name.to_string()) else {
            return false;
        };
        let mut members = self.model.params[*at].members.iter();
        let default = |i: &usize| self.model.param_elements[*i].default.as_ref();
        members.any(|i| default(i).is_some_and(|d| matches!(d.value.kind, ExprKind::Error)))
    }

    /// The name of a unit, where `index` is a constant that is called so.
    pub(super) fn hidden_unit<'e>(&self, index: &'e Expr, scope: &Scope<'m>) -> Option<&'e Ident> {
        let ExprKind::Name(name) = &index.kind else {
            return None;
        };
        let text = name.to_string();
        let hides = scope
            .variables
            .iter()
            .all(|(variable, _)| *variable != text)
            && self.model.integers.contains_key(&text)
            && ukunits::is_known(&text);
        hides.then_some(name)
    }

    /// Positions in q of the coordinates that `key` names, and the shape of what they make up.
    pub(super) fn coordinates(
        &mut self,
        key: &Key,
        scope: &Scope<'m>,
    ) -> Option<(&'m [usize], &'m [usize])> {
        let key = &*self.within(key, scope)?;
        let name = key.name.to_string();
        let family = match self.model.names.get(&name) {
            Some(Name::Coord(family)) => Some(*family),
            Some(Name::Body(_) | Name::Joint) => return self.of_owner(key, scope),
            _ => None,
        };
        let Some(family) = family else {
            // Once for all its uses.
            if !self.unknown.insert(name.clone()) {
                return None;
            }
            let coords = self.model.coords.iter().take(self.model.plain);
            let coords: Vec<String> = coords.map(|f| f.name.to_string()).collect();
            let remedy = match coords.len() {
                0 => "those of bodies are written `link.x`".to_owned(),
                1..=8 => format!("coordinates are `{}`", coords.join("`, `")),
                _ => "declare it under `coords`".to_owned(),
            };
            let owner = (!key.fields.is_empty()).then(|| self.no_owner(&name));
            let message = owner.flatten().unwrap_or_else(|| {
                let end = suggest(&name, coords.iter().map(String::as_str), &remedy);
                format!("`{name}` is not a coordinate{end}")
            });
            self.diag.error(key.name.span(), message);
            return None;
        };
        if let Some((field, _)) = key.fields.first() {
            let message = "no fields here; a coordinate is written by its name alone, such as `x`";
            self.diag.error(field.span(), message);
            return None;
        }
        let family = &self.model.coords[family];
        self.member(&key.name, &key.indices, family, scope)
    }

    /// `key` by the name that what it says has in the whole, where it is of a part.
    pub(super) fn within<'k>(&mut self, key: &'k Key, scope: &Scope<'m>) -> Option<Cow<'k, Key>> {
        let name = key.name.to_string();
        if !matches!(self.model.names.get(&name), Some(Name::Part)) {
            return Some(Cow::Borrowed(key));
        }
        let mut segments = vec![(key.name.clone(), key.indices.clone())];
        segments.extend(key.fields.iter().cloned());
        let found = scope.in_part(&segments, self.diag)?.ok()?;
        let key = Key {
            name: found.name,
            indices: found.indices,
            fields: segments.split_off(found.used),
            measure: None,
            loc: key.loc,
        };
        let whole = self.within(&key, scope)?.into_owned();
        Some(Cow::Owned(whole))
    }

    /// Positions in q of the coordinates of bodies, or of joints of the tree, that `key` names.
    pub(super) fn of_owner(
        &mut self,
        key: &Key,
        scope: &Scope<'m>,
    ) -> Option<(&'m [usize], &'m [usize])> {
        let (model, name) = (self.model, key.name.to_string());
        let body = match model.names.get(&name) {
            Some(Name::Body(family)) => Some(model.body_kinds[*family].coordinates()),
            _ => None,
        };
        let what = if body.is_some() { "body" } else { "joint" };
        let Some((field, behind)) = key.fields.first() else {
            let message = format!("`{name}` is a {what}; {}", self.its_coordinates(&name));
            self.diag.error(key.loc, message);
            return None;
        };
        let surplus = behind.first().map(|index| index.loc);
        let surplus = surplus.or(key.fields.get(1).map(|(name, _)| name.span().into()));
        if let Some(loc) = surplus {
            let choice = match field.to_string().as_str() {
                "centre" => format!("; {}", self.its_coordinates(&name)),
                _ => String::new(),
            };
            let message = match body {
                Some(_) if FIELDS.iter().any(|known| field == known) => {
                    format!("a start gives a vector as a whole: `{name}.{field} = […]`{choice}")
                }
                _ => "a coordinate is a number, and nothing follows it; indices stand behind the body or joint".to_owned(),
            };
            self.diag.error(loc, message);
            return None;
        }
        let text = field.to_string();
        let fields = model.fields.get(&name);
        match fields.and_then(|fields| fields.get(text.as_str())) {
            Some(Field::Family(family)) => {
                let chosen = self.indices(&key.indices, scope)?;
                let family = &model.coords[*family];
                let shown = indexed(model.shown(&name), &chosen);
                let owners = model.joints.iter().map(|joint| &joint.name);
                let bodies = model.body_elements.iter().map(|body| &body.name);
                let whole = family.shape.len() == chosen.len();
                if whole
                    && block(&family.shape, &chosen).is_err()
                    && owners.chain(bodies).any(|owner| *owner == shown)
                {
                    let message = format!("`{shown}` has no coordinate `{text}`");
                    self.diag.error(key.loc, message);
                    return None;
                }
                self.member(&key.name, &key.indices, family, scope)
            }
            Some(Field::Scattered(families)) => {
                let chosen = self.indices(&key.indices, scope)?;
                let places: Option<Vec<usize>> =
                    chosen.iter().map(|i| usize::try_from(*i).ok()).collect();
                let family = places.and_then(|places| families.get(&places));
                if family.is_none() {
                    let shown = indexed(&name, &chosen);
                    let message = format!("`{shown}` has no coordinate `{text}`");
                    self.diag.error(key.loc, message);
                }
                let family = &model.coords[*family?];
                Some((&family.members[..], &family.shape[..]))
            }
            None => {
                let message = self.no_coordinate(&name, field, body);
                self.diag.error(field.span(), message);
                None
            }
        }
    }

    /// Why joints called `name`, or bodies, which may have some coordinates, have none that is called `field`.
    fn no_coordinate(&self, name: &str, field: &Ident, body: Option<&[&'static str]>) -> String {
        let text = field.to_string();
        if body.is_some_and(|names| names.contains(&text.as_str())) {
            return format!(
                "`{name}` hangs on a joint of the tree: its coordinates are those of the joint{}; what acts on it goes under `forces` or `nonideal`",
                self.carrying(name)
            );
        }
        let names = body.into_iter().flatten().copied();
        let fields = self.model.fields.get(name).into_iter();
        let names = names.chain(fields.flat_map(|fields| fields.keys().copied()));
        let remedy = match body {
            Some(_) if FIELDS.contains(&text.as_str()) => format!(
                "what acts on it is written `force({name}.at(p), F)` or `torque({name}, M)`, under `forces` or `nonideal`"
            ),
            Some(names) => format!("they are `{}`", names.join("`, `")),
            None => self.its_coordinates(name),
        };
        let end = suggest(&text, names, &remedy);
        let what = if body.is_some() { "body" } else { "joint" };
        format!("{what} `{name}` has no coordinate `{text}`{end}")
    }

    /// The coordinates of the joint that the bodies called `name` hang on, as written, if all hang on joints of one name.
    pub(super) fn carrying(&self, name: &str) -> String {
        let model = self.model;
        let Some(Name::Body(family)) = model.names.get(name) else {
            return String::new();
        };
        let members = model.bodies[*family].members.iter();
        let joints = members.map(|at| model.hung[*at].map(|joint| &model.joints[joint]));
        let joints: Option<Vec<_>> = joints.collect();
        match joints.as_deref() {
            Some([first, rest @ ..]) if rest.iter().all(|joint| joint.key == first.key) => {
                let index = if first.indices.is_empty() { "" } else { "[i]" };
                let names = first.kind.coordinates.iter();
                let names = names.map(|name| format!(", `{}{index}.{name}`", first.key));
                names.collect()
            }
            _ => String::new(),
        }
    }

    /// What coordinates the bodies or joints called `name` have, in words.
    pub(super) fn its_coordinates(&self, name: &str) -> String {
        match (self.model.fields.get(name), self.model.names.get(name)) {
            (Some(fields), Some(Name::Joint)) => {
                let names = fields.keys().map(|field| format!("`{name}.{field}`"));
                format!(
                    "its coordinates are {}",
                    names.collect::<Vec<_>>().join(", ")
                )
            }
            (Some(_), Some(Name::Body(family))) => {
                let names = self.model.body_kinds[*family].coordinates().join("`, `");
                format!("choose a coordinate of it: `{names}`")
            }
            (_, Some(Name::Joint)) => "it has no coordinates".to_owned(),
            _ => "its coordinates are those of the joint that it hangs on".to_owned(),
        }
    }

    /// Position in q of the coordinate that `key` names.
    pub(super) fn coordinate(&mut self, key: &Key, scope: &Scope<'m>) -> Option<usize> {
        match self.coordinates(key, scope)? {
            ([position], []) => Some(*position),
            (_, shape) => {
                let message = self.choose_a_member(key, shape);
                self.diag.error(key.loc, message);
                None
            }
        }
    }

    /// The message about a family that stands where a number is needed; `shape` is what is left of it.
    pub(super) fn choose_a_member(&self, key: &Key, shape: &[usize]) -> String {
        let name = &key.name;
        let members = match self.model.names.get(&name.to_string()) {
            Some(Name::Coord(f)) => range_of(name, &self.model.coords[*f].shape),
            _ => String::new(),
        };
        let whole = describe(shape);
        format!("`{name}` is a family; choose a member, {members}, or give {whole}")
    }
}

/// `x[0]` to `x[2]`: the members of a family of this shape.
pub(super) fn range_of(name: &Ident, shape: &[usize]) -> String {
    let last: Vec<usize> = shape.iter().map(|size| size - 1).collect();
    let first = indexed(name, &vec![0; shape.len()]);
    format!("`{first}` to `{}`", indexed(name, &last))
}
