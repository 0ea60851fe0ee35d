//! How far stiff and extreme cases go: each sweeps one thing until it breaks, and compares with an oracle.

#![forbid(unsafe_code)]

mod cases;
mod mechanisms;

use std::process::ExitCode;

fn main() -> ExitCode {
    uktool::stability::main(&cases::all())
}

#[cfg(test)]
mod tests {
    use super::cases;

    #[test]
    fn cases_have_names_of_their_own_and_an_ordinary_value() {
        let cases = cases::all();
        for (i, case) in cases.iter().enumerate() {
            assert!(cases[..i].iter().all(|c| c.id != case.id), "{}", case.id);
            assert!(case.accurate <= case.bound, "{}", case.id);
            assert!(case.sweep.ordinary < case.sweep.values.len());
        }
    }
}
