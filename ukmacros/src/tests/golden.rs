//! The emitted code of every model, as reviewed: `golden/<Type>.rs`. A change shows in the diff.
//!
//! `UPDATE_GOLDEN=1 cargo test -p ukmacros golden` writes the files anew.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// All `multibody!` invocations of the models crate: type name → expansion, formatted.
fn expansions(models: &Path) -> BTreeMap<String, String> {
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
            if last.is_none_or(|s| s.ident != "multibody") {
                continue;
            }
            let (code, diagnostics) = crate::expand(call.mac.tokens.clone());
            let errors = diagnostics.take();
            assert!(errors.is_empty(), "{}: {errors:?}", path.display());
            let (again, _) = crate::expand(call.mac.tokens);
            assert_eq!(
                code.to_string(),
                again.to_string(),
                "same input, same output"
            );
            let file = syn::parse2::<syn::File>(code).expect("emitted code is Rust");
            let name = file.items.iter().find_map(|i| match i {
                syn::Item::Struct(s) => Some(s.ident.to_string()),
                _ => None,
            });
            out.insert(
                name.expect("a struct is emitted"),
                prettyplease::unparse(&file),
            );
        }
    }
    out
}

#[test]
fn emitted_code_is_as_reviewed() {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let golden = root.join("golden");
    let update = std::env::var_os("UPDATE_GOLDEN").is_some();
    let found = expansions(&root.join("../models/src"));
    assert!(!found.is_empty(), "there are models");
    if update {
        std::fs::create_dir_all(&golden).expect("can write");
    }
    let mut changed = Vec::new();
    for (name, code) in &found {
        let path = golden.join(format!("{name}.rs"));
        if update {
            std::fs::write(&path, code).expect("can write");
        }
        if std::fs::read_to_string(&path).ok().as_deref() != Some(code) {
            changed.push(name);
        }
    }
    assert!(
        changed.is_empty(),
        "the emitted code of {changed:?} is not as in ukmacros/golden; if the change is meant, run \
         `UPDATE_GOLDEN=1 cargo test -p ukmacros golden` and review the diff"
    );
    let stale: Vec<_> = std::fs::read_dir(&golden)
        .expect("golden files are there")
        .filter_map(|e| Some(e.ok()?.path().file_stem()?.to_string_lossy().into_owned()))
        .filter(|name| !found.contains_key(name))
        .collect();
    assert!(
        stale.is_empty(),
        "no model makes golden files {stale:?} any more"
    );
}
