//! The coupled four-bars by hand, in the null space of the constraints.
//!
//! With d_i the crank to top i and t_i its normal, the crank leaves a_i = α_i t_i − (v_i²/d_i²) d_i. The coupler e_i then gives α_{i+1}
//! from α_i, so that α = s + ρ α_0 and a = σ + τ α_0, and α_0 follows from τᵀ M τ α_0 = τᵀ (F − M σ). M couples neighbours only.

/// Tops.
const TOPS: usize = 41;

/// Parameters, as the declared model has them.
#[derive(Clone, Copy)]
pub(crate) struct FourBars {
    pub(crate) m: f64,
    pub(crate) l: f64,
    pub(crate) g: f64,
}

impl FourBars {
    /// q̈ at (q, q̇).
    #[inline(never)]
    pub(crate) fn acceleration(&self, q: &[f64], v: &[f64], out: &mut [f64]) {
        let split = |both: &[f64]| -> ([f64; TOPS], [f64; TOPS]) {
            let (x, y) = both.split_at(TOPS);
            let whole = |part: &[f64]| part.try_into().expect("both coordinates of all tops");
            (whole(x), whole(y))
        };
        let ((x, y), (vx, vy)) = (split(q), split(v));
        // a = σ where α = 0, divisions first.
        let (mut dx, mut sx, mut sy) = ([0.0; TOPS], [0.0; TOPS], [0.0; TOPS]);
        for i in 0..TOPS {
            dx[i] = x[i] - i as f64 * self.l;
            let pull = (vx[i] * vx[i] + vy[i] * vy[i]) / (dx[i] * dx[i] + y[i] * y[i]);
            (sx[i], sy[i]) = (-pull * dx[i], -pull * y[i]);
        }
        // e·(a_{i+1} − a_i) = −ė², with t = (−d_y, d_x): α_{i+1} = (known + near α_i)/far.
        let (mut ratio, mut step) = ([0.0; TOPS], [0.0; TOPS]);
        for i in 0..TOPS - 1 {
            let (ex, ey) = (x[i + 1] - x[i], y[i + 1] - y[i]);
            let (wx, wy) = (vx[i + 1] - vx[i], vy[i + 1] - vy[i]);
            let inverse = 1.0 / (ey * dx[i + 1] - ex * y[i + 1]);
            let bias = ex * (sx[i + 1] - sx[i]) + ey * (sy[i + 1] - sy[i]);
            ratio[i + 1] = (ey * dx[i] - ex * y[i]) * inverse;
            step[i + 1] = -(wx * wx + wy * wy + bias) * inverse;
        }
        let (mut rho, mut known) = ([1.0; TOPS], [0.0; TOPS]);
        for i in 1..TOPS {
            rho[i] = ratio[i] * rho[i - 1];
            known[i] = step[i] + ratio[i] * known[i - 1];
        }
        let (mut tx, mut ty) = ([0.0; TOPS], [0.0; TOPS]);
        for i in 0..TOPS {
            (tx[i], ty[i]) = (-rho[i] * y[i], rho[i] * dx[i]);
            sx[i] -= known[i] * y[i];
            sy[i] += known[i] * dx[i];
        }
        // M/m has (crank + couplers)/3 on and 1/6 beside the diagonal; the mass drops out but from where it is no number.
        let (mut top, mut bottom) = ([0.0; TOPS], [0.0; TOPS]);
        for i in 0..TOPS {
            let rods = if i == 0 || i == TOPS - 1 { 2.0 } else { 3.0 };
            let (diagonal, weight) = (rods / 3.0, -self.g * rods / 2.0);
            top[i] = ty[i] * weight - diagonal * (tx[i] * sx[i] + ty[i] * sy[i]);
            bottom[i] = diagonal * (tx[i] * tx[i] + ty[i] * ty[i]);
        }
        for i in 0..TOPS - 1 {
            let j = i + 1;
            let cross = tx[i] * sx[j] + ty[i] * sy[j] + tx[j] * sx[i] + ty[j] * sy[i];
            top[i] -= cross / 6.0;
            bottom[i] += (tx[i] * tx[j] + ty[i] * ty[j]) / 3.0;
        }
        let alpha = self.m * sum(&top) / (self.m * sum(&bottom));
        let (ax, ay) = out.split_at_mut(TOPS);
        for i in 0..TOPS {
            ax[i] = sx[i] + tx[i] * alpha;
            ay[i] = sy[i] + ty[i] * alpha;
        }
    }
}

/// Sum in eight parts, which run side by side.
fn sum(values: &[f64; TOPS]) -> f64 {
    let mut parts = [0.0; 8];
    for chunk in values.chunks(8) {
        for (part, value) in parts.iter_mut().zip(chunk) {
            *part += value;
        }
    }
    parts.iter().sum()
}
