//! A part for mechanisms of other crates.

ukcore::multibody! {
    /// A leg of two bars with a spring between them and a foot of its own; y points up.
    #[ukcore(part)]
    pub Leg {
        const BARS: usize = 2;
        params { l = 0.5, m[BARS] = [1.0, 0.7], k = 3.0, rest = 0.2, i = m[0] * sq(l) / 12.0 }
        bodies { for b in 0..BARS { planar bar[b] { mass: m[b], inertia: i, centre: [l / 2.0, 0] } } }
        gravity { [0, -9.81] }
        holonomic { knee: pin(bar[0].at([l, 0]), bar[1].at([0, 0])) }
        forces { turning_spring(bar[0], bar[1], k, rest) }
        let end = |b, s| bar[b].at([s * l, 0]);
        let toe = end(1, 1);
        output { toe = toe }
    }
}
