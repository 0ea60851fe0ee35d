ukcore::multibody! {
    pub Pendulum {
        params { m = 1.0, l = 1.0 }
        coords { x, y }
        mass { x: m, y: m }
        holonomic { rod: x ^ 2 + y.powi(2) = l.powi(2) }
    }
}

fn main() {}
