//! The quantities of a motion by the names that they have in tables: `t`, `x`, `dot(x)`, outputs, integrals, `energy`, `residual`.

use ukcore::simulate::{Drift, Sample};
use ukcore::spec::belongs;
use ukcore::{Error, Prepared};

use crate::failure::Failure;
use crate::units::turn;

/// Some quantities of a mechanism, in the order asked for.
#[derive(Debug, Clone)]
pub(crate) struct Columns {
    mechanism: Prepared,
    chosen: Vec<(String, Source)>,
}

/// Where a number comes from.
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

impl Columns {
    /// Those called `names`, as in the first line of `run --csv`; the name of a family or body, where no column is called so, means all
    /// that [belongs] to it.
    ///
    /// # Errors
    /// [`Failure::Usage`] for a name that is none, with the nearest.
    pub(crate) fn named(mechanism: &Prepared, names: &[impl AsRef<str>]) -> Result<Self, Failure> {
        let all = all(mechanism);
        let mut chosen = Vec::new();
        for name in names {
            let name = name.as_ref().trim();
            let before = chosen.len();
            match all.iter().find(|(known, _)| known == name) {
                Some(called) => chosen.push(called.clone()),
                None => chosen.extend(all.iter().filter(|(known, _)| means(name, known)).cloned()),
            }
            if chosen.len() == before {
                let mut known = all.iter().map(|(known, _)| known.as_str());
                return Err(Error::unknown_name("quantity", name, &mut known).into());
            }
        }
        Ok(Columns {
            mechanism: mechanism.clone(),
            chosen,
        })
    }

    /// All outputs and integrals; where there are none, all coordinates.
    pub(crate) fn of_interest(mechanism: &Prepared) -> Self {
        let mut chosen = all(mechanism);
        let told = |source: &Source| matches!(source, Source::Output(_) | Source::Integral(_));
        match chosen.iter().any(|(_, source)| told(source)) {
            true => chosen.retain(|(_, source)| told(source)),
            false => chosen.retain(|(_, source)| matches!(source, Source::Coordinate(_))),
        }
        Columns {
            mechanism: mechanism.clone(),
            chosen,
        }
    }

    /// The names of the quantities, as in tables.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.chosen.iter().map(|(name, _)| name.as_str())
    }

    /// The units of the quantities; nothing where none is known.
    pub(crate) fn units(&self) -> Vec<String> {
        let spec = self.mechanism.spec();
        let unit = |source: &Source| match *source {
            Source::Time => "s".to_owned(),
            Source::Coordinate(i) => spec.coordinate_unit(i).to_owned(),
            Source::Velocity(i) => match spec.coordinate_unit(i) {
                "" => String::new(),
                unit => format!("{unit}/s"),
            },
            Source::Output(k) => spec.outputs[k].unit.to_owned(),
            Source::Integral(k) => self.mechanism.integrals()[k].unit.to_owned(),
            Source::Energy if !spec.coordinate_units.is_empty() => "J".to_owned(),
            _ => String::new(),
        };
        self.chosen.iter().map(|(_, source)| unit(source)).collect()
    }

    /// What a turn is in the units of outputs that are angles; none of all else.
    pub(crate) fn turns(&self) -> Vec<Option<f64>> {
        let sources = self.chosen.iter().map(|(_, source)| source);
        let turn = |(source, unit): (&Source, String)| match source {
            Source::Output(_) => turn(&unit),
            _ => None,
        };
        sources.zip(self.units()).map(turn).collect()
    }

    /// The names of the quantities, with units behind where these are known.
    pub(crate) fn labels(&self) -> Vec<String> {
        self.names().zip(self.units()).map(labelled).collect()
    }

    /// The same quantities of `mechanism`, which has other parameters.
    pub(crate) fn with(&self, mechanism: &Prepared) -> Self {
        Columns {
            mechanism: mechanism.clone(),
            chosen: self.chosen.clone(),
        }
    }

    /// The values of the quantities at `sample`.
    pub(crate) fn values(&self, sample: Sample<'_>) -> Vec<f64> {
        let Sample { t, q, v, integrals } = sample;
        let (mechanism, spec) = (&self.mechanism, self.mechanism.spec());
        let mut outputs = vec![0.0; spec.outputs.len()];
        mechanism.outputs(t, q, v, &mut outputs);
        let value = |(_, source): &(String, Source)| match source {
            Source::Time => t,
            Source::Coordinate(k) => q[*k],
            Source::Velocity(k) => v[*k],
            Source::Output(k) => outputs[*k],
            Source::Integral(k) => integrals.get(*k).copied().unwrap_or(f64::NAN),
            Source::Energy => mechanism.energy(t, q, v).total(),
            Source::Residual => residual(mechanism, sample),
        };
        self.chosen.iter().map(value).collect()
    }
}

/// The largest |φ| and |φ̇| there; 0 without constraints.
pub(crate) fn residual(mechanism: &Prepared, sample: Sample<'_>) -> f64 {
    let mut drift = Drift::new(mechanism);
    drift.add(sample);
    drift.residual().largest()
}

fn all(mechanism: &Prepared) -> Vec<(String, Source)> {
    let spec = mechanism.spec();
    let coordinates = spec.coords.iter().enumerate();
    let outputs = spec.outputs.iter().enumerate();
    let integrals = mechanism.integrals().iter().enumerate();
    let mut all = vec![("t".to_owned(), Source::Time)];
    let positions = coordinates.clone();
    all.extend(positions.map(|(k, name)| ((*name).to_owned(), Source::Coordinate(k))));
    all.extend(coordinates.map(|(k, name)| (format!("dot({name})"), Source::Velocity(k))));
    all.extend(outputs.map(|(k, output)| (output.name.to_owned(), Source::Output(k))));
    all.extend(integrals.map(|(k, integral)| (integral.name.to_owned(), Source::Integral(k))));
    all.push(("energy".to_owned(), Source::Energy));
    all.push(("residual".to_owned(), Source::Residual));
    all
}

/// Whether the column `known` is called `name` or belongs to it: `x[1][2]` to `x`, `dot(x[1])` to `dot(x)`.
fn means(name: &str, known: &str) -> bool {
    let rate = |text: &str| Some(text.strip_prefix("dot(")?.strip_suffix(')')?.to_owned());
    match (rate(name), rate(known)) {
        (Some(name), Some(known)) => belongs(&known, &name),
        (None, None) => belongs(known, name),
        _ => false,
    }
}

/// A name, with a unit behind where there is one.
pub(crate) fn labelled((name, unit): (impl Into<String>, String)) -> String {
    match unit.as_str() {
        "" => name.into(),
        unit => format!("{} ({unit})", name.into()),
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
            let found = Columns::named(&mechanism, asked).expect("quantities");
            found.names().map(str::to_owned).collect()
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
