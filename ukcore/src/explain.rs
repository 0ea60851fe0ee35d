//! A mechanism in words and equations: what was declared, derived and decided.

use std::fmt::{self, Formatter};

use crate::assemble::State;
use crate::diagnosis::{Redundant, redundant};
use crate::error::Error;
use crate::mechanism::Prepared;
use crate::numbers::{fixed, short};
use crate::plan::widest;
use crate::solver::{Solution, Solver, SolverOptions};
use crate::spec::{OutputSpec, ParamSpec, Spec};

/// All that is known about a mechanism, to print: coordinates, parameters, M, Q, c, A and b as equations, outputs, structure, the
/// [`Plan`](crate::plan::Plan) of how q̈ is computed; and at a state rank, degrees of freedom, redundant constraints and accelerations.
#[derive(Debug, Clone)]
pub struct Explanation {
    mechanism: Prepared,
    start: Option<Start>,
}

/// A start, and what the equations say there.
#[derive(Debug, Clone)]
struct Start {
    name: String,
    state: State,
    found: Option<(Solution, Vec<Redundant>)>,
}

/// Decimals of values.
const DIGITS: usize = 8;

impl Explanation {
    /// What is known about `mechanism` with its parameters, at any state.
    pub fn new(mechanism: impl Into<Prepared>) -> Self {
        Explanation {
            mechanism: mechanism.into(),
            start: None,
        }
    }

    /// Adds to the explanation what holds at `state`, which it calls `name`.
    ///
    /// # Errors
    /// What [`Solver::solve`] reports, beside the explanation without what only the solution tells.
    pub fn at(mut self, name: &str, state: &State) -> (Self, Result<(), Error>) {
        let mut solver = Solver::new(&self.mechanism, SolverOptions::default());
        let solution = solver.solve(state.t, &state.q, &state.v);
        let (found, result) = match solution {
            Ok(solution) => {
                let redundant = redundant(&self.mechanism, state, solution.rank);
                (Some((solution, redundant)), Ok(()))
            }
            Err(error) => (None, Err(error)),
        };
        self.start = Some(Start {
            name: name.to_owned(),
            state: state.clone(),
            found,
        });
        (self, result)
    }

    fn coordinates(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let spec = self.mechanism.spec();
        write!(f, "Coordinates q ({})", spec.n())?;
        if let Some(start) = &self.start {
            let name = &start.name;
            write!(f, ", with their value and rate at the start `{name}`")?;
        }
        writeln!(f)?;
        let names = spec.coords.iter().enumerate();
        let names = names.map(|(i, name)| with_unit(name, spec.coordinate_unit(i)));
        let names: Vec<String> = names.collect();
        let wide = widest(names.iter().map(String::as_str));
        for (i, name) in names.iter().enumerate() {
            let mut line = format!("  {name:<wide$}");
            if let Some(Start { state, .. }) = &self.start {
                let [q, v] = [&state.q, &state.v].map(|x| fixed(x[i], DIGITS));
                line += &format!(" {q:>14} {v:>14}");
            }
            if spec.structure.massless.contains(&i) {
                line += "  (no mass)";
            }
            writeln!(f, "{}", line.trim_end())?;
        }
        Ok(())
    }

    fn parameters(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let params = self.mechanism.spec().params;
        if params.is_empty() {
            return Ok(());
        }
        let setting = |(p, value): (&ParamSpec, &f64)| {
            let mut text = format!("{} = {} {}", p.name, short(*value, DIGITS), p.unit);
            text.truncate(text.trim_end().len());
            if *value != p.default {
                text += &format!(" (default {})", short(p.default, DIGITS));
            }
            text
        };
        let values = params.iter().zip(self.mechanism.parameters());
        let settings: Vec<String> = values.map(setting).collect();
        let docs = params.iter().map(|p| p.doc);
        writeln!(f, "\nParameters")?;
        table(f, settings.iter().map(String::as_str).zip(docs))
    }
}

impl fmt::Display for Explanation {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let spec = self.mechanism.spec();
        if !spec.doc.trim().is_empty() {
            writeln!(f, "{}\n", spec.doc.trim())?;
        }
        self.coordinates(f)?;
        self.parameters(f)?;
        unconstrained(f, spec)?;
        constraints(f, spec)?;
        if !spec.outputs.is_empty() {
            writeln!(f, "\nOutputs")?;
            described(f, spec.outputs)?;
        }
        let integrals = self.mechanism.integrals();
        if !integrals.is_empty() {
            writeln!(f, "\nIntegrals along a run")?;
            described(f, integrals)?;
        }
        structure(f, spec)?;
        write!(f, "\n{}", self.mechanism.plan())?;
        match &self.start {
            Some(start) => at_start(f, spec, start),
            None => Ok(()),
        }
    }
}

/// Outputs or integrals with their units, and what they mean in a column beside them.
fn described(f: &mut Formatter<'_>, outputs: &[OutputSpec]) -> fmt::Result {
    let names = outputs.iter().map(|o| with_unit(o.name, o.unit));
    let names: Vec<String> = names.collect();
    let docs = outputs.iter().map(|o| o.doc);
    table(f, names.iter().map(String::as_str).zip(docs))
}

/// A name, with its unit where it has one.
fn with_unit(name: &str, unit: &str) -> String {
    match unit {
        "" => name.to_owned(),
        _ => format!("{name} [{unit}]"),
    }
}

