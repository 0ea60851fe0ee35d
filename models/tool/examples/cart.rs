//! A whole program for a mechanism of one's own: `list`, `run`, `animate`, `explain`, `report`.

ukcore::multibody! {
    /// A cart on a spring with a pendulum hanging from it; y points up.
    pub Cart {
        params { big = 2.0, m = 1.0, l = 0.5, k = 40.0, g = 9.81 }
        coords { s, x, y }
        mass { s: big, x: m, y: m }
        potential { 0.5 * k * sq(s), m * g * y }
        holonomic { rod: sq(x - s) + sq(y) = sq(l) }
        output { swing = atan2(x - s, -y) }
        /// let go with the cart at rest
        start released(
            /// Angle of the rod from the vertical, rad
            angle = 0.9,
        ) {
            s = 0.0;
            x near l * sin(angle);
            y near -l * cos(angle)
        }
        draw { spring([-1.0, 0.0], [s, 0.0]) line([s, 0.0], [x, y]) circle([x, y], 0.05) trace([x, y]) }
    }
}

uktool::main!(Cart);
