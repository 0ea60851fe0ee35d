//! Many motions of one mechanism at once: other starts, other parameters.
//!
//! Each core takes some members at a time, one in each lane of its numbers. A member has its own step sizes, its own rejections and
//! projections, and when it has ended the next one takes its lane; lanes that step together would all take the smallest step of them, and
//! all repeat what one rejects. So the result of a member depends neither on its neighbours nor on the number of threads, bit by bit.
//!
//! Per member the run is that of a [`Simulation`] with [`Method::Dop853`](crate::Method), projection and steps across switches
//! ([`Switching::Ignored`](super::Switching): a lane is not taken back to a kink of its own); results agree to the tolerance where there
//! are no switches, not bit by bit, as lanes round sines otherwise and their projections end elsewhere within rounding.

use std::sync::atomic::AtomicUsize;

use rayon::iter::{IntoParallelIterator, ParallelIterator};

use super::agenda::Sampling;
use super::{Sample, Simulation, Switching};
use crate::assemble::State;
use crate::error::Error;
use crate::mechanism::{Mechanism, Prepared};
use crate::trajectory::{Trajectory, Work};

mod group;
mod running;

use group::Group;

/// Numbers that the members of a group share: as wide as the registers are. Measured with AVX-512, eight lanes take 0.7 of the time of
/// four.
#[cfg(target_feature = "avx512f")]
type Wide = wide::f64x8;
/// Numbers that the members of a group share: as wide as the registers are.
#[cfg(not(target_feature = "avx512f"))]
type Wide = wide::f64x4;

/// An ensemble: members and settings, then [`until`](Ensemble::until).
#[derive(Debug, Clone)]
pub struct Ensemble {
    members: Vec<(Prepared, State)>,
    /// The mechanism in lanes, with whatever parameters.
    lanes: Prepared<Wide>,
    tolerance: f64,
    sampling: Sampling,
    max_steps: usize,
}

/// The motion of one member.
#[derive(Debug, Clone, PartialEq)]
pub struct Member {
    /// The state at the end.
    pub end: State,
    /// What is integrated along the motion, from its start to its end, in the order of
    /// [`Mechanism::INTEGRALS`](crate::Mechanism::INTEGRALS).
    pub integrals: Vec<f64>,
    /// The samples asked for, in the order of integration.
    pub samples: Vec<State>,
    /// What the motion cost.
    pub work: Work,
}

impl Member {
    /// What is kept of a run from `start`.
    fn of(run: &Trajectory, start: &State) -> Self {
        let end = run.last().unwrap_or_else(|| Sample::from(start));
        Member {
            end: end.to_state(),
            integrals: end.integrals.to_vec(),
            samples: run.samples().map(Sample::to_state).collect(),
            work: run.work(),
        }
    }
}

impl Ensemble {
    /// An ensemble of mechanisms and their starts, at tolerance 1e-9, without samples, with at most 10⁷ steps for each.
    #[must_use]
    pub fn new<M: Mechanism>(members: Vec<(M, State)>) -> Self {
        let prepared = |(mechanism, start): (M, State)| (mechanism.prepared(), start);
        Ensemble {
            members: members.into_iter().map(prepared).collect(),
            lanes: M::default().prepared(),
            tolerance: 1e-9,
            sampling: Sampling::At(Vec::new()),
            max_steps: 10_000_000,
        }
    }

    /// Relative and absolute tolerance of the integration, as for [`Simulation::tolerance`]; 1e-9 where nothing is said.
    #[must_use]
    pub fn tolerance(mut self, tolerance: f64) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// Samples of each member at t₀ + k `dt`, and at its end, as [`Simulation::every`].
    #[must_use]
    pub fn every(mut self, dt: f64) -> Self {
        self.sampling = Sampling::Every(dt);
        self
    }

    /// Samples of each member at these times, as [`Simulation::at`].
    #[must_use]
    pub fn at(mut self, times: Vec<f64>) -> Self {
        self.sampling = Sampling::At(times);
        self
    }

    /// Largest number of attempted steps of each member, at least 1.
    #[must_use]
    pub fn max_steps(mut self, steps: usize) -> Self {
        self.max_steps = steps;
        self
    }

    /// Runs each member from its start to `t_end`, on all threads of the current rayon pool. Results are in the order of the members.
    ///
    /// A member that fails ends alone, with an error as [`Simulation::until`] has it.
    pub fn until(&self, t_end: f64) -> Vec<Result<Member, Error>> {
        let Some((mechanism, _)) = self.members.first() else {
            return Vec::new();
        };
        let threads = rayon::current_num_threads().max(1);
        let next = AtomicUsize::new(0);
        // Few members are shared out evenly.
        let capacity = self.members.len().div_ceil(threads);
        let run = |_| Group::new(self, mechanism, t_end, &next, capacity).run();
        let parts: Vec<_> = (0..threads).into_par_iter().map(run).collect();
        let mut all: Vec<_> = parts.into_iter().flatten().collect();
        all.sort_by_key(|(index, _)| *index);
        all.into_iter().map(|(_, result)| result).collect()
    }

    /// The motion of member `index` as it is alone: lanes do not pass singular positions.
    fn alone(&self, index: usize, t_end: f64) -> Result<Member, Error> {
        let simulation = self.simulation(index).switching(Switching::Ignored);
        let run = simulation.until(t_end).map_err(|failure| failure.error)?;
        Ok(Member::of(&run, &self.members[index].1))
    }

    /// Member `index` alone.
    fn simulation(&self, index: usize) -> Simulation {
        let (mechanism, start) = &self.members[index];
        let mut simulation = Simulation::new(mechanism.clone());
        simulation.start = Some(start.clone());
        simulation.tolerance = self.tolerance;
        simulation.sampling = self.sampling.clone();
        simulation.max_steps = self.max_steps;
        simulation
    }
}