/// Names, with what they mean in a column beside them.
fn table<'a>(
    f: &mut Formatter<'_>,
    rows: impl Iterator<Item = (&'a str, &'a str)> + Clone,
) -> fmt::Result {
    let wide = widest(rows.clone().map(|(name, _)| name));
    for (name, meaning) in rows {
        let line = format!("  {name:<wide$}  {}", meaning.trim());
        writeln!(f, "{}", line.trim_end())?;
    }
    Ok(())
}

fn unconstrained(f: &mut Formatter<'_>, spec: &Spec) -> fmt::Result {
    let e = &spec.equations;
    writeln!(
        f,
        "\nM q̈ = Q without constraints (eq. 1); entries that are not listed are zero"
    )?;
    lines(f, e.mass)?;
    lines(f, e.force)?;
    if !e.nonideal.is_empty() {
        writeln!(f, "\nNon-ideal constraint force c (eq. 8)")?;
        lines(f, e.nonideal)?;
    }
    if !e.definitions.is_empty() {
        writeln!(f, "\nAbbreviations")?;
        lines(f, e.definitions)?;
    }
    Ok(())
}

fn lines(f: &mut Formatter<'_>, lines: &[&str]) -> fmt::Result {
    lines.iter().try_for_each(|line| writeln!(f, "  {line}"))
}

fn constraints(f: &mut Formatter<'_>, spec: &Spec) -> fmt::Result {
    if spec.constraints.is_empty() {
        return writeln!(f, "\nNo constraints");
    }
    let (holonomic, others) = (spec.holonomic, spec.m() - spec.holonomic);
    writeln!(
        f,
        "\nConstraints ({holonomic} holonomic, {others} nonholonomic) and A q̈ = b (eq. 5)"
    )?;
    lines(f, spec.equations.constraints)
}

fn structure(f: &mut Formatter<'_>, spec: &Spec) -> fmt::Result {
    let s = &spec.structure;
    let (n, m) = (spec.n(), spec.m());
    let constant = |yes| if yes { "constant" } else { "varies" };
    let yes_no = |yes| if yes { "yes" } else { "no" };
    let diagonal = if s.mass_diagonal { "diagonal, " } else { "" };
    let (mass, jacobian) = (s.mass_pattern.len(), s.jacobian_pattern.len());
    writeln!(f, "\nStructure")?;
    writeln!(
        f,
        "  M  {n} × {n}, {mass} of {} entries, {diagonal}{}",
        n * n,
        constant(s.mass_constant)
    )?;
    writeln!(
        f,
        "  A  {m} × {n}, {jacobian} of {} entries, {}",
        m * n,
        constant(s.jacobian_constant)
    )?;
    writeln!(f, "  explicit time: {}", yes_no(!s.scleronomic))?;
    writeln!(f, "  energy conserved: {}", yes_no(s.conservative))?;
    if !s.massless.is_empty() {
        let names: Vec<&str> = s.massless.iter().map(|&i| spec.coords[i]).collect();
        writeln!(f, "  without mass: {}", names.join(", "))?;
    }
    Ok(())
}

fn at_start(f: &mut Formatter<'_>, spec: &Spec, start: &Start) -> fmt::Result {
    let Some((solution, redundant)) = &start.found else {
        return Ok(());
    };
    let redundant: Vec<String> = redundant.iter().map(Redundant::to_string).collect();
    let redundant = match redundant.is_empty() {
        true => "none".to_owned(),
        false => redundant.join("; "),
    };
    writeln!(
        f,
        "\nAt the start `{}`, t = {} s",
        start.name, start.state.t
    )?;
    writeln!(f, "  rank of A: {} of {}", solution.rank, spec.m())?;
    writeln!(f, "  degrees of freedom: {}", solution.degrees_of_freedom)?;
    writeln!(f, "  redundant constraints: {redundant}")?;
    writeln!(f, "  formula: {}", solution.formula)?;
    writeln!(f, "  accelerations:")?;
    let wide = widest(spec.coords.iter().copied());
    for (name, value) in spec.coords.iter().zip(&solution.acceleration) {
        writeln!(f, "    {name:<wide$} {:>14}", fixed(*value, DIGITS))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::Pendulum;
    use crate::mechanism::Mechanism;

    #[test]
    fn what_holds_at_a_state_is_told_where_there_is_one() {
        let mut mech = Pendulum::default();
        mech.set("l", 2.0).unwrap();
        let anywhere = Explanation::new(&mech);
        let text = anywhere.to_string();
        assert!(
            text.contains("Coordinates q (2)\n  x\n") && text.contains("Constraints (1 holonomic"),
            "{text}"
        );
        assert!(
            text.contains("l = 2 (default 1)") && !text.contains("rank of A"),
            "{text}"
        );
        let state = State {
            q: vec![2.0, 0.0],
            ..State::zeros::<Pendulum>()
        };
        let (there, solved) = anywhere.at("level", &state);
        assert_eq!(solved, Ok(()));
        let text = there.to_string();
        assert!(
            text.contains("At the start `level`, t = 0 s\n  rank of A: 1 of 1"),
            "{text}"
        );
        // A state off the mechanism has no solution, but all the rest.
        let nowhere = State {
            q: vec![f64::NAN, 0.0],
            ..state
        };
        let (text, failed) = there.at("nowhere", &nowhere);
        assert!(failed.is_err() && text.to_string().contains("Constraints (1 "));
    }
}
