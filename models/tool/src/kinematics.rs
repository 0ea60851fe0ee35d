//! The command `kinematics`: positions, velocities and accelerations while drives are swept, and the limits of motion.

use std::io::{self, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

use clap::Args;
use ukcore::model::Entry;
use ukcore::simulate::Sample;
use ukcore::studies::{Effort, Kinematics};
use ukcore::{Error, State, kinematics as swept};

use crate::columns::{self, Column, labelled};
use crate::command;
use crate::curves::Curves;
use crate::failure::Failure;
use crate::numbers::{count, full, significant, width};
use crate::output::{self, write_whole};
use crate::scene::{Ready, Scene};
use crate::units::{self, Quantity};

/// The arguments of `kinematics`.
#[derive(Debug, Args)]
pub struct KinematicsArgs {
    /// The mechanism, and the start from where it is followed; `--hold` keeps coordinates at its values
    #[command(flatten)]
    pub scene: Scene,
    /// Sweep a coordinate, or the time `t`, as in `crank.angle=0deg..360deg:5deg`; without a step in 200 intervals. Drives that are given
    /// together go together, evenly each, in the steps of the first
    #[arg(long = "drive", value_name = "NAME=FROM..TO[:STEP]", required = true, value_parser = drive, allow_hyphen_values = true)]
    pub drives: Vec<Drive>,
    /// Speed of the first drive; 1 in SI units if absent
    #[arg(long, value_name = "SPEED", value_parser = Quantity::parse, allow_hyphen_values = true)]
    pub speed: Option<Quantity>,
    /// Coordinates on which forces or torques are to make the motion, such as the drive: `effort(NAME)` and `power(NAME)`; of more than it
    /// takes the least
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    pub effort: Vec<String>,
    /// Write the positions as CSV, with velocities, outputs, accelerations `ddot(NAME)` and efforts; `-` is standard output
    #[arg(long, value_name = "FILE", value_parser = command::path_or_stdout)]
    pub csv: Option<PathBuf>,
    /// Draw curves as SVG: each is a NAME of the table over the first drive, or `X,Y`, which is Y over X
    #[arg(long, num_args = 2.., value_names = ["FILE", "CURVE"])]
    pub plot: Option<Vec<String>>,
}

/// Drives by name, from value to value.
type Ranges<'a> = Vec<(&'a str, Range<f64>)>;

/// What `--drive` says: a name, from where to where it goes, and in which steps.
pub type Drive = (String, [Quantity; 2], Option<Quantity>);

/// Intervals where no step is given, and at most.
const INTERVALS: usize = 200;
const MOST: f64 = 1e6;

/// Reads `NAME=FROM..TO` or `NAME=FROM..TO:STEP`.
fn drive(text: &str) -> Result<Drive, String> {
    let (name, values) = units::split(text, "FROM..TO")?;
    let (ends, step) = units::range(name, values)?;
    Ok((name.to_owned(), ends, step))
}

