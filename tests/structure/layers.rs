//! The order of the layers: each module uses only itself and those before it.

use std::path::{Path, PathBuf};

/// All source files below `directory`, tests and test fixtures left out.
fn sources(directory: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(directory).expect("a source directory") {
        let path = entry.expect("readable").path();
        let name = path
            .file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        if path.is_dir() {
            if name != "tests" {
                found.extend(sources(&path));
            }
        } else if name.ends_with(".rs")
            && !["lib.rs", "tests.rs", "fixture.rs"].contains(&name.as_str())
        {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// The first path segment below the crate root: the module a file belongs to.
fn module(root: &Path, file: &Path) -> String {
    let relative = file.strip_prefix(root).expect("below the root");
    let first = relative.iter().next().unwrap_or_default().to_string_lossy();
    first.trim_end_matches(".rs").to_owned()
}

/// The code of a file without its unit tests, which stand at its end. (`mod tests;` may stand anywhere.)
fn code(file: &Path) -> String {
    let text = std::fs::read_to_string(file).expect("readable");
    let end = text.find("#[cfg(test)]\nmod tests {").unwrap_or(text.len());
    text[..end].to_owned()
}

/// Modules that `text` names by `crate::…`, groups in braces included.
fn used(text: &str) -> Vec<String> {
    let mut out = Vec::new();
    for part in text.split("crate::").skip(1) {
        match part.strip_prefix('{') {
            Some(group) => out.extend(members(group).into_iter().map(first_name)),
            None => out.push(first_name(part)),
        }
    }
    out
}

/// The members of the group whose text `group` begins with, up to its closing brace; groups within it are parts of members.
fn members(group: &str) -> Vec<&str> {
    let (mut out, mut depth, mut start) = (Vec::new(), 0, 0);
    for (at, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth > 0 => depth -= 1,
            ',' if depth > 0 => {}
            ',' | '}' => {
                out.push(&group[start..at]);
                start = at + 1;
                if c == '}' {
                    break;
                }
            }
            _ => {}
        }
    }
    out
}

fn first_name(path: &str) -> String {
    let word = |c: &char| c.is_alphanumeric() || *c == '_';
    path.trim().chars().take_while(word).collect()
}

#[test]
fn groups_within_groups_are_seen() {
    let text = "use crate::{\n    a::{b, c::{d, e}}, f,\n    g::h,\n};\nuse crate::k::l;\nlet x = crate::m::n(o, p);";
    let mut names = used(text);
    names.retain(|name| !name.is_empty());
    assert_eq!(names, ["a", "f", "g", "k", "m"]);
}

fn check_order(crate_name: &str, order: &[&str]) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../{crate_name}/src"));
    let position = |name: &str| order.iter().position(|m| *m == name);
    let mut wrong = Vec::new();
    let files = sources(&root);
    for file in &files {
        let own = module(&root, file);
        let Some(rank) = position(&own) else {
            wrong.push(format!("`{own}` has no place in the order of {crate_name}"));
            continue;
        };
        for name in used(&code(file)) {
            // Names of items re-exported at the root (types, macros) are not modules.
            if position(&name).is_some_and(|other| other > rank) {
                wrong.push(format!(
                    "{}: `{own}` uses `{name}`, which stands above it",
                    file.display()
                ));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
    for name in order {
        assert!(
            files.iter().any(|f| module(&root, f) == *name),
            "`{name}` does not exist"
        );
    }
}

#[test]
fn ukmacros() {
    check_order(
        "ukmacros",
        &[
            "diag",
            "parse",
            "model",
            "lower",
            "check",
            "constants",
            "emit",
        ],
    );
    check_order("ukmacros/algebra", &["place", "expr", "analysis"]);
}

#[test]
fn ukcore() {
    check_order(
        "ukcore",
        &[
            "numbers",
            "error",
            "scalar",
            "scan",
            "random",
            "rounding",
            "interval",
            "zero",
            "spec",
            "plan",
            "mechanism",
            "spectrum",
            "pinv",
            "lu",
            "equations",
            "noise",
            "measure",
            "metric",
            "dense",
            "saddle",
            "naming",
            "solver",
            "lanes",
            "manifold",
            "assemble",
            "start",
            "model",
            "linearise",
            "displacements",
            "kinks",
            "modes",
            "nearby",
            "branches",
            "inverse",
            "diagnosis",
            "kinematics",
            "explain",
            "equilibrium",
            "integrate",
            "events",
            "trajectory",
            "simulate",
            "verify",
        ],
    );
}

#[test]
fn syntax_is_parsed_in_parse_and_written_in_emit() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../ukmacros/src");
    for file in sources(&root) {
        let text = code(&file);
        let own = module(&root, &file);
        // `diag` takes over the parser's own errors.
        let syn = text.replace("syn::Error", "");
        assert!(
            own == "parse" || !syn.contains("syn::"),
            "{}",
            file.display()
        );
        assert!(
            own == "emit" || !text.contains("quote!"),
            "{}",
            file.display()
        );
    }
}

#[test]
fn no_unsafe_code_and_no_loose_ends() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    for name in [
        "ukmacros/algebra",
        "ukmacros/units",
        "ukcore",
        "ukmacros",
        "models",
        "models/catalogue",
        "models/tool",
        "models/uk",
        "tests",
        "tests/stability",
    ] {
        for file in sources(&root.join(name).join("src")) {
            let text = std::fs::read_to_string(&file).expect("readable");
            let words = [
                concat!("to", "do!"),
                concat!("unimpl", "emented!"),
                concat!("FIX", "ME"),
                concat!("db", "g!"),
            ];
            // The library and the compiler tell by their results alone.
            let silent = ["eprint", "env::var("];
            let silent = match name {
                "ukcore" | "ukmacros" | "ukmacros/algebra" | "ukmacros/units" => &silent[..],
                _ => &[],
            };
            for word in words.iter().chain(silent) {
                assert!(!text.contains(word), "{} contains {word}", file.display());
            }
        }
    }
}

/// All Rust files below `directory`, but those that are emitted.
fn files(directory: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(directory).expect("a directory");
    let paths = entries.map(|entry| entry.expect("readable").path());
    let below = |path: PathBuf| match path.is_dir() {
        true if path.ends_with("golden") || path.ends_with("target") => Vec::new(),
        true => files(&path),
        false if path.extension().is_some_and(|end| end == "rs") => vec![path],
        false => Vec::new(),
    };
    paths.flat_map(below).collect()
}

#[test]
fn lines_of_prose_end_within_140_columns() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut texts = vec![root.join("README.md")];
    for entry in std::fs::read_dir(root.join("docs")).expect("the pages") {
        texts.push(entry.expect("readable").path());
    }
    for name in ["ukcore", "ukmacros", "models", "tests"] {
        texts.extend(files(&root.join(name)));
    }
    let mut wide = Vec::new();
    for file in &texts {
        let page = file.extension().is_some_and(|end| end == "md");
        let text = std::fs::read_to_string(file).expect("readable");
        for (number, line) in text.lines().enumerate() {
            // (Tables, and text in code, may be wider.)
            let prose = match page {
                true => !line.starts_with('|') && !line.contains("]("),
                // (A text in code goes on behind a backslash.)
                false => line.trim_start().starts_with("//") && !line.ends_with('\\'),
            };
            if prose && line.chars().count() > 140 {
                wide.push(format!("{}:{}", file.display(), number + 1));
            }
        }
    }
    assert!(wide.is_empty(), "{wide:#?}");
}
