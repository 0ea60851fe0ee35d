//! Every failure, in the modeller's own names.

use std::fmt;

use crate::numbers::full;

/// What can go wrong in solving, assembling and integrating a mechanism.
#[derive(Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// rank [M | Aᵀ] < n (the condition of eq. 19): these coordinates have neither mass nor constraint in some direction.
    #[error(
        "the motion is not determined: rank [M | Aᵀ] is {rank}, not {needed}; {} can accelerate without mass or constraint; give mass, add \
         a constraint, or take other coordinates where these are two angles about axes that fall in line",
        quoted(coordinates)
    )]
    Underdetermined {
        /// Names of the coordinates that move in the undetermined directions.
        coordinates: Vec<String>,
        /// The rank of [M | Aᵀ].
        rank: usize,
        /// The number n of coordinates, which that rank has to be.
        needed: usize,
    },
    /// A q̈ = b has no solution: these constraints contradict each other.
    #[error(
        "constraints contradict each other (residual of A q̈ − b): {}; remove one of them or make them agree",
        named(constraints)
    )]
    Inconsistent {
        /// Names of the constraints involved, with the residual of A q̈ − b.
        constraints: Vec<(String, f64)>,
    },
    /// The state does not satisfy these constraints (φ or φ̇), and no nearby state does or was asked for.
    #[error(
        "the state violates constraints at {level} level (residual): {}; a start has to be consistent, as one from `assemble` is, and on \
         the way the constraints must not come to contradict each other",
        named(constraints)
    )]
    OffConstraint {
        /// The level of the constraints: `"position"` or `"velocity"`.
        level: &'static str,
        /// Names of the constraints, with their residual.
        constraints: Vec<(String, f64)>,
    },
    /// `assemble` found no state near the guess.
    #[error(
        "no state near the guess satisfies the constraints at {level} level (residual that remains): {}; {}",
        named(constraints),
        remedy(held)
    )]
    NotAssembled {
        /// The level of the constraints: `"position"` or `"velocity"`.
        level: &'static str,
        /// Names of the constraints that are not met, with the residual that remains.
        constraints: Vec<(String, f64)>,
        /// Names of the held coordinates without whose values there would be such a state, `dot(x)` where only a velocity is held; empty if
        /// holding is not the cause.
        held: Vec<String>,
    },
    /// A value is NaN or infinite.
    #[error("not a finite number: {}", what.join(", "))]
    NonFinite {
        /// What is not finite: `"parameter m"`, `"coordinate x[3]"`, `"force on th1"`, `"constraint link[2]"`.
        what: Vec<String>,
    },
    /// M has a negative eigenvalue, or is not what a mass matrix can be.
    #[error(
        "the mass matrix is not positive semidefinite at {}; masses must not be negative, and an entry (x, y) is at most √(M[x, x] M[y, y])",
        quoted(coordinates)
    )]
    IndefiniteMass {
        /// Coordinates at which the factorisation failed.
        coordinates: Vec<String>,
    },
    /// A name that is not there.
    #[error("no {kind} is called `{name}`{}", alternatives(nearest.as_deref(), known))]
    UnknownName {
        /// What the name was to be of: `"parameter"`, `"coordinate"`, `"model"`, ….
        kind: &'static str,
        /// The name that was asked for.
        name: String,
        /// The nearest name that exists.
        nearest: Option<String>,
        /// All names that exist.
        known: Vec<String>,
    },
    /// A vector of the wrong length.
    #[error("`{what}` has length {found}, but {expected} is needed")]
    WrongLength {
        /// The vector whose length is wrong, by its letter, such as `"q"`.
        what: &'static str,
        /// The vector's length as given.
        found: usize,
        /// The vector's length as needed.
        expected: usize,
    },
    /// A setting outside of its range.
    #[error("`{what}` {reason}")]
    InvalidSetting {
        /// The setting that is outside of its range.
        what: &'static str,
        /// What is wrong and what is allowed.
        reason: String,
    },
    /// These constraints come to be implied by the others, or have no gradient: a singular position, where branches of the motion may meet.
    /// One that branches cross in is passed, in the branch on which the motion came, without a jump of its velocity. This one cannot be:
    /// rounding does not tell whether branches cross there or turn away from each other, or the motion can go on in many ways, as from the
    /// apex of a cone, or the run begins or ends too close to it.
    #[error(
        "a singular position, where {}: nothing tells in which way the motion goes on; end the run before it, start it elsewhere, or \
         change lengths or the start such that the position is met exactly on the way or missed by more",
        lost(constraints)
    )]
    Singular {
        /// The names of the constraints.
        constraints: Vec<String>,
    },
    /// These constraints move away from the motion faster than any step follows: prescribed motion that jumps, or a path with a kink.
    #[error(
        "constraints jump at {level} level (residual after a step of no length): {}; a prescribed motion must not jump, nor its velocity, \
         nor a path have a kink: smooth it, or end the run there and start another behind it",
        named(constraints)
    )]
    Jump {
        /// The level of the constraints: `"position"` or `"velocity"`.
        level: &'static str,
        /// Names of the constraints, with their residual after the shortest step.
        constraints: Vec<(String, f64)>,
    },
    /// What these constraints prescribe by the time has come to the limit of its motion: a dead centre, where it would have to stand still
    /// while the mechanism goes on.
    #[error(
        "the mechanism cannot follow {} beyond this position, a dead centre: what is driven has come to the limit of its motion and would stand \
         still, while `{leader}` goes on; prescribe less (`kinematics` tells how far a drive goes), end the run before, or drive `{leader}` instead",
        quoted(constraints)
    )]
    DeadCentre {
        /// Names of the constraints that prescribe the motion.
        constraints: Vec<String>,
        /// The coordinate that moves most there, measured by the root of its inertia, or an angle that moves at least half as far.
        leader: String,
    },
    /// Steps became so small that the run does not get on.
    #[error("{}", too_small(*step, fastest.as_ref()))]
    StepTooSmall {
        /// Step size; 0 where no step was tried.
        step: f64,
        /// The coordinate with the largest acceleration beside the error allowed in its velocity, and this acceleration, if there is one.
        fastest: Option<(String, f64)>,
    },
    /// Rounding of accelerations makes more of a step than any motion could be told by.
    #[error(
        "rounding makes {share:.0e} of the motion in one step here, most of it along `{coordinate}`: {}",
        rounded(*time)
    )]
    Rounding {
        /// The coordinate whose acceleration is known least.
        coordinate: String,
        /// The estimated error of the step, as a share of the motion.
        share: f64,
        /// The rounding of the time, where most of the rounding is of it.
        time: Option<f64>,
    },
    /// Steps became so small that the time does not tell their ends apart: so late it is known no better.
    #[error(
        "steps of {step:.1e} are nothing beside the time, which is known to {rounding:.1e} so late; count it from a moment near the start, \
         or loosen the tolerance"
    )]
    TooLate {
        /// The size of the last step.
        step: f64,
        /// The rounding of the time.
        rounding: f64,
    },
    /// The number of steps allowed was used up.
    #[error(
        "{steps} steps were not enough; where forces are stiff, soften them or take `Method::Radau5` in place of an explicit method; else \
         loosen the tolerance, or raise `max_steps`"
    )]
    TooManySteps {
        /// The number of steps that were allowed.
        steps: usize,
    },
    /// Steps became tiny about a place where sign, abs, min or max switch or the direction v/|v| of a vector turns, as where dry friction
    /// brings a body to rest.
    #[error(
        "{} a switch of sign, abs, min, max or v/|v| in the {}{}; {} by a terminal event, or smooth the switch, as by tanh(v / 1e-3) for \
         sign(v), sqrt(sq(v) + sq(1e-3)) for |v|",
        if *step == 0.0 { "both branches of".to_owned() } else { format!("steps fell to {step:.1e} about") },
        terms.join(", "),
        if *step == 0.0 { " drive the motion back onto it" } else { "" },
        if terms.iter().all(|term| term.starts_with("constraint ")) {
            "nothing tells how the motion goes on where a constraint switches: end the run before"
        } else {
            "dry friction that brings a body to rest is not found to stick: end the run at rest"
        }
    )]
    Chattering {
        /// Size of the last steps; 0 where both branches were found to drive the motion back onto the switch.
        step: f64,
        /// The terms that contain such a function: `"force on s"`.
        terms: Vec<String>,
    },
    /// The direction v/|v| of a vector is asked for where the vector vanishes, as that of dry friction on a body at rest.
    #[error(
        "v/|v| has no direction where v vanishes, in the {}; let the run start with a velocity, or smooth the length, as by \
         sqrt(sq(v) + sq(1e-3)) for |v|",
        terms.join(", ")
    )]
    NoDirection {
        /// The terms that contain such a direction: `"force on x"`.
        terms: Vec<String>,
    },
    /// A state at the zero of a switching function where the motion near it has another linear part on each side, so that there is no
    /// linear motion, as of a joint that is stiffer in one direction than in the other.
    #[error(
        "no linear motion: `{function}` is 0, where the {} has a kink or a jump, and each side has a linear motion of its own; a run tells \
         the motion; else smooth the switch, or take a state a little to one side for the linear motion there",
        terms.join(", ")
    )]
    Kink {
        /// The switching function, as of sign, abs, min or max.
        function: String,
        /// The terms that contain it: `"force on x"`.
        terms: Vec<String>,
    },
    /// Another error that arose during integration, with the time and state where it did.
    #[error("at t = {}: {source}", full(*t))]
    At {
        /// The time at which the error arose.
        t: f64,
        /// The coordinates at that time.
        q: Vec<f64>,
        /// The velocities at that time.
        v: Vec<f64>,
        /// The error that arose there.
        source: Box<Error>,
    },
}

