//! What is compared: the one list of combinations of method, formula and stabilisation.

use ukcore::manifold::Stabilisation;
use ukcore::simulate::Switching;
use ukcore::solver::{Baumgarte, Formula};
use ukcore::spec::Spec;
use ukcore::{Method, Simulation};

use Engine::{Adaptive, Rattle};
use Method::{Dop853, Dopri5, Radau5};
use Stabilisation::{None, Projection};
use Switching::{Ignored, Located};

const AUTOMATIC: Option<Formula> = Some(Formula::Auto);
const DENSE: Option<Formula> = Some(Formula::Kkt);
const GENERAL: Option<Formula> = Option::None;

/// How a method advances, and what its accuracy is set by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Engine {
    /// Steps of its own choice, by a tolerance.
    Adaptive(Method),
    /// RATTLE, by the size of its equal steps.
    Rattle,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Variant {
    /// The variant's name in JSON and CSV.
    pub(super) name: &'static str,
    /// The variant's name on the page.
    pub(super) label: &'static str,
    pub(super) engine: Engine,
    /// The formula: [`Formula::Auto`] is the straight line where there is one; none is the rank-revealing solve of eq. 13, or of eq. 19
    /// where M is singular.
    pub(super) formula: Option<Formula>,
    pub(super) stabilisation: Stabilisation,
    /// What is done about kinks and jumps.
    pub(super) switching: Switching,
}

const fn baumgarte(rate: f64) -> Stabilisation {
    Stabilisation::Baumgarte(Baumgarte {
        alpha: rate,
        beta: rate,
    })
}

macro_rules! variants {
    ($($name:literal $label:literal $engine:expr, $formula:expr, $stabilisation:expr, $switching:expr;)*) => {
        &[$(Variant {
            name: $name,
            label: $label,
            engine: $engine,
            formula: $formula,
            stabilisation: $stabilisation,
            switching: $switching,
        }),*]
    };
}

/// All combinations; the first is the default of [`Simulation`]. Of two that cost alike the earlier one is recommended.
pub(super) const VARIANTS: &[Variant] = variants! {
    "dop853" "DOP853, projection"                         Adaptive(Dop853), AUTOMATIC, Projection, Located;
    "dopri5" "DOPRI5, projection"                         Adaptive(Dopri5), AUTOMATIC, Projection, Located;
    "radau5" "Radau IIA 5, projection"                    Adaptive(Radau5), AUTOMATIC, Projection, Located;
    "rattle" "RATTLE"                                     Rattle, AUTOMATIC, Projection, Located;
    "dop853-across" "DOP853, projection, across switches" Adaptive(Dop853), AUTOMATIC, Projection, Ignored;
    "dop853-none" "DOP853, no stabilisation"              Adaptive(Dop853), AUTOMATIC, None, Located;
    "dopri5-none" "DOPRI5, no stabilisation"              Adaptive(Dopri5), AUTOMATIC, None, Located;
    "dop853-baumgarte20" "DOP853, Baumgarte 20/s"         Adaptive(Dop853), AUTOMATIC, baumgarte(20.0), Located;
    "dop853-baumgarte200" "DOP853, Baumgarte 200/s"       Adaptive(Dop853), AUTOMATIC, baumgarte(200.0), Located;
    "dop853-general" "DOP853, projection, eq. 13 or 19"   Adaptive(Dop853), GENERAL, Projection, Located;
    "dopri5-general" "DOPRI5, projection, eq. 13 or 19"   Adaptive(Dopri5), GENERAL, Projection, Located;
    "dop853-kkt" "DOP853, projection, dense KKT"          Adaptive(Dop853), DENSE, Projection, Located;
};

/// Combinations that the list leaves out, and why.
pub(super) const OMITTED: &str = "Not in the list: DOPRI5 with Baumgarte's feedback and with the dense KKT, and other stabilisations than \
     projection with a formula other than the automatic one. What they cost follows from what is measured, since a method, a formula and a \
     stabilisation act on the run independently of each other. With Baumgarte's feedback the automatic choice is eq. 13 or 19: there is no \
     straight line for it.";

/// The combination called `name`.
pub(super) fn named(name: &str) -> Option<&'static Variant> {
    VARIANTS.iter().find(|v| v.name == name)
}

/// What the combination called `name` is called on the page.
pub(super) fn label(name: &str) -> &str {
    named(name).map_or(name, |v| v.label)
}

impl Variant {
    /// The default of [`Simulation`].
    pub(super) fn default() -> &'static Variant {
        &VARIANTS[0]
    }

    /// Whether the constraints hold to rounding at the end of each step.
    pub(super) fn keeps_constraints(&self) -> bool {
        self.engine == Rattle || self.stabilisation == Projection
    }

    /// Whether there is no straight line for it in any model: evaluations are then dearer by up to two orders, and fewer tolerances have to
    /// do.
    fn is_dense(&self) -> bool {
        let feedback = matches!(self.stabilisation, Stabilisation::Baumgarte(_));
        self.formula != AUTOMATIC || feedback
    }

    /// Why the combination makes no sense for a model with this `spec`, if so.
    pub(super) fn senseless(&self, spec: &Spec) -> Option<&'static str> {
        if spec.m() == 0 && self.stabilisation != Projection {
            return Some("without constraints nothing drifts");
        }
        if spec.switches.is_empty() && self.switching == Ignored {
            return Some("there is no switch to step across");
        }
        if self.formula == GENERAL && !spec.structure.straight_line {
            return Some("the automatic choice is this formula: there is no straight line");
        }
        Option::None
    }

    /// The settings of accuracy to run, loose to tight, for a motion that lasts `span`, s. A quick look runs those that the page speaks of.
    pub(super) fn knobs(&self, span: f64, quick: bool) -> Vec<f64> {
        let exponents: &[i32] = match (self.engine, quick, self.is_dense()) {
            (Adaptive(_), true, false) => &[3, 6, 9, 12],
            (Adaptive(_), true, true) => &[6, 9],
            (Adaptive(_), false, false) => &[3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13],
            (Adaptive(_), false, true) => &[3, 5, 7, 9, 11, 13],
            (Rattle, true, _) => &[7, 9, 11],
            (Rattle, false, _) => &[5, 6, 7, 8, 9, 10, 11, 12, 13],
        };
        let knob = |k: &i32| match self.engine {
            Adaptive(_) => 10_f64.powi(-k),
            Rattle => span * 2_f64.powi(-k),
        };
        exponents.iter().map(knob).collect()
    }

    /// `simulation` with these settings; `general` is the formula that fits the mass matrix of the model.
    pub(super) fn apply(&self, simulation: Simulation, knob: f64, general: Formula) -> Simulation {
        let simulation = simulation
            .stabilise(self.stabilisation)
            .switching(self.switching)
            .formula(self.formula.unwrap_or(general));
        match self.engine {
            Adaptive(method) => simulation.method(method).tolerance(knob),
            Rattle => simulation.method(Method::Rattle { step: knob }),
        }
    }

    /// What the setting of accuracy is.
    pub(super) fn knob_name(&self) -> &'static str {
        match self.engine {
            Adaptive(_) => "tolerance",
            Rattle => "step",
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
        assert_eq!(named("dop852"), Option::None);
        assert_eq!(Variant::default().stabilisation, Stabilisation::default());
        assert_eq!(Variant::default().engine, Adaptive(Method::default()));
    }
}
