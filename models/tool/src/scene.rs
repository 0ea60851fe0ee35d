//! From the command line to a mechanism with its parameters and a consistent start.

use clap::Args;
use ukcore::model::{Entry, StartOptions, StartSpec};
use ukcore::spec::rate_of;
use ukcore::{Error, Prepared, State, assemble};
use ukunits::Unit;

use crate::command::find;
use crate::failure::Failure;
use crate::numbers::{elsewhere, short};
use crate::units::{self, Quantity};
use crate::ways;

/// The command-line arguments that name a mechanism, its parameters and its start.
#[derive(Debug, Args)]
pub struct Scene {
    /// Model (see `list`)
    pub model: String,
    /// Its parameters and its start
    #[command(flatten)]
    pub start: Start,
}

/// The command-line arguments for the parameters of a mechanism and its start.
#[derive(Debug, Default, Clone, Args)]
pub struct Start {
    /// Set a parameter or an option of the start; may be repeated
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = units::assignment)]
    pub settings: Vec<(String, Quantity)>,
    /// Where the motion begins
    #[command(flatten)]
    pub place: Place,
}

/// The command-line arguments for where a motion begins: a start on offer, or a guess to assemble one from.
#[derive(Debug, Default, Clone, Args)]
pub struct Place {
    /// Start configuration (see `list`); the first one if absent
    #[arg(long, value_name = "NAME")]
    pub start: Option<String>,
    /// Guess a coordinate, or by `dot(NAME)=VALUE` a velocity, of the start; may be repeated. The start is then the nearest state that
    /// satisfies the constraints. What is not guessed has the value of the start configuration, or 0 where the model has none
    #[arg(long = "guess", value_name = "NAME=VALUE", value_parser = units::assignment)]
    pub guesses: Vec<(String, Quantity)>,
    /// Coordinates that keep the value and velocity guessed; may be repeated
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    pub hold: Vec<String>,
}

impl Place {
    /// The names of the coordinates that are held.
    pub(crate) fn held(&self) -> Vec<&str> {
        self.hold.iter().map(String::as_str).collect()
    }
}

/// A mechanism with the parameters asked for, at the start asked for.
pub struct Ready<'a> {
    pub(crate) entry: &'a Entry,
    /// The mechanism with the parameters asked for.
    pub mechanism: Prepared,
    /// Name of the start; `"assembled"` where it was found from a guess.
    pub start: &'static str,
    /// The state at the start.
    pub state: State,
    /// How long a typical run from the start lasts, s.
    pub duration: f64,
}

impl Scene {
    /// Finds the mechanism that is asked for, sets its parameters and puts it together at its start. Where assembly sees other ways to do
    /// that which are as near, notes on standard error tell them.
    ///
    /// # Errors
    /// What [`Start::ready`] reports, and [`Failure::Usage`] for an unknown model.
    pub(crate) fn ready<'a>(&self, models: &'a [Entry]) -> Result<Ready<'a>, Failure> {
        self.start.noted(find(models, &self.model)?)
    }
}

impl Start {
    /// The start called `name`, the first one if there is no name, with these parameters and options.
    pub fn with(name: Option<&str>, settings: &[(&str, f64)]) -> Self {
        let settings = settings
            .iter()
            .map(|(name, value)| ((*name).to_owned(), (*value).into()));
        Start {
            settings: settings.collect(),
            place: Place {
                start: name.map(str::to_owned),
                ..Place::default()
            },
        }
    }

    /// Whether nothing is asked for, so that the model is taken as it is.
    pub(crate) fn is_default(&self) -> bool {
        self.settings.is_empty() && self.place.start.is_none() && !self.guesses()
    }

    /// Whether a start has to be assembled from zeros alone.
    pub(crate) fn is_unguessed(&self, entry: &Entry) -> bool {
        entry.starts.is_empty() && !self.guesses()
    }

    pub(crate) fn guesses(&self) -> bool {
        !self.place.guesses.is_empty() || !self.place.hold.is_empty()
    }

