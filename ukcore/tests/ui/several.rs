ukcore::multibody! {
    pub Chain {
        const N: usize = 3;
        params { m = 1.0 }
        coords { x[N] }
        mass { for i in 0..N { x[i]: m } }
        force { x[3]: 1.0, y[0]: 1.0 }
        holonomic {
            for i in 0..N - 1 { link[i]: x[i + 1] - x[i] = dot(x[i]) }
            end: x[0] = t
            end: x[2] = 1.0
        }
    }
}

fn main() {}
