//! From the command line to a mechanism with its parameters and a consistent start.

use models::{Model, StartOptions, StartSpec};
use ukcore::{Error, Spec, State};

use crate::args::Scene;
use crate::failure::Failure;
use crate::units::{self, Quantity};

/// A mechanism with the parameters asked for, at the start asked for.
#[derive(Debug, Clone)]
pub(crate) struct Ready<M> {
    /// The mechanism.
    pub(crate) mechanism: M,
    /// Name of the start.
    pub(crate) start: &'static str,
    /// The start's state.
    pub(crate) state: State,
}

/// Applies the settings to a fresh `M`, and starts it. Parameters are set first: the start depends on them.
///
/// # Errors
/// [`Failure::Usage`] for unknown names, values in the wrong unit, and settings that the start refuses.
pub(crate) fn ready<M: Model>(scene: &Scene) -> Result<Ready<M>, Failure> {
    let start = start_spec(M::starts(), scene.start.as_deref())?;
    let mut mechanism = M::default();
    let mut options = StartOptions::new();
    for (name, quantity) in &scene.settings {
        if let Some(option) = start.options.iter().find(|o| o.name == *name) {
            options.set(name, in_unit(name, *quantity, Some(option.unit))?);
        } else if let Some(doc) = parameter_doc(M::SPEC, name) {
            mechanism.set(name, in_unit(name, *quantity, units::unit_in(doc))?)?;
        } else {
            return Err(unknown_setting::<M>(name, start));
        }
    }
    let state = mechanism.start(start.name, &options)?;
    Ok(Ready {
        mechanism,
        start: start.name,
        state,
    })
}

fn start_spec(
    starts: &'static [StartSpec],
    name: Option<&str>,
) -> Result<&'static StartSpec, Failure> {
    match name {
        None => starts
            .first()
            .ok_or_else(|| Failure::Failed("the model has no start".to_owned())),
        Some(name) => starts.iter().find(|s| s.name == name).ok_or_else(|| {
            Error::unknown_name("start", name, &mut starts.iter().map(|s| s.name)).into()
        }),
    }
}

fn in_unit(name: &str, quantity: Quantity, unit: Option<&str>) -> Result<f64, Failure> {
    quantity
        .in_unit(unit)
        .map_err(|e| Failure::Usage(format!("`{name}`: {e}")))
}

/// Doc comment of a parameter, or of a family named without index.
fn parameter_doc(spec: &Spec, name: &str) -> Option<&'static str> {
    spec.params
        .iter()
        .find(|p| p.name == name || family(p.name) == name)
        .map(|p| p.doc)
}

fn family(name: &str) -> &str {
    name.split_once('[').map_or(name, |(family, _)| family)
}

fn unknown_setting<M: Model>(name: &str, start: &StartSpec) -> Failure {
    let elsewhere = M::starts()
        .iter()
        .find(|s| s.options.iter().any(|o| o.name == name));
    if let Some(other) = elsewhere {
        return Failure::Usage(format!(
            "`{name}` is an option of the start `{}`, not of `{}`; add `--start {}`",
            other.name, start.name, other.name
        ));
    }
    let options = start.options.iter().map(|o| o.name);
    let params = M::SPEC.params.iter().map(|p| p.name);
    let members = M::SPEC.params.iter().filter(|p| p.name.ends_with("[0]"));
    let families = members.map(|p| family(p.name));
    Error::unknown_name(
        "parameter or start option",
        name,
        &mut options.chain(params).chain(families),
    )
    .into()
}
