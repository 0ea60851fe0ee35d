//! The command `list`.

use std::io::{self, Write};

use ukcore::model::Entry;

use crate::failure::Failure;
use crate::numbers::{rounded, short, width};
use crate::output;

/// Width of a list of parameters; with what stands before them, lines are within 100 characters.
const LINE: usize = 84;

/// Decimals of values.
const DIGITS: usize = 8;

/// Prints every model with its starts, their options, and the parameters, all with their defaults.
///
/// # Errors
/// If standard output cannot be written.
pub fn list(models: &[Entry]) -> Result<(), Failure> {
    let wide = width(models.iter().map(|m| m.id.as_str()));
    output::to_stdout(|out| models.iter().try_for_each(|model| entry(out, model, wide)))
}

/// `wide` is the width of the column of names.
fn entry(out: &mut dyn Write, model: &Entry, wide: usize) -> io::Result<()> {
    let line = format!("{:<wide$}  {}", model.id, model.summary);
    writeln!(out, "{}", line.trim_end())?;
    for (i, start) in model.starts.iter().enumerate() {
        let default = if i == 0 { " (default)" } else { "" };
        let until = short(start.duration, DIGITS);
        let head = format!("    start {}{default}, until {until} s", start.name);
        match start.doc {
            "" => writeln!(out, "{head}")?,
            doc => writeln!(out, "{head}: {doc}")?,
        }
        for option in start.options {
            let setting = value(option.name, option.default, option.unit);
            let line = format!("        {setting:<24}{}", option.doc);
            writeln!(out, "{}", line.trim_end())?;
        }
    }
    if model.starts.is_empty() {
        let spec = model.mechanism.spec();
        let coordinates = spec.coords.iter().enumerate();
        let coordinates = coordinates.map(|(i, c)| match spec.coordinate_unit(i) {
            "" => (*c).to_owned(),
            unit => format!("{c} in {unit}"),
        });
        paragraph(out, "guess", coordinates)?;
    }
    let params = model.mechanism.spec().params.iter();
    paragraph(
        out,
        "parameters",
        params.map(|p| value(p.name, p.default, p.unit)),
    )?;
    writeln!(out)
}

/// `name = value unit`; an angle in degrees, if it has fewer digits there.
fn value(name: &str, value: f64, unit: &str) -> String {
    let (si, degrees) = (
        short(value, DIGITS),
        short(rounded(value.to_degrees()), DIGITS),
    );
    let text = match unit == "rad" && degrees.len() < si.len() {
        true => format!("{name} = {degrees} deg"),
        false => format!("{name} = {si} {unit}"),
    };
    text.trim_end().to_owned()
}

/// Entries with commas between them, in lines of at most [`LINE`] characters where the entries allow it.
fn paragraph(
    out: &mut dyn Write,
    head: &str,
    entries: impl Iterator<Item = String>,
) -> io::Result<()> {
    let mut lines: Vec<String> = Vec::new();
    for entry in entries {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 2 + entry.chars().count() <= LINE => {
                *line += ", ";
                *line += &entry;
            }
            Some(line) => {
                line.push(',');
                lines.push(entry);
            }
            None => lines.push(entry),
        }
    }
    for (i, line) in lines.iter().enumerate() {
        let head = if i == 0 { head } else { "" };
        writeln!(out, "    {head:<10} {line}")?;
    }
    Ok(())
}