    /// Sets the parameters of `entry` and puts it together at its start.
    ///
    /// # Errors
    /// [`Failure::Usage`] for unknown names, values in the wrong unit, and settings that the start refuses; [`Failure::Failed`] where
    /// nothing near the guess satisfies the constraints.
    pub fn ready<'a>(&self, entry: &'a Entry) -> Result<Ready<'a>, Failure> {
        let (mechanism, start, options) = self.settings(entry)?;
        let (name, state) = match start.filter(|_| !self.guesses()) {
            Some(spec) => (spec.name, entry.start(&mechanism, spec.name, &options)?),
            None => (
                "assembled",
                self.assembled(&mechanism, &self.guess(entry)?)?,
            ),
        };
        Ok(Ready {
            entry,
            mechanism,
            start: name,
            state,
            duration: StartSpec::typical(start),
        })
    }

    /// [`Start::ready`], with notes on standard error: other ways to put it together that are as near, where assembly sees them, and
    /// numbers that may be meant in the units of the declaration.
    pub(crate) fn noted<'a>(&self, entry: &'a Entry) -> Result<Ready<'a>, Failure> {
        let given = self.settings.iter();
        // They may be why it fails.
        ways::tell(given.filter_map(|(name, value)| self.bare(entry, name, value)));
        let ready = self.ready(entry)?;
        ways::tell(self.other_ways(&ready));
        Ok(ready)
    }

    /// What to say of a bare number given for `name`, whose default `list` has in a unit that is not SI, if it would be nearer to that
    /// default there.
    pub(crate) fn bare(&self, entry: &Entry, name: &str, given: &Quantity) -> Option<String> {
        let value = given.bare()?;
        let start = self.spec(entry).ok()?;
        let Setting { default, units, .. } = setting(entry, name, start).ok()?;
        let (_, unit) = elsewhere(default, units)?;
        let like = if default == 0.0 { 1.0 } else { default };
        let far = |value: f64| (value / like).abs().ln().abs();
        let there = Unit::parse(unit).ok()?.to_si(value);
        if far(there) >= far(value) || elsewhere(value, units).is_some() {
            return None;
        }
        let (number, si) = (short(value, 8), units[0]);
        // `8/mm`, not `81/mm`.
        let behind = unit.strip_prefix('1').unwrap_or(unit);
        let meant = match behind.contains(' ') {
            true => format!("'{name}={number} {behind}'"),
            false => format!("{name}={number}{behind}"),
        };
        Some(format!(
            "`{name}` is {number} {si}, as bare numbers are; in {unit} write `{meant}`"
        ))
    }

    /// The mechanism with its parameters, which are set first since the start depends on them, and the start with its options.
    pub(crate) fn settings(
        &self,
        entry: &Entry,
    ) -> Result<(Prepared, Option<&'static StartSpec>, StartOptions), Failure> {
        once("--set", &self.settings)?;
        let start = self.spec(entry)?;
        let mut mechanism = entry.mechanism.clone();
        let mut options = StartOptions::new();
        for (name, quantity) in &self.settings {
            let Setting { option, units, .. } = setting(entry, name, start)?;
            let value = quantity.si(units[0]).map_err(Failure::value(name))?;
            match option {
                true => options.set(name, value),
                false => mechanism.set(name, value)?,
            }
        }
        Ok((mechanism, start, options))
    }

    /// The unit of the parameter or option called `name`.
    pub(crate) fn unit(&self, entry: &Entry, name: &str) -> Result<&'static str, Failure> {
        Ok(setting(entry, name, self.spec(entry)?)?.units[0])
    }

    fn spec(&self, entry: &Entry) -> Result<Option<&'static StartSpec>, Failure> {
        let Some(name) = &self.place.start else {
            return Ok(entry.starts.first());
        };
        let found = entry.starts.iter().find(|s| s.name == name);
        let unknown =
            || Error::unknown_name("start", name, &mut entry.starts.iter().map(|s| s.name));
        Ok(Some(found.ok_or_else(unknown)?))
    }

    /// The start state asked for, or zeros where the model has none, with the guesses in it.
    pub(crate) fn guess(&self, entry: &Entry) -> Result<State, Failure> {
        let (mechanism, start, options) = self.settings(entry)?;
        let spec = mechanism.spec();
        let mut state = match start {
            Some(start) => entry.start(&mechanism, start.name, &options)?,
            None => State {
                t: 0.0,
                q: vec![0.0; spec.n()],
                v: vec![0.0; spec.n()],
            },
        };
        once("--guess", &self.place.guesses)?;
        for (name, quantity) in &self.place.guesses {
            let velocity = rate_of(name);
            let values = if velocity.is_some() {
                &mut state.v
            } else {
                &mut state.q
            };
            for index in spec.coordinate_indices(velocity.unwrap_or(name))? {
                let unit = spec.coordinate_unit(index);
                let value = match velocity {
                    Some(_) => quantity.si_rate(unit),
                    None => quantity.si(unit),
                };
                values[index] = value.map_err(Failure::value(name))?;
            }
        }
        Ok(state)
    }

    /// The nearest consistent state to `guess`.
    fn assembled(&self, mechanism: &Prepared, guess: &State) -> Result<State, Failure> {
        assemble(mechanism, guess, &self.place.held()).map_err(|error| match error {
            error @ Error::NotAssembled { .. } => Failure::Failed(format!(
                "{error}; `--guess NAME=VALUE` gives one, of {}",
                mechanism.spec().coords.join(", ")
            )),
            other => other.into(),
        })
    }
}

