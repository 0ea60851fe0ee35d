//! The stiff and extreme cases of this package, run and told by `uktool`.

#![forbid(unsafe_code)]

use std::process::ExitCode;

fn main() -> ExitCode {
    uktool::stability::main(&uk_stability::cases())
}
