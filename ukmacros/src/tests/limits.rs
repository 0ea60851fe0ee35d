//! Sizes: what is long is taken, what is deep is refused, and the graph grows no faster than the declaration.

use super::{expand, system};

/// A declaration of one coordinate under the force `force`.
fn forced(force: &str) -> String {
    format!("pub T {{ coords {{ x, y }} mass {{ x: 1.0, y: 1.0 }} force {{ x: {force} }} }}")
}

/// `count` copies of `piece` with its number in place of `#`.
fn repeated(piece: &str, count: usize) -> String {
    (0..count)
        .map(|k| piece.replace('#', &k.to_string()))
        .collect()
}

#[track_caller]
fn accepted(source: &str) {
    let (_, errors) = expand(source);
    let first: Vec<_> = errors.iter().take(3).map(|e| &e.message).collect();
    assert!(errors.is_empty(), "{first:?}");
}

#[test]
fn flat_expressions_of_thousands_of_operands_are_taken() {
    let n = 3000;
    accepted(&forced(&format!("x{}", repeated(" + #.5 * x", n))));
    accepted(&forced(&format!("x{}", repeated(" - -sin(#.5)", n))));
    accepted(&forced(&format!("x{}", repeated(" * y / 1.5", n / 100))));
    let params: String = repeated("p# = 1.5, ", n);
    let product = format!("x{}", repeated(" * p#", n));
    accepted(&format!(
        "pub T {{ params {{ {params} }} coords {{ x }} mass {{ x: 1.0 }} force {{ x: {product} }} }}"
    ));
    // Thousands of entries, with and without commas, docs and `=` included.
    let families = format!(
        "params {{ {} }} coords {{ x[{n}] }}",
        repeated("/// p\np# = 1.0\n", n)
    );
    let mass = repeated("x[#]: 1.0 ", n);
    let outputs = repeated("o# = -2.0 * x[#] ", n);
    let loops = repeated("for i in 0..1 { x[i]: p# } ", n);
    let lets = repeated("let f# = |u| u; ", n);
    accepted(&format!(
        "pub T {{ {families} {lets} mass {{ {mass} }} force {{ {loops} }} output {{ {outputs} }} }}"
    ));
}

#[test]
fn long_functions_have_borders() {
    for (links, has) in [(5, false), (400, true)] {
        let (code, _) = expand(&super::speed::chain(links));
        assert_eq!(code.to_string().contains("border"), has, "{links} links");
    }
}

#[test]
fn deep_nesting_is_refused_before_it_overflows() {
    let n = 20_000;
    let nested = |open: &str, inner: &str, close: &str| {
        format!("{}{inner}{}", open.repeat(n), close.repeat(n))
    };
    for force in [
        nested("-", "x", ""),
        nested("- ", "x", ""),
        nested("!", "x", ""),
        nested("&", "x", ""),
        nested("x = ", "x", ""),
        nested("|u| ", "x", ""),
        nested("|u,| ", "x", ""),
        nested("x + |u| ", "x", ""),
        nested("#[a] -", "x", ""),
        nested("return ", "x", ""),
        nested("x as A<", "f64", ">"),
        nested("x as &'a ", "f64", ""),
        nested("x + if x {} else ", "x", ""),
        nested("", "x", ".sin()"),
        nested("", "x", "[0]"),
        nested("", "x", "(0)"),
        nested("", "x", " as f64"),
        nested("..", "x", ""),
    ] {
        let start: String = force.chars().take(20).collect();
        let (code, errors) = expand(&forced(&force));
        assert_eq!(errors.len(), 1, "{start}");
        assert!(
            errors[0].message.contains("nested too deeply"),
            "{start}: {}",
            errors[0].message
        );
        assert!(
            code.to_string().contains("struct T"),
            "the type is still there"
        );
    }
    // As deep as anyone writes.
    accepted(&forced(&format!(
        "{}x{}",
        "sin(".repeat(90),
        ")".repeat(90)
    )));
    accepted(&forced(&format!("{}x", "-".repeat(90))));
    let deep = format!("{}x{}", "(".repeat(300), ")".repeat(300));
    assert_eq!(expand(&forced(&deep)).1.len(), 1);
}

#[test]
fn functions_within_functions_are_bounded() {
    let chain = |n: usize| {
        let functions = repeated("let f#_ = |u| f#(u) + 1.0; ", n);
        let mut renamed = functions;
        for k in (0..n).rev() {
            renamed = renamed.replace(&format!("f{k}_ "), &format!("f{} ", k + 1));
        }
        format!(
            "pub T {{ coords {{ x }} let f0 = |u| u; {renamed} mass {{ x: 1.0 }} force {{ x: f{n}(x) }} }}"
        )
    };
    accepted(&chain(20));
    let (_, errors) = expand(&chain(500));
    let messages: Vec<_> = errors.iter().map(|e| &e.message).collect();
    assert_eq!(errors.len(), 1, "{messages:?}");
    assert!(messages[0].contains("too deeply"), "{messages:?}");
}

