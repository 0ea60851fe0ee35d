//! The fish robot by hand: with both tail angles prescribed only the body's three coordinates are unknown.
//!
//! The joints give a2 = a1 + a α1 n1 + c2 and a3 = a1 + a α1 n1 + c3 with known c2, c3. In virtual displacements of the body the
//! joints and the gait do no work: Σ m a = Σ F, and i1 α1 + a n1·(m2 a2 + m3 a3) = a n1·(F2 + F3). With a1 eliminated, α1 is one
//! division by a constant.

use models::FishRobot;

/// Parameters, and what depends on them alone.
pub(crate) struct Fish {
    p: FishRobot,
    /// Factors of |v| v.
    drag: [f64; 4],
    lift: f64,
    behind: f64,
    per_mass: f64,
    share: f64,
    per_inertia: f64,
}

impl Fish {
    pub(crate) fn new(p: FishRobot) -> Self {
        let tail = p.m2 + p.m3;
        let mass = p.m1 + tail;
        let drag = [p.s, p.s1, p.s2, p.s3].map(|area| -0.5 * p.rho * p.cd * area);
        let inertia = p.i1 + p.a * p.a * tail * p.m1 / mass;
        Fish {
            drag,
            lift: 2.0 * std::f64::consts::PI * p.rho * p.span * p.half_chord,
            behind: p.l2 / 2.0,
            per_mass: 1.0 / mass,
            share: tail / mass,
            per_inertia: 1.0 / inertia,
            p,
        }
    }

    /// q̈ at (t, q, q̇).
    #[inline(never)]
    pub(crate) fn acceleration(&self, t: f64, q: &[f64; 9], v: &[f64; 9], out: &mut [f64]) {
        let p = &self.p;
        let [_, _, th1, _, _, th2, _, _, th3] = *q;
        let [vx1, vy1, w1, _, vy2, w2, vx3, vy3, w3] = *v;
        let out: &mut [f64; 9] = out.try_into().expect("nine coordinates");
        let ((s1, c1), (s2, c2), (s3, c3)) = (th1.sin_cos(), th2.sin_cos(), th3.sin_cos());
        // The gait.
        let ww = -p.w * p.w;
        let al2 = ww * p.a2 * (p.w * t).sin();
        let al3 = ww * p.a3 * (p.w * t - p.phi).sin();
        // Forces on the body, the peduncle, the fin.
        let f1 = [
            self.drag[0] * vx1.abs() * vx1,
            self.drag[1] * vy1.abs() * vy1,
        ];
        let f2 = self.drag[2] * vy2.abs() * vy2;
        let across = vx3 * s3 - vy3 * c3;
        let along = vy3 * c3 - vx3 * s3;
        let f3 = [
            self.lift * vy3 * across,
            self.drag[3] * vy3.abs() * vy3 + self.lift * vx3 * along,
        ];
        // What of the accelerations of peduncle and fin is known: θ̈ n − θ̇² e of each half link on the way.
        let (ww1, ww2, ww3) = (p.a * w1 * w1, self.behind * w2 * w2, p.b * w3 * w3);
        let half = [
            -self.behind * al2 * s2 - ww2 * c2,
            self.behind * al2 * c2 - ww2 * s2,
        ];
        let k2 = [half[0] - ww1 * c1, half[1] - ww1 * s1];
        let k3 = [
            k2[0] + half[0] - p.b * al3 * s3 - ww3 * c3,
            k2[1] + half[1] + p.b * al3 * c3 - ww3 * s3,
        ];
        let tail = [
            f3[0] - p.m2 * k2[0] - p.m3 * k3[0],
            f2 + f3[1] - p.m2 * k2[1] - p.m3 * k3[1],
        ];
        let all = [f1[0] + tail[0], f1[1] + tail[1]];
        let lever =
            p.a * (c1 * (tail[1] - self.share * all[1]) - s1 * (tail[0] - self.share * all[0]));
        let al1 = lever * self.per_inertia;
        let joint = [-p.a * al1 * s1, p.a * al1 * c1];
        let x1 = all[0] * self.per_mass - self.share * joint[0];
        let y1 = all[1] * self.per_mass - self.share * joint[1];
        let (xj, yj) = (x1 + joint[0], y1 + joint[1]);
        *out = [
            x1,
            y1,
            al1,
            xj + k2[0],
            yj + k2[1],
            al2,
            xj + k3[0],
            yj + k3[1],
            al3,
        ];
    }
}
