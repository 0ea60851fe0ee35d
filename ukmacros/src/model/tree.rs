//! The tree: which bodies hang on which, by joints whose coordinates are theirs.

use super::elsewhere::elsewhere;
use super::in_part::InPart;
use super::scope::Scope;
use super::types::{Model, Name, TreeJoint, Variable, block};
use crate::diag::{Diagnostics, suggest};
use crate::parse::{Declaration, Expr, ExprKind};
use proc_macro2::Ident;
use std::collections::{HashMap, HashSet};
use ukalgebra::expr::indexed;

/// A step from the axes at the point of the first body to those of the second. Texts are expressions of the joint's arguments.
pub(crate) enum Step {
    /// A turn about this axis (in the plane about the only one) by the next coordinate.
    Turn(&'static str),
    /// A displacement along this direction by the next coordinate.
    Slide(&'static str),
    /// A displacement along this direction by the coordinate before, times this.
    Follow(&'static str, &'static str),
    /// A turn by this matrix, which does not change.
    Fix(&'static str),
    /// A turn about `u`, an axis of the first body, and `w`, that axis in the second one, by the next coordinate.
    Hinge,
    /// The turn of a unit quaternion, the next four coordinates.
    Ball,
}

const PLANE: bool = false;
const SPACE: bool = true;

macro_rules! tree_joints {
    ($($name:literal $space:ident [$($coordinate:literal),*] [$($step:expr),*];)*) => {
        static JOINTS: &[TreeJoint] = &[$(TreeJoint {
            name: $name,
            spatial: $space,
            coordinates: &[$($coordinate),*],
            steps: &[$($step),*],
        }),*];
    };
}

/// Axes of a universal joint: what of `w` is at right angles with `u`, which is its first axis; `u`; a normal of both.
const CROSS: &str = "transpose([normalise(w - inner(u, w) / sq(u) * u), normalise(u), \
    cross(normalise(w - inner(u, w) / sq(u) * u), normalise(u))])";
/// They in the second body, by rows: `w`, its second axis; what of `u` is at right angles with it; a normal of both.
const CROSSED: &str = "[normalise(w), normalise(u - inner(u, w) / sq(w) * w), cross(normalise(w), normalise(u - inner(u, w) / sq(w) * w))]";

tree_joints! {
    "pin" PLANE ["angle"] [Step::Turn("")];
    "weld" PLANE [] [Step::Fix("rot(angle)")];
    "slider" PLANE ["slide"] [Step::Slide("normalise(d)"), Step::Fix("rot(angle)")];
    "slot" PLANE ["slide", "angle"] [Step::Slide("normalise(d)"), Step::Turn("")];
    "ball" SPACE ["e0", "e1", "e2", "e3"] [Step::Ball];
    "hinge" SPACE ["angle"] [Step::Hinge];
    "universal" SPACE ["first", "second"] [Step::Fix(CROSS), Step::Turn("[0, 1, 0]"), Step::Turn("[1, 0, 0]"), Step::Fix(CROSSED)];
    "cylinder" SPACE ["slide", "angle"] [Step::Slide("normalise(u)"), Step::Hinge];
    "slider" SPACE ["slide"] [Step::Slide("normalise(u)"), Step::Fix("turn")];
    "weld" SPACE [] [Step::Fix("turn")];
    "screw" SPACE ["angle"] [Step::Turn("normalise(u)"), Step::Follow("normalise(u)", "lead / (2 * PI)")];
}

/// A joint of the tree.
pub(crate) struct Joint {
    /// The name as written: `elbow`, `knee[2]`.
    pub(crate) name: String,
    pub(crate) key: Ident,
    pub(super) docs: Vec<String>,
    pub(crate) indices: Vec<usize>,
    pub(crate) kind: &'static TreeJoint,
    /// The joint's function and arguments, the first two of which are points of bodies.
    pub(crate) call: Ident,
    pub(crate) args: Vec<Expr>,
    /// The loop variables that it was declared under.
    pub(crate) variables: Vec<Variable>,
    /// The body that carries it, by its place in [`Model::body_elements`]; nothing where that is the ground.
    pub(crate) parent: Option<usize>,
    /// The body that hangs on it; nothing where it is in error.
    child: Option<usize>,
    /// Position in q of its first coordinate.
    pub(crate) first: usize,
}

/// The joints as declared, with what they join.
fn declared(decl: &Declaration, model: &Model, diag: &Diagnostics) -> Vec<Joint> {
    let mut found: Vec<Joint> = Vec::new();
    Scope::new(model).unroll(&decl.tree, diag, &mut |joint, scope| {
        let indices = joint.key.indices.iter().map(|index| {
            let i = scope.integer(index, diag)?;
            let place = usize::try_from(i).ok();
            if place.is_none() {
                diag.error(index.loc, format!("an index must not be negative, as {i} is"));
            }
            place
        });
        let Some(indices) = indices.collect::<Option<Vec<usize>>>() else {
            return;
        };
        let Some((kind, call, args)) = kind(&joint.value, diag) else {
            return;
        };
        let ends = (end(&args[0], scope, model, diag), end(&args[1], scope, model, diag));
        let (parent, child) = (ends.0.flatten(), ends.1.flatten());
        if ends.1 == Some(None) {
            let message = "the second body of a joint of the tree hangs on it, which the ground does not; name the ground first";
            diag.error(args[1].loc, message);
        }
        let spatial = |body: usize| model.body_kinds[model.body_elements[body].family].spatial;
        let home = child.map_or(kind[0].spatial, spatial);
        let fitting = kind.iter().find(|kind| kind.spatial == home);
        if fitting.is_none() {
            let (other, here) = if home { ("planar", "in space") } else { ("spatial", "in the plane") };
            let message = format!("`{call}` joins {other} bodies; {} {}", here, listed(Some(home)));
            diag.error(call.span(), message);
        }
        let shown = |end: Option<usize>| end.map_or("ground", |at| &model.body_elements[at].name);
        let apart = parent.is_some_and(|parent| child.is_some_and(|child| spatial(parent) != spatial(child)));
        if apart {
            let names = (shown(parent), shown(child));
            let kinds = if home { ("planar", "spatial") } else { ("spatial", "planar") };
            let message = format!("`{}` is {} and `{}` is {}", names.0, kinds.0, names.1, kinds.1);
            diag.error(args[0].loc, message);
        }
        let sound = child.filter(|_| fitting.is_some() && !apart);
        found.push(Joint {
            name: indexed(model.shown(&joint.key.name.to_string()), &indices),
            key: joint.key.name.clone(),
            docs: joint.docs.clone(),
            indices,
            kind: fitting.unwrap_or(&kind[0]),
            call,
            variables: scope.variables.clone(),
            parent,
            child: sound.filter(|_| ends.0.is_some()),
            args,
            first: 0,
        });
    });
    found
}

/// Enters the joints of the tree, with the bodies that hang on them.
pub(super) fn joints(decl: &Declaration, model: &mut Model, diag: &Diagnostics) {
    let mut names: HashSet<String> = HashSet::new();
    let mut lengths: HashMap<String, usize> = HashMap::new();
    for joint in declared(decl, model, diag) {
        let text = joint.key.to_string();
        let again = names.contains(&joint.name);
        let reason = match lengths.get(&text) {
            None => model.free(&joint.key).err(),
            Some(n) if *n != joint.indices.len() => Some(format!(
                "`{text}` is declared with different numbers of indices; rename one"
            )),
            Some(_) if again && joint.indices.is_empty() && !joint.variables.is_empty() => Some(
                format!("`{text}` is declared twice; in a loop, index it: `{text}[i]`"),
            ),
            Some(_) if again => Some(format!(
                "`{}` is declared twice; names must be unique",
                joint.name
            )),
            Some(_) => None,
        };
        if let Some(reason) = reason {
            diag.error(joint.key.span(), reason);
            continue;
        }
        lengths.insert(text.clone(), joint.indices.len());
        names.insert(joint.name.clone());
        model.names.insert(text, Name::Joint);
        hang(joint, model, diag);
    }
    circles(model, diag);
}

/// Enters `joint`, on which its second body hangs.
fn hang(joint: Joint, model: &mut Model, diag: &Diagnostics) {
    if let Some(child) = joint.child {
        let name = &model.body_elements[child].name;
        let loc = joint.args[1].loc;
        match model.hung[child] {
            _ if joint.parent == Some(child) => {
                diag.error(loc, format!("`{name}` cannot hang on itself"));
            }
            Some(other) => {
                let other = &model.joints[other].name;
                let message = format!(
                    "`{name}` hangs on the joint `{other}` already; what closes a loop goes under `holonomic`"
                );
                diag.error(loc, message);
            }
            None => model.hung[child] = Some(model.joints.len()),
        }
    }
    model.joints.push(joint);
}

/// Reports bodies that hang on each other in a circle, and takes the circle apart.
fn circles(model: &mut Model, diag: &Diagnostics) {
    // By the walk from which each body was seen first.
    let mut seen: Vec<Option<usize>> = vec![None; model.body_elements.len()];
    for start in 0..seen.len() {
        let mut at = start;
        while seen[at].is_none() {
            seen[at] = Some(start);
            let Some(joint) = model.hung[at] else {
                break;
            };
            let Some(parent) = model.joints[joint].parent else {
                break;
            };
            if seen[parent] == Some(start) {
                let (joint, name) = (&model.joints[joint], &model.body_elements[at].name);
                let message = format!(
                    "`{name}` hangs on itself by other joints; of a loop one joint goes under `holonomic`"
                );
                diag.error(joint.args[1].loc, message);
                model.hung[at] = None;
                break;
            }
            at = parent;
        }
    }
}

/// The joints that `e` may mean, in the plane or in space, with its arguments, at least two.
fn kind(e: &Expr, diag: &Diagnostics) -> Option<(Vec<&'static TreeJoint>, Ident, Vec<Expr>)> {
    let ExprKind::Call(name, args) = &e.kind else {
        if !matches!(e.kind, ExprKind::Error) {
            let message = format!(
                "a joint of the tree is written `name: pin(p, q)`; {}",
                listed(None)
            );
            diag.error(e.loc, message);
        }
        return None;
    };
    let kinds: Vec<&TreeJoint> = JOINTS.iter().filter(|joint| name == joint.name).collect();
    if kinds.is_empty() {
        let names = JOINTS.iter().map(|joint| joint.name);
        let remedy = format!("{}, others go under `holonomic`", listed(None));
        let text = name.to_string();
        let end = match elsewhere(&text) {
            Some(here) => format!("; {here}"),
            None => suggest(&text, names, &remedy),
        };
        diag.error(
            name.span(),
            format!("no joint of the tree is called `{name}`{end}"),
        );
        return None;
    }
    if args.len() < 2 {
        let message = format!(
            "a joint of the tree joins points of two bodies: `{name}(arm.at(…), hand.at(…), …)`"
        );
        diag.error(name.span(), message);
        return None;
    }
    Some((kinds, name.clone(), args.clone()))
}

/// What joints of the tree there are, in words.
fn listed(spatial: Option<bool>) -> String {
    let mut names: Vec<&str> = Vec::new();
    for joint in JOINTS
        .iter()
        .filter(|j| spatial.is_none_or(|s| s == j.spatial))
    {
        if !names.contains(&joint.name) {
            names.push(joint.name);
        }
    }
    format!("joints of the tree are `{}`", names.join("`, `"))
}

/// The body that the point `e`, written `body.at(p)`, belongs to; nothing inside where that is the ground.
fn end(e: &Expr, scope: &Scope<'_>, model: &Model, diag: &Diagnostics) -> Option<Option<usize>> {
    let form = || {
        let message =
            "a joint of the tree names its bodies where it stands: `pin(arm.at(p), hand.at(q))`";
        diag.error(e.loc, message);
        None
    };
    let body = match &e.kind {
        ExprKind::Call(at, args) if at == "at" && args.len() == 2 => &args[0],
        ExprKind::Error => return None,
        _ => return form(),
    };
    let Some(segments) = body.segments() else {
        return form();
    };
    let found = match scope.in_part(&segments, diag) {
        Some(found) => found.ok()?,
        None => InPart {
            name: segments[0].0.clone(),
            indices: segments[0].1.clone(),
            used: 1,
        },
    };
    if found.used != segments.len() {
        return form();
    }
    let InPart { name, indices, .. } = found;
    let text = name.to_string();
    let Some(Name::Body(family)) = model.names.get(&text) else {
        if text == "ground" && indices.is_empty() && !model.names.contains_key(&text) {
            return Some(None);
        }
        if model.lost.contains(&text) {
            return None;
        }
        let names = model.bodies.iter().map(|family| family.name.to_string());
        let names: Vec<String> = names.chain(["ground".to_owned()]).collect();
        let remedy = format!("bodies are `{}`", names.join("`, `"));
        let end = suggest(&text, names.iter().map(String::as_str), &remedy);
        diag.error(name.span(), format!("`{text}` is not a body{end}"));
        return None;
    };
    let family = &model.bodies[*family];
    let chosen: Option<Vec<i64>> = indices.iter().map(|i| scope.integer(i, diag)).collect();
    let chosen = chosen?;
    if chosen.len() != family.shape.len() {
        let message = match family.shape.len() {
            0 => format!("`{text}` is one body; write it without an index"),
            n => format!(
                "bodies of `{text}` take {n} ind{}",
                if n == 1 { "ex" } else { "ices" }
            ),
        };
        diag.error(body.loc, message);
        return None;
    }
    match block(&family.shape, &chosen) {
        Ok(range) => family.members.get(range.start).map(|at| Some(*at)),
        Err(wrong) => {
            let message = format!(
                "index {} is out of range: `{text}` has {} members",
                chosen[wrong],
                family.members.len()
            );
            diag.error(indices[wrong].loc, message);
            None
        }
    }
}
