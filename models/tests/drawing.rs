//! Pictures: what is declared, and what bodies and joints give by themselves.

use tests::assert_all_close;
use ukcore::Mechanism;
use ukcore::spec::ShapeKind::{Line, Spring, Support};

ukcore::multibody! {
    /// A crank, a plate that it carries, a loose body on a spring.
    pub Plate {
        params { r = 0.5, a = 0.3 }
        bodies {
            planar crank { mass: 1.0, inertia: 0.1, centre: [0.2, 0] }
            planar plate { mass: 2.0, inertia: 0.3 }
            planar loose { mass: 1.0, inertia: 0.2 }
            planar free { mass: 1.0, inertia: 0.2 }
        }
        holonomic {
            bearing: pin(ground.at([1, 2]), crank.at([0, 0]))
            again: turn(ground, crank) = t
            pin: pin(crank.at([r, 0]), plate.at([0, 0]))
            rail: slot(ground.at([1, 2]), plate.at([a, 0]), [1, 0])
        }
        let tip = free.at([0, r]);
        forces { spring(plate.at([0, a]), loose.at([0, 0]), 10.0, 0.2) force(ground.at([1, 2]), loose.at([a, a]), 3.0) }
        output { reach = norm(tip - [1, 2]), inside = plate.at([a / 4.0, a / 4.0]) }
    }
}

#[test]
fn bodies_and_joints_have_a_picture() {
    let drawing = Plate::SPEC.drawing;
    let kinds: Vec<_> = drawing.shapes.iter().map(|s| (s.kind, s.numbers)).collect();
    // Each place on the ground once; the plate around its points, of which one is within, the others from their centres to what acts on
    // them and what is reported.
    let expected = [
        (Spring, 4),
        (Support, 2),
        (Line, 4),
        (Line, 4),
        (Line, 8),
        (Line, 4),
        (Line, 4),
    ];
    assert_eq!((drawing.dimension, &kinds[..]), (2, &expected[..]));
    let angle = 0.7_f64;
    let (sin, cos) = angle.sin_cos();
    let mut q = vec![0.0; 12];
    // The crank's frame has its origin at the bearing, its centre of mass 0.2 m farther out.
    q[Plate::CRANK_X] = 1.0 + 0.2 * cos;
    q[Plate::CRANK_Y] = 2.0 + 0.2 * sin;
    q[Plate::CRANK_ANGLE] = angle;
    (q[Plate::PLATE_X], q[Plate::PLATE_Y]) = (4.0, 5.0);
    (q[Plate::LOOSE_X], q[Plate::LOOSE_Y]) = (6.0, 7.0);
    (q[Plate::FREE_X], q[Plate::FREE_Y]) = (8.0, 9.0);
    let mut numbers = vec![f64::NAN; drawing.numbers()];
    Plate::default()
        .prepared()
        .drawing(0.0, &q, &[0.0; 12], &mut numbers);
    let crank = [1.0, 2.0, 1.0 + 0.5 * cos, 2.0 + 0.5 * sin];
    let plate = [4.0, 5.0, 4.3, 5.0, 4.0, 5.3, 4.0, 5.0];
    let spring = [4.0, 5.3, 6.0, 7.0];
    let expected = [
        &spring[..],
        &[1.0, 2.0],
        &[1.0, 2.0, 6.3, 7.3],
        &crank,
        &plate,
        &[6.0, 7.0, 6.3, 7.3],
        &[8.0, 9.0, 8.0, 9.5],
    ]
    .concat();
    assert_all_close("points", &numbers, &expected, 1e-15);
}

#[test]
fn every_model_is_whole() {
    models::entries().iter().for_each(tests::assert_whole);
}
