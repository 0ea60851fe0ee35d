//! All models in turn.

use models::{Entry, StartOptions};
use tests::Random;
use ukcore::solver::SolverOptions;
use ukcore::{Solver, State};

/// Runs `check` on every model of the registry.
pub(crate) fn every_model(check: impl Fn(&Entry)) {
    let models = models::entries();
    assert!(!models.is_empty(), "the registry has no model");
    models.iter().for_each(check);
}

/// Runs `check` on every model of the registry in each of twenty random states near its start, on its constraints. They come from a
/// generator with this seed, a new one for each model, which `check` may draw more from; its solver serves all states of a model.
pub(crate) fn every_state(seed: u64, check: impl Fn(&Entry, &State, &mut Solver, &mut Random)) {
    every_model(|model| {
        let mut random = Random::new(seed);
        let mut solver = Solver::new(&model.mechanism, SolverOptions::default());
        for _ in 0..20 {
            let state = random.near(&model.mechanism, start(model), 0.01);
            check(model, &state, &mut solver, &mut random);
        }
    });
}

/// The default start of a model with its default parameters.
#[must_use]
pub(crate) fn start(model: &Entry) -> State {
    let name = model.starts.first().map_or("", |start| start.name);
    let start = model.start(&model.mechanism, name, &StartOptions::new());
    start.expect("the default start exists")
}
