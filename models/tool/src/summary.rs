//! The summary of a run, for reading and as JSON.

use std::io::{self, Write};

use serde_json::{Map, Value, json};
use ukcore::simulate::Ending;
use ukcore::solver::SolverOptions;
use ukcore::spec::Spec;
use ukcore::{Solver, State, Trajectory, lost_digits, lost_reactions};

use crate::drift::Drift;
use crate::motion::Motion;
use crate::numbers::{count, fixed, full, significant, width};
use crate::scene::Ready;

/// What a run was, what came out and what it cost. SI units.
pub(crate) struct Summary<'a> {
    pub(crate) trajectory: &'a Trajectory,
    /// What was measured of the samples.
    pub(crate) measured: &'a ukcore::simulate::Drift,
    /// The first of them at which an output is not finite.
    pub(crate) broken: Option<&'a State>,
    pub(crate) ready: &'a Ready<'a>,
    pub(crate) motion: &'a Motion,
    /// Wall time of the integration, s.
    pub(crate) seconds: f64,
    /// Why it ended early, if it did.
    pub(crate) error: Option<String>,
}

/// Names with values; a value that is not finite becomes null, as JSON has no other word for it.
fn named<'a>(names: impl IntoIterator<Item = &'a str>, values: &[f64]) -> Map<String, Value> {
    let pairs = names.into_iter().zip(values);
    pairs
        .map(|(name, value)| (name.to_owned(), Value::from(*value)))
        .collect()
}

