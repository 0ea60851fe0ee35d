use ukcore::{Mechanism, Solver, SolverOptions};

ukcore::multibody! {
    pub Pendulum {
        params { m = 1.0, l = 1.0, g = 9.81 }
        coords { x, y }
        mass { x: m, y: m }
        potential { m * g * y }
        holonomic { rod: sq(x) + sq(y) = sq(length) }
        output { angle = atan2(x, -y) }
    }
}

// Uses of the type give no further message.
fn main() {
    let pendulum = Pendulum { m: 2.0, ..Pendulum::default() };
    let solver = Solver::new::<Pendulum>(SolverOptions::default());
    let _ = (pendulum.parameter(0), Pendulum::X, Pendulum::ROD, Pendulum::OUT_ANGLE, solver);
}
