//! The command `animate`: a motion as a page that opens from disk, with no network and no library.

use std::io::Write;
use std::ops::ControlFlow;
use std::path::PathBuf;

use clap::Args;
use maud::{DOCTYPE, PreEscaped, html};
use serde::Serialize;
use ukcore::assemble::residuals;
use ukcore::model::Entry;
use ukcore::simulate::Sample;
use ukcore::spec::ShapeKind;
use ukcore::{Error, Prepared};

use crate::command;
use crate::failure::Failure;
use crate::motion::Motion;
use crate::numbers::{full, short};
use crate::output::{self, WholeFile};
use crate::run::usage;
use crate::scene::{Ready, Scene};

/// The arguments of `animate`.
#[derive(Debug, Args)]
pub struct AnimateArgs {
    /// The mechanism and its start
    #[command(flatten)]
    pub scene: Scene,
    /// How its motion is computed
    #[command(flatten)]
    pub motion: Motion,
    /// Number of pictures, from 2 to 100000
    #[arg(long, value_name = "NUMBER", default_value = "600", value_parser = clap::value_parser!(u32).range(2..=100_000))]
    pub pictures: u32,
    /// The page; MODEL.html if absent
    #[arg(long, value_name = "FILE", value_parser = command::path)]
    pub out: Option<PathBuf>,
}

/// What the page is given: numbers with the seven digits that a picture needs.
#[derive(Serialize)]
struct Data<'a> {
    dimension: usize,
    shapes: Vec<Shape<'a>>,
    t: Vec<f64>,
    pictures: Vec<Vec<f32>>,
    energy: Vec<f64>,
    /// J, where the declaration has units.
    energy_unit: &'static str,
    /// Of each picture the largest |φ| and |φ̇|; nothing without constraints.
    residual: Vec<f64>,
}

#[derive(Serialize)]
struct Shape<'a> {
    kind: &'static str,
    numbers: usize,
    label: &'a str,
}

/// Computes a motion and writes its page. Of a motion that ends early what was computed is shown.
///
/// # Errors
/// [`Failure::Usage`] for what is wrong with the command line, and for a mechanism without a picture; [`Failure::Failed`] if the integration
/// ends early or the page cannot be written.
pub fn animate(models: &[Entry], args: &AnimateArgs) -> Result<(), Failure> {
    let ready = args.scene.ready(models)?;
    let spec = ready.mechanism.spec();
    if spec.drawing.shapes.is_empty() {
        return Err(Failure::Usage(format!(
            "`{}` has no picture; declare one: `draw {{ line([x, y], [0, 0]) }}`",
            ready.entry.id
        )));
    }
    let path = args.out.clone();
    let path = path.unwrap_or_else(|| PathBuf::from(format!("{}.html", ready.entry.id)));
    let mut file = WholeFile::create(&path)?;
    let shapes = spec.drawing.shapes.iter().map(|shape| Shape {
        kind: kind(shape.kind),
        numbers: shape.numbers,
        label: shape.label,
    });
    let mut data = Data {
        dimension: spec.drawing.dimension,
        shapes: shapes.collect(),
        t: Vec::new(),
        pictures: Vec::new(),
        energy: Vec::new(),
        energy_unit: if spec.coordinate_units.is_empty() {
            ""
        } else {
            " J"
        },
        residual: Vec::new(),
    };
    let every = args.motion.length(&ready).abs() / f64::from(args.pictures - 1);
    let (_, error) = args.motion.follow(&ready, Some(every), |sample| {
        data.add(&ready.mechanism, sample);
        ControlFlow::Continue(())
    })?;
    if let Some(error @ Error::InvalidSetting { .. }) = error {
        return Err(usage(error));
    }
    let ended = error
        .as_ref()
        .map(|error| format!("The motion ends early: {error}"));
    let page = page(&ready, &args.motion, &data, ended)?;
    file.write_all(page.as_bytes())
        .map_err(|e| output::failure(Some(&path), &e))?;
    file.finish()?;
    output::to_stdout(|out| writeln!(out, "open {}", path.display()))?;
    error.map_or(Ok(()), |error| Err(error.into()))
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

impl Data<'_> {
    fn add(&mut self, mechanism: &Prepared, sample: Sample<'_>) {
        let Sample { t, q, v, .. } = sample;
        let mut numbers = vec![0.0; mechanism.spec().drawing.numbers()];
        mechanism.drawing(t, q, v, &mut numbers);
        let energy = mechanism.energy(t, q, v);
        self.t.push(t);
        self.pictures
            .push(numbers.into_iter().map(|x| x as f32).collect());
        self.energy.push(energy.total());
        if mechanism.spec().m() > 0
            && let Ok(left) = residuals(mechanism, &sample.to_state())
        {
            let largest = left.largest_position().max(left.largest_velocity());
            self.residual.push(largest);
        }
    }
}

/// The page's text.
fn page(
    ready: &Ready<'_>,
    motion: &Motion,
    data: &Data<'_>,
    ended: Option<String>,
) -> Result<String, Failure> {
    let data = serde_json::to_string(data).map_err(|e| Failure::Failed(e.to_string()))?;
    // In a script nothing but its end has a meaning.
    let data = data.replace("</", "<\\/");
    let title = ready.mechanism.spec().name;
    let parameters = ready.mechanism.spec().params.iter();
    let parameters = parameters.zip(ready.mechanism.parameters());
    let parameters = parameters.map(|(p, value)| format!("{} = {}", p.name, short(*value, 6)));
    let parameters: Vec<String> = parameters.collect();
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                h1 { (title) }
                p { (ready.entry.summary) }
                @if let Some(ended) = ended { p.note { (ended) } }
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
                p.soft {
                    "From `" (ready.start) "`, by " (motion.method.to_string()) " at tolerance " (full(motion.tol)) ". "
                    @if !parameters.is_empty() { "Parameters: " (parameters.join(", ")) "." }
                }
                script type="application/json" id="data" { (PreEscaped(data)) }
                script { (PreEscaped(PLAYER)) }
            }
        }
    };
    Ok(page.into_string())
}

const STYLE: &str = include_str!("animate/player.css");
const PLAYER: &str = include_str!("animate/player.js");
