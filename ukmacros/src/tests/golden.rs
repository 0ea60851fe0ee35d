//! The emitted code as reviewed, in `golden`: of four small mechanisms that show everything, of a type with an error, what all models cost,
//! and a digest of each. A change shows in the diff.
//!
//! `UPDATE_EXPECT=1 cargo test -p ukmacros golden` writes the files anew; `cargo test -p ukmacros expansions -- --ignored` writes the whole
//! code of every model to `target/expansions`, to be compared with that of another commit.

use super::analysis;
use expect_test::expect_file;
use proc_macro2::{Group, Literal, TokenStream, TokenTree};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use ukalgebra::analysis::Costs;

/// A regular mechanism, a massless coordinate, a switch, a nonholonomic constraint.
const WHOLE: [&str; 4] = ["Pendulum", "MasslessSpring", "RoughBlock", "KnifeEdge"];

/// All `multibody!` invocations of the models crate: type and tokens of the declaration.
pub(super) fn declarations() -> BTreeMap<String, TokenStream> {
    let models = Path::new(env!("CARGO_MANIFEST_DIR")).join("../models/src");
    let mut out = BTreeMap::new();
    for entry in std::fs::read_dir(models).expect("the models crate is there") {
        let path = entry.expect("readable directory").path();
        if path.extension().is_none_or(|e| e != "rs") {
            continue;
        }
        let text = std::fs::read_to_string(&path).expect("readable file");
        let file = syn::parse_file(&text).expect("models are Rust");
        for item in file.items {
            let syn::Item::Macro(call) = item else {
                continue;
            };
            let last = call.mac.path.segments.last();
            if last.is_some_and(|s| s.ident == "multibody") {
                let diag = crate::diag::Diagnostics::default();
                let declaration = crate::parse::parse(call.mac.tokens.clone(), &diag);
                let name = declaration.expect("a declaration").name.to_string();
                out.insert(name, call.mac.tokens);
            }
        }
    }
    assert!(!out.is_empty(), "there are models");
    out
}

/// The code of a declaration without errors.
fn expansion(tokens: &TokenStream) -> TokenStream {
    let (code, diagnostics) = crate::expand(tokens.clone());
    assert!(diagnostics.is_empty(), "{:?}", diagnostics.take());
    code
}

/// The code, formatted, without `CODE`, which is the text of its functions; of tapes their lengths.
fn formatted(code: TokenStream) -> String {
    let text =
        prettyplease::unparse(&syn::parse2(without_tapes(code)).expect("emitted code is Rust"));
    let (before, rest) = text.split_once("    const CODE:").unwrap_or((&text, ""));
    let rest = rest.split_once("    ];\n").map_or("", |(_, rest)| rest);
    format!("{}{rest}", before.trim_end_matches(' '))
}

/// The code with the length of each string of bytes in its place.
fn without_tapes(code: TokenStream) -> TokenStream {
    let short = |tree| match tree {
        TokenTree::Group(group) => {
            let inner = without_tapes(group.stream());
            TokenTree::Group(Group::new(group.delimiter(), inner))
        }
        TokenTree::Literal(literal) => {
            match syn::parse_str::<syn::LitByteStr>(&literal.to_string()) {
                Ok(bytes) => {
                    let length = format!("{} bytes", bytes.value().len());
                    TokenTree::Literal(Literal::byte_string(length.as_bytes()))
                }
                Err(_) => TokenTree::Literal(literal),
            }
        }
        other => other,
    };
    code.into_iter().map(short).collect()
}

/// The head of the digest.
const DIGEST: &str = "\
The emitted code of each model in brief. All of it: cargo test -p ukmacros expansions -- --ignored (in target/expansions).
This file anew: UPDATE_EXPECT=1 cargo test -p ukmacros golden

";

