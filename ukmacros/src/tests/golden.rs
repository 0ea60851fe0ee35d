//! The emitted code of every model, as reviewed: `golden/<Type>.rs`, and what all of it costs, on one page: `golden/operations.txt`.
//! A change shows in the diff.
//!
//! `UPDATE_GOLDEN=1 cargo test -p ukmacros golden` writes the files anew.

use proc_macro2::TokenStream;
use quote::ToTokens;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// All `multibody!` invocations of the models crate: file and tokens of the declaration.
pub(super) fn declarations() -> Vec<(PathBuf, TokenStream)> {
    let models = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../models/src");
    let mut out = Vec::new();
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
                out.push((path.clone(), call.mac.tokens));
            }
        }
    }
    out.sort_by(|a, b| a.0.cmp(&b.0));
    out
}

/// What one model becomes.
struct Expansion {
    /// The emitted code, formatted, without the text of its functions.
    code: String,
    /// Operations: what is counted, counts.
    costs: Vec<(String, Vec<String>)>,
}

/// Type name → expansion.
fn expansions() -> BTreeMap<String, Expansion> {
    let mut out = BTreeMap::new();
    for (path, tokens) in declarations() {
        let (code, diagnostics) = crate::expand(tokens.clone());
        let errors = diagnostics.take();
        assert!(errors.is_empty(), "{}: {errors:?}", path.display());
        let (again, _) = crate::expand(tokens);
        assert_eq!(
            code.to_string(),
            again.to_string(),
            "same input, same output"
        );
        let mut file = syn::parse2::<syn::File>(code).expect("emitted code is Rust");
        let name = file.items.iter().find_map(|i| match i {
            syn::Item::Struct(s) => Some(s.ident.to_string()),
            _ => None,
        });
        let name = name.expect("a struct is emitted");
        let block = file.items.iter_mut().find_map(|item| match item {
            syn::Item::Const(syn::ItemConst { expr, .. }) => match &mut **expr {
                syn::Expr::Block(block) => Some(&mut block.block.stmts),
                _ => None,
            },
            _ => None,
        });
        let Some(syn::Stmt::Item(syn::Item::Impl(implementation))) =
            block.and_then(|statements| statements.last_mut())
        else {
            panic!("the trait is implemented")
        };
        let items = &mut implementation.items;
        let spec = items.iter().find_map(|i| constant(i, "SPEC"));
        let costs = costs(spec.expect("SPEC"));
        items.retain(|i| constant(i, "CODE").is_none());
        let code = prettyplease::unparse(&file);
        out.insert(name, Expansion { code, costs });
    }
    out
}

/// The value of the associated constant `name`, if `item` is that.
fn constant<'a>(item: &'a syn::ImplItem, name: &str) -> Option<&'a syn::Expr> {
    match item {
        syn::ImplItem::Const(c) if c.ident == name => Some(&c.expr),
        _ => None,
    }
}

/// The counts of `costs` in SPEC.
fn costs(spec: &syn::Expr) -> Vec<(String, Vec<String>)> {
    let field = |expr: &syn::Expr, name: &str| -> syn::Expr {
        let expr = match expr {
            syn::Expr::Reference(r) => &*r.expr,
            expr => expr,
        };
        let syn::Expr::Struct(literal) = expr else {
            panic!("a struct with `{name}`")
        };
        let mut fields = literal.fields.iter();
        let found = fields.find(|f| matches!(&f.member, syn::Member::Named(n) if n == name));
        found.expect("the field is there").expr.clone()
    };
    let syn::Expr::Struct(costs) = field(&field(spec, "structure"), "costs") else {
        panic!("costs are emitted")
    };
    let rows = costs.fields.iter().map(|row| {
        let syn::Expr::Struct(counts) = &row.expr else {
            panic!("operations are emitted")
        };
        let counts = counts
            .fields
            .iter()
            .map(|f| f.expr.to_token_stream().to_string());
        (row.member.to_token_stream().to_string(), counts.collect())
    });
    rows.collect()
}

/// One line a model and function.
fn table(found: &BTreeMap<String, Expansion>) -> String {
    let mut out = format!(
        "{:<22} {:<14} {:>7} {:>8} {:>7} {:>7} {:>8} {:>7}\n",
        "model", "what", "add", "multiply", "divide", "root", "function", "select"
    );
    for (name, expansion) in found {
        for (what, counts) in &expansion.costs {
            let [add, multiply, divide, root, function, select] = &counts[..] else {
                panic!("six counts")
            };
            out += &format!(
                "{name:<22} {what:<14} {add:>7} {multiply:>8} {divide:>7} {root:>7} {function:>8} {select:>7}\n"
            );
        }
    }
    out
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

/// The type that `BROKEN` becomes, which `tests/tests/fallback.rs` compiles and uses.
fn fallback() -> String {
    let (code, errors) = super::expand(BROKEN);
    assert_eq!(errors.len(), 1, "{errors:?}");
    // What follows `::core::compile_error! { "message" }`.
    let code: TokenStream = code.into_iter().skip(8).collect();
    prettyplease::unparse(&syn::parse2(code).expect("the fallback is Rust"))
}

#[test]
fn emitted_code_is_as_reviewed() {
    let golden = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("golden");
    let update = std::env::var_os("UPDATE_GOLDEN").is_some();
    let found = expansions();
    assert!(!found.is_empty(), "there are models");
    if update {
        std::fs::create_dir_all(&golden).expect("can write");
    }
    let mut files: BTreeMap<String, String> = BTreeMap::new();
    files.insert("operations.txt".to_owned(), table(&found));
    files.insert("Broken.rs".to_owned(), fallback());
    files.extend(
        found
            .into_iter()
            .map(|(name, e)| (format!("{name}.rs"), e.code)),
    );
    let mut changed = Vec::new();
    for (name, text) in &files {
        let path = golden.join(name);
        if update {
            std::fs::write(&path, text).expect("can write");
        }
        if std::fs::read_to_string(&path).ok().as_ref() != Some(text) {
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
        .filter_map(|e| Some(e.ok()?.file_name().to_string_lossy().into_owned()))
        .filter(|name| !files.contains_key(name))
        .collect();
    assert!(
        stale.is_empty(),
        "no model makes golden files {stale:?} any more"
    );
}
