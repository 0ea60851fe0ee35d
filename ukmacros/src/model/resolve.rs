//! Integer constants, families, loops; duplicates and reserved names.

use super::scope::{MAX_MEMBERS, Scope, index_functions};
use super::sizes;
use super::tree;
use super::types::{
    BodyKind, Element, Family, Field, Integer, Model, Name, Preset, every, unit_of,
};
use crate::diag::{Diagnostics, Loc};
use crate::parse::{Block, Declaration, Expr, Key, Measure};
use proc_macro2::Ident;
use std::collections::{HashMap, HashSet};
use std::rc::Rc;
use ukalgebra::expr::indexed;
use ukunits::Unit;

/// Names with a fixed meaning, beside those of functions.
const RESERVED: [&str; 15] = [
    "t", "PI", "dot", "ddot", "sum", "sq", "signum", "powi", "recip", "self", "Self", "super",
    "crate", "gen", "_",
];

/// Columns of every run beside coordinates, velocities and outputs.
const COLUMNS: [&str; 3] = ["t", "energy", "residual"];

/// A model with the constants of `decl` alone.
fn constants(
    decl: &Declaration,
    functions: impl Iterator<Item = &'static str>,
    diag: &Diagnostics,
) -> Model {
    let mut model = Model {
        index_functions: index_functions(decl),
        units: decl.units,
        reserved: functions.chain(RESERVED).collect(),
        ..Model::default()
    };
    for constant in &decl.consts {
        let name = constant.name.to_string();
        let meaning = if constant.integer {
            let scope = Scope::new(&model);
            let value = scope.integer(&constant.value, diag);
            let value = value.filter(|v| {
                let fits = *v >= 0;
                if !fits {
                    diag.error(
                        constant.value.loc,
                        format!("`{name}` is a `usize`, which cannot be negative"),
                    );
                }
                fits
            });
            let integer = Integer {
                docs: constant.docs.clone(),
                name: constant.name.clone(),
                loc: constant.value.loc,
                value,
            };
            model.integers.entry(name).or_insert(integer);
            Name::Integer
        } else {
            Name::Float(model.floats.len())
        };
        declare(&constant.name, meaning, &mut model, diag);
        if !constant.integer {
            model.floats.push(constant.clone());
        }
    }
    model
}

/// Resolves constants alone, without names that are reserved, for what is evaluated before all names are known.
pub(super) fn bare(decl: &Declaration, diag: &Diagnostics) -> Model {
    constants(decl, std::iter::empty(), diag)
}

/// Resolves constants, parameters and coordinates. `functions` are the names of functions.
pub(crate) fn resolve(
    decl: &mut Declaration,
    functions: impl Iterator<Item = &'static str>,
    diag: &Diagnostics,
) -> Model {
    let mut model = constants(decl, functions, diag);
    parts(decl, &mut model, diag);
    members(&decl.params, Kind::Param, &mut model, diag, |param| {
        (&param.key, &param.docs, Some(&param.value))
    });
    members(&decl.coords, Kind::Coord, &mut model, diag, |coord| {
        (&coord.key, &coord.docs, None)
    });
    sizes::refuse(decl, &model, diag);
    let before = diag.len();
    members(&decl.bodies, Kind::Body, &mut model, diag, |body| {
        (&body.key, &body.docs, None)
    });
    model.lost = lost(decl, &model, diag);
    bodies(decl, &mut model, diag, before);
    model.lost = lost(decl, &model, diag);
    if model.coord_elements.is_empty() && diag.is_empty() {
        diag.error(
            decl.name.span(),
            format!(
                "`{}` has no coordinates; add `coords {{ x, y }}`",
                decl.name
            ),
        );
    }
    model
}

