//! After an error in a declaration its type is still there: what uses it compiles, so that one mistake gives one message.

use ukcore::{Mechanism, Prepared};
use written::Broken;

/// As the macro writes it (`ukmacros/src/tests/golden.rs`).
#[allow(unreachable_pub)]
mod written {
    include!("../../ukmacros/golden/Broken.rs");
}

#[test]
fn what_uses_a_type_with_an_error_compiles() {
    let broken = Broken {
        m: 2.0,
        ..Broken::default()
    };
    assert_eq!(
        (broken.parameter(0), broken.parameter(2)),
        (2.0, broken.k[1])
    );
    let places = (Broken::X[1], Broken::Y, Broken::ROD, Broken::OUT_ANGLE);
    assert_eq!(places, (1, 2, 0, 0));
    assert_eq!((Broken::PIN[1][0], Broken::N, Broken::HALF), (3, 2, 0.5));
    let _: Prepared = broken.prepared();
    assert_eq!(Broken::SPEC.name, "Broken");
}
