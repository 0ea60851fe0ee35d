//! What the compiler tells about a mechanism.

use super::{analysis, expand};

/// The coordinates x, y, th of a mechanism under these forces and constraints that are angles.
fn angles(sections: &str) -> Vec<&'static str> {
    let source = format!(
        "pub T {{ params {{ w = 2.0, k = 1.0 }} coords {{ x, y, th }} mass {{ x: 1.0, y: 1.0, th: 1.0 }} {sections} }}"
    );
    let analysis = analysis(source.parse().expect("tokens"));
    let name = |i: usize| ["x", "y", "th"][i];
    analysis.structure.angles.into_iter().map(name).collect()
}

#[test]
fn angles_are_what_sines_are_taken_of() {
    for (sections, expected) in [
        ("force { x: cos(x - th) }", &["x", "th"][..]),
        ("force { x: tan(-2.0 * th) }", &["th"]),
        ("let s = x + y; force { x: sin(s) }", &["x", "y"]),
        ("let f = |u| cos(u); force { x: f(th) }", &["th"]),
        // A length, if w is one over a length.
        ("force { x: sin(w * (t + x)) + cos(y / k) }", &[]),
        ("force { x: sin(2.0 * (w * t + th)) }", &["th"]),
        ("force { x: sin(w * t + k) * th }", &[]),
        ("force { x: sin(dot(th)) }", &[]),
        ("force { x: asin(0.1 * x) + atan(th) + sinh(y) }", &[]),
        ("force { x: sin(atan2(y, x)) + cos(abs(th)) }", &["th"]),
        ("potential { k * cos(th) }", &["th"]),
        ("holonomic { rod: [x, y] = [cos(th), sin(th)] }", &["th"]),
        ("nonholonomic { blade: dot(x) * sin(th) = dot(y) }", &["th"]),
        ("nonideal { x: -dot(x) * sq(cos(y)) }", &["y"]),
        ("force { x: -atan(x) }", &[]),
        (
            "let s = x + 2.0 * y - w * th + k + t; force { y: sin(s) }",
            &["x", "y"],
        ),
        ("force { x: sin(th + k) }", &["th"]),
        ("force { x: sin(w * x) + sin(x) }", &["x"]),
        // An output turns nothing.
        ("output { o = sin(x) }", &[]),
    ] {
        assert_eq!(angles(sections), expected, "{sections}");
    }
}

/// Units tell of angles where they are declared, whatever the factor is: a wave along x, gears.
#[test]
fn angles_are_what_units_say() {
    let source = "pub T { params { k = 2.0 [1/m], ratio = 3.0 } coords { x [m], th [rad], u } mass { x: 1.0 [kg], th: 1.0 [kg m^2], u: 1.0 [kg m^2] }
        force { x: 1.0 [N] * sin(k * x), th: 1.0 [N m] * sin(ratio * th), u: 1.0 [N m] * cos(u) } }";
    let analysis = analysis(source.parse().expect("tokens"));
    assert_eq!(analysis.structure.angles, [1, 2]);
}

#[test]
fn documentation_shows_the_first_constraints_and_the_last() {
    let long = |i: usize| {
        let terms = (0..200).map(|k| format!("sin({k}.25 * x[{i}])"));
        terms.collect::<Vec<_>>().join(" + ")
    };
    let rows = (0..12).map(|i| match i {
        // Long ones among those that are left out: the first of them, and another.
        6 | 8 => format!("c{i}: {} = y", long(i)),
        _ => format!("c{i}: sin({}.5 * x[{i}]) = y * x[{i}]", i * i),
    });
    let rows: Vec<String> = rows.collect();
    let source = format!(
        "pub T {{ coords {{ x[12], y }} mass {{ y: 1, x: 1 }} holonomic {{ {} }} }}",
        rows.join(", ")
    );
    let docs = expand(&source).0.to_string();
    let count = |text: &str| docs.matches(text).count();
    assert_eq!(count("… 5 more, which"), 1);
    assert_eq!(count("… a long one, which"), 0);
    for i in 0..12 {
        let shown = !(6..11).contains(&i);
        assert_eq!(
            docs.contains(&format!("<mtext>c{i}:</mtext>")),
            shown,
            "c{i}"
        );
    }
}

#[test]
fn the_runtime_is_called_what_the_user_calls_it() {
    let rest = "pub T { coords { x } mass { x: 1.0 } }";
    let emitted = |source: &str| expand(source).0.to_string().replace(' ', "");
    assert!(emitted(rest).contains("use::ukcore::emittedasukcore;"));
    let renamed = emitted(&format!("#[ukcore(crate = my::dynamics)] {rest}"));
    assert!(
        renamed.contains("usemy::dynamics::emittedasukcore;"),
        "{renamed}"
    );
    assert!(!renamed.contains("::ukcore;") && !renamed.contains("::ukcore::"));
}

#[test]
fn commas_may_be_left_out_before_names() {
    let source = "pub T { bodies { planar a { mass: 1, inertia: 2 } } coords { u, v } mass { u: 1, v: 1 } \
        start s(b = 30 [deg], c = 2.0) { [u, v] near [b, c], a.angle = b } draw { line(a.at([0, 0]), a.centre), text(a.centre, \"a\") } }";
    let (with, errors) = expand(source);
    assert!(errors.is_empty());
    for (from, to) in [
        ("mass: 1, inertia", "mass: 1 inertia"),
        ("[deg], c", "[deg] c"),
        ("[u, v] near", "[u v] near"),
        ("([0, 0]), a.centre", "([0, 0]) a.centre"),
        ("a.centre, \"a\"", "a.centre \"a\""),
    ] {
        assert!(source.contains(from));
        let (without, errors) = expand(&source.replace(from, to));
        let told: Vec<&str> = errors.iter().map(|e| e.message.as_str()).collect();
        assert!(told.is_empty(), "{to}: {told:?}");
        assert_eq!(with.to_string(), without.to_string(), "{to}");
    }
}