/// What is declared and not entered, which is so because of an error.
fn lost(decl: &Declaration, model: &Model, diag: &Diagnostics) -> HashSet<String> {
    let mut names = HashSet::new();
    if diag.is_empty() {
        return names;
    }
    let mut enter = |key: &Key| names.extend([key.name.to_string()]);
    let entries = decl.params.iter().chain(&decl.tree);
    entries.for_each(|block| block.each(&mut |entry| enter(&entry.key)));
    let coords = decl.coords.iter();
    coords.for_each(|block| block.each(&mut |coord| enter(&coord.key)));
    let bodies = decl.bodies.iter();
    bodies.for_each(|block| block.each(&mut |body| enter(&body.key)));
    names.retain(|name| !model.names.contains_key(name));
    names
}

/// Enters the names of parts.
fn parts(decl: &mut Declaration, model: &mut Model, diag: &Diagnostics) {
    model.shown = std::mem::take(&mut decl.merged.shown);
    model.part_families = std::mem::take(&mut decl.merged.families);
    let places = &decl.merged.places;
    for name in model.part_families.keys().cloned().collect::<Vec<_>>() {
        let place = places.iter().find(|(_, shown)| {
            let base = shown.split('[').next().unwrap_or_default();
            base == name
        });
        let span = place.map_or(decl.name.span(), |(loc, _)| loc.start);
        declare(&Ident::new(&name, span), Name::Part, model, diag);
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Param,
    Coord,
    Body,
}

/// The unit of a coordinate, which equations have in kg, m, s and rad.
fn coherent(measure: &Measure, diag: &Diagnostics) -> Option<Unit> {
    if !measure.unit.is_coherent() {
        let message = format!(
            "equations have coordinates in SI units: write `[{}]`; an output may be in `[{}]`",
            measure.unit.si(),
            measure.unit
        );
        diag.error(measure.loc, message);
        return None;
    }
    Some(measure.unit.clone())
}

/// A member found while unrolling.
struct Found {
    name: Ident,
    docs: Vec<String>,
    indices: Vec<usize>,
    loc: Loc,
    default: Option<Rc<Preset>>,
    unit: Option<Unit>,
}

/// Enters parameters, coordinates or bodies: `x[N]` outside of a loop is a family of N; `x[i]` inside of one is its member i. Of an entry
/// `said` is its key, what documents it and its default.
fn members<T>(
    blocks: &[Block<T>],
    kind: Kind,
    model: &mut Model,
    diag: &Diagnostics,
    said: impl Fn(&T) -> (&Key, &Vec<String>, Option<&Expr>),
) {
    for block in blocks {
        let mut found = Vec::new();
        let looped = matches!(block, Block::For { .. });
        Scope::new(model).unroll(std::slice::from_ref(block), diag, &mut |item, scope| {
            let (key, docs, default) = said(item);
            let unit = key.measure.as_ref().and_then(|m| coherent(m, diag));
            let Some(sizes) = sizes(key, looped, scope, diag) else {
                return;
            };
            let shape = if looped { Vec::new() } else { sizes.clone() };
            let default = default.map(|value| {
                Rc::new(Preset {
                    value: value.clone(),
                    variables: scope.variables.clone(),
                    shape: shape.clone(),
                })
            });
            let member = |indices| Found {
                name: key.name.clone(),
                docs: docs.clone(),
                indices,
                loc: key.loc,
                default: default.clone(),
                unit: unit.clone(),
            };
            match looped {
                true => found.push(member(sizes)),
                false => found.extend(every(&shape).map(member)),
            }
        });
        // Of a family whose name is refused no other member is told of.
        let mut refused = Vec::new();
        for member in found {
            let name = member.name.to_string();
            if !refused.contains(&name) && !add(member, kind, model, diag) {
                refused.push(name);
            }
        }
    }
    let (families, elements) = model.lists(kind);
    for family in families {
        let places: usize = family.shape.iter().product();
        if let Some(last) = family
            .members
            .last()
            .filter(|_| family.members.len() < places)
        {
            let end = family.shape.iter().map(|size| size - 1);
            let end = indexed(&family.name, &end.collect::<Vec<_>>());
            let (name, last) = (&family.name, &elements[*last].name);
            let message = format!(
                "`{name}` ends at `{last}`, before `{end}`: rows of a family have one length"
            );
            diag.error(name.span(), message);
            // Every place has a member all the same, so that other messages stay right.
            family.members.resize(places, family.members[0]);
        }
    }
}

/// The sizes of a family that `key` declares; inside a loop, the indices of its member.
fn sizes(key: &Key, looped: bool, scope: &Scope<'_>, diag: &Diagnostics) -> Option<Vec<usize>> {
    let mut sizes = Vec::new();
    let mut count: i64 = 1;
    for index in &key.indices {
        let n = scope.integer(index, diag)?;
        if !looped && n > 0 {
            count = count.saturating_mul(n);
        }
        match usize::try_from(n) {
            Ok(i) if looped || (i > 0 && count <= MAX_MEMBERS) => sizes.push(i),
            Ok(1..) => {
                scope.too_large(&key.indices.iter().collect::<Vec<_>>(), diag);
                return None;
            }
            _ => {
                let message = format!("a family needs at least 1 member, not {n}");
                diag.error(index.loc, message);
                return None;
            }
        }
    }
    Some(sizes)
}

impl Family {
    /// Takes the member `next` into the shape, if it follows the member `last`, the last index running fastest and rows having one length.
    fn extend(&mut self, last: &[usize], next: &[usize]) -> bool {
        let parting = last.iter().zip(next).position(|(a, b)| a != b);
        let Some(d) = parting.filter(|_| last.len() == next.len()) else {
            return false;
        };
        // Once an outer index has moved on, sizes of the inner ones are known.
        let known = last[..d].iter().any(|i| *i > 0);
        let steps = next[d] == last[d] + 1 && next[d + 1..].iter().all(|i| *i == 0);
        let inside = !known || next[d] < self.shape[d];
        let full = (d + 1..last.len()).all(|e| last[e] + 1 == self.shape[e]);
        let follows = steps && inside && full;
        if follows {
            self.shape[d] = self.shape[d].max(next[d] + 1);
        }
        follows
    }
}

/// Enters a member, and its family with the first; whether that is so.
fn add(found: Found, kind: Kind, model: &mut Model, diag: &Diagnostics) -> bool {
    let text = found.name.to_string();
    if kind == Kind::Body && text == "ground" {
        let message = "the ground is there already, and does not move; give the body another name";
        diag.error(found.loc, message);
        return false;
    }
    let known = match (model.names.get(&text), kind) {
        (Some(Name::Param(f)), Kind::Param)
        | (Some(Name::Coord(f)), Kind::Coord)
        | (Some(Name::Body(f)), Kind::Body) => Some(*f),
        _ => None,
    };
    let (families, elements) = model.lists(kind);
    let count = families.len();
    let existing = known.filter(|f| {
        let last = families[*f].members.last().map(|at| &elements[*at].indices);
        last.is_some_and(|last| families[*f].extend(last, &found.indices))
    });
    let family = existing.unwrap_or(count);
    if existing.is_none() {
        if found.indices.iter().any(|i| *i != 0) {
            let first = indexed(&text, &vec![0; found.indices.len()]);
            diag.error(
                found.loc,
                format!("members of `{text}` must be declared in order from `{first}`, each once"),
            );
            return false;
        }
        let meaning = match kind {
            Kind::Param => Name::Param(family),
            Kind::Coord => Name::Coord(family),
            Kind::Body => Name::Body(family),
        };
        if !declare(&found.name, meaning, model, diag) {
            return false;
        }
        // It is declared all the same: what uses it is right.
        if kind == Kind::Coord
            && let Err(reason) = model.column(&found.name)
        {
            diag.error(found.name.span(), reason);
        }
    }
    let (families, elements) = model.lists(kind);
    if existing.is_none() {
        families.push(Family {
            name: found.name,
            docs: found.docs,
            shape: vec![1; found.indices.len()],
            members: Vec::new(),
        });
    }
    let position = elements.len();
    families[family].members.push(position);
    let name = indexed(model.shown(&text), &found.indices);
    let (_, elements) = model.lists(kind);
    elements.push(Element {
        name,
        family,
        indices: found.indices,
        default: found.default,
        unit: found.unit,
    });
    true
}

/// Enters the bodies and the joints of the tree with their coordinates. There were `before` errors before bodies were read.
fn bodies(decl: &Declaration, model: &mut Model, diag: &Diagnostics, before: usize) {
    let mut kinds: HashMap<String, bool> = HashMap::new();
    for block in &decl.bodies {
        block.each(&mut |body| {
            let name = &body.key.name;
            if *kinds.entry(name.to_string()).or_insert(body.spatial) != body.spatial
                && diag.len() == before
            {
                let message = format!("`{name}` is declared planar and spatial; rename one");
                diag.error(name.span(), message);
            }
        });
    }
    for family in &model.bodies {
        let spatial = kinds[&family.name.to_string()];
        model.body_kinds.push(BodyKind { spatial });
    }
    model.plain = model.coords.len();
    model.hung = vec![None; model.body_elements.len()];
    model.own = vec![None; model.body_elements.len()];
    tree::joints(decl, model, diag);
    for (f, kind) in model.body_kinds.clone().into_iter().enumerate() {
        let family = &model.bodies[f];
        let free = family.members.iter().copied();
        let free: Vec<usize> = free.filter(|at| model.hung[*at].is_none()).collect();
        let owners = free.iter().map(|at| Owner {
            name: model.body_elements[*at].name.clone(),
            indices: model.body_elements[*at].indices.clone(),
            coordinates: kind.coordinates(),
        });
        let owners: Vec<Owner> = owners.collect();
        let (name, docs) = (family.name.clone(), family.docs.clone());
        let whole = (free.len() == family.members.len()).then(|| family.shape.clone());
        let places = coordinates(&name, &docs, &owners, whole, model);
        for (at, place) in free.into_iter().zip(places) {
            model.own[at] = Some(place);
        }
    }
    let mut entered: Vec<bool> = vec![false; model.joints.len()];
    for first in 0..model.joints.len() {
        if entered[first] {
            continue;
        }
        let key = model.joints[first].key.clone();
        let same: Vec<usize> = (first..entered.len())
            .filter(|at| model.joints[*at].key == key)
            .collect();
        let owners = same.iter().map(|at| Owner {
            name: model.joints[*at].name.clone(),
            indices: model.joints[*at].indices.clone(),
            coordinates: model.joints[*at].kind.coordinates,
        });
        let docs = model.joints[first].docs.clone();
        let places = coordinates(&key, &docs, &owners.collect::<Vec<_>>(), None, model);
        for (at, place) in same.into_iter().zip(places) {
            entered[at] = true;
            model.joints[at].first = place;
        }
    }
}

/// A body or a joint, of which coordinates are.
struct Owner {
    name: String,
    indices: Vec<usize>,
    coordinates: &'static [&'static str],
}

