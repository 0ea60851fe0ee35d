//! Words that are no names, at all places where names stand: each is told once, and nothing follows from it.

use super::expand;

/// Where a name stands, as `NAME`, with uses of it.
const PLACES: [&str; 17] = [
    "params { NAME = 2 } coords { x } mass { x: NAME } force { x: -NAME * x }",
    "params { NAME[2] = 2 } coords { x } mass { x: NAME[0] }",
    "params { a = 1 NAME = 2 } coords { x } mass { x: a + NAME }",
    "coords { NAME } mass { NAME: 1 } force { NAME: -2 * NAME - dot(NAME) }",
    "coords { y NAME[2] [m], x } mass { x: 1, y: 1, NAME: 1 } output { o = NAME[0] }",
    "coords { x } let NAME = 2 * x; mass { x: 1 } output { o = NAME + x }",
    "coords { x } let f = |u, NAME| NAME * u; mass { x: 1 } output { o = f(1, x) }",
    "coords { x } let NAME = |u| 2 * u; mass { x: 1 } output { o = NAME(x) }",
    "coords { x } let { NAME = 2 * x, d = NAME } mass { x: 1 } output { o = d }",
    "const NAME: usize = 2; coords { x[NAME] } mass { for i in 0..NAME { x[i]: 1 } }",
    "coords { x, y } mass { x: 1, y: 1 } holonomic { NAME: x = y } output { o = reaction(NAME) }",
    "coords { x } mass { x: 1 } output { NAME = 2 * x } integral { w = x }",
    "coords { x } mass { x: 1 } start NAME { x = 1 } start b { x = 2 }",
    "coords { x } mass { x: 1 } start s(a = 1, NAME = 1) { x = NAME + a }",
    "coords { x[2] } mass { for NAME in 0..2 { x[NAME]: 1 } }",
    "bodies { planar NAME { mass: 1, inertia: 1 } } holonomic { c: pin(ground.at([0, 0]), NAME.at([1, 0])) } output { o = NAME.angle }",
    "bodies { planar a { mass: 1, inertia: 1 } } tree { NAME: pin(ground.at([0, 0]), a.at([1, 0])) } output { o = NAME.angle }",
];

#[test]
fn reserved_words_are_told_once_wherever_names_stand() {
    let words = "as async await become box break const continue crate do dyn else enum extern false final fn for if impl in let loop \
        macro match mod move mut override pub ref return self Self static struct super trait true try type unsafe use where while yield \
        r#fn r#struct r#a _";
    for place in PLACES {
        for word in words.split_whitespace() {
            let source = format!("pub T {{ {} }}", place.replace("NAME", word));
            let (_, found) = expand(&source);
            let told: Vec<&str> = found.iter().map(|e| e.message.as_str()).collect();
            assert!(
                told.len() == 1 && (told[0].contains(&format!("`{word}`")) || word == "_"),
                "{source}: {told:#?}"
            );
        }
    }
}

#[test]
fn names_of_other_alphabets_are_names() {
    for place in PLACES {
        for word in [
            "größe",
            "θ",
            "длина",
            "長さ",
            "_a",
            "name_",
            "union",
            "auto",
        ] {
            let (_, found) = expand(&format!("pub T {{ {} }}", place.replace("NAME", word)));
            let told: Vec<&str> = found.iter().map(|e| e.message.as_str()).collect();
            assert!(told.is_empty(), "{place} with {word}: {told:#?}");
        }
    }
}

#[test]
fn the_type_is_no_reserved_word() {
    for word in ["fn", "self", "r#loop", "box", "_", "f64"] {
        let (_, found) = expand(&format!("pub {word} {{ coords {{ x }} mass {{ x: 1 }} }}"));
        assert_eq!(found.len(), 1, "{word}");
    }
}
