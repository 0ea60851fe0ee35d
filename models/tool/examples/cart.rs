//! A whole program for a mechanism of one's own: `list`, `run`, `animate`, `explain`, `report`.

ukcore::multibody! {
    /// A cart on a spring with a pendulum hanging from it; y points up.
    pub Cart {
        params { big = 2.0 [kg], m = 1.0 [kg], l = 500 [mm], k = 40.0 [N/m], g = 9.81 [m/s^2] }
        coords { s [m], x [m], y [m] }
        mass { s: big, x: m, y: m }
        potential { 0.5 * k * sq(s), m * g * y }
        holonomic { rod: sq(x - s) + sq(y) = sq(l) }
        output { swing [deg] = atan2(x - s, -y) }
        /// let go with the cart at rest
        start released(
            /// Angle of the rod from the vertical
            angle = 50 [deg],
        ) {
            s = 0.0;
            x near l * sin(angle);
            y near -l * cos(angle)
        }
        draw { spring([-1.0, 0.0], [s, 0.0]) line([s, 0.0], [x, y]) circle([x, y], 0.05) trace([x, y]) }
    }
}

uktool::main!(Cart);