/// Enters the coordinates of all owners called `base`, those of one after those of another; returns the position of each one's first.
/// They are `whole` where they are all that an array of this shape has.
fn coordinates(
    base: &Ident,
    docs: &[String],
    owners: &[Owner],
    whole: Option<Vec<usize>>,
    model: &mut Model,
) -> Vec<usize> {
    let mut names: Vec<&'static str> = Vec::new();
    for name in owners.iter().flat_map(|owner| owner.coordinates) {
        if !names.contains(name) {
            names.push(name);
        }
    }
    for name in &names {
        let with = owners
            .iter()
            .filter(|owner| owner.coordinates.contains(name));
        let all: Vec<&Vec<usize>> = with.map(|owner| &owner.indices).collect();
        let mut enter = |name: String, shape: Vec<usize>| {
            let members = vec![0; shape.iter().product()];
            let (name, docs) = (Ident::new(&name, base.span()), docs.to_vec());
            model.coords.push(Family {
                name,
                docs,
                shape,
                members,
            });
            model.coords.len() - 1
        };
        let field = match whole.clone().or_else(|| shape(&all)) {
            Some(shape) => Field::Family(enter(format!("{base}_{name}"), shape)),
            None => Field::Scattered(
                all.into_iter()
                    .map(|indices| {
                        let indices_text: String =
                            indices.iter().map(|i| format!("_{i}")).collect();
                        (
                            indices.clone(),
                            enter(format!("{base}{indices_text}_{name}"), Vec::new()),
                        )
                    })
                    .collect(),
            ),
        };
        model
            .fields
            .entry(base.to_string())
            .or_default()
            .insert(name, field);
    }
    let mut places = Vec::new();
    for owner in owners {
        places.push(model.coord_elements.len());
        for name in owner.coordinates {
            let position = model.coord_elements.len();
            let (family, indices) = match &model.fields[&base.to_string()][name] {
                Field::Family(family) => (*family, owner.indices.clone()),
                Field::Scattered(families) => (families[&owner.indices], Vec::new()),
            };
            let element = Element {
                name: format!("{}.{name}", owner.name),
                family,
                indices,
                default: None,
                unit: unit_of(name).filter(|_| model.units),
            };
            let of_family = &mut model.coords[family];
            let place = element.place(&of_family.shape);
            of_family.members[place] = position;
            model.coord_elements.push(element);
        }
    }
    places
}