/// Sweeps the drives of a model, and prints what is reached, the limits of motion, and the range of each output.
///
/// # Errors
/// [`Failure::Usage`] for what is wrong with the command line, and where drives and held coordinates do not decide the motion;
/// [`Failure::Failed`] where no position is reached, where positions do not go on, and where a file cannot be written.
pub fn kinematics(models: &[Entry], args: &KinematicsArgs) -> Result<(), Failure> {
    let to_stdout = args.csv.as_deref().is_some_and(output::is_stdout);
    let plot = args.plot.as_ref().and_then(|asked| asked.first());
    let plot = plot.map(Path::new);
    output::apart(&[("--csv", args.csv.as_deref()), ("--plot", plot)])?;
    let ready = args.scene.ready(models)?;
    let (drives, intervals) = ranges(&ready, &args.drives)?;
    let (name, _) = &drives[0];
    let speed = args.speed.as_ref();
    let speed = speed.map(|speed| speed.si_rate(unit(&ready, name)));
    let speed = speed.transpose().map_err(Failure::value("--speed"))?;
    let curves = args.plot.as_deref();
    let curves = curves.map(|asked| Curves::new(&ready.mechanism, name, asked));
    let curves = curves.transpose()?;
    let hold = args.scene.start.place.held();
    let found = swept(&ready.mechanism, &ready.state, &drives, &hold, intervals);
    let found = match speed {
        Some(speed) => found?.at_speed(speed)?,
        None => found?,
    };
    if found.postures.is_empty() {
        let limits: Vec<String> = found.limits.iter().map(ToString::to_string).collect();
        let message = format!("no position of the sweep is reached: {}", limits.join("; "));
        return Err(Failure::Failed(message));
    }
    let spec = ready.mechanism.spec();
    // Of some outputs nothing is known but why.
    let untold = spec.outputs.iter();
    let untold = untold.filter_map(|o| found.output(o.name).err().map(|error| (o.name, error)));
    let untold: Vec<(&str, Error)> = untold.collect();
    let is_untold = |column: &Column| untold.iter().position(|(name, _)| column.name == *name);
    if let Some(k) = curves.iter().flat_map(Curves::columns).find_map(is_untold) {
        return Err(untold[k].1.clone().into());
    }
    if let Some(mut curves) = curves {
        for posture in &found.postures {
            curves.add(&ready.mechanism, Sample::from(&posture.state));
        }
        curves.finish()?;
    }
    let on: Vec<&str> = args.effort.iter().map(String::as_str).collect();
    let efforts = match on.is_empty() {
        true => vec![Vec::new(); found.postures.len()],
        false => found.efforts(&on)?,
    };
    let named = efforts[0].iter().flat_map(|e| {
        let coordinate = spec.coordinate_index(e.name);
        let unit = units::effort(coordinate.map_or("", |j| spec.coordinate_unit(j)));
        let watt = unit.as_ref().map_or("", |_| "W").to_owned();
        let pair = [("effort", unit.unwrap_or_default()), ("power", watt)];
        pair.map(|(what, unit)| (format!("{what}({})", e.name), unit))
    });
    let numbers = |of: &Vec<Effort>| of.iter().flat_map(|e| [e.effort, e.power]).collect();
    let mut columns = columns::of_state(&ready.mechanism);
    columns.retain(|column| is_untold(column).is_none());
    let found = Found {
        columns,
        untold: untold.iter().map(|(_, error)| error.to_string()).collect(),
        efforts: named.collect(),
        values: efforts.iter().map(numbers).collect(),
        swept: found,
    };
    if let Some(path) = &args.csv {
        write_whole(path, |out| table(out, &ready, &found))?;
    }
    if to_stdout {
        return Ok(());
    }
    output::to_stdout(|out| summary(out, &ready, &drives, intervals, &found))
}

/// Postures and limits, and of each posture the efforts and powers asked for.
struct Found {
    swept: Kinematics,
    /// What is told of each posture, and why other outputs are not.
    columns: Vec<Column>,
    untold: Vec<String>,
    /// The names and units of the efforts and powers.
    efforts: Vec<(String, String)>,
    values: Vec<Vec<f64>>,
}

/// The unit of a coordinate, or of the time; none of what is neither, which the library has a word for.
fn unit(ready: &Ready<'_>, name: &str) -> &'static str {
    let spec = ready.mechanism.spec();
    match (name, spec.coordinate_index(name)) {
        (_, Ok(j)) => spec.coordinate_unit(j),
        ("t", Err(_)) => "s",
        _ => "",
    }
}

/// The drives as numbers, and how many intervals there are.
fn ranges<'a>(ready: &Ready<'_>, asked: &'a [Drive]) -> Result<(Ranges<'a>, usize), Failure> {
    let mut ranges = Vec::new();
    let mut intervals = INTERVALS;
    for (k, (name, [from, to], step)) in asked.iter().enumerate() {
        let unit = unit(ready, name);
        let si = |quantity: &Quantity| quantity.si(unit).map_err(Failure::value(name));
        let (from, mut to) = (si(from)?, si(to)?);
        if let Some(step) = step {
            let step = si(step)?;
            if k > 0 {
                return Err(Failure::Usage(format!(
                    "`{name}` goes along with `{}`, which alone has a step",
                    asked[0].0
                )));
            }
            let steps = units::steps(from, to, step).map_err(Failure::value(name))?;
            if !(1.0 - 1e-9..MOST).contains(&steps) {
                return Err(Failure::Usage(format!(
                    "`{name}`: steps of {step} do not lead from {from} to {to}, by fewer than {MOST:.0e}"
                )));
            }
            // A last step that rounding puts beyond the end is meant; what is left behind the last one is not swept.
            intervals = (steps * (1.0 + 1e-9)).floor() as usize;
            if steps - intervals as f64 > 1e-9 * steps {
                to = from + step * intervals as f64;
            }
        }
        ranges.push((name.as_str(), from..to));
    }
    Ok((ranges, intervals))
}

