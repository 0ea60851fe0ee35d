//! `uk list`.

use std::io::{self, Write};

use models::{Model, Visitor};

use crate::failure::Failure;
use crate::numbers::{short, width};
use crate::output;

/// Prints every model with its starts and their options.
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
        writeln!(to)
    }
}
