//! Truncated Taylor arithmetic: a second way to derivatives, against which the symbolic ones are checked.

/// Value, first and second derivative along a path.
#[derive(Clone, Copy)]
pub struct Jet(pub f64, pub f64, pub f64);

impl Jet {
    pub fn constant(x: f64) -> Jet {
        Jet(x, 0.0, 0.0)
    }
    pub fn plus(self, o: Jet) -> Jet {
        Jet(self.0 + o.0, self.1 + o.1, self.2 + o.2)
    }
    pub fn times(self, o: Jet) -> Jet {
        Jet(
            self.0 * o.0,
            self.1 * o.0 + self.0 * o.1,
            self.2 * o.0 + 2.0 * self.1 * o.1 + self.0 * o.2,
        )
    }
    /// f(u) from f, f′ and f″ at u.
    pub fn chain(self, value: f64, slope: f64, bend: f64) -> Jet {
        Jet(
            value,
            slope * self.1,
            bend * self.1 * self.1 + slope * self.2,
        )
    }
    /// θ of tan θ = self/w, by θ′ = (w u′ − u w′)/(u² + w²) and this quotient's own derivative.
    pub fn atan2(self, w: Jet) -> Jet {
        let top = w.0 * self.1 - self.0 * w.1;
        let bottom = self.0 * self.0 + w.0 * w.0;
        let top1 = w.0 * self.2 - self.0 * w.2;
        let bottom1 = 2.0 * (self.0 * self.1 + w.0 * w.1);
        let rate = top / bottom;
        Jet(self.0.atan2(w.0), rate, (top1 - rate * bottom1) / bottom)
    }
}
