//! What is compared: the one list of combinations of method, formula and stabilisation.

use ukcore::{Baumgarte, Formula, Method, Simulation, Spec, Stabilisation, Switching};

use models::Model;

/// Where the accelerations come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Solve {
    /// [`Formula::Auto`]: the straight line where there is one.
    Automatic,
    /// Gaussian elimination of the dense [M Aᵀ; A 0].
    Dense,
    /// The rank-revealing solve of eq. 13, or of eq. 19 where M is singular.
    General,
}

/// How a method advances, and what its accuracy is set by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Engine {
    /// Steps of its own choice, by a tolerance.
    Adaptive(Method),
    /// RATTLE, by the size of its equal steps.
    Rattle,
}

/// A combination.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Variant {
    /// Its name in JSON and CSV.
    pub(super) name: &'static str,
    /// Its name on the page.
    pub(super) label: &'static str,
    /// The method.
    pub(super) engine: Engine,
    /// The solver.
    pub(super) solve: Solve,
    /// The stabilisation.
    pub(super) stabilisation: Stabilisation,
    /// What is done about kinks and jumps.
    pub(super) switching: Switching,
}

/// Rate of Baumgarte's feedback that `uk run` takes, too, 1/s.
const SLOW: Stabilisation = baumgarte(20.0);
/// A stiffer one.
const FAST: Stabilisation = baumgarte(200.0);

const fn baumgarte(rate: f64) -> Stabilisation {
    Stabilisation::Baumgarte(Baumgarte {
        alpha: rate,
        beta: rate,
    })
}

const fn variant(
    name: &'static str,
    label: &'static str,
    engine: Engine,
    solve: Solve,
    stabilisation: Stabilisation,
) -> Variant {
    Variant {
        name,
        label,
        engine,
        solve,
        stabilisation,
        switching: Switching::Located,
    }
}

/// All combinations; the first is the default of [`Simulation`]. Of two that cost alike the earlier one is recommended.
pub(super) const VARIANTS: &[Variant] = {
    const DOP853: Engine = Engine::Adaptive(Method::Dop853);
    const DOPRI5: Engine = Engine::Adaptive(Method::Dopri5);
    const RADAU5: Engine = Engine::Adaptive(Method::Radau5);
    use Engine::Rattle;
    use Solve::{Automatic, Dense, General};
    use Stabilisation::{None, Projection};
    &[
        variant(
            "dop853",
            "DOP853, projection",
            DOP853,
            Automatic,
            Projection,
        ),
        variant(
            "dopri5",
            "DOPRI5, projection",
            DOPRI5,
            Automatic,
            Projection,
        ),
        variant(
            "radau5",
            "Radau IIA 5, projection",
            RADAU5,
            Automatic,
            Projection,
        ),
        variant("rattle", "RATTLE", Rattle, Automatic, Projection),
        Variant {
            switching: Switching::Ignored,
            ..variant(
                "dop853-across",
                "DOP853, projection, across switches",
                DOP853,
                Automatic,
                Projection,
            )
        },
        variant(
            "dop853-none",
            "DOP853, no stabilisation",
            DOP853,
            Automatic,
            None,
        ),
        variant(
            "dopri5-none",
            "DOPRI5, no stabilisation",
            DOPRI5,
            Automatic,
            None,
        ),
        variant(
            "dop853-baumgarte20",
            "DOP853, Baumgarte 20/s",
            DOP853,
            Automatic,
            SLOW,
        ),
        variant(
            "dop853-baumgarte200",
            "DOP853, Baumgarte 200/s",
            DOP853,
            Automatic,
            FAST,
        ),
        variant(
            "dop853-general",
            "DOP853, projection, eq. 13 or 19",
            DOP853,
            General,
            Projection,
        ),
        variant(
            "dopri5-general",
            "DOPRI5, projection, eq. 13 or 19",
            DOPRI5,
            General,
            Projection,
        ),
        variant(
            "dop853-kkt",
            "DOP853, projection, dense KKT",
            DOP853,
            Dense,
            Projection,
        ),
    ]
};