/// All names that a pattern binds.
fn bound(pattern: &syn::Pat, names: &mut Vec<String>) {
    match pattern {
        syn::Pat::Ident(p) => names.push(p.ident.to_string()),
        syn::Pat::Type(p) => bound(&p.pat, names),
        syn::Pat::Tuple(p) => p.elems.iter().for_each(|p| bound(p, names)),
        syn::Pat::Slice(p) => p.elems.iter().for_each(|p| bound(p, names)),
        _ => {}
    }
}

/// The functions of the emitted code, each with the names it binds, but for `lit` and a `sum` within a block.
fn functions(code: proc_macro2::TokenStream) -> Vec<(String, Vec<String>)> {
    let items = syn::parse2::<syn::File>(code)
        .expect("emitted code is Rust")
        .items;
    let blocks = items.into_iter().filter_map(|item| match item {
        syn::Item::Const(item) => Some(*item.expr),
        _ => None,
    });
    let items = blocks.flat_map(|block| match block {
        syn::Expr::Block(b) => b.block.stmts,
        _ => Vec::new(),
    });
    let members = items.flat_map(|item| match item {
        syn::Stmt::Item(syn::Item::Impl(item)) => item.items,
        _ => Vec::new(),
    });
    let functions = members.filter_map(|member| match member {
        syn::ImplItem::Fn(f) => Some(f),
        _ => None,
    });
    let named = functions.map(|f| {
        let mut names = Vec::new();
        for argument in &f.sig.inputs {
            if let syn::FnArg::Typed(argument) = argument {
                bound(&argument.pat, &mut names);
            }
        }
        for statement in &f.block.stmts {
            if let syn::Stmt::Local(local) = statement {
                bound(&local.pat, &mut names);
            }
        }
        (f.sig.ident.to_string(), names)
    });
    named.collect()
}

#[test]
fn no_name_of_the_user_is_one_of_the_emitted_code() {
    let declaration = |name: &str| {
        format!(
            "pub T {{ params {{ k = 1.0 }} coords {{ zx, zy }} let {name} = zx * zy + k; \
             kinetic {{ 0.5 * sq(dot(zx)), sq({name}) * sq(dot(zy)) }} potential {{ {name} * sq({name}) }} \
             force {{ zx: abs({name}) + sin({name}), zy: sign(dot({name})) }} nonideal {{ zx: -{name} }} \
             holonomic {{ zc: {name} * zx = sin({name}) }} output {{ zo = {name} * sq({name}) }} }}"
        )
    };
    let emitted = functions(expand(&declaration("zz")).0);
    let mut names: Vec<String> = emitted
        .into_iter()
        .flat_map(|(name, bound)| [vec![name], bound].concat())
        .collect();
    names.sort_unstable();
    names.dedup();
    names.retain(|name| !["k", "zx", "zy"].contains(&name.as_str()));
    assert!(names.len() > 40, "{names:?}");
    for name in names {
        let (code, errors) = expand(&declaration(&name));
        if !errors.is_empty() {
            assert!(
                errors.len() == 1 && errors[0].message.contains("reserved"),
                "{name}: {errors:?}"
            );
            continue;
        }
        for (function, bound) in functions(code) {
            let slices = [
                "out",
                "mass",
                "force",
                "nonideal",
                "jacobian",
                "rhs",
                "phi",
                "rate",
                "outputs",
                "switching",
                "prepared",
            ];
            let mut seen = std::collections::HashMap::new();
            for bound in bound {
                let times = seen.entry(bound.clone()).or_insert(0);
                *times += 1;
                // A slice is bound as an argument, and with its length.
                let allowed = if slices.contains(&bound.as_str()) {
                    2
                } else {
                    1
                };
                assert!(
                    *times <= allowed,
                    "`{name}` in `{function}`: `{bound}` is bound twice"
                );
            }
        }
    }
}

#[test]
fn constants_of_every_mechanism_are_reserved() {
    let source = include_str!("../../../ukcore/src/mechanism.rs");
    let (_, body) = source.split_once("pub trait Mechanism").expect("the trait");
    let (body, _) = body.split_once("\n}\n").expect("its end");
    let names: Vec<&str> = body
        .lines()
        .filter_map(|line| line.trim().strip_prefix("const ")?.split(':').next())
        .collect();
    assert_eq!(names, crate::constants::ASSOCIATED);
    for name in names {
        let name = name.to_lowercase();
        for sections in [
            format!("coords {{ {name} }} mass {{ {name}: 1.0 }}"),
            format!("coords {{ x }} mass {{ x: 1.0 }} holonomic {{ {name}: x = t }}"),
            format!("const {name}: usize = 3; coords {{ x }} mass {{ x: 1.0 }}"),
        ] {
            let (_, errors) = expand(&format!("pub T {{ {sections} }}"));
            assert!(
                errors.len() == 1 && errors[0].message.contains("which every mechanism has"),
                "{sections}: {errors:?}"
            );
        }
    }
}
