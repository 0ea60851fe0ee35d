//! What other languages, programs and papers write, and names that Rust keeps for itself: each is told once, by what it is here.

use super::check;

cases! {
    check;
    keywords_as_coordinates: "coords { «self», «async», x } mass { self: 1, async: 1, x: 1 } force { x: self * dot(async) }" => "`self` is a reserved word of Rust; use another name, such as `self_`", "`async` is a reserved word of Rust; use another name, such as `async_`";
    keywords_as_parameters: "params { «fn» = 1, «move» = 2 «in» = 3 } coords { x } mass { x: fn + move } force { x: -in * x } output { for i in 0..2 { o[i] = i * in } }" => "`fn` is a reserved word of Rust; use another name, such as `fn_`", "`move` is a reserved word", "`in` is a reserved word";
    keyword_as_a_family: "params { «ref»[2] = 1 } coords { «loop»[2] [m] } mass { loop: 1 } force { for i in 0..2 { loop[i]: ref[i] } }" => "`ref` is a reserved word", "`loop` is a reserved word";
    keywords_as_constants_and_values: "const «break»: usize = 2; coords { x[break] } let «match» = x[0]; let f = |«use», u| use * u; mass { x: 1 } force { x[0]: f(match, 2) }" => "`break` is a reserved word", "`match` is a reserved word", "`use` is a reserved word";
    keywords_as_results: "coords { x, y } mass { x: 1, y: 1 } holonomic { «if»: x = y } output { «true» = x + 1, «return» = y + reaction(if) } start «static» { x = 1 } start «let»(«as» = 1) { x = as }" => "`if` is a reserved word", "`true` is a reserved word", "`return` is a reserved word", "`static` is a reserved word", "`let` is a reserved word", "`as` is a reserved word";
    keyword_as_a_body: "bodies { planar «crate» { mass: 1, inertia: 1 } } tree { «super»: pin(ground.at([0, 0]), crate.at([1, 0])) } output { a = crate.x + super.angle }" => "`crate` is a reserved word", "`super` is a reserved word";
    keyword_as_a_loop_variable: "coords { x[2] } mass { for «mut» in 0..2 { x[mut]: 1 } }" => "`mut` is a reserved word";
    keyword_behind_a_dot: "bodies { planar a { mass: 1, inertia: 1 } } output { o = a.«await» }" => "`await` is a reserved word";
    keyword_that_is_none_of_a_name: "coords { x } mass { x: 1 } force { x: «while x { 1 }» }" => "not an equation's expression";
    name_that_is_none: "coords { «_» } mass { _: 1 }" => "`_` names nothing; use another name, such as `unused`";
    loop_without_a_variable: "coords { x } mass { for «_» in 0..2 { x: 1 } }" => "`_` names nothing; use another name, such as `unused`";
    argument_without_a_name: "coords { x } let f = |«_», u| u; mass { x: 1 } output { o = f(1, x) }" => "`_` names nothing";
    names_that_begin_with_digits: "params { «3k» = 2 } coords { «2x» } mass { 2x: 3k }" => "`3k` is no name, since it begins with a digit; use another name, such as `k3`", "`2x` is no name, since it begins with a digit; use another name, such as `x2`";
    raw_names: "params { «r#box» = 1 } coords { «r#in» } mass { r#in: r#box }" => "`r#box` is reserved; use another name, such as `box_`", "`r#in` is reserved";
    raw_names_of_what_is_built: "bodies { planar «r#fn» { mass: 1, inertia: 1 } } tree { «r#if»: pin(ground.at([0, 0]), r#fn.at([1, 0])) }" => "`r#fn` is reserved", "`r#if` is reserved";
    value_with_a_reserved_name: "coords { x } let «gen» = 2 * x; let «sq» = |u| u; let { for i in 0..2 { d[«x»] = i } } mass { x: 1 } output { o = gen + gen, p = d[0] }" => "`gen` is reserved; choose another name", "`sq` is reserved", "`x` is not an integer constant or loop variable";
    bars_for_a_magnitude: "coords { x } mass { x: 1 } force { x: -0.3 * «|dot(x)|» * dot(x) }" => "a magnitude is written `abs(x)`, that of a vector `norm(v)`";
    bars_first: "coords { x } mass { x: 1 } force { x: «|x|» }" => "a magnitude is written `abs(x)`";
    bars_of_sums: "coords { x, y } let u = «|x - y|» - 2; let f = |v, w| v * w; mass { x: 1, y: 1 } holonomic { c: «|x|» + y = f(u, «|y|») }" => "a magnitude is written", "a magnitude is written", "a magnitude is written";
    bars_within_bars: "coords { x[2] } mass { x: 1 } potential { sum(0..2, |i| «|x[i]|» * sin(«|x[i]|» - 1)) }" => "a magnitude is written", "a magnitude is written";
    path_of_an_infinity: "params { k = «f64::INFINITY» } coords { x } mass { x: k }" => "no paths here, and nothing is called `INFINITY`; numbers are finite, and written out: `1e9`";
    path_of_a_turn: "params { k = «std::f64::consts::TAU» } coords { x } mass { x: k }" => "no paths here; write `2 * PI`";
    path_of_a_fraction: "params { k = «consts::FRAC_PI_4» } coords { x } mass { x: k }" => "no paths here; write `PI / 4`";
    quoted_name: "coords { x } mass { x: 1 } holonomic { h: sin(x) = t } output { o = reaction(«\"h\"») }" => "not a number; a name has no quotes: `h`";
    quoted_unit: "coords { x «[\"m\"]» } mass { x: 1 }" => "a unit has no quotes, nor has an index: `[m]`";
    quoted_units: "params { c = 1 «[\"N\"]», k[\"m\"] = 2 } coords { x [\"m\"] } mass { x[\"m\"]: c + k }" => "a unit has no quotes, nor has an index: `[N]`";
    quoted_index: "coords { x[2], y } mass { x: 1, y: 1 } holonomic { c«[\"u\"]»: x[0] = y }" => "a unit has no quotes, nor has an index: `[u]`";
    comment_with_a_hash: "params { m = 1, «#» mass
        k = 2 } coords { x } mass { x: m }" => "a comment begins with `//`";
    comment_in_a_mass: "coords { x } mass { x: 1, «#» the mass
        }" => "a comment begins with `//`";
    comment_between_sections: "coords { x } mass { x: 1 } «#» done" => "a comment begins with `//`";
    text: "coords { x } mass { x: «\"heavy\"» }" => "not a number; a name has no quotes: `heavy`";
    quoted_number: "coords { x } mass { x: «\" 1.5 \"» }" => "a number has no quotes: `1.5`";
    sum_as_rust_has_it: "coords { x[2] } mass { x: 1 } potential { «(0..2).map(|i| sq(x[i])).sum()» }" => "a sum over a range is written `sum(0..N, |i| …)`";
    sum_of_a_vector: "coords { x[2] } mass { x: 1 } potential { «x.sum()» }" => "a sum over a range is written `sum(0..N, |i| …)`";
    logarithm: "coords { x } mass { x: 1 } force { x: «log»(1 + sq(x)) }" => "unknown function `log`; the natural logarithm is `ln(x)`, that to base 10 `ln(x) / ln(10)`";
    point_of_the_ground: "bodies { planar a { mass: 1, inertia: 1 } } holonomic { c: pin(ground.«point»([0, 0]), a.at([1, 0])) }" => "unknown function `point`; the point p of a body is `body.at(p)`";
    revolute_joint: "bodies { planar a { mass: 1, inertia: 1 } } holonomic { c: «revolute»(ground.at([0, 0]), a.at([1, 0])) }" => "unknown function `revolute`; it is `pin` in the plane and `hinge` in space";
    prismatic_joint_of_a_tree: "bodies { planar a { mass: 1, inertia: 1 } } tree { c: «prismatic»(ground.at([0, 0]), a.at([1, 0]), [1, 0]) }" => "no joint of the tree is called `prismatic`; it is `slider`";
    spherical_joint: "bodies { spatial a { mass: 1, inertia: [1, 1, 1] } } holonomic { c: «spherical»(ground.at([0, 0, 0]), a.at([1, 0, 0])) }" => "unknown function `spherical`; it is `ball`";
    torsional_spring: "bodies { planar a { mass: 1, inertia: 1 } } forces { «torsional_spring»(ground, a, 1, 0) }" => "nothing that acts is called `torsional_spring`; it is `turning_spring`";
    function_called_nearly_as_elsewhere: "coords { x } let lengths = |u| 2 * u; mass { x: 1 } force { x: «length»(x) + «floor»(x) }" => "unknown function `length`; did you mean `lengths`?", "unknown function `floor`; no function here jumps";
}