/// So many names are listed in full. Of more names that exist the nearest one alone is offered, if there is one; else, and of more names
/// concerned, the first ones.
const MOST_LISTED: usize = 8;

impl Error {
    /// An [`Error::InvalidSetting`].
    pub(crate) fn invalid(what: &'static str, reason: impl Into<String>) -> Self {
        let reason = reason.into();
        Error::InvalidSetting { what, reason }
    }

    /// An [`Error::NonFinite`] of one thing.
    pub(crate) fn non_finite(what: impl Into<String>) -> Self {
        let what = vec![what.into()];
        Error::NonFinite { what }
    }

    /// An [`Error::StepTooSmall`] of which no more is known.
    pub(crate) fn too_small(step: f64) -> Self {
        let fastest = None;
        Error::StepTooSmall { step, fastest }
    }

    /// An [`Error::UnknownName`] with `names`, and the nearest of them.
    pub fn unknown_name(
        kind: &'static str,
        name: &str,
        names: &mut dyn Iterator<Item = &str>,
    ) -> Self {
        let known: Vec<String> = names.map(str::to_owned).collect();
        let lower = name.to_lowercase();
        // Less than half of it differs, or one letter of two; or one is the beginning of the other.
        let alike = |n: &&String| {
            let differ = strsim::osa_distance(&lower, &n.to_lowercase());
            let length = n.chars().count().max(name.chars().count());
            (2 * differ < length || differ == 1 && length == 2).then_some(differ)
        };
        let begins = |n: &&String| {
            let n = n.to_lowercase();
            let [short, long] = if n.len() < lower.len() {
                [&n, &lower]
            } else {
                [&lower, &n]
            };
            short.len() > 2 && long.starts_with(short)
        };
        let nearest = known.iter().filter_map(|n| Some((alike(&n)?, n))).min();
        let nearest = nearest
            .map(|(_, n)| n)
            .or_else(|| known.iter().find(begins))
            .cloned();
        Error::UnknownName {
            kind,
            name: name.to_owned(),
            nearest,
            known,
        }
    }
}

