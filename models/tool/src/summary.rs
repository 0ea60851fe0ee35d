//! The summary of a run, for reading and as JSON.

use std::io::{self, Write};

use serde::Serialize;
use serde_json::{Map, Value};
use ukcore::{Ending, Method, Trajectory};

use crate::drift::Drift;
use crate::numbers::{count, fixed, full, width};
use crate::run::RunArgs;
use crate::scene::Ready;

/// What a run was, what came out and what it cost. SI units.
#[derive(Debug, Serialize)]
pub(crate) struct Summary {
    model: String,
    start: &'static str,
    parameters: Map<String, Value>,
    method: String,
    stabilise: String,
    /// `null` where the method looks at none.
    tolerance: Option<f64>,
    /// `"completed"`, `"interrupted"`, or `"failed"` with `error` saying why.
    ending: &'static str,
    error: Option<String>,
    /// The last state that was computed.
    #[serde(rename = "final")]
    last: Option<Last>,
    samples: usize,
    /// Largest of all samples.
    #[serde(flatten)]
    drift: Drift,
    work: Counters,
    /// Wall time of the integration, s.
    seconds: f64,
}

#[derive(Debug, Serialize)]
struct Last {
    t: f64,
    q: Map<String, Value>,
    /// Rates, by the names of the coordinates.
    v: Map<String, Value>,
    outputs: Map<String, Value>,
    energy: Energies,
}

#[derive(Debug, Serialize)]
struct Energies {
    kinetic: f64,
    potential: f64,
}

#[derive(Debug, Serialize)]
struct Counters {
    steps: usize,
    rejected: usize,
    switches: usize,
    evaluations: usize,
    jacobians: usize,
    factorisations: usize,
    projections: usize,
    projection_iterations: usize,
    fallbacks: usize,
}

/// Names with values; a value that is not finite becomes null, as JSON has no other word for it.
fn named<'a>(
    names: impl IntoIterator<Item = &'a str>,
    values: impl IntoIterator<Item = f64>,
) -> Map<String, Value> {
    names
        .into_iter()
        .zip(values)
        .map(|(name, value)| (name.to_owned(), Value::from(value)))
        .collect()
}

impl Summary {
    /// The summary of `trajectory`, whose samples were `measured` and which took `seconds`; `error` says why it ended early, if it did.
    pub(crate) fn new(
        trajectory: &Trajectory,
        measured: &ukcore::Drift,
        ready: &Ready<'_>,
        args: &RunArgs,
        seconds: f64,
        error: Option<String>,
    ) -> Self {
        let (mechanism, spec) = (trajectory.mechanism(), trajectory.spec());
        let coords = || spec.coords.iter().copied();
        let last = trajectory.last().map(|last| {
            let mut outputs = vec![0.0; spec.outputs.len()];
            mechanism.outputs(last.t, last.q, last.v, &mut outputs);
            let energy = mechanism.energy(last.t, last.q, last.v);
            Last {
                t: last.t,
                q: named(coords(), last.q.iter().copied()),
                v: named(coords(), last.v.iter().copied()),
                outputs: named(spec.outputs.iter().map(|o| o.name), outputs),
                energy: Energies {
                    kinetic: energy.kinetic,
                    potential: energy.potential,
                },
            }
        });
        let values = mechanism.parameters().iter().copied();
        let work = trajectory.work();
        Summary {
            model: ready.entry.id.clone(),
            start: ready.start,
            parameters: named(spec.params.iter().map(|p| p.name), values),
            method: args.method.to_string(),
            stabilise: args.stabilise.to_string(),
            tolerance: (!matches!(args.method, Method::Rattle { .. })).then_some(args.tol),
            ending: match trajectory.ending() {
                Ending::Completed => "completed",
                Ending::Event => "event",
                Ending::Interrupted => "interrupted",
                Ending::Failed => "failed",
            },
            error,
            last,
            samples: measured.samples(),
            drift: Drift::measured(measured, spec),
            work: Counters {
                steps: work.steps,
                rejected: work.rejected,
                switches: work.switches,
                evaluations: work.evaluations,
                jacobians: work.jacobians,
                factorisations: work.factorisations,
                projections: work.projections,
                projection_iterations: work.projection_iterations,
                fallbacks: work.fallbacks,
            },
            seconds,
        }
    }

    /// Writes the summary for reading.
    ///
    /// # Errors
    /// Those of `out`.
    pub(crate) fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(
            out,
            "{} from `{}`, {}{}, {}",
            self.model,
            self.start,
            self.method,
            self.tolerance
                .map_or(String::new(), |tol| format!(" at tolerance {tol:e}")),
            self.ending
        )?;
        if let Some(last) = &self.last {
            let wide = width(last.q.keys().chain(last.outputs.keys()).map(String::as_str));
            writeln!(out, "\nState at t = {} s", full(last.t))?;
            for ((name, q), v) in last.q.iter().zip(last.v.values()) {
                writeln!(
                    out,
                    "  {name:<wide$} {:>18}   dot {:>18}",
                    number(q),
                    number(v)
                )?;
            }
            if !last.outputs.is_empty() {
                writeln!(out, "\nOutputs")?;
                for (name, value) in &last.outputs {
                    writeln!(out, "  {name:<wide$} {:>18}", number(value))?;
                }
            }
        }
        let (d, w) = (&self.drift, &self.work);
        writeln!(
            out,
            "\nResiduals: position {:.1e}, velocity {:.1e} at most over {}",
            d.position_residual,
            d.velocity_residual,
            count(self.samples, "sample")
        )?;
        match d.energy_drift {
            Some(drift) => writeln!(out, "Energy drift: {drift:.1e} of the energy exchanged")?,
            None => writeln!(out, "Energy is not conserved in this model")?,
        }
        let implicit = match (w.jacobians, w.factorisations) {
            (0, 0) => String::new(),
            (jacobians, factorisations) => format!(
                ", {}, {}",
                count(jacobians, "Jacobian"),
                count(factorisations, "factorisation")
            ),
        };
        writeln!(
            out,
            "Work: {} ({} rejected, {} onto switches), {}{implicit}, {} ({}), {}; {:.3} s",
            count(w.steps, "step"),
            w.rejected,
            w.switches,
            count(w.evaluations, "evaluation"),
            count(w.projections, "projection"),
            count(w.projection_iterations, "iteration"),
            count(w.fallbacks, "fallback"),
            self.seconds
        )
    }
}

fn number(value: &Value) -> String {
    value
        .as_f64()
        .map_or_else(|| "not finite".to_owned(), |v| fixed(v, 12))
}
