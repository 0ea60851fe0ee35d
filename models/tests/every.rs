//! All models in turn.

use models::{Entry, Model, StartOptions, Visitor};
use tests::Random;
use ukcore::{Solver, SolverOptions, State};

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

/// A test of any model that needs its type, and is compiled for each.
pub(crate) trait Check {
    /// Tests the model `M`; panics where it fails.
    fn check<M: Model>(&self);
}

/// Runs `check` on the type of every model of the registry.
pub(crate) fn every_type(check: &impl Check) {
    struct Run<'a, C>(&'a C);
    impl<C: Check> Visitor for Run<'_, C> {
        type Output = ();
        fn visit<M: Model>(self) {
            self.0.check::<M>();
        }
    }
    let mut visited = 0;
    for id in models::ids() {
        models::visit(id, Run(check)).expect("ids() names registered models");
        visited += 1;
    }
    assert!(visited > 0, "the registry has no model");
}