/// The sentence on where the rounding of a step comes from, and what to do.
fn rounded(time: Option<f64>) -> String {
    match time {
        Some(time) => format!(
            "so late the time is known to {time:.1e}, in which what depends on it changes by so much; count it from a moment near the start"
        ),
        None => "coordinates are near a place where they tell little of it, as two angles about axes that all but fall in line, forces all \
                 but cancel, or a mass all but vanishes; take other coordinates, or a looser tolerance, whose steps go over the place"
            .to_owned(),
    }
}

/// Names with their residuals.
pub(crate) fn named(constraints: &[(String, f64)]) -> String {
    let text = |(name, residual): &(String, f64)| format!("`{name}` ({residual:.3e})");
    let texts: Vec<String> = constraints.iter().map(text).collect();
    texts.join(", ")
}

pub(crate) fn quoted(names: &[String]) -> String {
    let listed = match names.len() {
        len if len > MOST_LISTED => MOST_LISTED - 1,
        len => len,
    };
    let mut text: Vec<String> = names[..listed].iter().map(|n| format!("`{n}`")).collect();
    if listed < names.len() {
        text.push(format!("… ({} in all)", names.len()));
    }
    text.join(", ")
}

/// What to do where holding these coordinates is the cause, or is not.
fn remedy(held: &[String]) -> String {
    let (are, one) = match held.len() {
        0 => return "make them agree, or give a nearer guess".to_owned(),
        1 => ("is", "it"),
        _ => ("are", "one of them"),
    };
    let names = quoted(held);
    format!("the cause is that {names} {are} held: let {one} go, or give it another value")
}

fn alternatives(nearest: Option<&str>, known: &[String]) -> String {
    match (nearest, known.len()) {
        (Some(nearest), 2..=MOST_LISTED) => {
            format!("; did you mean `{nearest}`? There are {}", quoted(known))
        }
        (Some(nearest), _) => format!("; did you mean `{nearest}`?"),
        (None, 0) => "; there is none".to_owned(),
        (None, 1) => format!("; there is {}", quoted(known)),
        (None, _) => format!("; there are {}", quoted(known)),
    }
}

/// What has become of `constraints` in a singular position.
fn lost(constraints: &[String]) -> String {
    let who = match constraints {
        [] => "a constraint".to_owned(),
        some => quoted(some),
    };
    match constraints.len() {
        0 | 1 => format!("{who} is implied by the others or has no gradient"),
        _ => format!("{who} are implied by the others or have no gradient"),
    }
}

