//! Models are found by name, and wrong names are answered with the nearest.

use models::{Model, Visitor};
use ukcore::Error;

struct Name;

impl Visitor for Name {
    type Output = &'static str;
    fn visit<M: Model>(self) -> &'static str {
        M::SPEC.name
    }
}

#[test]
fn models_are_found_by_name() {
    assert_eq!(models::visit("uchain", Name), Ok("UChain"));
    assert_eq!(models::visit("fish", Name), Ok("FishRobot"));
    let error = models::visit("uchian", Name).expect_err("a slip");
    assert!(
        matches!(&error, Error::UnknownName { kind: "model", nearest: Some(n), .. } if n == "uchain"),
        "{error}"
    );
}

#[test]
fn wrong_start_names_are_answered() {
    let chain = models::UChain::default();
    let error = chain
        .start("trapezium", &models::StartOptions::new())
        .expect_err("a slip");
    assert_eq!(
        error.to_string(),
        "no start is called `trapezium`; did you mean `trapezoid`? There are `trapezoid`, `catenary`"
    );
    let options = models::StartOptions::new().with("x", 12.0);
    let error = chain.start("catenary", &options).expect_err("a slip");
    assert_eq!(
        error.to_string(),
        "no start option is called `x`; did you mean `x0`?"
    );
}