/// Combinations that the list leaves out, and why.
pub(super) const OMITTED: &str = "Not in the list: DOPRI5 with Baumgarte's feedback and with the dense KKT, and other stabilisations than projection with a formula other than \
     the automatic one. What they cost follows from what is measured, since a method, a formula and a stabilisation act on the run independently of each \
     other. With Baumgarte's feedback the automatic choice is eq. 13 or 19: there is no straight line for it.";

/// The combination called `name`.
pub(super) fn named(name: &str) -> Option<&'static Variant> {
    VARIANTS.iter().find(|v| v.name == name)
}

impl Variant {
    /// The default of [`Simulation`].
    pub(super) fn default() -> &'static Variant {
        &VARIANTS[0]
    }

    /// Whether the constraints hold to rounding at the end of each step.
    pub(super) fn keeps_constraints(&self) -> bool {
        self.engine == Engine::Rattle || self.stabilisation == Stabilisation::Projection
    }

    /// Whether there is no straight line for it in any model: evaluations are then dearer by up to two orders, and fewer tolerances have to do.
    fn is_dense(&self) -> bool {
        let feedback = matches!(self.stabilisation, Stabilisation::Baumgarte(_));
        self.solve != Solve::Automatic || feedback
    }

    /// Why the combination makes no sense for a model with this `spec`, if so.
    pub(super) fn senseless(&self, spec: &Spec) -> Option<&'static str> {
        if spec.m() == 0 && self.stabilisation != Stabilisation::Projection {
            return Some("without constraints nothing drifts");
        }
        if spec.switches.is_empty() && self.switching == Switching::Ignored {
            return Some("there is no switch to step across");
        }
        if self.solve == Solve::General && !spec.structure.straight_line {
            return Some("the automatic choice is this formula: there is no straight line");
        }
        None
    }

    /// The settings of accuracy to run, loose to tight, for a motion that lasts `span`, s.
    pub(super) fn knobs(&self, span: f64, quick: bool) -> Vec<f64> {
        let exponents: &[i32] = match (self.engine, quick, self.is_dense()) {
            (Engine::Adaptive(_), true, false) => &[4, 6, 8, 10],
            (Engine::Adaptive(_), true, true) => &[5, 8],
            (Engine::Adaptive(_), false, false) => &[3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13],
            (Engine::Adaptive(_), false, true) => &[3, 5, 7, 9, 11, 13],
            (Engine::Rattle, true, _) => &[7, 9, 11],
            (Engine::Rattle, false, _) => &[5, 6, 7, 8, 9, 10, 11, 12, 13],
        };
        let knob = |k: &i32| match self.engine {
            Engine::Adaptive(_) => 10_f64.powi(-k),
            Engine::Rattle => span * 2_f64.powi(-k),
        };
        exponents.iter().map(knob).collect()
    }

    /// `simulation` with these settings; `general` is the formula that fits the mass matrix of the model.
    pub(super) fn apply<M: Model>(
        &self,
        simulation: Simulation<M>,
        knob: f64,
        general: Formula,
    ) -> Simulation<M> {
        let simulation = simulation
            .stabilise(self.stabilisation)
            .switching(self.switching)
            .formula(match self.solve {
                Solve::Automatic => Formula::Auto,
                Solve::Dense => Formula::Kkt,
                Solve::General => general,
            });
        match self.engine {
            Engine::Adaptive(method) => simulation.method(method).tolerance(knob),
            Engine::Rattle => simulation.method(Method::Rattle { step: knob }),
        }
    }

    /// The setting of accuracy in words, HTML.
    pub(super) fn knob_name(&self) -> &'static str {
        match self.engine {
            Engine::Adaptive(_) => "tolerance",
            Engine::Rattle => "step",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_distinct_and_found() {
        for variant in VARIANTS {
            assert_eq!(named(variant.name), Some(variant));
        }
        assert_eq!(named("dop852"), None);
        assert_eq!(Variant::default().stabilisation, Stabilisation::default());
        assert_eq!(
            Variant::default().engine,
            Engine::Adaptive(Method::default())
        );
    }
}
