//! `uk list`.

use std::io::{self, Write};

use models::{Model, Visitor};

use crate::failure::Failure;
use crate::numbers::{short, width};
use crate::output;
use crate::units;

/// Width of a list of parameters; with what stands before them, lines are within 100 characters.
const LINE: usize = 84;

/// Prints every model with its starts, their options, and the parameters, all with their defaults.
///
/// # Errors
/// If standard output cannot be written.
pub(crate) fn list() -> Result<(), Failure> {
    let mut text = Vec::new();
    let wide = width(models::ids());
    for id in models::ids() {
        let entry = Entry {
            to: &mut text,
            wide,
        };
        models::visit(id, entry)?.map_err(|e| Failure::stdout(&e))?;
    }
    output::to_stdout(|out| out.write_all(&text))
}

struct Entry<'a> {
    to: &'a mut Vec<u8>,
    /// Width of the column of names.
    wide: usize,
}

impl Visitor for Entry<'_> {
    type Output = io::Result<()>;

    fn visit<M: Model>(self) -> io::Result<()> {
        let Entry { to, wide } = self;
        writeln!(to, "{:<wide$}  {}", M::ID, M::summary())?;
        for (i, start) in M::starts().iter().enumerate() {
            let default = if i == 0 { " (default)" } else { "" };
            writeln!(to, "    start {}{default}: {}", start.name, start.doc)?;
            for option in start.options {
                let setting = format!(
                    "{} = {} {}",
                    option.name,
                    short(option.default, 6),
                    option.unit
                );
                writeln!(to, "        {:<24}{}", setting.trim_end(), option.doc)?;
            }
        }
        let params = M::SPEC.params.iter().map(|p| {
            let unit = units::unit_in(p.doc).unwrap_or_default();
            let setting = format!("{} = {} {unit}", p.name, short(p.default, 8));
            setting.trim_end().to_owned()
        });
        for (i, line) in lines(params).iter().enumerate() {
            let head = if i == 0 { "parameters" } else { "" };
            writeln!(to, "    {head:<10} {line}")?;
        }
        writeln!(to)
    }
}

/// Entries with commas between them, in lines of at most [`LINE`] characters where the entries allow it.
fn lines(entries: impl Iterator<Item = String>) -> Vec<String> {
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
    lines
}