/// Refuses a name that is given twice, of which one value would count and nobody know which.
fn once(option: &str, given: &[(String, Quantity)]) -> Result<(), Failure> {
    for (k, (name, _)) in given.iter().enumerate() {
        if given[..k].iter().any(|(other, _)| other == name) {
            return Err(Failure::Usage(format!(
                "`{name}` is given twice by `{option}`; leave one out"
            )));
        }
    }
    Ok(())
}

/// What `--set` can name.
struct Setting {
    /// An option of the start, not a parameter.
    option: bool,
    default: f64,
    /// The unit in SI, and as declared.
    units: [&'static str; 2],
}

/// The option or parameter called `name`; of a family or row named without index its first member.
fn setting(entry: &Entry, name: &str, start: Option<&StartSpec>) -> Result<Setting, Failure> {
    let mut offered = start.map_or(&[][..], |s| s.options).iter();
    let spec = entry.mechanism.spec();
    let first = || Some(&spec.params[*spec.parameter_indices(name).ok()?.first()?]);
    let option = offered.find(|o| o.name == name);
    let option = option.map(|o| (true, o.default, [o.unit, o.written]));
    let found = option.or_else(|| first().map(|p| (false, p.default, [p.unit, p.written])));
    let (option, default, units) = found.ok_or_else(|| unknown_setting(entry, name, start))?;
    Ok(Setting {
        option,
        default,
        units,
    })
}

fn unknown_setting(entry: &Entry, name: &str, start: Option<&StartSpec>) -> Failure {
    let has = |s: &&StartSpec| s.options.iter().any(|o| o.name == name);
    if let (Some(other), Some(start)) = (entry.starts.iter().find(has), start) {
        return Failure::Usage(format!(
            "`{name}` is an option of the start `{}`, not of `{}`; add `--start {}`",
            other.name, start.name, other.name
        ));
    }
    let params = || entry.mechanism.spec().params.iter().map(|p| p.name);
    let options = start.map_or(&[][..], |s| s.options).iter().map(|o| o.name);
    let families = params().filter(|p| p.ends_with("[0]"));
    let families = families.filter_map(|p| Some(p.split_once('[')?.0));
    let mut known = options.chain(params()).chain(families);
    Error::unknown_name("parameter or start option", name, &mut known).into()
}