#[test]
fn functions_that_multiply_are_bounded() {
    // Each applies the one before twice: 2^60 applications.
    let doubled: String = (1..60).fold("let f0 = |u| u + 1; ".to_owned(), |text, k| {
        let j = k - 1;
        text + &format!("let f{k} = |u| f{j}(u) - f{j}(u); ")
    });
    for force in ["f59(x)", "x.powi(f59(1))"] {
        let source = format!(
            "pub T {{ coords {{ x }} {doubled} mass {{ x: 1.0 }} force {{ x: {force} }} }}"
        );
        let (_, errors) = expand(&source);
        let messages: Vec<_> = errors.iter().map(|e| &e.message).collect();
        assert_eq!(errors.len(), 1, "{messages:?}");
        assert!(messages[0].contains("times in all"), "{messages:?}");
    }
    // Each is two of the one before: 2^60 numbers. A product of 16 million terms.
    let doubled: String = (1..60).fold("let a0 = [x, x]; ".to_owned(), |text, k| {
        text + &format!("let a{k} = [a{}, a{}]; ", k - 1, k - 1)
    });
    let listed = "let { for i in 0..30 { for j in 0..2000 { b[i][j] = [x, x] } } }";
    for (lets, force) in [
        (doubled.as_str(), "norm(a59)"),
        (listed, "norm(b[1][0]) * b[0][7][1] + sq(b)"),
        ("", "(transpose([p]) * [p])[0][0]"),
    ] {
        let source = format!(
            "pub T {{ coords {{ x, p[4000] }} {lets} mass {{ x: 1.0, p: 1.0 }} force {{ x: {force} }} }}"
        );
        let (_, errors) = expand(&source);
        let messages: Vec<_> = errors.iter().map(|e| &e.message).collect();
        assert_eq!(errors.len(), 1, "{messages:?}");
        assert!(
            messages[0].contains("terms; up to 100000 compile"),
            "{messages:?}"
        );
    }
    // Deep chains of index functions are refused, not followed until the stack ends.
    let chain: String = (1..3000).fold("let f0 = |u| u; ".to_owned(), |text, k| {
        text + &format!("let f{k} = |u| (((f{}(u)))); ", k - 1)
    });
    let source = |index: usize| {
        format!("pub T {{ coords {{ x[1] }} {chain} mass {{ x[f{index}(0)]: 1.0 }} }}")
    };
    accepted(&source(50));
    let (_, errors) = expand(&source(2999));
    assert_eq!(errors.len(), 1);
    assert!(errors[0].message.contains("gives no integer"));
}

#[test]
fn long_vectors_and_deep_matrices_are_taken() {
    let n = 600;
    let vector = format!("[{}]", repeated("# * x, ", n));
    accepted(&forced(&format!(
        "inner({vector}, {vector}) + norm({vector})"
    )));
    accepted(&format!(
        "pub T {{ const N: usize = {n}; params {{ m[N] = [{}] }} coords {{ x[N], p[N][2] }} mass {{ x: m, p: 1.0 }} \
         force {{ x: -m[0] * x }} potential {{ for i in 0..N {{ sq(p[i]) + 0.5 * m[i] * sq(x[i]) }} }} }}",
        repeated("#.5, ", n)
    ));
    let deep = format!("{}x{}{}", "[".repeat(45), "]".repeat(45), "[0]".repeat(45));
    accepted(&forced(&deep));
    let (_, errors) = expand(&forced(&format!("x{}", "[0]".repeat(20_000))));
    assert_eq!(errors.len(), 1);
    assert!(errors[0].message.contains("nested too deeply"));
}

/// Nodes of the graph with all derivatives.
fn nodes(source: &str) -> usize {
    let (mut system, model) = system(source);
    ukalgebra::analysis::derive(&mut system, model.coord_elements.len());
    system.graph.size()
}

#[test]
fn chains_of_values_make_graphs_in_proportion() {
    for step in [
        "let a# = a0# * (a0# + x); ",
        "let a# = a0# * a0#; ",
        "let a# = (a0# + x) * (a0# + y) * a0#; ",
        "let a# = a0# * x / (a0# + y); ",
        "let a# = a0# + x * a0# + y; ",
        "let a# = sin(a0#) * a0# * y; ",
    ] {
        let chain = |n: usize| {
            let lets: String = (1..=n)
                .map(|k| {
                    step.replace("a0#", &format!("a{}", k - 1))
                        .replace('#', &k.to_string())
                })
                .collect();
            format!(
                "pub T {{ coords {{ x, y }} let a0 = x * y; {lets} mass {{ x: 1.0, y: 1.0 }} holonomic {{ c: a{n} = 1.0 }} }}"
            )
        };
        let (short, long) = (nodes(&chain(120)), nodes(&chain(240)));
        assert!(long < 9 * short / 4, "{step}: {short} nodes, then {long}");
    }
}

/// Constraints on everything in reach: a coordinate waits for pairs whose inertia changes three couplings away.
#[test]
fn an_order_ends_where_more_rows_than_coordinates_are_coupled() {
    let text = include_str!("../../../tests/structure/vectors.rs");
    let (_, text) = text.split_once("multibody! {").expect("a declaration");
    let (declared, _) = text.split_once("\n}\n").expect("its end");
    let frame = "frame: rot(s) * [[p[0][0], p[0][1]], [p[1][0], p[1][1]]] = transpose(rot(t))";
    let source = declared.replacen("holonomic {", &format!("holonomic {{ {frame}"), 1);
    assert_ne!(source, declared);
    accepted(&source);
}
