//! The tools of `uktool` for the catalogue: `cargo run --release -p catalogue -- list`.

#![forbid(unsafe_code)]

fn main() -> std::process::ExitCode {
    uktool::command::main(&catalogue::entries())
}
