//! A whole program for a mechanism of one's own: `list`, `run`, `explain`, `report`.

ukcore::multibody! {
    /// A cart on a spring with a pendulum hanging from it; y points up.
    pub Cart {
        params { big = 2.0, m = 1.0, l = 0.5, k = 40.0, g = 9.81 }
        coords { s, x, y }
        mass { s: big, x: m, y: m }
        potential { 0.5 * k * sq(s), m * g * y }
        holonomic { rod: sq(x - s) + sq(y) = sq(l) }
        output { angle = atan2(x - s, -y) }
    }
}

uktool::main!(Cart);
