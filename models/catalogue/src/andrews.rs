//! Andrews' squeezing mechanism.

ukcore::multibody! {
    /// Andrews' squeezing mechanism: seven planar bodies, one degree of freedom, driven by a constant torque.
    ///
    /// Schiehlen (ed.), Multibody Systems Handbook, 1990; Hairer & Wanner, Solving Ordinary Differential Equations II, VII.7; Test Set for
    /// IVP Solvers. Bodies 1 to 7 of the literature are `k[0]` to `k[6]`: crank, rod, triangle, rod, lever, rod, lever; `a`, `b` and `c`
    /// are its points A, B and C of the ground. Lengths in m, masses in kg.
    pub Andrews {
        params {
            m[7] = [0.04325, 0.00365, 0.02373, 0.00706, 0.07050, 0.00706, 0.05498] [kg],
            i[7] = [2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7, 1.169e-5, 5.667e-7, 1.912e-5] [kg m^2],
            a[2] = [-0.06934, -0.00227] [m], b[2] = [-0.03635, 0.03273] [m], c[2] = [0.014, 0.072] [m], c0 = 4530.0 [N/m], l0 = 0.07785 [m],
            d = 0.028 [m], da = 0.0115 [m], e = 0.02 [m], ea = 0.01421 [m], rr = 0.007 [m], ra = 0.00092 [m], ss = 0.035 [m], sa = 0.01874 [m],
            sb = 0.01043 [m], sc = 0.018 [m], sd = 0.02 [m], ta = 0.02308 [m], tb = 0.00916 [m], u = 0.04 [m], ua = 0.01228 [m], ub = 0.00449 [m],
            zf = 0.02 [m], zt = 0.04 [m], fa = 0.01421 [m], mom = 0.033 [N m],
        }
        let centre = [[ra, 0], [-da, 0], [sb, -sa], [0, ea - e], [ta, -tb], [zf - fa, 0], [ua, -ub]];
        bodies { for n in 0..7 { planar k[n] { mass: m[n], inertia: i[n], centre: centre[n] } } }
        let end = [k[1].at([-d, 0]), k[2].at([0, -ss]), k[3].at([0, -e]), k[5].at([zf, 0])];
        holonomic {
            o: pin(ground.at([0, 0]), k[0].at([0, 0]))
            f: pin(k[0].at([rr, 0]), k[1].at([0, 0]))
            b3: pin(ground.at(b), k[2].at([0, 0]))
            a5: pin(ground.at(a), k[4].at([0, 0]))
            h: pin(k[4].at([zt, 0]), k[3].at([0, 0]))
            a7: pin(ground.at(a), k[6].at([0, 0]))
            g: pin(k[6].at([0, -u]), k[5].at([0, 0]))
            for n in 1..4 { e0[n - 1]: end[n] - end[0] = 0 }
        }
        forces { spring(k[2].at([sd, -sc]), ground.at(c), c0, l0), torque(k[0], mom) }
        output { beta [rad] = k[0].angle, theta [rad] = k[1].angle - k[0].angle, gamma [rad] = k[2].angle, phi [rad] = k[3].angle - k[4].angle,
            delta [rad] = k[4].angle, omega [rad] = k[5].angle - k[6].angle, epsilon [rad] = k[6].angle }
        /// at rest at the published angles
        start published until 0.03 {
            k[0].angle = -0.06171389001427645
            k[1].angle near -0.06171389001427645
            k[2].angle near 0.4552798191630704
            k[3].angle near 0.7100333697097284
            k[4].angle near 0.48736497954384255
            k[5].angle near 1.0078790543839353
            k[6].angle near 1.2305474445498212
        }
    }
}
