//! What a start says, and its options.

use super::check;

cases! {
    check;
    start_without_a_name: "coords { x } mass { x: 1.0 } start «{» x = 1.0 }" => "a start needs a name: `start released { x = 1.0 }`";
    start_without_a_value: "coords { x } mass { x: 1.0 } start a { «x»: 1.0 }" => "a start says where `x` is: `x = 1.0`, which holds, or `x near 1.0`, from where it may move";
    start_of_coordinates: "coords { x, y } mass { x: 1.0, y: 1.0 } start a { x = «y» }" => "a start is given by parameters and its options";
    start_of_velocities: "coords { x } mass { x: 1.0 } start a { dot(x «+» 1.0) = 2.0 }" => "a start gives velocities of coordinates, such as `dot(x) = 1.0`";
    start_of_what_is_none: "params { m = 1.0 } coords { x } mass { x: m } start a { «m» = 1.0 }" => "`m` is not a coordinate; coordinates are `x`";
    start_given_twice: "coords { x[2] } mass { x: 1.0 } start a { x = [1.0, 2.0]; «x[1]» near 1.0 }" => "`x[1]` is given twice in this start; remove one";
    start_declared_twice: "coords { x } mass { x: 1.0 } start a { x = 1.0 } start «a» { x = 2.0 }" => "start `a` is declared twice; names must be unique";
    option_behind_a_number: "coords { x } mass { x: 1.0 } start a(b = 1.0 «2.0») { x = b }" => "expected identifier";
    option_without_a_default: "coords { x } mass { x: 1.0 } start a(«b») { x = b }" => "option `b` needs a default: `b = 1.0`";
    option_with_its_unit_behind_its_name: "coords { x [m] } mass { x: 1.0 } start a(b «[m]» = 1.0) { x = b }" => "a unit stands behind numbers, as in `l = 0.3 [m]`";
    option_of_several_numbers: "coords { x } mass { x: 1.0 } start a(«b»[2] = 1.0) { x = b }" => "option `b` is one number; declare one for each";
    option_like_a_parameter: "params { m = 1.0 } coords { x } mass { x: m } start a(«m» = 1.0) { x = m }" => "`m` is declared twice; names must be unique";
    option_not_constant: "params { m = 1.0 } coords { x } mass { x: m } start a(b = 2.0 * «m») { x = b }" => "the default of an option is a number, or made of constants; parameters stand in what the start says, beside the option";
    option_not_finite: "coords { x } mass { x: 1.0 } start a(b = «ln(0.0 - 1.0)») { x = b }" => "default of `b`";
    start_of_a_vector_of_nothing: "coords { x } mass { x: 1.0 } start a { «[]» near 1.0 }" => "a vector of coordinates, such as `[x, y] near [1.0, 0.0]`, needs one at least";
    start_of_a_vector_of_another_size: "coords { x, y } mass { x: 1.0, y: 1.0 } start a { [x, y] near «[1.0, 2.0, 3.0]» }" => "expected a vector of 2, found a vector of 3";
    start_of_a_mixed_vector: "coords { x, y[2] } mass { x: 1.0, y: 1.0 } start a { [x, «y»] near [1.0, 2.0] }" => "those of one vector are numbers all, or families of one size";
    start_that_turns_twice: "bodies { spatial top { mass: 1.0, inertia: [1.0, 1.0, 1.0] } } start a { dot(top.e0) = 0.0; «top.omega» = [1.0, 2.0, 3.0] }" => "`dot(top.e0)` is given twice in this start; remove one";
    start_that_turns_again: "bodies { spatial top { mass: 1.0, inertia: [1.0, 1.0, 1.0] } } start a { top.spin near [1.0, 2.0, 3.0]; «top.omega» = [1.0, 2.0, 3.0] }" => "`dot(top.e0)` is given twice in this start; remove one";
    start_of_vectors_without_a_comma: "coords { x, y } mass { x: 1.0, y: 1.0 } start a { dot(x) = 1.0 [x, y] «near» [1.0, 2.0] }" => "what stands before `near` is read as an index of the entry before it; put `,` between them";
    start_of_held_vectors_without_a_comma: "coords { x, y } mass { x: 1.0, y: 1.0 } start a { dot(x) = 1.0 [x, y] «=» [1.0, 2.0] }" => "what stands before `=` is read as an index of the entry before it; put `,` between them";
    start_that_lasts_nothing: "coords { x } mass { x: 1.0 } start a «until» { x = 1.0 }" => "`until` needs how long a motion lasts: `until 2.0`";
    start_of_a_wrong_turn: "bodies { spatial top { mass: 1.0, inertia: [1.0, 1.0, 1.0] } } start a { top.spin = «2.0» }" => "expected a vector of 3, found a number";
    start_of_what_no_body_has: "bodies { planar bar { mass: 1.0, inertia: 1.0 } } start a { bar.«spin» = 2.0 }" => "body `bar` has no coordinate `spin`";
    start_that_lasts_no_time: "coords { x } mass { x: 1.0 } start a until «0.0» { x = 1.0 }" => "a motion lasts a time above 0, not 0";
    start_that_lasts_what_changes: "params { m = 1.0 } coords { x } mass { x: m } start a until «m» { x = 1.0 }" => "how long a motion lasts is a number of units of time, or of constants; parameters and options do not change it";
    start_with_a_slip: "coords { x } mass { x: 1.0 } start a «till» 2.0 { x = 1.0 }" => "unexpected `till`; behind name and options of a start stands how long a motion from it lasts, `until 2.0`, or `{`";
    start_of_a_wrong_shape: "coords { x[2] } mass { x: 1.0 } start a { x = «[1.0, 2.0, 3.0]» }" => "expected a vector of 2, found a vector of 3";
}
