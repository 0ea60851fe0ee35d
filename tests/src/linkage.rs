//! The linkage that many tests look at, and closed forms of planar ones.

ukcore::multibody! {
    /// The four-bar linkage of docs/planar.md, of bodies with coordinates of their own, with its reactions.
    pub FourBar {
        params { l[3] = [0.5, 2.0, 1.5], m[3] = 1.0, span = 2.0, k = 3.0, fold = 1.0, g = 9.81 }
        bodies { for i in 0..3 { planar bar[i] { mass: m[i], inertia: m[i] * sq(l[i]) / 12.0, centre: [l[i] / 2.0, 0] } } }
        gravity { [0, -g] }
        holonomic {
            o: pin(ground.at([0, 0]), bar[0].at([0, 0]))
            p: pin(bar[0].at([l[0], 0]), bar[1].at([0, 0]))
            q: pin(bar[1].at([l[1], 0]), bar[2].at([l[2], 0]))
            r: pin(ground.at([span, 0]), bar[2].at([0, 0]))
        }
        forces { turning_spring(bar[1], bar[2], k, fold) }
        output {
            tip = bar[1].at([1.0, 0.3]), push = dot(bar[1].at([1.0, 0.3])),
            o = reaction(o), p = reaction(p), q = reaction(q), r = reaction(r)
        }
        start open(crank = 1.0, coupler = 0.3, rocker = 1.4, speed = 0.0) {
            bar[0].angle = crank;
            bar[1].angle near coupler;
            bar[2].angle near rocker;
            bar[0].omega = speed
        }
        start crossed(crank = 1.0) { bar[0].angle = crank; bar[1].angle near -1.2; bar[2].angle near -2.0 }
        start crank(crank = 1.0) { bar[0].angle = crank }
    }
}

/// The angle between two sides of a triangle that are `a` and `b` long, where the third is `c`, by the law of cosines.
#[must_use]
pub fn corner(a: f64, b: f64, c: f64) -> f64 {
    ((a * a + b * b - c * c) / (2.0 * a * b)).acos()
}

/// The angle of the rocker of a four-bar linkage with these lengths of crank, coupler and rocker and this distance of their bearings; it
/// lies above the diagonal from the crank's pin to its bearing where `above` is 1, below where that is −1.
#[must_use]
pub fn rocker([a, b, c]: [f64; 3], span: f64, crank: f64, above: f64) -> f64 {
    let (x, y) = (a * crank.cos() - span, a * crank.sin());
    y.atan2(x) - above * corner(x.hypot(y), c, b)
}
