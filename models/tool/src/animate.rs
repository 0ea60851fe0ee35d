//! The command `animate`: motions as a page that opens from disk, with no network and no library.

use std::ops::ControlFlow;
use std::path::PathBuf;

use clap::Args;
use maud::{PreEscaped, html};
use serde::Serialize;
use serde_json::{Value, json};
use ukcore::Prepared;
use ukcore::model::Entry;
use ukcore::simulate::Sample;
use ukcore::spec::ShapeKind;

use crate::columns::residual;
use crate::command::{self, find};
use crate::curves::Thinned;
use crate::failure::Failure;
use crate::html::{document, joined, message};
use crate::motion::{Motion, early, whole};
use crate::numbers::setting;
use crate::output::{self, WholeFile};
use crate::runs::Runs;
use crate::scene::{Ready, Start};
use crate::summary::joule;
use crate::ways;

/// The command-line arguments of the command `animate`, to be flattened into a parser of `clap`.
#[derive(Debug, Args)]
pub struct AnimateArgs {
    /// Model (see `list`)
    pub model: String,
    /// Its runs, which are shown side by side: `--tol 1e-3,1e-10`, `--set k=40,400`, `--stabilise projection,none`
    #[command(flatten)]
    pub runs: Runs,
    /// Number of pictures, from 2 to 100000
    #[arg(long, value_name = "NUMBER", default_value = "600", value_parser = pictures, allow_hyphen_values = true)]
    pub pictures: u32,
    /// The page; MODEL.html if absent
    #[arg(long, value_name = "FILE", value_parser = command::path)]
    pub out: Option<PathBuf>,
}

/// Reads a number of pictures.
fn pictures(text: &str) -> Result<u32, String> {
    let number = whole(text, 2.0..MOST_PICTURES as f64 + 1.0).map(|number| number as u32);
    number.ok_or_else(|| format!("a whole number of pictures is needed, from 2 to {MOST_PICTURES}"))
}

/// More runs side by side are not told apart.
const MOST_RUNS: usize = 6;
/// More pictures of a run are thinned out.
const MOST_PICTURES: usize = 100_000;

/// What the page is given: numbers with the seven digits that a picture needs.
#[derive(Serialize)]
struct Data {
    dimension: usize,
    /// The kind of each shape, how many numbers it has, and what it says.
    shapes: Vec<Value>,
    /// J, where the declaration has units.
    energy_unit: &'static str,
    runs: Vec<Shown>,
}

#[derive(Serialize)]
struct Shown {
    label: String,
    /// Why it ends early, if it does.
    ended: Option<String>,
    t: Vec<f64>,
    pictures: Vec<Vec<f32>>,
    energy: Vec<f64>,
    /// The largest |φ| and |φ̇| of each picture; nothing without constraints.
    residual: Vec<f64>,
}

/// A run whose pictures are taken while it is computed.
pub(crate) struct Film {
    mechanism: Prepared,
    label: String,
    ended: Option<String>,
    frames: Thinned<Frame>,
}

struct Frame {
    t: f64,
    picture: Vec<f32>,
    energy: f64,
    residual: f64,
}

impl Film {
    /// The film of a mechanism, called by what distinguishes it from those beside it.
    ///
    /// # Errors
    /// [`Failure::Usage`] for a mechanism without a picture.
    pub(crate) fn new(ready: &Ready<'_>, label: String) -> Result<Self, Failure> {
        if ready.mechanism.spec().drawing.shapes.is_empty() {
            return Err(Failure::Usage(format!(
                "`{}` has no picture; declare one: `draw {{ line([x, y], [0, 0]) }}`",
                ready.entry.id
            )));
        }
        Ok(Film {
            mechanism: ready.mechanism.clone(),
            label,
            ended: None,
            frames: Thinned::new(MOST_PICTURES),
        })
    }

    pub(crate) fn add(&mut self, sample: Sample<'_>) {
        let Sample { t, q, v, .. } = sample;
        let mut numbers = vec![0.0; self.mechanism.spec().drawing.numbers()];
        self.mechanism.drawing(t, q, v, &mut numbers);
        self.frames.push(Frame {
            t,
            picture: numbers.into_iter().map(|x| x as f32).collect(),
            energy: self.mechanism.energy(t, q, v).total(),
            residual: residual(&self.mechanism, sample),
        });
    }

    /// Notes why the run ends early, if it does.
    pub(crate) fn end(&mut self, failure: Option<&Failure>) {
        self.ended = failure.map(|failure| format!("The motion ends early: {}", failure.message()));
    }

    fn shown(self) -> Shown {
        let constrained = self.mechanism.spec().m() > 0;
        let frames = self.frames.finish();
        let residuals = frames.iter().filter(|_| constrained);
        Shown {
            label: self.label,
            ended: self.ended,
            t: frames.iter().map(|frame| frame.t).collect(),
            energy: frames.iter().map(|frame| frame.energy).collect(),
            residual: residuals.map(|frame| frame.residual).collect(),
            pictures: frames.into_iter().map(|frame| frame.picture).collect(),
        }
    }
}

