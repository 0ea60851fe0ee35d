//! The command `list`.

use std::io::{self, Write};

use ukcore::model::Entry;

use crate::failure::Failure;
use crate::numbers::{lines, setting, short, width};
use crate::output;

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
        let duration = short(start.duration, 8);
        let head = format!("    start {}{default}, for {duration} s", start.name);
        match start.doc {
            "" => writeln!(out, "{head}")?,
            doc => writeln!(out, "{head}: {doc}")?,
        }
        for option in start.options {
            let setting = setting(option.name, option.default, [option.unit, option.written]);
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
        params.map(|p| setting(p.name, p.default, [p.unit, p.written])),
    )?;
    writeln!(out)
}

fn paragraph(
    out: &mut dyn Write,
    head: &str,
    entries: impl Iterator<Item = String>,
) -> io::Result<()> {
    for (i, line) in lines(entries).iter().enumerate() {
        let head = if i == 0 { head } else { "" };
        writeln!(out, "    {head:<10} {line}")?;
    }
    Ok(())
}
