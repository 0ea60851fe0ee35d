//! `uk list`.

use std::io::{self, Write};

use models::{Model, Visitor};

use crate::failure::Failure;
use crate::output;

/// Prints every model with its starts and their options.
///
/// # Errors
/// If standard output cannot be written.
pub(crate) fn list() -> Result<(), Failure> {
    let mut text = Vec::new();
    for id in models::ids() {
        models::visit(id, Entry { to: &mut text })?.map_err(|e| Failure::stdout(&e))?;
    }
    output::to_stdout(|out| out.write_all(&text))
}

struct Entry<'a> {
    to: &'a mut Vec<u8>,
}

impl Visitor for Entry<'_> {
    type Output = io::Result<()>;

    fn visit<M: Model>(self) -> io::Result<()> {
        let to = self.to;
        writeln!(to, "{:<16} {}", M::ID, M::summary())?;
        for (i, start) in M::starts().iter().enumerate() {
            let default = if i == 0 { " (default)" } else { "" };
            writeln!(to, "    start {}{default}: {}", start.name, start.doc)?;
            for option in start.options {
                let setting = format!("{} = {} {}", option.name, option.default, option.unit);
                writeln!(to, "        {:<22} {}", setting.trim_end(), option.doc)?;
            }
        }
        writeln!(to)
    }
}
