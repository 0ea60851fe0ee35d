//! Pictures: what is declared, and what bodies and joints give by themselves.

use tests::{assert_all_close, assert_close};
use ukcore::Mechanism;
use ukcore::spec::ShapeKind::{Line, Mark, Spring, Support};

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

ukcore::multibody! {
    /// A plate whose corners are named across, and a body whose points lie in no plane.
    pub Hung {
        bodies {
            spatial plate { mass: 1.0, inertia: [0.1, 0.1, 0.2] }
            spatial star { mass: 1.0, inertia: [0.1, 0.1, 0.1] }
        }
        forces {
            spring(ground.at([0, 0, 3]), plate.at([1, 1, 0]), 10.0, 1.0)
            spring(ground.at([0, 0, 3]), plate.at([-1, -1, 0]), 10.0, 1.0)
            spring(star.at([1, 0, 0]), plate.at([1, -1, 0]), 10.0, 1.0)
            spring(star.at([0, 1, 0]), plate.at([-1, 1, 0]), 10.0, 1.0)
            spring(star.at([0, 0, 1]), ground.at([0, 0, 3]), 10.0, 1.0)
        }
    }
}

#[test]
fn spatial_bodies_are_drawn_around_a_plane_or_from_their_centres() {
    let drawing = Hung::SPEC.drawing;
    let mut q = vec![0.0; 14];
    (q[Hung::PLATE_E0], q[Hung::STAR_E0]) = (1.0, 1.0);
    let mut numbers = vec![f64::NAN; drawing.numbers()];
    let hung = Hung::default().prepared();
    hung.drawing(0.0, &q, &[0.0; 14], &mut numbers);
    let mut lines = Vec::new();
    let mut rest = &numbers[..];
    for shape in drawing.shapes {
        let (own, after) = rest.split_at(shape.numbers);
        rest = after;
        if shape.kind == Line {
            lines.push(own.chunks(3).collect::<Vec<_>>());
        }
    }
    let [plate, star] = &lines[..] else {
        panic!("two bodies, {} lines", lines.len())
    };
    // Around the square, each side once, wherever it begins.
    assert_eq!((plate.len(), plate.first()), (5, plate.last()));
    for side in plate.windows(2) {
        assert_eq!(
            tests::largest(&[side[0][0] - side[1][0], side[0][1] - side[1][1]]),
            2.0
        );
        assert!(
            side[0][0] == side[1][0] || side[0][1] == side[1][1],
            "{side:?}"
        );
    }
    let centre = [0.0; 3];
    assert_eq!(
        star[..],
        [
            &centre,
            &[1.0, 0.0, 0.0],
            &centre,
            &[0.0, 1.0, 0.0],
            &centre,
            &[0.0, 0.0, 1.0],
            &centre
        ]
    );
}

ukcore::multibody! {
    /// A disc on the plane z = 0.
    pub Coin {
        bodies { spatial coin { mass: 1.0, inertia: [0.1, 0.2, 0.1] } }
        holonomic { touches: disc(coin.at([0, 0, 0]), [0, 1, 0], 0.4) }
    }
}

ukcore::multibody! {
    /// A wheel on a line.
    pub Wheel {
        bodies { planar hub { mass: 1.0, inertia: 0.1 } }
        holonomic { rolls: wheel(ground.at([0, 0]), hub.at([0, 0]), [1, 0], 0.4) }
    }
}

ukcore::multibody! {
    /// A pinion, whose bearing a slot leads, on a rack.
    pub Pinion {
        bodies { planar pinion { mass: 1.0, inertia: 0.1 } }
        holonomic {
            bearing: slot(ground.at([0, 0.4]), pinion.at([0, 0]), [1, 0])
            rolls: rack(ground.at([0, 0]), pinion.at([0, 0]), [1, 0], 0.4)
        }
    }
}

#[test]
fn what_rolls_has_a_rim_that_touches_the_ground() {
    let (sin, cos) = 0.3_f64.sin_cos();
    // The axis turned about x by 0.6 rad, which leaves the lowest point at r cos 0.6 below the centre.
    let height = 0.4 * 0.6_f64.cos();
    let coin = [1.0, 2.0, height, cos, sin, 0.0, 0.0];
    // Rolled by an angle of −0.3 rad.
    let wheel = [0.12, 0.4, -0.3];
    // The rim, the places on the ground, the hub.
    let coin_shapes = &[Line, Mark][..];
    let wheel_shapes = &[Line, Support, Mark][..];
    let pinion_shapes = &[Line, Support, Support, Mark][..];
    for (mechanism, q, up, shapes) in [
        (Coin::default().prepared(), &coin[..], 2, coin_shapes),
        (Wheel::default().prepared(), &wheel, 1, wheel_shapes),
        (Pinion::default().prepared(), &wheel, 1, pinion_shapes),
    ] {
        let drawing = mechanism.spec().drawing;
        let kinds: Vec<_> = drawing.shapes.iter().map(|shape| shape.kind).collect();
        assert_eq!(kinds, shapes);
        let mut numbers = vec![f64::NAN; drawing.numbers()];
        mechanism.drawing(0.0, q, &vec![0.0; q.len()], &mut numbers);
        // A spoke and the rim.
        let points = numbers[..drawing.shapes[0].numbers].chunks(up + 1);
        let points: Vec<&[f64]> = points.collect();
        let (centre, rim) = points.split_first().expect("a centre");
        assert_eq!(centre[..], q[..=up]);
        for point in rim {
            let square: f64 = point
                .iter()
                .zip(*centre)
                .map(|(x, c)| (x - c) * (x - c))
                .sum();
            assert_close("radius", square.sqrt(), 0.4, 1e-15);
        }
        let lowest = rim.iter().map(|p| p[up]).fold(f64::INFINITY, f64::min);
        assert!((-1e-15..2e-3).contains(&lowest), "{lowest}");
        if up == 1 {
            // The spoke turns with the body.
            let spoke = [q[0] + 0.4 * q[2].cos(), q[1] + 0.4 * q[2].sin()];
            assert_all_close("spoke", rim[0], &spoke, 1e-15);
        }
    }
}

#[test]
fn every_model_is_whole() {
    models::entries().iter().for_each(tests::assert_whole);
}