/// Computes motions and writes their page. Of one that ends early what was computed is shown.
///
/// # Errors
/// [`Failure::Usage`] for what is wrong with the command line, and for a mechanism without a picture; [`Failure::Failed`] if an integration
/// ends early or the page cannot be written.
pub fn animate(models: &[Entry], args: &AnimateArgs) -> Result<(), Failure> {
    let entry = find(models, &args.model)?;
    let runs = args.runs.each(entry, MOST_RUNS)?;
    let path = args.out.clone();
    let path = path.unwrap_or_else(|| PathBuf::from(format!("{}.html", entry.id)));
    output::promised("--out", &path, "html")?;
    let (mut takes, mut notes) = (Vec::new(), args.runs.bare(entry));
    for run in &runs {
        let differs = run.differs.iter();
        let label = joined(differs.map(|(name, value)| format!("{name} = {value}")));
        let ready = run.start.ready(entry);
        let ready = ready.map_err(|failure| failure.of(&label))?;
        notes.extend(run.start.other_ways(&ready));
        takes.push((Film::new(&ready, label)?, ready, &run.motion));
    }
    // Where the page cannot be written it is known before a long computation.
    let file = WholeFile::create(&path)?;
    let (page, failed) = filmed(entry, takes, args.pictures)?;
    ways::tell(notes);
    file.finish_with(page)?;
    output::to_stdout(|out| writeln!(out, "open {}", path.display()))?;
    failed.map_or(Ok(()), Err)
}

/// The page of motions of one model side by side from several starts, each with what it is called there, in so many pictures.
///
/// # Errors
/// What [`animate`] reports, and why a motion ends early if one does.
pub fn page_of(
    entry: &Entry,
    runs: impl IntoIterator<Item = (String, Start)>,
    motion: &Motion,
    pictures: u32,
) -> Result<String, Failure> {
    let mut takes = Vec::new();
    for (label, start) in runs {
        let ready = start.ready(entry)?;
        takes.push((Film::new(&ready, label)?, ready, motion));
    }
    let (page, failed) = filmed(entry, takes, pictures)?;
    failed.map_or(Ok(page), Err)
}

/// The page of these motions, which are computed for it, and why the first of those that end early does.
fn filmed(
    entry: &Entry,
    takes: Vec<(Film, Ready<'_>, &Motion)>,
    pictures: u32,
) -> Result<(String, Option<Failure>), Failure> {
    let (mut films, mut about, mut failed) = (Vec::new(), None, None);
    for (mut film, ready, motion) in takes {
        let every = motion.interval(&ready, None, pictures - 1)?;
        let (trajectory, error) = motion.follow(&ready, every, |sample| {
            film.add(sample);
            ControlFlow::Continue(())
        })?;
        let failure = early(&trajectory, error);
        film.end(failure.as_ref());
        about.get_or_insert_with(|| foot(&ready, motion));
        failed = failed.or(failure.map(|failure| failure.of(&film.label)));
        films.push(film);
    }
    Ok((page(entry, films, &about.unwrap_or_default())?, failed))
}

fn kind(kind: ShapeKind) -> &'static str {
    match kind {
        ShapeKind::Line => "line",
        ShapeKind::Circle => "circle",
        ShapeKind::Spring => "spring",
        ShapeKind::Trace => "trace",
        ShapeKind::Text => "text",
        ShapeKind::Support => "support",
        ShapeKind::Mark => "mark",
    }
}

/// Says from where a motion was computed, how, and with which parameters.
pub(crate) fn foot(ready: &Ready<'_>, motion: &Motion) -> String {
    let parameters = ready.mechanism.spec().params.iter();
    let parameters = parameters.zip(ready.mechanism.parameters());
    let parameters = parameters.map(|(p, value)| setting(p.name, *value, [p.unit, p.written]));
    let parameters: Vec<String> = parameters.collect();
    let (start, method) = (ready.start, motion.method);
    let tolerance = motion.tolerance();
    let tolerance = tolerance.map_or(String::new(), |tol| format!(" at tolerance {tol:e}"));
    let from = format!("from `{start}`, by {method}{tolerance}.");
    match parameters.is_empty() {
        true => from,
        false => format!("{from} Parameters: {}.", parameters.join(", ")),
    }
}

/// The page's text: films of one mechanism side by side, and what is to say of them.
pub(crate) fn page(entry: &Entry, films: Vec<Film>, about: &str) -> Result<String, Failure> {
    let spec = entry.mechanism.spec();
    let shapes = spec.drawing.shapes.iter().map(
        |shape| json!({ "kind": kind(shape.kind), "numbers": shape.numbers, "label": shape.label }),
    );
    let several = films.len() > 1;
    let data = Data {
        dimension: spec.drawing.dimension,
        shapes: shapes.collect(),
        energy_unit: joule(spec),
        runs: films.into_iter().map(Film::shown).collect(),
    };
    let data = serde_json::to_string(&data).map_err(|e| Failure::Failed(e.to_string()))?;
    // In a script nothing but its end has a meaning.
    let data = data.replace("</", "<\\/");
    let body = html! {
        h1 { (spec.name) }
        p { (entry.summary) }
        div #stage {}
        div #controls {
            button #play type="button" { "Play" }
            input #time type="range" min="0" value="0" aria-label="time";
            output #now {}
            label { "speed " select #speed {
                @for speed in ["0.1", "0.25", "0.5", "1", "2", "5", "10"] {
                    option value=(speed) selected[speed == "1"] { "× " (speed) }
                }
            } }
            label { input #traces type="checkbox" checked; " traces" }
        }
        div #strips {}
        p.soft { @if several { "The first: " } @else { "A run " } (message(about)) }
        script type="application/json" id="data" { (PreEscaped(data)) }
        script { (PreEscaped(PLAYER)) }
    };
    Ok(document(spec.name, STYLE, &body))
}

const STYLE: &str = include_str!("animate/player.css");
const PLAYER: &str = include_str!("animate/player.js");
