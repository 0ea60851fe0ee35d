//! One integration of the report, and what is told of every one of them.

use std::time::Instant;

use serde::Serialize;
use ukcore::manifold::Stabilisation;
use ukcore::simulate::Switching;
use ukcore::solver::SolverOptions;
use ukcore::{Event, Method, Simulation, Solver, State, Trajectory};
use uktool::drift::Drift;
use uktool::failure::Failure;
use uktool::motion::{self, Steps};
use uktool::scene::{Ready, Start};
use uktool::{animate, command};

use super::TOLERANCE;

/// Interval of the samples that are written as CSV and whose drift is told, s.
const SAMPLES: f64 = 0.01;

/// Pictures of a motion that is played.
const PICTURES: u32 = 301;

/// A page that plays motions of the model `id` up to `until`, s, side by side under their labels.
pub(super) fn film(id: &str, runs: [(String, Start); 2], until: f64) -> Result<String, Failure> {
    let motion = motion::Motion {
        until: Some(until),
        tol: TOLERANCE,
        method: Method::Dop853,
        steps: Steps {
            max_steps: 1_000_000,
            max_step: None,
            switching: Switching::Located,
        },
        stabilise: Stabilisation::Projection,
    };
    let models = models::entries();
    animate::page_of(command::find(&models, id)?, runs, &motion, PICTURES)
}

/// A computed motion, and its accelerations.
pub(super) struct Motion {
    solver: Solver,
    pub(super) trajectory: Trajectory,
}

/// Cost and quality of one integration.
#[derive(Debug, Serialize)]
pub(super) struct RunRow {
    /// Name, also of the CSV file.
    pub(super) name: String,
    /// End, s.
    pub(super) until: f64,
    pub(super) steps: usize,
    pub(super) rejected: usize,
    pub(super) evaluations: usize,
    pub(super) projections: usize,
    /// Evaluations that fell back to a more general formula.
    pub(super) fallbacks: usize,
    #[serde(flatten)]
    pub(super) drift: Drift,
    /// Wall time, s.
    pub(super) seconds: f64,
    /// The samples as CSV.
    #[serde(skip)]
    pub(super) csv: Vec<u8>,
}

impl Motion {
    /// Integrates the model `id` from `start` to `until`, with an event.
    pub(super) fn new(
        name: &str,
        id: &str,
        start: &Start,
        until: f64,
        event: Option<Event>,
    ) -> Result<(Self, RunRow), Failure> {
        let models = models::entries();
        let Ready {
            mechanism, state, ..
        } = start.ready(command::find(&models, id)?)?;
        let started = Instant::now();
        let mut simulation = Simulation::new(&mechanism)
            .start(state)
            .tolerance(TOLERANCE)
            .every(SAMPLES)
            .dense();
        if let Some(event) = event {
            simulation = simulation.event(event);
        }
        let trajectory = simulation
            .until(until)
            .map_err(|f| Failure::Failed(format!("{name}: {}", f.error)))?;
        let seconds = started.elapsed().as_secs_f64();
        let (work, mut csv) = (trajectory.work(), Vec::new());
        let written = trajectory.write_csv(&mut csv);
        written.map_err(|e| Failure::Failed(format!("cannot format CSV: {e}")))?;
        let run = RunRow {
            name: name.to_owned(),
            until,
            steps: work.steps,
            rejected: work.rejected,
            evaluations: work.evaluations,
            projections: work.projections,
            fallbacks: work.fallbacks,
            drift: Drift::of(&trajectory),
            seconds,
            csv,
        };
        let solver = Solver::new(mechanism, SolverOptions::default());
        Ok((Motion { solver, trajectory }, run))
    }

    /// The state at `t`.
    pub(super) fn state(&self, t: f64) -> Result<State, Failure> {
        Ok(self.trajectory.at(t)?)
    }

    /// q̈ at `t`.
    pub(super) fn acceleration(&mut self, t: f64) -> Result<Vec<f64>, Failure> {
        let state = self.state(t)?;
        let mut out = vec![0.0; state.q.len()];
        let solver = &mut self.solver;
        solver.acceleration(t, &state.q, &state.v, &mut out)?;
        Ok(out)
    }
}

/// `count` + 1 times from `from` to `to`, both included.
pub(super) fn times(from: f64, to: f64, count: u32) -> impl Iterator<Item = f64> {
    (0..=count).map(move |k| from + (to - from) * f64::from(k) / f64::from(count))
}