/// 64-bit FNV-1a.
fn hash(text: &str) -> u64 {
    let start = 0xcbf2_9ce4_8422_2325;
    text.bytes().fold(start, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

/// The lines of MathML in the documentation within the code.
fn typeset(code: &TokenStream) -> Vec<String> {
    let lines = |tree| match tree {
        TokenTree::Group(group) => typeset(&group.stream()),
        TokenTree::Literal(literal) => {
            let text = syn::parse_str::<syn::LitStr>(&literal.to_string());
            let text = text.map(|text| text.value()).unwrap_or_default();
            let lines = text.lines().map(|line| line.trim().to_owned());
            lines.filter(|line| line.contains("<math>")).collect()
        }
        _ => Vec::new(),
    };
    code.clone().into_iter().flat_map(lines).collect()
}

/// Every tag that opens closes, in order.
fn assert_typeset_equations_are_well_formed(name: &str, code: &TokenStream) {
    let lines = typeset(code);
    assert!(!lines.is_empty(), "{name}");
    for line in &lines {
        let mut open = Vec::new();
        let inner = line.trim_start_matches("<p>");
        let inner = inner.trim_end_matches("<br>").trim_end_matches("</p>");
        for tag in inner.split('<').skip(1) {
            let (tag, text) = tag.split_once('>').expect("a tag ends");
            assert!(!text.contains('>'), "{name}: {line}");
            match tag.strip_prefix('/') {
                Some(end) => assert_eq!(open.pop(), Some(end), "{name}: {line}"),
                None if tag.ends_with('/') => {}
                None => open.extend(tag.split(' ').next()),
            }
        }
        assert!(open.is_empty(), "{name}: {line}");
    }
}

/// A declaration of everything that a user's code can name, with an error.
const BROKEN: &str = "
/// A declaration with an error: its type, so that what uses it gives no second message.
pub Broken {
    const N: usize = 2;
    const HALF: f64 = 0.5;
    params { m = 1.0, k[N] = 2.0 }
    coords { x[N], y }
    mass { x[0]: m, x[1]: m, y: weight }
    holonomic { rod: x[0] = x[1]  for i in 0..N { pin[i]: [x[i], y] = [t, t] } }
    output { angle = atan2(x[0], y) }
}";

/// The type that `BROKEN` becomes, which `tests/motion/fallback.rs` compiles and uses.
fn fallback() -> String {
    let (code, errors) = super::expand(BROKEN);
    assert_eq!(errors.len(), 1, "{errors:?}");
    // What follows `::core::compile_error! { "message" }`.
    formatted(code.into_iter().skip(8).collect())
}

/// One line a model and function.
fn operations(declarations: &BTreeMap<String, TokenStream>) -> String {
    let mut out = format!(
        "{:<22} {:<14} {:>7} {:>8} {:>7} {:>7} {:>8} {:>7}\n",
        "model", "what", "add", "multiply", "divide", "root", "function", "select"
    );
    for (name, tokens) in declarations {
        let Costs {
            dynamics,
            dense,
            unprepared,
            acceleration,
            correction,
            prepare,
        } = analysis(tokens.clone()).costs;
        for (what, operations) in [
            ("dynamics", dynamics),
            ("dense", dense),
            ("unprepared", unprepared),
            ("acceleration", acceleration),
            ("correction", correction),
            ("prepare", prepare),
        ] {
            let [add, multiply, divide, root, function, select] = operations.counts();
            out += &format!(
                "{name:<22} {what:<14} {add:>7} {multiply:>8} {divide:>7} {root:>7} {function:>8} {select:>7}\n"
            );
        }
    }
    out
}

#[test]
fn emitted_code_is_as_reviewed() {
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden");
    let declarations = declarations();
    let mut files = vec![
        ("operations.txt".to_owned(), operations(&declarations)),
        ("Broken.rs".to_owned(), fallback()),
    ];
    let mut digest = format!("{DIGEST}{:<22} {:>9}  hash\n", "model", "words");
    for (name, tokens) in &declarations {
        let code = expansion(tokens);
        let text = code.to_string();
        assert_eq!(text, expansion(tokens).to_string(), "one input, one output");
        assert_typeset_equations_are_well_formed(name, &code);
        let words: Vec<&str> = text.split_whitespace().collect();
        let hash = hash(&words.concat());
        digest += &format!("{name:<22} {:>9}  {hash:016x}\n", words.len());
        if WHOLE.contains(&name.as_str()) {
            files.push((format!("{name}.rs"), formatted(code)));
        }
    }
    files.push(("digest.txt".to_owned(), digest));
    for (name, text) in &files {
        expect_file![golden.join(name)].assert_eq(text);
    }
    let found = std::fs::read_dir(&golden).expect("golden files are there");
    let found = found.filter_map(|e| Some(e.ok()?.file_name().to_string_lossy().into_owned()));
    let stale = found.filter(|name| files.iter().all(|(known, _)| known != name));
    let stale: Vec<String> = stale.collect();
    assert!(stale.is_empty(), "nothing makes {stale:?} any more");
}

#[test]
#[ignore = "writes files: cargo test -p ukmacros expansions -- --ignored"]
fn expansions() {
    let directory = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../target/expansions");
    std::fs::create_dir_all(&directory).expect("can write");
    for (name, tokens) in declarations() {
        let text = formatted(expansion(&tokens));
        std::fs::write(directory.join(format!("{name}.rs")), text).expect("can write");
    }
}