impl Summary<'_> {
    fn ending(&self) -> &'static str {
        match self.trajectory.ending() {
            Ending::Completed => "completed",
            Ending::Event => "event",
            Ending::Interrupted => "interrupted",
            Ending::Failed => "failed",
        }
    }

    fn drift(&self) -> Drift {
        Drift::measured(self.measured, self.trajectory.spec())
    }

    /// The last state that was computed: time, coordinates, their rates by the names of the coordinates, outputs, energy.
    fn last(&self) -> Option<Value> {
        let (mechanism, spec) = (self.trajectory.mechanism(), self.trajectory.spec());
        let last = self.trajectory.last()?;
        let mut outputs = vec![0.0; spec.outputs.len()];
        mechanism.outputs(last.t, last.q, last.v, &mut outputs);
        let energy = mechanism.energy(last.t, last.q, last.v);
        let coords = || spec.coords.iter().copied();
        Some(json!({
            "t": last.t,
            "q": named(coords(), last.q),
            "v": named(coords(), last.v),
            "outputs": named(spec.outputs.iter().map(|o| o.name), &outputs),
            "integrals": named(mechanism.integrals().iter().map(|o| o.name), last.integrals),
            "energy": { "kinetic": energy.kinetic, "potential": energy.potential },
        }))
    }

    /// The units that are declared, by the names of parameters, coordinates, outputs and integrals.
    fn units(&self) -> Map<String, Value> {
        let (mechanism, spec) = (self.trajectory.mechanism(), self.trajectory.spec());
        let params = spec.params.iter().map(|p| (p.name, p.unit));
        let coords = spec.coords.iter().enumerate();
        let coords = coords.map(|(i, name)| (*name, spec.coordinate_unit(i)));
        let reported = spec.outputs.iter().chain(mechanism.integrals());
        let all = params
            .chain(coords)
            .chain(reported.map(|o| (o.name, o.unit)));
        let known = all.filter(|(_, unit)| !unit.is_empty());
        known
            .map(|(name, unit)| (name.to_owned(), unit.into()))
            .collect()
    }

    /// The summary as JSON.
    pub(crate) fn json(&self) -> Value {
        let (work, drift) = (self.trajectory.work(), self.drift());
        let params = self.trajectory.spec().params.iter().map(|p| p.name);
        json!({
            "model": self.ready.entry.id,
            "start": self.ready.start,
            "parameters": named(params, self.trajectory.mechanism().parameters()),
            "method": self.motion.method.to_string(),
            "stabilise": self.motion.stabilise.to_string(),
            "tolerance": self.motion.tolerance(),
            "ending": self.ending(),
            "error": self.error,
            "final": self.last(),
            "units": self.units(),
            "samples": self.measured.samples(),
            "position_residual": drift.position_residual,
            "velocity_residual": drift.velocity_residual,
            "energy_drift": drift.energy_drift,
            "energy_exchanged": drift.energy_drift.map(|_| self.measured.exchanged()),
            "work": {
                "steps": work.steps,
                "rejected": work.rejected,
                "switches": work.switches,
                "rounded": work.rounded,
                "evaluations": work.evaluations,
                "jacobians": work.jacobians,
                "factorisations": work.factorisations,
                "projections": work.projections,
                "projection_iterations": work.projection_iterations,
                "fallbacks": work.fallbacks,
                "refined": work.refined,
            },
            "seconds": self.seconds,
        })
    }

    /// Writes the summary for reading.
    pub(crate) fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let tolerance = self.motion.tolerance();
        let tolerance = tolerance.map_or(String::new(), |tol| format!(" at tolerance {tol:e}"));
        let (id, start) = (&self.ready.entry.id, self.ready.start);
        let (method, ending) = (self.motion.method, self.ending());
        writeln!(out, "{id} from `{start}`, {method}{tolerance}, {ending}")?;
        let w = self.trajectory.work();
        self.write_last(out)?;
        self.write_largest(out)?;
        self.write_broken(out)?;
        if w.rounded > 0 {
            let steps = count(w.rounded, "step");
            writeln!(
                out,
                "Tolerance below rounding: the error of {steps} is rounding of the forces; a looser one costs less and is as exact"
            )?;
        }
        let implicit = match (w.jacobians, w.factorisations) {
            (0, 0) => String::new(),
            (jacobians, factorisations) => format!(
                ", {}, {}",
                count(jacobians, "Jacobian"),
                count(factorisations, "factorisation")
            ),
        };
        let refined = match w.refined {
            0 => String::new(),
            refined => format!(", {refined} refined"),
        };
        writeln!(
            out,
            "Work: {} ({} rejected, {} onto switches), {}{implicit}, {} ({}), {}{refined}; {:.3} s",
            count(w.steps, "step"),
            w.rejected,
            w.switches,
            count(w.evaluations, "evaluation"),
            count(w.projections, "projection"),
            count(w.projection_iterations, "iteration"),
            count(w.fallbacks, "fallback"),
            self.seconds
        )?;
        // Each may have taken two evaluations.
        if 3 * w.fallbacks > w.evaluations {
            writeln!(
                out,
                "Most evaluations fell back from the straight line to the rank-revealing solve: {}",
                self.doubt()
            )?;
        } else if !self.trajectory.spec().structure.solve.redundant.is_empty() {
            let names = self.implied();
            if !names.is_empty() {
                let names = names.join(", ");
                writeln!(
                    out,
                    "Dropped from the straight line, as the other constraints imply them: {names}"
                )?;
            }
        }
        Ok(())
    }

    /// What the samples say of the motion's accuracy.
    fn write_largest(&self, out: &mut dyn Write) -> io::Result<()> {
        let (drift, samples) = (self.drift(), self.measured.samples());
        if samples == 0 {
            return Ok(());
        }
        let samples = count(samples, "sample");
        writeln!(out, "\nLargest of {samples}")?;
        if self.trajectory.spec().m() > 0 {
            writeln!(
                out,
                "  constraint residuals: position {:.1e}, velocity {:.1e}, in the units of the constraints (SI)",
                drift.position_residual, drift.velocity_residual,
            )?;
        }
        match drift.energy_drift {
            Some(drift) => {
                let exchanged = significant(self.measured.exchanged(), 4);
                let unit = joule(self.trajectory.spec());
                writeln!(
                    out,
                    "  energy drift: {drift:.1e} of the energy exchanged, {exchanged}{unit}"
                )?
            }
            None => writeln!(
                out,
                "  energy drift: not told, as energy is not conserved in this model"
            )?,
        }
        Ok(())
    }

    /// Constraints that the others imply at the last state.
    fn implied(&self) -> Vec<String> {
        let mechanism = self.trajectory.mechanism();
        let mut solver = Solver::new(mechanism.clone(), SolverOptions::default());
        let last = self.trajectory.last();
        let solution = last.and_then(|last| solver.solve(last.t, last.q, last.v).ok());
        let redundant = solution.map_or(Vec::new(), |s| s.redundant);
        let name = |i: &usize| format!("`{}`", self.trajectory.spec().constraints[*i].name);
        redundant.iter().map(name).collect()
    }

    /// Why the straight line was left, as far as the last state tells.
    fn doubt(&self) -> String {
        let names = self.implied();
        if !names.is_empty() {
            return format!("the other constraints imply {}", names.join(", "));
        }
        let last = self.trajectory.last().map(|last| last.to_state());
        let told = last.and_then(|last| lost_digits(self.trajectory.mechanism(), &last));
        let why = told.map_or(String::new(), |told| {
            format!(", as {told} at the last state")
        });
        format!("its pivots lose digits{why}")
    }

    /// Which outputs are not finite, and why, as far as reactions are the cause.
    fn write_broken(&self, out: &mut dyn Write) -> io::Result<()> {
        let Some(state) = self.broken else {
            return Ok(());
        };
        let mechanism = self.trajectory.mechanism();
        let declared = mechanism.spec().outputs;
        let mut outputs = vec![0.0; declared.len()];
        mechanism.outputs(state.t, &state.q, &state.v, &mut outputs);
        let names = declared.iter().zip(outputs).filter(|(_, x)| !x.is_finite());
        let names: Vec<String> = names.map(|(o, _)| format!("`{}`", o.name)).collect();
        let cause = lost_reactions(mechanism, state).map_or(String::new(), |c| format!("; {c}"));
        let (names, t) = (names.join(", "), full(state.t));
        writeln!(out, "Not finite at t = {t} s: {names}{cause}")
    }

    fn write_last(&self, out: &mut dyn Write) -> io::Result<()> {
        let (mechanism, spec) = (self.trajectory.mechanism(), self.trajectory.spec());
        let Some(last) = self.trajectory.last() else {
            return Ok(());
        };
        let names = spec.outputs.iter().map(|o| o.name);
        let integrals = mechanism.integrals().iter().map(|o| o.name);
        let wide = width(spec.coords.iter().copied().chain(names).chain(integrals));
        let units = spec.coordinate_units.iter().copied().map(behind);
        let most = units.map(|unit| unit.chars().count()).max().unwrap_or(0);
        writeln!(out, "\nState at t = {} s", full(last.t))?;
        for (i, ((name, q), v)) in spec.coords.iter().zip(last.q).zip(last.v).enumerate() {
            let [q, v] = [q, v].map(|x| number(*x));
            let unit = behind(spec.coordinate_unit(i));
            writeln!(out, "  {name:<wide$} {q:>18}{unit:<most$}   dot {v:>18}")?;
        }
        let mut outputs = vec![0.0; spec.outputs.len()];
        mechanism.outputs(last.t, last.q, last.v, &mut outputs);
        for (head, reported, values) in [
            ("Outputs", spec.outputs, &outputs[..]),
            ("Integrals", mechanism.integrals(), last.integrals),
        ] {
            if !values.is_empty() {
                writeln!(out, "\n{head}")?;
            }
            for (told, value) in reported.iter().zip(values) {
                let (name, unit) = (told.name, behind(told.unit));
                writeln!(out, "  {name:<wide$} {:>18}{unit}", number(*value))?;
            }
        }
        Ok(())
    }
}

/// The unit of energy behind a number, where the declaration has units.
pub(crate) fn joule(spec: &Spec) -> &'static str {
    match spec.coordinate_units {
        [] => "",
        _ => " J",
    }
}

/// A unit behind a number, if there is one.
fn behind(unit: &str) -> String {
    match unit {
        "" => String::new(),
        unit => format!(" {unit}"),
    }
}

/// Twelve decimals, unless there are so many digits before them that nobody would count them.
fn number(value: f64) -> String {
    match value.abs() {
        size if !size.is_finite() => "not finite".to_owned(),
        size if size >= 1e15 => full(value),
        _ => fixed(value, 12),
    }
}
