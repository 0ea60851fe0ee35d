//! What a modeller sees in the terminal: through rustc, one mistake gives one message, at its place, and nothing that follows from it.
//! (All messages and places are tested inside `ukmacros`.)

#[test]
fn messages() {
    trybuild::TestCases::new().compile_fail("tests/ui/*.rs");
}