fn table(out: &mut dyn Write, ready: &Ready<'_>, found: &Found) -> io::Result<()> {
    let (mechanism, columns) = (&ready.mechanism, &found.columns);
    let accelerations = mechanism.spec().coords.iter();
    let names = columns.iter().map(|column| column.name.clone());
    let names = names
        .chain(accelerations.map(|name| format!("ddot({name})")))
        .chain(found.efforts.iter().map(|(name, _)| name.clone()));
    let postures = found.swept.postures.iter().zip(&found.values);
    let rows = postures.map(|(posture, efforts)| {
        let values = columns::values(columns, mechanism, Sample::from(&posture.state));
        let values = [&values, &posture.acceleration, efforts].into_iter();
        let text = |x: &f64| {
            if x.is_finite() {
                full(*x)
            } else {
                String::new()
            }
        };
        values.flatten().map(text).collect::<Vec<_>>()
    });
    output::csv(out, names, rows)
}

fn summary(
    out: &mut dyn Write,
    ready: &Ready<'_>,
    drives: &[(&str, Range<f64>)],
    intervals: usize,
    found: &Found,
) -> io::Result<()> {
    let name = drives[0].0;
    let drive = ready.mechanism.spec().coordinate_index(name).ok();
    let at = |state: &State| drive.map_or(state.t, |j| state.q[j]);
    let postures = &found.swept.postures;
    let places: Vec<f64> = postures.iter().map(|p| at(&p.state)).collect();
    let (id, all) = (&ready.entry.id, count(intervals + 1, "position"));
    write!(
        out,
        "{id} from `{}`: {} of {all}",
        ready.start,
        places.len()
    )?;
    match places[..] {
        [begin, .., end] => writeln!(
            out,
            ", `{name}` from {} to {}",
            significant(begin, 7),
            significant(end, 7)
        )?,
        _ => writeln!(out)?,
    }
    let mut limits = found.swept.limits.iter();
    limits.try_for_each(|limit| writeln!(out, "{limit}"))?;
    let spec = ready.mechanism.spec();
    let mut columns = columns::of_interest(&ready.mechanism);
    let told = |column: &Column| found.columns.iter().any(|told| told.name == column.name);
    columns.retain(|column| told(column) || spec.output_index(&column.name).is_err());
    let efforts = found
        .efforts
        .iter()
        .map(|(name, unit)| labelled(name, unit));
    let labels: Vec<String> = columns.iter().map(Column::label).chain(efforts).collect();
    let wide = width(labels.iter().map(String::as_str));
    let rows = postures
        .iter()
        .zip(&found.values)
        .map(|(posture, efforts)| {
            let sample = Sample::from(&posture.state);
            [
                &columns::values(&columns, &ready.mechanism, sample)[..],
                efforts,
            ]
            .concat()
        });
    let rows: Vec<Vec<f64>> = rows.collect();
    for (k, label) in labels.iter().enumerate() {
        let values = || {
            let values = places.iter().zip(&rows).map(|(at, row)| (row[k], *at));
            values.filter(|(x, _)| x.is_finite())
        };
        let least = values().min_by(|a, b| a.0.total_cmp(&b.0));
        let most = values().max_by(|a, b| a.0.total_cmp(&b.0));
        if let (Some(least), Some(most)) = (least, most) {
            let [low, from, high, to] =
                [least.0, least.1, most.0, most.1].map(|x| significant(x + 0.0, 7));
            writeln!(
                out,
                "  {label:<wide$}  {low} at {name} = {from}, to {high} at {to}"
            )?;
        }
    }
    for reason in &found.untold {
        writeln!(out, "note: left out, as {reason}")?;
    }
    if !found.efforts.is_empty() && found.values.iter().flatten().all(|x| *x == 0.0) {
        writeln!(
            out,
            "note: the constraints make this motion by themselves, so that forces on coordinates are not needed; what drives it `inverse` tells"
        )?;
    }
    Ok(())
}
