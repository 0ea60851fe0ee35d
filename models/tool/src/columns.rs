//! The quantities of a motion by the names that they have in tables: `t`, `x`, `dot(x)`, outputs, integrals, `energy`, `residual`.

use ukcore::simulate::{Drift, Sample};
use ukcore::spec::{belongs, rate_of};
use ukcore::{Error, Prepared};

use crate::failure::Failure;
use crate::summary::joule;
use crate::units::turn;

/// A quantity of a mechanism: its name in tables, its unit (nothing where none is known), and where its numbers come from.
#[derive(Debug, Clone)]
pub(crate) struct Column {
    pub(crate) name: String,
    pub(crate) unit: String,
    source: Source,
}

/// The source of a number.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Source {
    Time,
    Coordinate(usize),
    Velocity(usize),
    Output(usize),
    Integral(usize),
    Energy,
    Residual,
}

impl Column {
    /// What a turn is in its unit, if it is an output that tells an angle.
    pub(crate) fn turn(&self) -> Option<f64> {
        match self.source {
            Source::Output(_) => turn(&self.unit),
            _ => None,
        }
    }

    /// The name of the column, with the unit behind where this is known.
    pub(crate) fn label(&self) -> String {
        labelled(&self.name, &self.unit)
    }
}

/// The quantities called `names`, as in the first line of `run --csv`, in the order asked for; the name of a family or body, where no
/// column is called so, means all that [belongs] to it.
///
/// # Errors
/// [`Failure::Usage`] for a name that is none, with the nearest.
pub(crate) fn named(
    mechanism: &Prepared,
    names: &[impl AsRef<str>],
) -> Result<Vec<Column>, Failure> {
    let all = all(mechanism);
    let mut chosen = Vec::new();
    for name in names {
        let name = name.as_ref().trim();
        let before = chosen.len();
        match all.iter().find(|column| column.name == name) {
            Some(called) => chosen.push(called.clone()),
            None => chosen.extend(all.iter().filter(|c| means(name, &c.name)).cloned()),
        }
        if chosen.len() == before {
            let mut known = all.iter().map(|column| column.name.as_str());
            return Err(Error::unknown_name("quantity", name, &mut known).into());
        }
    }
    Ok(chosen)
}

/// All outputs and integrals; where there are none, all coordinates.
pub(crate) fn of_interest(mechanism: &Prepared) -> Vec<Column> {
    let mut chosen = all(mechanism);
    let told = |c: &Column| matches!(c.source, Source::Output(_) | Source::Integral(_));
    match chosen.iter().any(told) {
        true => chosen.retain(told),
        false => chosen.retain(|c| matches!(c.source, Source::Coordinate(_))),
    }
    chosen
}

/// All that a state without a run tells: time, coordinates, velocities, outputs.
pub(crate) fn of_state(mechanism: &Prepared) -> Vec<Column> {
    let mut chosen = all(mechanism);
    let last = |c: &Column| {
        matches!(
            c.source,
            Source::Integral(_) | Source::Energy | Source::Residual
        )
    };
    chosen.retain(|column| !last(column));
    chosen
}

/// The values of the quantities at `sample`, of `mechanism`, which may have other parameters than they were chosen with.
pub(crate) fn values(columns: &[Column], mechanism: &Prepared, sample: Sample<'_>) -> Vec<f64> {
    let Sample { t, q, v, integrals } = sample;
    let mut outputs = vec![0.0; mechanism.spec().outputs.len()];
    mechanism.outputs(t, q, v, &mut outputs);
    let value = |column: &Column| match column.source {
        Source::Time => t,
        Source::Coordinate(k) => q[k],
        Source::Velocity(k) => v[k],
        Source::Output(k) => outputs[k],
        Source::Integral(k) => integrals.get(k).copied().unwrap_or(f64::NAN),
        Source::Energy => mechanism.energy(t, q, v).total(),
        Source::Residual => residual(mechanism, sample),
    };
    columns.iter().map(value).collect()
}

/// The largest |φ| and |φ̇| there; 0 without constraints.
pub(crate) fn residual(mechanism: &Prepared, sample: Sample<'_>) -> f64 {
    let mut drift = Drift::new(mechanism);
    drift.add(sample);
    drift.residual().largest()
}

fn all(mechanism: &Prepared) -> Vec<Column> {
    let spec = mechanism.spec();
    let mut all = Vec::new();
    let mut add = |name: &str, unit: &str, source| {
        let (name, unit) = (name.to_owned(), unit.to_owned());
        all.push(Column { name, unit, source });
    };
    add("t", "s", Source::Time);
    for (k, name) in spec.coords.iter().enumerate() {
        add(name, spec.coordinate_unit(k), Source::Coordinate(k));
    }
    for (k, name) in spec.coords.iter().enumerate() {
        let rate = match spec.coordinate_unit(k) {
            "" => String::new(),
            unit => format!("{unit}/s"),
        };
        add(&format!("dot({name})"), &rate, Source::Velocity(k));
    }
    for (k, output) in spec.outputs.iter().enumerate() {
        add(output.name, output.unit, Source::Output(k));
    }
    for (k, integral) in mechanism.integrals().iter().enumerate() {
        add(integral.name, integral.unit, Source::Integral(k));
    }
    add("energy", joule(spec).trim(), Source::Energy);
    add("residual", "", Source::Residual);
    all
}

/// Whether the column `known` is called `name` or belongs to it: `x[1][2]` to `x`, `dot(x[1])` to `dot(x)`.
fn means(name: &str, known: &str) -> bool {
    match (rate_of(name), rate_of(known)) {
        (Some(name), Some(known)) => belongs(known, name),
        (None, None) => belongs(known, name),
        _ => false,
    }
}

/// A name, with a unit behind where there is one.
pub(crate) fn labelled(name: &str, unit: &str) -> String {
    match unit {
        "" => name.to_owned(),
        unit => format!("{name} ({unit})"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ukcore::Mechanism;

    ukcore::multibody! {
        /// A bar that hangs on a pin, with an output that is called like it.
        Hanging {
            bodies { planar bar { mass: 1, inertia: 0.1, centre: [0.5, 0] } }
            gravity { [0, -9.81] }
            holonomic { top: pin(ground.at([0, 0]), bar.at([0, 0])) }
            output { bar = bar.angle, end = bar.at([1, 0]) }
        }
    }

    #[test]
    fn names_of_columns_go_before_those_of_bodies_and_families() {
        let mechanism = Hanging::default().prepared();
        let names = |asked: &[&str]| -> Vec<String> {
            let found = named(&mechanism, asked).expect("quantities");
            found.into_iter().map(|column| column.name).collect()
        };
        assert_eq!(names(&["bar", "end"]), ["bar", "end[0]", "end[1]"]);
        assert_eq!(
            names(&["dot(bar)"]),
            ["dot(bar.x)", "dot(bar.y)", "dot(bar.angle)"]
        );
        // What is found by its own name is found again.
        let found = names(&["bar", "end", "dot(bar)", "t"]);
        let again: Vec<&str> = found.iter().map(String::as_str).collect();
        assert_eq!(names(&again), found);
    }
}