/// The shape of an array that has these places, each once.
fn shape(places: &[&Vec<usize>]) -> Option<Vec<usize>> {
    let depth = places.first()?.len();
    let sizes = (0..depth).map(|d| places.iter().map(|p| p[d] + 1).max().unwrap_or(0));
    let shape: Vec<usize> = sizes.collect();
    let distinct: HashSet<&&Vec<usize>> = places.iter().collect();
    let size = shape
        .iter()
        .try_fold(1, |size: usize, n| size.checked_mul(*n));
    (distinct.len() == places.len() && size == Some(places.len())).then_some(shape)
}

/// Enters a name; reports and returns false if it is taken.
fn declare(name: &Ident, meaning: Name, model: &mut Model, diag: &Diagnostics) -> bool {
    if let Err(message) = model.free(name) {
        diag.error(name.span(), message);
        return false;
    }
    model.names.insert(name.to_string(), meaning);
    true
}

impl Model {
    /// Families of this kind, and their members.
    fn lists(&mut self, kind: Kind) -> (&mut Vec<Family>, &mut Vec<Element>) {
        match kind {
            Kind::Param => (&mut self.params, &mut self.param_elements),
            Kind::Coord => (&mut self.coords, &mut self.coord_elements),
            Kind::Body => (&mut self.bodies, &mut self.body_elements),
        }
    }

