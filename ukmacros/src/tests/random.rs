//! No input makes the macro panic.

use super::expand;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// Pieces that declarations are made of, and some that they are not.
const PIECES: [&str; 58] = [
    "pub",
    "T",
    "{",
    "}",
    "(",
    ")",
    "[",
    "]",
    "const",
    "N",
    ":",
    "usize",
    "=",
    "3",
    ";",
    "params",
    "m",
    "1.0",
    ",",
    "coords",
    "x",
    "y",
    "x[N]",
    "let",
    "f",
    "|a|",
    "a",
    "mass",
    "x: m",
    "kinetic",
    "force",
    "potential",
    "holonomic",
    "nonholonomic",
    "nonideal",
    "output",
    "for i in 0..N",
    "for",
    "in",
    "..",
    "dot(x)",
    "sin",
    "sq",
    "^",
    "**",
    "+",
    "-",
    "*",
    "/",
    "t",
    "PI",
    "c: x = 1.0",
    "sum(0..3, |i| i)",
    "///doc\n",
    "#[a]",
    "\"s\"",
    "'a'",
    "i64::MAX",
];

/// A declaration that works, to be damaged.
const WHOLE: &str = "pub T { const N: usize = 3; params { m = 1.0, k[N] = 2.0 } coords { x[N], y } let f = |a| a * m; \
    mass { for i in 0..N { x[i]: m } y: m } force { y: f(dot(y)) } potential { sum(0..N, |i| 0.5 * k[i] * sq(x[i])) } \
    holonomic { for i in 0..N - 1 { c[i]: sq(x[i + 1] - x[i]) = sin(t) } d: [x[0], y] = [y * 2.0, x[1]] } \
    nonholonomic { e: dot(x[0]) = y * dot(y) } nonideal { y: -dot(y) } output { o = hypot(x[0], y) } }";

fn survives(source: &str) {
    if let Ok(tokens) = source.parse::<proc_macro2::TokenStream>() {
        let (code, _) = crate::expand(tokens);
        assert!(!code.is_empty(), "something is always emitted");
    }
}

#[test]
fn the_whole_declaration_compiles() {
    let (_, errors) = expand(WHOLE);
    assert!(errors.is_empty(), "{errors:?}");
}

/// So many cases, the same at each run.
pub(super) fn fixed(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(1),
        ..ProptestConfig::default()
    }
}

proptest! {
    #![proptest_config(fixed(400))]

    #[test]
    fn random_pieces(picks in proptest::collection::vec(0usize..PIECES.len(), 0..40)) {
        let text: Vec<&str> = picks.iter().map(|i| PIECES[*i]).collect();
        survives(&text.join(" "));
        survives(&format!("pub T {{ {} }}", text.join(" ")));
        survives(&format!("pub T {{ coords {{ x, y }} mass {{ x: 1.0, y: 1.0 }} holonomic {{ {} }} }}", text.join(" ")));
        survives(&format!("pub T {{ coords {{ x, y }} force {{ x: {} }} }}", text.join(" ")));
    }

    #[test]
    fn damaged_declarations(at in 0usize..700, length in 0usize..12, piece in 0usize..PIECES.len()) {
        let characters: Vec<char> = WHOLE.chars().collect();
        let at = at.min(characters.len());
        let end = (at + length).min(characters.len());
        let damaged: String = characters[..at].iter().chain(PIECES[piece].chars().collect::<Vec<_>>().iter()).chain(&characters[end..]).collect();
        survives(&damaged);
    }

    #[test]
    fn any_tokens(text in "\\PC{0,60}") {
        survives(&text);
        survives(&format!("pub T {{ coords {{ x }} mass {{ x: {text} }} }}"));
    }
}
