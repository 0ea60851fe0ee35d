//! Every error: its text and the tokens it points at, read off what rustc is given.

use super::expand;
use expect_test::{Expect, expect};
use proc_macro2::{LineColumn, TokenStream, TokenTree};
use std::fmt::Write as _;

mod elsewhere;
mod starts;

/// An error as rustc is told of it: a `compile_error!` whose first and last token carry its place.
struct Found {
    start: LineColumn,
    end: LineColumn,
    message: String,
}

/// The errors that `source` gives, in the order of their places. What else is emitted is the type, so that what uses it gives no second
/// message.
fn errors(source: &str) -> Vec<Found> {
    let (code, collected) = expand(source);
    let text = code.to_string();
    let mut found = compile_errors(code);
    assert_eq!(found.len(), collected.len(), "each error is emitted once");
    found.sort_by_key(|f| f.start);
    if source.starts_with("pub ") {
        let named = source.contains(" start a");
        let start = named.then_some("pub fn start");
        for part in ["struct", "Mechanism for"].into_iter().chain(start) {
            assert!(text.contains(part), "the fallback has its `{part}`");
        }
    }
    syn::parse_str::<syn::File>(&text).expect("the fallback is Rust");
    for Found { message, .. } in &found {
        let capital = message.starts_with(char::is_uppercase) && !message.starts_with("M ");
        assert!(!capital, "messages start in lower case: {message}");
    }
    found
}

/// All `::core::compile_error! { "message" }` in `code`.
fn compile_errors(code: TokenStream) -> Vec<Found> {
    let tokens: Vec<TokenTree> = code.into_iter().collect();
    let names = |tree: &TokenTree| matches!(tree, TokenTree::Ident(i) if i == "compile_error");
    let places = (0..tokens.len()).filter(|at| names(&tokens[*at]));
    let error = |at: usize| {
        let TokenTree::Group(message) = &tokens[at + 2] else {
            panic!("a message in braces")
        };
        let text: syn::LitStr = syn::parse2(message.stream()).expect("a message");
        Found {
            start: tokens[at - 5].span().start(),
            end: message.span().end(),
            message: text.value(),
        }
    };
    places.map(error).collect()
}

/// Expects the errors of `source`, shown as rustc shows them.
#[track_caller]
fn check_shown(source: &str, expected: &Expect) {
    let mut shown = String::new();
    for Found {
        start,
        end,
        message,
    } in errors(source)
    {
        let LineColumn { line, column } = start;
        let text = source.lines().nth(line - 1).expect("the line is there");
        let (margin, carets) = (" ".repeat(line.to_string().len()), end.column - column);
        let _ = writeln!(shown, "error: {message}");
        let _ = writeln!(shown, "{margin}--> {line}:{}", column + 1);
        let _ = writeln!(shown, "{line} | {text}");
        let _ = writeln!(shown, "{margin} | {:column$}{}", "", "^".repeat(carets));
    }
    expected.assert_eq(&shown);
}