fn too_small(step: f64, fastest: Option<&(String, f64)>) -> String {
    let (size, cause) = match step {
        0.0 => (
            "no step from here succeeds, however small".to_owned(),
            "or masses or forces are out of all proportion",
        ),
        _ => (
            format!("steps fell to {step:.1e}, with which the run does not get on"),
            "the tolerance be too tight, or, where the method is explicit, forces too stiff for it: `Method::Radau5` is for these",
        ),
    };
    let fastest = fastest.map_or(String::new(), |(name, acceleration)| {
        format!("; `{name}` accelerates by {acceleration:.1e}")
    });
    format!("{size}{fastest}; the motion may have a singularity here, {cause}")
}

/// Writes the error as `Display` does: `main` prints the error it returns by `Debug`.
impl fmt::Debug for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn nearest(name: &str) -> Option<String> {
        let names = ["m", "length[0]", "length[1]", "gravity", "th1"];
        match Error::unknown_name("parameter", name, &mut names.into_iter()) {
            Error::UnknownName { nearest, .. } => nearest,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn the_nearest_name_is_offered_if_it_is_near() {
        assert_eq!(nearest("gravty").as_deref(), Some("gravity"));
        assert_eq!(nearest("Gravity").as_deref(), Some("gravity"));
        assert_eq!(nearest("length[2]").as_deref(), Some("length[0]"));
        assert_eq!(nearest("th2").as_deref(), Some("th1"));
        assert_eq!(nearest("stiffness"), None);
        assert_eq!(nearest("x"), None);
        assert_eq!(nearest(""), None);
    }

    #[test]
    fn few_names_are_listed_and_of_many_the_nearest_is_offered() {
        let message = |name: &str, known: &[&str]| {
            Error::unknown_name("event", name, &mut known.iter().copied()).to_string()
        };
        let none = "no event is called `floor`";
        assert_eq!(message("floor", &[]), format!("{none}; there is none"));
        assert_eq!(
            message("floor", &["bottom", "turn"]),
            format!("{none}; there are `bottom`, `turn`")
        );
        assert_eq!(
            message("floor", &["flour", "turn"]),
            format!("{none}; did you mean `flour`? There are `flour`, `turn`")
        );
        let many = ["flour"; MOST_LISTED + 1];
        assert_eq!(
            message("floor", &many),
            format!("{none}; did you mean `flour`?")
        );
        let first = ["`flour`"; MOST_LISTED - 1].join(", ");
        assert_eq!(
            message("roof", &many),
            format!("no event is called `roof`; there are {first}, … (9 in all)")
        );
    }

    #[test]
    fn long_lists_are_cut() {
        let message = Error::IndefiniteMass {
            coordinates: (0..20).map(|i| format!("x[{i}]")).collect(),
        }
        .to_string();
        assert!(message.contains("`x[6]`, … (20 in all);"), "{message}");
    }

    #[test]
    fn a_name_is_near_if_less_than_half_of_it_differs_or_it_begins_alike() {
        for (name, known, near) in [
            ("rodd", "rod", true),
            ("TH1", "th1", true),
            ("θ1", "θ2", true),
            ("form", "from", true),
            ("a", "b", false),
            ("pin", "bar", false),
            ("abcd", "abxy", false),
            ("", "x", false),
            ("knife", "knife-edge", true),
            ("barrel", "bar", true),
        ] {
            let error = Error::unknown_name("coordinate", name, &mut [known].into_iter());
            let Error::UnknownName { nearest, .. } = error else {
                panic!("{error}");
            };
            assert_eq!(nearest.is_some(), near, "{name} {known}");
        }
    }

    #[test]
    fn messages_name_things_and_give_the_remedy() {
        let message = Error::Inconsistent {
            constraints: vec![("rod[1]".into(), 0.5), ("copy".into(), -0.5)],
        }
        .to_string();
        assert!(
            message.contains("`rod[1]` (5.000e-1), `copy` (-5.000e-1)")
                && message.contains("remove one")
        );
        let inner = Error::NonFinite {
            what: vec!["force on th1".into()],
        };
        let outer = Error::At {
            t: 0.25,
            q: vec![],
            v: vec![],
            source: Box::new(inner.clone()),
        };
        assert_eq!(
            outer.to_string(),
            "at t = 0.25: not a finite number: force on th1"
        );
        let source = std::error::Error::source(&outer).map(ToString::to_string);
        assert_eq!(source, Some(inner.to_string()));
        let message =
            Error::unknown_name("model", "uchan", &mut ["uchain"].into_iter()).to_string();
        assert_eq!(
            message,
            "no model is called `uchan`; did you mean `uchain`?"
        );
    }
}