    /// The positions in q of the first coordinates of all quaternions: of bodies, and of joints of the tree.
    pub(crate) fn quaternions(&self) -> impl Iterator<Item = usize> + use<'_> {
        let turned = self.owners().into_iter().filter(|body| body.turns() == 4);
        turned.map(|body| body.first + body.lengths())
    }

    /// How the `name` is shown.
    pub(crate) fn shown<'a>(&'a self, name: &'a str) -> &'a str {
        self.shown.get(name).map_or(name, String::as_str)
    }

    /// Whether `name` may still be declared; the reason if not.
    pub(crate) fn free(&self, name: &Ident) -> Result<(), String> {
        let text = self.unreserved(name)?;
        if self.names.contains_key(&text) {
            return Err(format!("`{text}` is declared twice; names must be unique"));
        }
        Ok(())
    }

    /// The text of a name that has no fixed meaning.
    fn unreserved(&self, name: &Ident) -> Result<String, String> {
        let text = name.to_string();
        match self.reserved.contains(&text.as_str()) || text.starts_with("r#") {
            true => Err(format!("`{text}` is reserved; choose another name")),
            false => Ok(text),
        }
    }

    /// Whether `name` may head a column of a run's table; the reason if not.
    pub(crate) fn column(&self, name: &Ident) -> Result<(), String> {
        let text = self.unreserved(name)?;
        if COLUMNS.contains(&text.as_str()) {
            return Err(format!(
                "`{text}` is a column of every run; choose another name"
            ));
        }
        Ok(())
    }
}