#[test]
fn errors_as_they_are_shown() {
    check_shown(
        "pub Pendulum {
    params { m = 1.0, l = 1.0, g = 9.81 }
    coords { x, y }
    mass { x: m, y: m }
    potential { m * g * y }
    holonomic { rod: sq(x) + y ^ 2 = sq(length) }
    output { angle = atan2(x, -y) }
}",
        &expect![[r#"
            error: `^` is not a power in Rust; write `x.powi(2)`, `x.powf(y)` or `sq(x)`
             --> 6:32
            6 |     holonomic { rod: sq(x) + y ^ 2 = sq(length) }
              |                                ^
            error: unknown name `length`; declare it under `params`, `coords` or by `let` before its use
             --> 6:41
            6 |     holonomic { rod: sq(x) + y ^ 2 = sq(length) }
              |                                         ^^^^^^
        "#]],
    );
    check_shown(
        "pub Cart {
    params { m = 1.0, k = 1.0 }
    coords { x, y }
    mass { x: m }
    force { x: -k * x, y: -k * y }
}",
        &expect![[r#"
            error: coordinate `y` has neither mass nor constraint, so nothing determines the motion; give mass, constrain or remove what has none
             --> 3:17
            3 |     coords { x, y }
              |                 ^
        "#]],
    );
    check_shown(
        "pub Chain {
    const N: usize = 3;
    params { m = 1.0 }
    coords { x[N] }
    mass { for i in 0..N { x[i]: m } }
    force { x[3]: 1.0, y[0]: 1.0 }
    holonomic {
        for i in 0..N - 1 { link[i]: x[i + 1] - x[i] = dot(x[i]) }
        end: x[0] = t
        end: x[2] = 1.0
    }
}",
        &expect![[r#"
            error: index 3 is out of range: `x` has 3 members, `x[0]` to `x[2]`
             --> 6:15
            6 |     force { x[3]: 1.0, y[0]: 1.0 }
              |               ^
            error: `y` is not a coordinate; coordinates are `x`
             --> 6:24
            6 |     force { x[3]: 1.0, y[0]: 1.0 }
              |                        ^
            error: a velocity in a holonomic constraint; move the constraint under `nonholonomic`
             --> 8:56
            8 |         for i in 0..N - 1 { link[i]: x[i + 1] - x[i] = dot(x[i]) }
              |                                                        ^^^^^^^^^
            error: constraint `end` is declared twice; names must be unique
              --> 10:9
            10 |         end: x[2] = 1.0
               |         ^^^
        "#]],
    );
}

/// The places where `«` and `»` stand, and the source without them.
fn unmark(marked: &str) -> (String, Vec<(LineColumn, LineColumn)>) {
    let (mut source, mut spans, mut open) = (String::new(), Vec::new(), Vec::new());
    for c in marked.chars() {
        // Declarations of the cases are one line each.
        let at = LineColumn {
            line: 1,
            column: source.chars().count(),
        };
        match c {
            '«' => open.push(at),
            '»' => spans.push((open.pop().expect("« before »"), at)),
            _ => source.push(c),
        }
    }
    (source, spans)
}

/// Expects exactly the errors that `marked` marks, in order, each with its message.
#[track_caller]
pub(super) fn check(marked: &str, messages: &[&str]) {
    check_after("", marked, messages);
}

/// Expects exactly the errors that `marked` marks, each with its message, in a declaration that stands after `before`.
#[track_caller]
pub(super) fn check_after(before: &str, marked: &str, messages: &[&str]) {
    let (source, spans) = unmark(&format!("{before}pub T {{ {marked} }}"));
    let found = errors(&source);
    let shown: Vec<_> = found.iter().map(|f| f.message.as_str()).collect();
    assert_eq!(found.len(), messages.len(), "errors found: {shown:#?}");
    assert_eq!(spans.len(), messages.len(), "one mark per message");
    for ((f, expected), span) in found.iter().zip(messages).zip(spans) {
        let text = &f.message;
        assert!(
            text.contains(expected),
            "expected «{expected}»\n   found «{text}»"
        );
        assert_eq!((f.start, f.end), span, "place of «{text}»");
    }
}

cases! {
    check;
    // Names.
    unknown_name: "params { mass1 = 1.0 } coords { x } mass { x: «mass2» }" => "unknown name `mass2`; did you mean `mass1`?";
    unknown_name_without_neighbour: "coords { x } mass { x: «weight» }" => "declare it under `params`, `coords` or by `let`";
    unknown_coordinate: "coords { alpha } mass { alpha: 1.0 } force { «alpho»: 1.0 }" => "`alpho` is not a coordinate; did you mean `alpha`?";
    parameter_as_coordinate: "params { m = 1.0 } coords { x } mass { x: m } force { «m»: 1.0 }" => "`m` is not a coordinate";
    duplicate_coordinate: "coords { x, «x» } mass { x: 1.0 }" => "`x` is declared twice";
    duplicate_across_sections: "params { x = 1.0 } coords { «x», y } mass { y: 1.0 }" => "`x` is declared twice";
    names_alike_but_for_case: "params { k = 1.0 } coords { x, «X» } mass { x: 1.0 }" => "would both become the constant `X`";
    reserved_name: "coords { «t» } mass { }" => "`t` is reserved";
    reserved_function_name: "params { «sin» = 1.0 } coords { x } mass { x: 1.0 }" => "`sin` is reserved";
    duplicate_constraint_name: "coords { x, y } mass { x: 1.0, y: 1.0 } holonomic { c: x = 1.0  «c»: y = 1.0 }" => "constraint `c` is declared twice";
    unindexed_constraint_in_a_loop: "coords { x[2] } mass { for i in 0..2 { x[i]: 1.0 } } holonomic { for i in 0..2 { «c»: x[i] = 1.0 } }" => "in a loop, index it: `c[i]`";
    constraint_named_as_a_let: "coords { x } let d = x - 1.0; mass { x: 1.0 } holonomic { «d»: d = 0.0 }" => "`d` is declared twice";
    duplicate_output: "coords { x } mass { x: 1.0 } output { o = x, «o» = 2.0 * x }" => "output `o` is declared twice";
    output_named_as_a_coordinate: "coords { x } mass { x: 1.0 } output { «x» = x }" => "is a coordinate and in the output anyway";
    let_declared_twice: "coords { x } let u = x; let «u» = 2.0 * x; mass { x: 1.0 }" => "`u` is declared twice";
    let_used_before: "coords { x } let a = «b»; let b = x; mass { x: 1.0 }" => "unknown name `b`";
    reserved_word_as_a_name: "bodies { planar «box» { mass: 1.0, inertia: 1.0 } } holonomic { p: pin(ground.at([0, 0]), box.at([1, 0])) } output { a = box.x }" => "`box` is a reserved word of Rust; use another name, such as `box_`";
    // Syntax.
    let_within_a_section: "coords { x } mass { x: 1.0 } output { «let» u = x; o = u }" => "`let` stands beside sections, before the first that uses it";
    until_behind_the_braces: "coords { x } mass { x: 1.0 } start a { x = 1.0 } «until» 3.0 output { o = x }" => "`until` of a start stands before its braces: `start a until 2.0 { … }`";
    nonideal_spring: "bodies { planar a { mass: 1.0, inertia: 1.0 } } nonideal { «spring»(ground.at([0, 0]), a.at([1, 0]), 2.0, 1.0) }" => "a `spring` has a potential, which no constraint force has; it stands under `forces`";
    nonideal_misspelt: "bodies { planar a { mass: 1.0, inertia: 1.0 } } nonideal { «torqe»(a, 1.0) }" => "nothing that acts is called `torqe`; did you mean `torque`?";
    nonideal_force_at_the_centre: "bodies { planar a { mass: 1.0, inertia: 1.0 } } nonideal { a.«centre»: [0, 1] }" => "body `a` has no coordinate `centre`; what acts on it is written `force(a.at(p), F)` or `torque(a, M)`, under `forces` or `nonideal`";
    nonideal_moment_of_a_vector: "bodies { planar a { mass: 1.0, inertia: 1.0 } } nonideal { torque(a, «[0, 1]») }" => "`m` of `torque(b, m)` is a number, found a vector of 2";
    generalised_force_of_a_point: "bodies { planar a { mass: 1.0, inertia: 1.0 } } force { «a».at([1, 0]): [0, 1] }" => "goes under `forces`: `force(link.at([0, 0]), [fx, fy])`";
    caret_is_no_power: "coords { x } mass { x: 1.0 } holonomic { c: x «^» 2 = 1.0 }" => "`^` is not a power in Rust; write `x.powi(2)`";
    double_star_is_no_power: "coords { x } mass { x: 1.0 } holonomic { c: x * «*»2.0 = 1.0 }" => "`**` is not a power in Rust";
    remainder: "coords { x } mass { x: 1.0 } force { x: x «%» 2.0 }" => "`%` cannot be differentiated";
    comparison: "coords { x } mass { x: 1.0 } force { x: x «<» 2.0 }" => "no comparisons";
    not: "coords { x } mass { x: 1.0 } force { x: «!x» }" => "`!` has no meaning in an equation";
    operator_of_bits: "coords { x } mass { x: 1.0 } force { x: x «&» 2.0 }" => "this operator has no meaning in an equation; use `+ - * /`";
    call_of_a_number: "coords { x } mass { x: 1.0 } force { x: «(2.0)»(x) }" => "only a function's name can be called, such as `sin(x)`; an entry that begins with a parenthesis needs a `,` before it";
    type_argument: "coords { x } mass { x: 1.0 } force { x: x.powi«::<f64>»(2) }" => "a function takes no type arguments here";
    loop_in_an_equation: "coords { x } mass { x: 1.0 } force { x: «loop { }» }" => "not an equation's expression; allowed are numbers, names";
    large_integer: "coords { x } mass { x: 1.0 } force { x: «99999999999999999999» }" => "integer is too large; write it as a float";
    large_number: "coords { x } mass { x: 1.0 } force { x: «1e999» }" => "number is too large for an `f64`";
    function_with_an_index: "coords { x } mass { x: 1.0 } let { for i in 0..2 { f[i] = |u| «i * u» } } output { o = x }" => "a function cannot be indexed; pass the index as an argument";
    double_equals: "coords { x } mass { x: 1.0 } holonomic { c: «x == 1.0» }" => "an equation is written with one `=`";
    double_equals_of_a_start: "coords { x } mass { x: 1.0 } start s() { x «=»= 1.0 }" => "an equation is written with one `=`";
    branch: "coords { x } mass { x: 1.0 } force { x: «if x { 1.0 } else { 2.0 }» }" => "no branches in an equation";
    two_equals: "coords { x, y } mass { x: 1.0, y: 1.0 } holonomic { c: x = y «=» 1.0 }" => "an equation has one `=`";
    not_an_equation: "coords { x } mass { x: 1.0 } holonomic { c: «x - 1.0» }" => "a constraint is an equation: `lhs = rhs`";
    unnamed_constraint: "coords { x } mass { x: 1.0 } holonomic { «x» = 1.0 }" => "a constraint needs a name";
    field_access: "params { m = 1.0 } coords { x } mass { x: self.«m» }" => "no fields here";
    path: "coords { x } mass { x: 1.0 } force { x: «f64::consts::PI» }" => "no paths here; write `PI`";
    constant_without_type: "const «N» = 3; coords { x[N] } mass { for i in 0..N { x[i]: 1.0 } }" => "a constant needs its type: `const N: usize = 3;`";
    product_without_sign: "coords { x } mass { x: 1.0 } force { x: «2x» }" => "a product is written with its sign: `2 * x`";
    float_suffix: "coords { x } mass { x: «1.0f32» }" => "only `f64` numbers here";
    equals_in_a_mass: "coords { x } mass { x «=» 1 }" => "here stands `:`, as in `x: 1.0`";
    equals_in_a_force: "coords { x } mass { x: 1 } force { x «=» 1 }" => "here stands `:`, as in `x: 1.0`";
    colon_in_an_output: "coords { x } mass { x: 1 } output { o«:» x }" => "here stands `=`: `o = …`";
    hyphen_in_a_parameter: "params { my«-»l = 1 } coords { x } mass { x: 1 }" => "names have no `-`; `_` joins words";
    fractional_powi: "coords { x } mass { x: 1 } potential { x.powi(«2.5») }" => "write `powf(2.5)`";
    unit_in_parentheses: "coords { x «(»m) } mass { x: 1 }" => "a unit stands in brackets: `x [m]`";
    mass_of_a_coordinate: "coords { x«:» 1.0 } mass { x: 1 }" => "a coordinate is declared by its name alone";
    unit_behind_a_start: "coords { x } mass { x: 1 } start s { dot(x) = 2 «m»/s }" => "a unit stands in brackets: `2.0 [m]`";
    product_without_a_sign: "params { k = 1 } coords { x } mass { x: 2 «k» }" => "a product is written with `*`";
    force_on_nothing: "params { m = 1 } coords { x } mass { x: m } force { «-»m * 9.81 }" => "an entry begins with the coordinate that it belongs to";
    power_of_a_parameter: "params { n = 2 } coords { x } mass { x: 1 } potential { x.powi(«n») }" => "others go with `powf`";
    downward_range: "coords { x[3] } mass { for i in «3..0» { x[i]: 1 } }" => "it goes upwards, from the smaller number";
    closure_in_place: "coords { x } mass { x: 1.0 } force { x: «|u| u» }" => "a function must be named first";
    cast: "const N: usize = 2; coords { x } mass { x: N as «f32» }" => "only `as f64` is allowed";
    tuple: "coords { x, y } mass { x: 1.0, y: 1.0 } holonomic { c: «(x, y)» = [0.0, 0.0] }" => "a vector is written `[a, b]`";
    body_called_ground: "bodies { planar «ground» { mass: 1, inertia: 1 } }" => "the ground is there already, and does not move; give the body another name";
    unit_without_brackets: "params { a = 1 «rad», m = 1 } coords { x } mass { x: m }" => "a unit stands in brackets: `1 [rad]`";
    units_without_brackets: "params { a = -1.5 «kg» m } coords { x } mass { x: 1 }" => "a unit stands in brackets: `1.5 [kg]`";
    pow: "coords { x } mass { x: 1 } force { x: -x.«pow»(2) }" => "a power is written `x.powi(2)`, with a whole exponent, `x.powf(y)` or `sq(x)`";
    velocity_in_one_word: "coords { x[2] } mass { x[0]: 1, x[1]: 1 } force { x[0]: -«xdot» }" => "unknown name `xdot`; the velocity of `x` is `dot(x)`";
    velocity_with_a_letter: "coords { x } mass { x: 1 } force { x: -«v_x» }" => "unknown name `v_x`; the velocity of `x` is `dot(x)`";
    entry_of_omega: "bodies { spatial ball { mass: 1, inertia: [1, 1, 1] } } start s() { ball.omega[«2»] = 1.0 }" => "a start gives a vector as a whole: `ball.omega = […]`";
    entry_of_a_centre: "bodies { spatial ball { mass: 1, inertia: [1, 1, 1] } } start s() { ball.centre[«2»] = 1.0 }" => "a start gives a vector as a whole: `ball.centre = […]`; choose a coordinate of it: `x`, `y`, `z`, `e0`, `e1`, `e2`, `e3`";
    parameter_without_default: "params { «m» } coords { x } mass { x: 1.0 }" => "parameter `m` needs a default";
    unknown_section: "coords { x } mass { x: 1.0 } «forced» { x: 1.0 }" => "unknown section `forced`; did you mean `force`?";
    unknown_section_for_constraints: "coords { x } mass { x: 1.0 } «constraint» { c: x = 1.0 }" => "unknown section `constraint`; constraints stand under `holonomic`, those with velocities under `nonholonomic`";
    friction_the_other_way_round: "coords { x } mass { x: 1.0 } nonideal { x: «friction(2.0, dot(x))» }" => "`friction` takes a velocity, made with `dot` or of a body, and a number";
    reaction_of_a_joint_of_the_tree: "bodies { planar a { mass: 1.0, inertia: 1.0 } } tree { p: pin(ground.at([0, 0]), a.at([1, 0])) } output { f = reaction(«p») }" => "`p` stands under `tree`";
    unknown_shape: "coords { x } mass { x: 1.0 } draw { «lien»([x, 0], [0, 0]) }" => "unknown shape `lien`; did you mean `line`?";
    shape_far_from_all: "coords { x } mass { x: 1.0 } draw { «flower»([x, 0]) }" => "unknown shape `flower`; shapes are `line(p, q)`, `polyline(p, q, …)`";
    shape_like_none: "coords { x } mass { x: 1.0 } draw { «rect»([x, 0], [1, 1]) }" => "unknown shape `rect`; shapes are `line(p, q)`";
    shape_without_points: "coords { x } mass { x: 1.0 } draw { «line» }" => "a shape is written with its points: `line(p, q)`";
    shape_with_too_few_points: "coords { x } mass { x: 1.0 } draw { «line»([x, 0]) }" => "shapes are written `line(p, q)`, ";
    text_without_words: "coords { x } mass { x: 1.0 } draw { «text»([x, 0]) }" => "shapes are written `line(p, q)`, ";
    circle_of_a_vector: "coords { x } mass { x: 1.0 } draw { circle([x, 0], «[1, 0]») }" => "expected a number, found a vector of 2";
    point_that_is_a_number: "coords { x } mass { x: 1.0 } draw { trace(«x») }" => "expected a point of 2 or 3 coordinates, found a number";
    points_of_two_worlds: "coords { x } mass { x: 1.0 } draw { line([x, 0], «[x, 0, 0]») }" => "found a vector of 3 in a picture whose first point has 2 coordinates";
    body_for_a_point: "bodies { planar a { mass: 1.0, inertia: 1.0 } } draw { trace(«a») }" => "found the body `a`; a point of it is written `a.at([x, y])`";
    repeated_section: "coords { x } «coords» { y } mass { x: 1.0, y: 1.0 }" => "section `coords` appears twice";
    repeated_section_of_the_same_names: "params { m = 1.0 } «params» { m = 2.0 } coords { x } mass { x: m }" => "section `params` appears twice";
    repeated_constraints: "coords { x, y } mass { x: 1.0, y: 1.0 } holonomic { c: x = y } «holonomic» { c: x = y }" => "section `holonomic` appears twice";
    repeated_outputs: "coords { x } mass { x: 1.0 } output { o = x } «output» { o = x }" => "section `output` appears twice";
    repeated_section_with_an_error: "coords { x } mass { x: 1.0 } «mass» { x: sin(x; 2) }" => "section `mass` appears twice";
    semicolon_in_a_call: "coords { x } mass { x: 1.0 } force { x: atan(x«;» 2) }" => "expected `,`";
    semicolon_in_parentheses: "coords { x } mass { x: 1.0 } force { x: 2 * (x«;» 2) } output { o = x }" => "expected `,`";
    no_comma_in_a_call: "coords { x, y } mass { x: 1.0, y: 1.0 } force { x: max(x «y») }" => "expected `,`";
    two_commas_in_a_call: "coords { x } mass { x: 1.0 } force { x: max(x,«,» 2) }" => "expected an expression";
    semicolon_in_a_sum: "coords { x } mass { x: 1.0 } force { x: sum(0..3«;» |i| x) }" => "expected `,`";
    ternary: "coords { x } mass { x: 1.0 } force { x: x «>» 0 ? 1 : 2 }" => "no comparisons";
    pair_of_three: "coords { x, y } mass { x: 1.0, y: 1.0, (x, y, «x»): 1.0 }" => "an entry of M belongs to one or two coordinates";
    type_of_an_argument: "coords { x } let f = |«a: f64»| a; mass { x: 1.0 } force { x: f(x) }" => "an argument is a plain name";
    attribute: "coords { #[«inline»] x } mass { x: 1.0 }" => "only doc comments are allowed here";
    lint_of_an_entry: "coords { «#»[allow(dead_code)] x } mass { x: 1.0 }" => "`#[allow(…)]` stands before the whole declaration";
    crate_without_path: "#[«ukcore(runtime)»] coords { x } mass { x: 1.0 }" => "this attribute is written `#[ukcore(part)]` or `#[ukcore(crate = my::path::to::ukcore)]`";
    crate_of_an_entry: "coords { «#»[ukcore(crate = a)] x } mass { x: 1.0 }" => "stands before the whole declaration";
    open_range: "coords { x[3] } mass { for i in «0..» { x[i]: 1.0 } }" => "a range needs both ends";
    no_range: "coords { x[3] } mass { for i in «3» { x[i]: 1.0 } }" => "expected a range such as `0..N`";
    // Indices and loops.
    index_out_of_range: "const N: usize = 3; coords { x[N] } mass { for i in 0..N { x[i]: 1.0 } } holonomic { for i in 0..N { c[i]: x[«i + 1»] = 0.0 } }" => "index 3 is out of range: `x` has 3 members";
    negative_index: "coords { x[3] } mass { for i in 0..3 { x[i]: 1.0 } } force { x[«-1»]: 1.0 }" => "index -1 is out of range";
    range_not_constant: "params { n = 3.0 } coords { x[3] } mass { for i in 0..«n» { x[i]: 1.0 } }" => "`n` is not an integer constant or loop variable";
    fractional_index: "coords { x[3] } mass { for i in 0..3 { x[i]: 1.0 } } force { x[«1.5»]: 1.0 }" => "not an integer known at compile time";
    endless_range: "coords { x[3] } mass { for i in 0..«1000000000» { x[i]: 1.0 } }" => "up to 5000 compile";
    endless_constant: "const N: usize = «100000»; coords { x[N], y[2 * N] } mass { for i in 0..N - 1 { x[i]: sum(0..N, |k| 1.0) } }" => "by `N` = 100000 have";
    loops_in_loops: "const N: usize = 1000; coords { x[N] } mass { for i in 0..N { x[i]: sum(«0..N», |k| 1.0) } }" => "100000 repetitions in all";
    loop_variable_taken: "coords { x } mass { x: 1.0 } force { for «x» in 0..2 { x: 1.0 } }" => "`x` is declared twice";
    nested_loop_variable: "coords { x } mass { x: 1.0 } force { for i in 0..2 { for «i» in 0..2 { x: 1.0 } } }" => "`i` is already a loop variable";
    family_without_index: "coords { x[3] } mass { for i in 0..3 { x[i]: 1.0 } } force { «x»: 1.0 }" => "`x` is a family; choose a member, `x[0]` to `x[2]`";
    scalar_with_index: "coords { x } mass { x: 1.0 } force { x[«0»]: 1.0 }" => "`x` is not a family";
    empty_family: "coords { x[«0»], y } mass { y: 1.0 }" => "a family needs at least 1 member, not 0";
    integer_overflow: "const N: usize = «9223372036854775807 + 1»; coords { x } mass { x: 1.0 }" => "integer overflow";
    integer_division_by_zero: "const N: usize = «1 / 0»; coords { x } mass { x: 1.0 }" => "division by zero";
    negative_constant: "const N: usize = «2 - 3»; coords { x } mass { x: 1.0 }" => "cannot be negative";
    constant_of_another_type: "const N: «i32» = 3; coords { x } mass { x: 1.0 }" => "a constant is a `usize` or an `f64`, not `i32`";
    family_members_out_of_order: "coords { for i in 1..3 { «x[i]» } y } mass { y: 1.0 }" => "must be declared in order from `x[0]`";
    // Functions.
    unknown_function: "coords { x } mass { x: 1.0 } force { x: «sine»(x) }" => "unknown function `sine`; did you mean `sin`?";
    function_called_as_a_reserved_word: "coords { x } mass { x: 1.0 } force { x: «mod»(t, 2.0) * mod(x, 2.0) }" => "`mod` is a reserved word of Rust";
    unsupported_function: "coords { x } mass { x: 1.0 } force { x: x.«gamma»() }" => "unknown function `gamma`; functions are sqrt";
    signum: "coords { x } mass { x: 1.0 } force { x: x.«signum»() }" => "write `sign`, which is 0 at 0";
    too_many_arguments: "coords { x } mass { x: 1.0 } force { x: «sin»(x, x) }" => "`sin` takes 1 argument, found 2";
    too_few_arguments: "coords { x } let f = |a, b| a * b; mass { x: 1.0 } force { x: «f»(x) }" => "`f` takes 2 arguments, found 1";
    calling_a_number: "params { k = 1.0 } coords { x } mass { x: 1.0 } force { x: «k»(x) }" => "`k` is not a function";
    function_as_a_value: "coords { x } let f = |a| a; mass { x: 1.0 } force { x: «f» }" => "`f` is a function; call it";
    recursion: "coords { x } let f = |a| «f»(a); mass { x: 1.0 } force { x: f(x) }" => "`f` calls itself";
    exponent_not_constant: "coords { x } mass { x: 1.0 } force { x: x.powi(«x») }" => "`x` is not an integer constant";
    sum_without_function: "coords { x } mass { x: 1.0 } force { x: «sum(0..3, x)» }" => "`sum` is written `sum(0..N, |i| …)`";
    integer_division_by_name: "coords { x } let half = |i| «i / 2»; mass { x: half(1) }" => "this, of 1 by 2, is an integer division, which Rust rounds to 0; it may stand in an index";
    integer_division: "coords { x } mass { x: «1 / 2» }" => "`1 / 2` is an integer division, which Rust rounds to 0; write `1.0 / 2.0`";
    division_by_zero: "coords { x } mass { x: 1.0 / «0.0» }" => "division by zero";
    // Vectors.
    vectors_of_different_length: "coords { x, y } mass { x: 1.0, y: 1.0 } holonomic { c: [x, y] = «[1.0, 2.0, 3.0]» }" => "expected a vector of 2, found a vector of 3";
    vector_and_number: "coords { x, y } mass { x: 1.0, y: 1.0 } holonomic { c: [x, y] + «1.0» = [1.0, 2.0] }" => "expected a vector of 2, found a number";
    vector_as_force: "coords { x } mass { x: 1.0 } force { x: «[1.0, 2.0]» }" => "expected a number, found a vector of 2";
    product_of_vectors: "coords { x, y } mass { x: 1.0, y: 1.0 } holonomic { c: «[x, y] * [x, y]» = 0.0 }" => "the product of two vectors is not defined";
    division_by_a_vector: "coords { x } mass { x: 1.0 } force { x: 1.0 / «[x, x]» }" => "cannot divide by a vector";
    component_out_of_range: "coords { x, y } let p = [x, y]; mass { x: 1.0, y: 1.0 } force { x: p[«2»] }" => "index 2 is out of range: `p` has 2 components";
    component_of_an_expression_out_of_range: "coords { x, y } mass { x: 1.0, y: 1.0 } force { x: (2.0 * [x, y])[«2»] }" => "index 2 is out of range: this has 2 components";
    component_of_a_number: "coords { x, y } mass { x: 1.0, y: 1.0 } force { x: inner([x, y], [y, x])[«0»] }" => "this is a number; write it without an index";
    index_too_many: "coords { x, y } let p = [x, y]; mass { x: 1.0, y: 1.0 } force { x: p[0][«1»] }" => "`p` is a vector of 2; it takes no index beyond 1";
    inner_of_different_lengths: "coords { x, y } mass { x: 1.0, y: 1.0 } force { x: «inner([x, y], [1.0, 2.0, x])» }" => "`inner` takes two vectors of one length, found a vector of 2 and a vector of 3";
    inner_of_matrices: "coords { x } let a = [[x]]; mass { x: 1.0 } force { x: «inner(a, a)» }" => "found a matrix of 1×1 and a matrix of 1×1";
    cross_of_a_number: "coords { x, y } mass { x: 1.0, y: 1.0 } force { x: «cross([x, y], 2.0)» }" => "`cross` takes two vectors of 3, or two of 2, found a vector of 2 and a number";
    norm_of_a_number: "coords { x } mass { x: 1.0 } force { x: «norm(x)» }" => "`norm` takes a vector, found a number";
    square_of_a_matrix: "coords { x } mass { x: 1.0 } force { x: «sq(rot(x))» }" => "`sq` takes a number or a vector, found a matrix of 2×2";
    rotation_by_a_vector: "coords { x, y } mass { x: 1.0, y: 1.0 } force { x: («rotz([x, y])» * [x, y, y])[0] }" => "`rotz` takes a number, found a vector of 2";
    transpose_of_a_vector: "coords { x, y } mass { x: 1.0, y: 1.0 } force { x: «transpose([x, y])»[0] }" => "`transpose` takes a matrix, found a vector of 2";
    arguments_of_cross: "coords { x, y } mass { x: 1.0, y: 1.0 } force { x: «cross»([x, y]) }" => "`cross` takes 2 arguments, found 1";
    product_of_shapes: "coords { x, y } mass { x: 1.0, y: 1.0 } force { x: («rotx(x) * [x, y]»)[0] }" => "a matrix of 3×3 times a vector of 2 is not defined";
    vector_times_matrix: "coords { x, y } mass { x: 1.0, y: 1.0 } force { x: («2.0 * [x, y] * rot(x)»)[0] }" => "a vector of 2 times a matrix of 2×2 is not defined; write `transpose(m) * v`";
    matrix_plus_vector: "coords { x, y } mass { x: 1.0, y: 1.0 } force { x: (rot(x) + «[x, y]»)[0][0] }" => "expected a matrix of 2×2, found a vector of 2";
    division_by_a_matrix: "coords { x } mass { x: 1.0 } force { x: 1.0 / «rot(x)» }" => "cannot divide by a matrix of 2×2";
    rows_of_different_length: "coords { x, y } let m = [[x, y], «[x]»]; mass { x: 1.0, y: 1.0 } force { x: m[0][0] }" => "expected a vector of 2 as before it, found a vector of 1";
    sine_of_a_vector: "coords { p[2] } mass { p: 1.0 } force { p[0]: sin(«p») }" => "expected a number, found a vector of 2";
    vector_in_the_kinetic_energy: "coords { p[2] } kinetic { «dot(p)» }" => "expected a number, found a vector of 2";
    force_of_another_length: "coords { p[2][3] } mass { p: 1.0 } force { p[1]: «[1.0, 2.0]» }" => "expected a vector of 3, found a vector of 2";
    masses_of_another_length: "coords { p[2] } mass { p: «[1.0, 2.0, 3.0]» }" => "expected a vector of 2, found a vector of 3";
    number_as_a_vector_of_force: "coords { p[2][3] } mass { p: 1.0 } force { «p[1]»: 1.0 }" => "choose a member, `p[0][0]` to `p[1][2]`, or give a vector of 3";
    family_in_a_pair: "coords { p[2], x } mass { p: 1.0, x: 1.0, (x, «p»): 1.0 }" => "`p` is a family; choose a member";
    second_index_out_of_range: "coords { p[2][3] } mass { p: 1.0 } force { p[1][«3»]: 1.0 }" => "index 3 is out of range: `p` has 6 members, `p[0][0]` to `p[1][2]`";
    too_many_indices: "coords { p[2][3] } mass { p: 1.0 } force { p[0][0][«0»]: 1.0 }" => "members of `p` are numbers: they take 2 indices";
    two_indices_in_one: "coords { p[2«,» 3] } mass { p: 1.0 }" => "each index has its own brackets, such as `x[i][j]`";
    rows_of_a_family_of_different_length: "coords { for i in 0..2 { for k in 0..2 - i { «p»[i][k] } } } mass { p: 1.0 }" => "rows of a family have one length";
    members_of_a_row_out_of_order: "coords { for i in 0..2 { for k in 0..2 { «p[k][i]» } } y } mass { y: 1.0 }" => "must be declared in order from `p[0][0]`";
    family_too_large_in_all: "coords { p[100][«100»] } mass { p: 1.0 }" => "up to 5000 compile";
    default_of_another_length: "params { k[3] = «[1.0, 2.0]» } coords { x } mass { x: k[0] }" => "expected a number or a vector of 3, found a vector of 2";
    default_of_a_scalar: "params { k = «[1.0, 2.0]» } coords { x } mass { x: k[0] }" => "a row of 2 parameters is declared `k[2] = […]`";
    forgotten_product: "params { m = 1.0, g = 9.81 } coords { x, y } mass { x: m, y: m } potential { m * g «y» }" => "`*` is missing before this, or `,` if it is a term of its own";
    more_than_a_function: "coords { x } mass { x: 1 } force { x: «cosine»(x) }" => "unknown function `cosine`; did you mean `cos`?";
    defaults_not_finite: "params { k[3] = «ln(-1.0)» } coords { x } mass { x: k[0] }" => "default of `k[0]` is not a finite number";
    family_of_values_with_a_gap: "coords { x } let { d[0] = x, d[2] = x } mass { x: 1.0 } force { x: norm(«d») }" => "`d` is no vector: its members are not of one shape with indices 0, 1, 2, …";
    family_of_values_of_two_shapes: "coords { x } let { d[0] = x, d[1] = [x, x] } mass { x: 1.0 } force { x: norm(«d») }" => "`d` is no vector";
    family_of_values_not_whole: "coords { x[3] } let { for i in 0..3 { d[i] = x[i], e[i] = norm(«d») } } mass { x: e[0] }" => "whose members are still being declared";
    values_with_one_and_two_indices: "coords { x } let { d[0] = x, «d[0][0]» = x } mass { x: d[0] }" => "`d` is declared with different numbers of indices";
    matrix_named_as_its_member: "coords { p[2] } mass { p: 1.0 } holonomic { c: [p, p] = 0.0  «c[0][0]»: p[0] = 1.0 }" => "constraint `c` is declared both with and without an index";
    // Index functions.
    function_of_no_integer: "coords { x[3] } let f = |i| 1.5 * i; mass { x: 1.0 } force { x[«f(2)»]: 1.0 }" => "`f` gives no integer known at compile time";
    index_function_of_a_number: "params { k = 1.0 } coords { x[3] } let f = |i| i + 1; mass { x: k } force { x[f(«k»)]: 1.0 }" => "`k` is not an integer constant";
    index_function_declared_below: "coords { x[3] } let f = |i| g(i); let g = |i| i; mass { x: 1.0 } force { x[«f(2)»]: 1.0 }" => "functions declared before it";
    index_function_of_itself: "coords { x[3] } let f = |i| f(i); mass { x: 1.0 } force { x[«f(2)»]: 1.0 }" => "`f` gives no integer";
    arguments_of_an_index_function: "coords { x[3] } let f = |i, j| i + j; mass { x: 1.0 } force { x[«f»(2)]: 1.0 }" => "`f` takes 2 arguments, found 1";
    index_function_out_of_range: "const N: usize = 3; coords { x[N] } let next = |i| i + 1; mass { x: 1.0 } force { for i in 0..N { x[«next(i)»]: 1.0 } }" => "index 3 is out of range";
    argument_hides_a_constant: "const N: usize = 2; coords { x[N] } let f = |N| x[«N»]; mass { x: 1.0 } force { x[0]: f(1.5) }" => "`N` is not an integer constant or loop variable";
    // One mistake, one message.
    number_beside_a_vector_and_zero: "coords { x, y } mass { x: 1.0, y: 1.0 } holonomic { c: 0.0 + [x, y] + «t» = [1.0, 0.0] }" => "expected a vector of 2, found a number";
    unknown_function_in_calls_and_methods: "coords { x } mass { x: 1.0 } force { x: «foo»(x) + foo(x) * foo(2.0 * x), x: foo(foo(x)) } output { a = foo(x), b = x.foo() }" => "unknown function `foo`";
    number_called_many_times: "params { k = 1.0 } coords { x } mass { x: 1.0 } force { x: «k»(x) + k(2.0 * x) }" => "`k` is not a function";
    signum_many_times: "coords { x } mass { x: 1.0 } force { x: «signum»(x) + signum(2.0 * x) }" => "write `sign`, which is 0 at 0";
    unknown_coordinate_many_times: "coords { x } mass { x: 1.0, «z»: 1.0 } force { z: 1.0 } nonideal { z: 2.0 }" => "`z` is not a coordinate";
    unknown_vector_many_times: "coords { p[3] } mass { p: 1.0 } force { p: cross(«w», p) + 2.0 * w } holonomic { c: [p[0], w] = [1.0, 2.0] }" => "unknown name `w`";
    // What may stand where.
    velocity_in_a_holonomic_constraint: "coords { x } mass { x: 1.0 } holonomic { c: «dot(x)» = 0.0 }" => "move the constraint under `nonholonomic`";
    velocity_by_a_let: "coords { x } let u = dot(x); mass { x: 1.0 } holonomic { c: x + «u» = 0.0 }" => "move the constraint under `nonholonomic`";
    velocity_in_mass: "coords { x } mass { x: 1.0 + sq(«dot(x)») }" => "M depends on coordinates and time only";
    velocity_in_potential: "coords { x } mass { x: 1.0 } potential { x * «dot(x)» }" => "a potential depends on coordinates and time only";
    acceleration: "coords { x } mass { x: 1.0 } force { x: «dot(dot(x))» }" => "is an acceleration, which is what is solved for";
    acceleration_by_name: "coords { x } mass { x: 1.0 } force { x: «ddot»(x) }" => "accelerations are what is solved for";
    dot_of_a_constant: "params { m = 1.0 } coords { x } mass { x: m } force { x: dot(«m») }" => "this does not change with time";
    coordinate_in_a_default: "params { a = «x» } coords { x } mass { x: 1.0 }" => "a parameter is a number";
    default_uses_a_later_parameter: "params { a = 2.0 * «b», b = 1.0 } coords { x } mass { x: a }" => "a default may use parameters declared above it only";
    parameter_in_a_constant: "const L: f64 = 2.0 * «m»; params { m = 1.0 } coords { x } mass { x: m }" => "a constant is known at compile time";
    default_not_finite: "params { a = «ln(-1.0)» } coords { x } mass { x: a }" => "default of `a` is not a finite number";
    // Mechanics.
    mass_and_kinetic: "coords { x } mass { x: 1.0 } «kinetic» { 0.5 * sq(dot(x)) }" => "`mass` and `kinetic` exclude each other";
    kinetic_not_quadratic: "coords { x } «kinetic» { dot(x).powi(4) }" => "must be quadratic in the velocities";
    kinetic_without_velocity: "coords { x } «kinetic» { x }" => "contains no square of a velocity";
    negative_mass: "coords { x } mass { «x»: -1.0 }" => "a mass must not be negative";
    pair_in_both_orders: "coords { x, y } mass { x: 1.0, y: 1.0, (x, y): 0.5, («y, x»): 0.5 }" => "`(y, x)` is the entry that stands as `(x, y)` already, which sets both M[y, x] and M[x, y]; write it once";
    pairs_of_a_ring_of_two: "const N: usize = 2; coords { x[N] } let next = |i| i + 1 - N * ((i + 1) / N); mass { x: 1.0, for i in 0..N { («x[i], x[next(i)]»): 0.1 } }" => "`(x[1], x[0])` is the entry that stands as `(x[0], x[1])` already, which sets both M[x[1], x[0]] and M[x[0], x[1]]; write it once, twice as large where two couplings are meant, as those of a ring of two";
    pairs_of_loops: "coords { x[3] } mass { x: 1.0, for i in 1..3 { (x[i - 1], x[i]): 0.5 } for i in 1..3 { («x[i], x[i - 1]»): 0.5 } }" => "`(x[1], x[0])` is the entry that stands as `(x[0], x[1])` already";
    diagonal_as_a_pair: "coords { x } mass { (x, «x»): 1.0 }" => "a diagonal entry of M is written `x: …`";
    comma_between_sections: "coords { x }«,» mass { x: 1 }" => "nothing stands between sections; remove this";
    member_in_parentheses: "coords { x[2] } mass { x«(»0): 1, x(1): 2 }" => "a member of a family is chosen in brackets: `x[0]: 1.0`";
    constraint_of_a_square: "coords { x, y } mass { x: 1, y: 1 } holonomic { «c»: sq(sq(x) + sq(y) - 1) = 0 }" => "constraint `c` sets squares to 0";
    constraint_of_squares: "coords { x, y, z } mass { x: 1, y: 1, z: 1 } holonomic { «c»: -sq(x) - 2 * sq(y - sin(x)) = 0 }" => "set what is squared to 0";
    constraint_of_a_distance: "coords { p[2], q[2] } mass { p: 1, q: 1 } holonomic { «c»: norm(p - q) = 0 }" => "sets a magnitude to 0";
    constraint_of_magnitudes: "coords { x, y, z } mass { x: 1, y: 1, z: 1 } holonomic { «c»: -abs(x) - 2 * hypot(y, z) - sq(z) = 0 }" => "set to 0 what it is the magnitude of";
    constraint_without_coordinate: "params { l = 1.0 } coords { x } mass { x: 1.0 } holonomic { «c»: sq(l) = sin(t) }" => "constraint `c` contains no coordinate";
    joint_under_nonholonomic: "bodies { spatial b { mass: 1.0, inertia: [1, 1, 1] } } nonholonomic { «h»: hinge(ground.at([0, 0, 0]), b.at([0, 0, 1]), [0, 1, 0]) }" => "`h` is a joint, which stands under `holonomic`; move it there";
    constraint_without_velocity: "coords { x } mass { x: 1.0 } nonholonomic { «c»: x = 1.0 }" => "contains no velocity; move it under `holonomic`";
    constraint_always_true: "coords { x } mass { x: 1.0 } holonomic { «c»: 2.0 * x = x + x }" => "constraint `c` is always true";
    brace_always_true: "params { x = 0.3 } bodies { planar d { mass: 1, inertia: 0.2 } } tree { s1: pin(ground.at([x, 0.7]), d.at([0.1, 0.2])) } holonomic { «s2»: rod(ground.at([x, 0.7]), d.at([0.4, 0.6]), 0.5) }" => "constraint `s2` is always true; remove it";
    hinge_always_true: "bodies { spatial d { mass: 1, inertia: [0.2, 0.2, 0.2] } } tree { h1: hinge(ground.at([0, 0, 0]), d.at([0, 0, 0]), [1, 2, 3]) } holonomic { «h2»: hinge(ground.at([1, 2, 3]), d.at([1, 2, 3]), [1, 2, 3]) }" => "constraint `h2` is always true; remove it";
    true_with_defaults: "params { a = 1.0 } bodies { spatial d { mass: 1, inertia: [0.2, 0.2, 0.2] } } tree { h1: hinge(ground.at([0, 0, 0]), d.at([0, 0, 0]), [a, 2, 3]) } holonomic { «h2»: ball(ground.at([1, 2, 3]), d.at([1, 2, 3])) }" => "`h2.x`, `h2.y`, `h2.z` always hold with the default parameters";
    reaction_of_what_always_holds: "bodies { spatial d { mass: 1, inertia: [1, 1, 1] } spatial e { mass: 1, inertia: [1, 1, 1] } } tree { h1: hinge(ground.at([0, 0, 0]), d.at([0, 0, 0]), [0, 1, 2])  h2: hinge(d.at([1, 0, 0]), e.at([0, 0, 0]), [0, 1, 2]) } holonomic { h3: hinge(ground.at([1.5, 0, 0]), e.at([1, 0, 0]), [0, 1, 2]) } output { r = reaction(h3.y), s = reaction(h3.«tilt0»), m = moment(«h3») }" => "row `tilt0` of `h3` always holds", "`h3` has no unique reaction: rows of it, `tilt0` among them, always hold";
    row_of_points_without_a_difference: "bodies { planar p { mass: 1, inertia: 1 } planar q { mass: 1, inertia: 1 } } holonomic { «c»: [p.x - q.x, p.y - p.y] = [0, 0] }" => "constraint `c[1]` is always true; remove it";
    same_constraint_twice: "coords { x, y } mass { x: 1.0, y: 1.0 } holonomic { a: x - y = 0.0  «b»: y = x }" => "constraint `b` is the same equation as `a`";
    massless_family: "coords { «x»[5], «y»[2], z } mass { z: 1.0 }" => "coordinates `x[0]` … `x[4]` have neither mass nor constraint", "coordinates `y[0]`, `y[1]` have neither";
    massless_and_unconstrained: "coords { x, «y» } mass { x: 1.0 } force { y: 1.0 }" => "coordinate `y` has neither mass nor constraint";
    massless_outnumber_constraints: "coords { x, y, «z» } mass { x: 1.0 } holonomic { c: x + y + z = 0.0 }" => "rank [M | Aᵀ] is below 3";
    // One mistake, one message.
    number_beside_a_vector: "coords { x, y } mass { x: 1.0, y: 1.0 } holonomic { c: 0.0 + [x, y] + «t» = [1.0, 0.0] }" => "expected a vector of 2, found a number";
    coordinates_alike_but_for_case: "coords { x, «X» } mass { x: 1.0, X: 1.0 } force { X: x }" => "coordinate `X` and coordinate `x` would both become the constant `X`; rename one";
    coordinate_named_as_a_function: "coords { «sin», x } mass { sin: 1.0, x: 1.0 } force { x: sin }" => "`sin` is reserved";
    coordinate_named_as_a_parameter: "params { m = 1.0 } coords { «m», x } mass { x: m } force { m: 1.0 }" => "`m` is declared twice";
    parameter_named_as_the_time: "params { «t» = 1.0 } coords { x } mass { x: t } force { x: y }" => "`t` is reserved";
    section_in_upper_case: "«Params» { m = 1.0 } coords { x } mass { x: m }" => "unknown section `Params`; did you mean `params`?";
    section_that_is_none: "«JUNK» x: 3 { m = 1.0 } coords { x } mass { x: m }" => "unknown section `JUNK`; sections are `const`";
    coords_in_upper_case: "«Coords» { x } mass { x: 1.0 } holonomic { c: x = 1.0 }" => "unknown section `Coords`";
    negative_constant_in_use: "const N: usize = «0 - 1»; coords { x[N] } mass { for i in 0..N { x[i]: 1.0 } }" => "`N` is a `usize`, which cannot be negative";
    syntax_error_in_coords: "coords { x y , «,» z } mass { x: 1.0, y: 1.0, z: 1.0 }" => "expected identifier";
    force_on_a_list: "coords { x, y } mass { x: 1.0, y: 1.0 } force { «[»x, y]: 1.0 }" => "an entry belongs to one coordinate or family";
    nonideal_on_a_list: "coords { x, y } mass { x: 1.0, y: 1.0 } nonideal { «[»x, y]: [1.0, 2.0] }" => "an entry belongs to one coordinate or family";
    mass_of_a_list: "coords { x, y } mass { «[»x, y]: 1.0 }" => "an entry belongs to one coordinate or family";
    unknown_name_in_a_function: "coords { x } mass { x: 1.0 } force { x: recip(«y») + 1.0 / «z» }" => "unknown name `y`", "unknown name `z`";
    velocities_on_both_sides: "coords { x, y } mass { x: 1, y: 1 } holonomic { c: «dot(x)» = dot(y) }" => "a velocity in a holonomic constraint; move the constraint under `nonholonomic`";
    velocities_on_one_side: "coords { x, y } mass { x: 1, y: 1 } holonomic { c: «dot(x)» + 2 * dot(y) = 0 }" => "a velocity in a holonomic constraint";
    constant_in_error_in_use: "const N: usize = 7 «%» 4; coords { x[N] } mass { x: 1 } output { o = N * x[0] }" => "`%` cannot be differentiated; remove it";
    constant_of_a_path: "const K: usize = «Stage::N»; coords { x } mass { x: 1 } output { n = K, m = K + 1 }" => "no paths here; write `N`";
    size_in_error: "coords { y, x[«0..3»] } mass { x: 1, y: 1 } force { x[0]: -x[0] } holonomic { c: x[1] = y } output { o = x[1] + dot(x[2]) } start s { x = 1 }" => "a range belongs in `for i in 0..N { … }`";
    size_of_a_parameter_in_error: "params { k[«'m'»] = 2 } coords { x } mass { x: k[0] } output { o = k[1] }" => "not a number";
    body_in_error: "params { n = 2 } bodies { planar a[«n»] { mass: 1, inertia: 1 } planar b { mass: 1, inertia: 1 } } holonomic { c: pin(a[0].at([0, 0]), b.at([1, 0])) } force { a[1].angle: 1 } output { o = a[0].x }" => "`n` is not an integer constant or loop variable";
    joint_in_error: "params { n = 2 } bodies { planar a { mass: 1, inertia: 1 } } tree { p[«n»]: pin(ground.at([0, 0]), a.at([1, 0])) } force { p[0].angle: 1 } output { o = p[0].angle }" => "`n` is not an integer constant or loop variable";
    only_body_in_error: "params { n = 2 } bodies { planar a[«n»] { mass: 1, inertia: 1 } } output { o = a[0].x }" => "`n` is not an integer constant or loop variable";
    body_in_error_in_a_tree: "params { n = 2 } bodies { planar a[«n»] { mass: 1, inertia: 1 } } tree { p: pin(ground.at([0, 0]), a[0].at([1, 0])) }" => "`n` is not an integer constant or loop variable";
    ball_between_kinds: "bodies { spatial a { mass: 1, inertia: [1, 1, 1] } planar b { mass: 1, inertia: 1 } } holonomic { c: ball(b.at([0, 0]), «a.at([0, 0, 0])») }" => "`b` is planar and `a` is spatial";
    spring_between_kinds: "bodies { spatial a { mass: 1, inertia: [1, 1, 1] } planar b { mass: 1, inertia: 1 } } forces { spring(a.at([0, 0, 0]), «b.at([0, 0])», 1, 0) }" => "`a` is spatial and `b` is planar";
    torque_on_the_ground: "bodies { planar a { mass: 1, inertia: 1 } } nonideal { «torque(ground, 1)» }" => "the ground does not move, so that this `torque` does nothing";
    spring_between_places: "bodies { planar a { mass: 1, inertia: 1 } } forces { «spring(ground.at([0, 0]), ground.at([1, 0]), 1, 0)» }" => "the ground does not move, so that this `spring` does nothing";
    spring_of_one_body: "bodies { planar a { mass: 1, inertia: 1 } } forces { «spring(a.at([0, 0]), a.at([0, 0]), 1, 2)» «turning_spring(a, a, 1, 0)» }" => "both ends of this `spring` are on `a`, so that it does nothing; name two bodies", "both ends of this `turning_spring` are on `a`";
    option_in_a_duration: "coords { x } mass { x: 1 } start s(tau = 3) until «tau» { x = tau }" => "unknown name `tau`";
    // Associated constants.
    constraint_as_a_coordinate: "coords { rod } mass { rod: 1.0 } holonomic { «Rod»: rod = 1.0 }" => "constraint `Rod` and coordinate `rod` would both become the constant `ROD`";
    outputs_alike_but_for_case: "coords { x } mass { x: 1.0 } output { o = x, «O» = 2.0 * x }" => "output `O` and output `o` would both become the constant `OUT_O`";
    output_and_coordinate: "coords { out_fall } mass { out_fall: 1.0 } output { «fall» = 2.0 * out_fall }" => "output `fall` and coordinate `out_fall` would both become the constant `OUT_FALL`";
    float_constant_and_coordinate: "const A: f64 = 1.0; coords { «a» } mass { a: A }" => "coordinate `a` and constant `A` would both become the constant `A`";
    coordinate_named_code: "coords { «code» } mass { code: 1.0 }" => "the constant `CODE`, which every mechanism has";
    constraint_in_a_force: "coords { x } mass { x: 1.0 } force { x: -0.1 * abs(«rod») } holonomic { for i in 0..1 { rod: sin(x) = t } }" => "`rod` is a constraint, which no expression can use; its force is `reaction(rod)`";
    reaction_of_an_unknown_name: "coords { x } mass { x: 1 } holonomic { rod: sin(x) = t } output { a = reaction(«rods»), b = reaction(rods) }" => "no constraint is called `rods`; did you mean `rod`?";
    reaction_of_a_coordinate: "coords { x } mass { x: 1 } holonomic { rod: sin(x) = t } output { a = reaction(«x») }" => "no constraint is called `x`; it is declared under `holonomic`";
    reaction_of_a_number: "coords { x } mass { x: 1 } holonomic { rod: sin(x) = t } output { a = reaction(«2 * x») }" => "`reaction` takes the name of a constraint, such as `reaction(knee)`";
    reaction_of_a_family: "coords { x[2] } mass { x: 1 } holonomic { for i in 0..2 { rod[i]: sin(x[i]) = t } } output { a = reaction(«rod») }" => "no constraint is called `rod`; it is a family; choose a member, such as `rod[0]`";
    reaction_out_of_range: "coords { x[2] } mass { x: 1 } holonomic { for i in 0..2 { rod[i]: sin(x[i]) = t } } output { a = reaction(«rod[2]») }" => "no constraint is called `rod[2]`";
    reaction_with_too_many_arguments: "coords { x } mass { x: 1 } holonomic { rod: sin(x) = t } output { a = «reaction»(rod, 1) }" => "`reaction` takes 1 argument, found 2";
    moment_of_an_equation: "coords { x } mass { x: 1 } holonomic { rod: sin(x) = t } output { a = moment(«rod») }" => "`rod` is no joint between bodies; its multipliers are `reaction(rod)`";
    moment_in_a_force: "coords { x } mass { x: 1 } force { x: «moment»(rod) } holonomic { rod: sin(x) = t }" => "`moment` stands under `output`";
    moment_of_bodies_that_hang: "bodies { planar a { mass: 1, inertia: 1 } planar b { mass: 1, inertia: 1 } } tree { p: pin(ground.at([0, 0]), a.at([1, 0])) q: pin(a.at([0, 1]), b.at([0, 0])) } holonomic { r: pin(ground.at([1, 1]), b.at([1, 1])) } output { a = moment(«r») }" => "the second body of `r` has no coordinates of its own orientation";
    moment_of_a_body_that_the_first_hangs_on: "bodies { for i in 0..3 { planar a[i] { mass: 1, inertia: 1 } } } tree { for i in 1..3 { p[i]: pin(a[i - 1].at([1, 0]), a[i].at([0, 0])) } } holonomic { r: pin(a[2].at([1, 1]), a[0].at([1, 1])) } output { a = moment(«r») }" => "or the first one hangs on it";
    reaction_of_an_unknown_row: "bodies { planar a { mass: 1, inertia: 1 } } holonomic { p: pin(ground.at([0, 0]), a.at([1, 0])) } output { a1 = reaction(p.«z») }" => "no row of `p` is called `z`";
    reaction_of_a_row_without_name: "bodies { planar a { mass: 1, inertia: 1 } } holonomic { p: rod(ground.at([0, 0]), a.at([1, 0]), 1) } output { a1 = reaction(p.«x») }" => "the rows of `p` have no names of their own; write `reaction(p)`";
    reaction_in_a_constraint: "coords { x, y } mass { x: 1, y: 1 } holonomic { rod: sin(x) = t, next: y = «reaction»(rod) }" => "reactions follow from all other equations: `reaction` stands under";
    reaction_in_a_force: "coords { x } mass { x: 1 } force { x: «reaction»(rod) } holonomic { rod: sin(x) = t }" => "reactions follow from all other equations: `reaction` stands under";
    reaction_in_a_value: "coords { x } let n = «reaction»(rod); mass { x: 1 } holonomic { rod: sin(x) = t } output { a = n }" => "under `output`, `integral`, `draw` and `nonideal`; make this a function of no argument, `let n = || reaction(…);`, and write `n()` there";
    reaction_in_a_function_of_a_force: "coords { x } let n = |k| k * «reaction»(rod); mass { x: 1 } force { x: n(1) + n(2) } holonomic { rod: sin(x) = t }" => "and in functions used there";
    derivative_of_a_reaction: "coords { x } mass { x: 1 } holonomic { rod: sin(x) = t } output { a = «dot(reaction(rod))» }" => "the time derivative of a reaction is not solved for";
    reaction_without_a_straight_line: "coords { x, y, z } mass { x: 1 } holonomic { a: sin(y) * cos(z) = x, b: cos(y) * sin(z) = 2 * x } output { n = «reaction(a)» }" => "reactions cannot be used here, as they are not solved for on a straight line";
    integral_of_itself: "coords { x } mass { x: 1 } integral { w = 2.0 * «w» }" => "`w` is an integral, which no expression can use";
    integral_named_as_an_output: "coords { x } mass { x: 1 } output { w = x } integral { «w» = x }" => "integral `w` is declared twice";
    integral_named_as_a_coordinate: "coords { x } mass { x: 1 } integral { «x» = x }" => "`x` is a coordinate and in the output anyway";
    integral_named_as_a_column: "coords { x } mass { x: 1 } integral { «energy» = x }" => "`energy` is a column of every run";
    integral_twice: "coords { x } mass { x: 1 } integral { for i in 0..2 { «w» = x } }" => "integral `w` is declared twice; in a loop, index it: `w[i]`";
    friction_without_its_size: "coords { x } mass { x: 1 } force { x: «friction»(dot(x)) }" => "`friction` takes 2 arguments, found 1";
    friction_of_a_vector_size: "coords { x } mass { x: 1 } force { x: «friction(dot(x), [1, 2])» }" => "`friction` takes a velocity, made with `dot` or of a body, and a number, found a number and a vector of 2";
    output_in_an_output: "coords { x } mass { x: 1.0 } output { o = x, p = 2.0 * «o» }" => "`o` is an output, which no expression can use";
    unknown_function_many_times: "coords { x } let a = «foo»(x); let b = a[0]; mass { x: foo(x) * foo(x) } force { x: foo(2 * b) }" => "unknown function `foo`";
    unknown_function_in_a_family: "coords { x } let { for i in 0..3 { a[i] = «foo»(x) } } mass { x: 1.0 } force { x: a[2] }" => "unknown function `foo`";
    unknown_name_many_times: "coords { x } mass { x: «mm» } force { x: -mm * 9.81 }" => "unknown name `mm`";
    coordinate_named_spec: "coords { «spec» } mass { spec: 1.0 }" => "the constant `SPEC`, which every mechanism has";
    constraint_with_and_without_an_index: "coords { x, y } mass { x: 1.0, y: 1.0 } holonomic { rod: x = 1.0  «rod[0]»: y = 1.0 }" => "constraint `rod` is declared both with and without an index";
    vector_constraint_and_a_member: "coords { x, y, z } mass { x: 1.0, y: 1.0, z: 1.0 } holonomic { joint: [x, y] = 0.0  «joint[0]»: z = 1.0 }" => "constraint `joint` is declared both with and without an index";
    output_with_and_without_an_index: "coords { x } mass { x: 1.0 } output { o[0] = x, «o» = 2.0 * x }" => "output `o` is declared both with and without an index";
    reserved_keyword: "params { «gen» = 1.0 } coords { x } mass { x: gen }" => "`gen` is reserved";
    raw_output: "coords { x } mass { x: 1.0 } output { «r#type» = x }" => "`r#type` is reserved";
    // Columns of a run.
    output_named_as_the_time: "coords { x } mass { x: 1.0 } output { «t» = x }" => "`t` is reserved";
    output_named_energy: "coords { x } mass { x: 1.0 } output { «energy» = x }" => "`energy` is a column of every run";
    coordinate_named_energy_in_units: "coords { «energy» [m], y [m] } mass { energy: 1.0 [kg], y: 1.0 } force { energy: y }" => "`energy` is a column of every run";
    too_many_coordinates_in_units: "const N: usize = «100000»; coords { x[N] [m] } mass { for i in 0..N { x[i]: 1.0 [kg] } } start a { x[0] = 1.0 [m] }" => "families and loops by `N` = 100000 have more than 5000 members";
    family_of_coordinates_named_energy: "coords { «energy»[3], y } mass { for i in 0..3 { energy[i]: 1.0 } y: 1.0 } force { y: energy[2] }" => "`energy` is a column of every run";
    family_named_as_a_parameter: "params { x = 1.0 } coords { «x»[3], y } mass { y: x }" => "`x` is declared twice";
    family_named_as_what_is_reserved: "coords { «t»[3], y } mass { y: 1.0 }" => "`t` is reserved";
    coordinate_named_residual: "coords { «residual» } mass { residual: 1.0 }" => "`residual` is a column of every run";
    vector_output_as_a_family: "coords { x[2] } mass { x[0]: 1.0, x[1]: 1.0 } output { «x» = [1.0 * t, t] }" => "`x[0]` is a coordinate and in the output anyway";
    // Arguments.
    argument_twice: "coords { x } let f = |u, «u»| u; mass { x: 1.0 } force { x: f(x, 1.0) }" => "argument `u` is declared twice";
    // Numbers.
    exponent_too_large: "coords { x } mass { x: 1.0 } force { x: x.powi(«2147483647») }" => "`powi` takes exponents from -64 to 64; use `powf`";
    exponent_too_small: "coords { x } mass { x: 1.0 } force { x: x.powi(«-2147483648») }" => "`powi` takes exponents from -64 to 64";
    reciprocal_of_zero: "coords { x } mass { x: 1.0 } force { x: x * «recip(0)» }" => "this constant is not a finite number";
    negative_power_of_zero: "coords { x } mass { x: 1.0 } force { x: «powf(0, -1)» + x }" => "this constant is not a finite number";
    overflowing_product: "coords { x } mass { x: 1.0 } force { x: «1e300 * 1e300» * x }" => "this constant is not a finite number";
    vanishing_product: "coords { x } mass { x: 1.0 } force { x: «1e-300 * 1e-300» * x }" => "this constant is too small for an `f64`";
    overflowing_sum: "coords { x } mass { x: 1.0 } force { x: «1e308 + x + 1e308» }" => "this constant is not a finite number";
    undefined_function_value: "coords { x } mass { x: 1.0 } force { x: 2.0 * «ln(-1.0)» * x }" => "this constant is not a finite number";
    constant_not_finite: "const A: f64 = «ln(-1)»; coords { x } mass { x: A }" => "constant `A` is not a finite number";
    integer_overflow_of_a_remainder: "const N: usize = «(0 - 9223372036854775807 - 1) / (0 - 1)»; coords { x } mass { x: 1.0 }" => "integer overflow";
    // Mechanics.
    constraint_without_slope: "coords { x } mass { x: 1.0 } holonomic { «c»: sign(x) = 1.0 }" => "constraint `c` restricts no velocity";
    nonholonomic_without_slope: "coords { x } mass { x: 1.0 } nonholonomic { «c»: sign(dot(x)) = 1.0 }" => "constraint `c` restricts no velocity";
    coordinate_without_neighbour: "coords { alpha, beta } mass { alpha: 1.0, beta: 1.0, «z»: 1.0 }" => "`z` is not a coordinate; coordinates are `alpha`, `beta`";
}

#[test]
fn several_errors_are_reported_together() {
    check(
        "params { m = 1.0 } coords { x, y } mass { x: «mm», y: m } force { x: «foo»(x) } holonomic { c: x «^» 2 = «yy» }",
        &[
            "unknown name `mm`",
            "unknown function `foo`",
            "`^` is not a power",
            "unknown name `yy`",
        ],
    );
}

#[test]
fn no_coordinates() {
    for source in [
        "pub T { params { m = 1.0 } coords { } }",
        "pub T { params { m = 1.0 } mass { x: m, y: m } holonomic { c: x = y } }",
    ] {
        let found = errors(source);
        assert_eq!(found.len(), 1);
        assert!(found[0].message.contains("`T` has no coordinates"));
        assert_eq!(found[0].start.column, 4);
    }
}

#[test]
fn an_unreadable_name_still_gives_one_error() {
    assert_eq!(errors("42 { coords { x } }").len(), 1);
}

#[test]
fn one_declaration_in_a_call() {
    let found = errors("pub T { coords { x } mass { x: 1 } } pub U { coords { x } mass { x: 1 } }");
    assert_eq!(found.len(), 1);
    assert!(
        found[0]
            .message
            .starts_with("one declaration per `multibody!`")
    );
    assert_eq!(found[0].start.column, 37);
}
