//! One explicit Runge-Kutta step, for any scalar.
//!
//! A scalar may carry many lanes, each with a mechanism, a time and a step size of its own; so times and sizes are scalars too, and nothing
//! here branches on a value. What is accepted, and how large the next step is, is decided outside.

use super::tableau::{Stage, Tableau, Terms};
use crate::scalar::Scalar;

/// Buffers for steps with n components, and what the last attempted one left in them.
///
/// A right-hand side f(t, y, rate) writes y' into `rate`. Its error ends the call at once.
pub(crate) struct Stepper<S> {
    tableau: &'static Tableau,
    n: usize,
    /// Rates at the stages, row by row: those of the step, the closing one, those for the interpolant.
    rates: Vec<S>,
    /// Where a stage is evaluated.
    argument: Vec<S>,
    /// State at the end of the step.
    new: Vec<S>,
    /// Weighted squares of the estimates of the error, row by row.
    squares: Vec<S>,
    /// Rows of coefficients of the interpolant.
    dense: Vec<S>,
}

impl<S: Scalar> Stepper<S> {
    pub(crate) fn new(tableau: &'static Tableau, n: usize) -> Self {
        let zeros = |rows: usize| vec![S::from_f64(0.0); rows * n];
        Stepper {
            tableau,
            n,
            rates: zeros(tableau.closing() + 1 + tableau.extra.len()),
            argument: zeros(1),
            new: zeros(1),
            squares: zeros(tableau.errors.len()),
            dense: zeros(4 + tableau.dense.len()),
        }
    }

    /// Evaluates f at the start of the first step. Later steps begin with what [`close`](Stepper::close) has evaluated.
    pub(crate) fn begin<E>(
        &mut self,
        mut f: impl FnMut(S, &[S], &mut [S]) -> Result<(), E>,
        t: S,
        y: &[S],
    ) -> Result<(), E> {
        f(t, y, &mut self.rates[..self.n])
    }

    /// f at the start of the step.
    pub(crate) fn rate(&self) -> &[S] {
        &self.rates[..self.n]
    }

    /// An Euler step of size h, and f after it, which tells how fast f changes.
    pub(crate) fn probe<E>(
        &mut self,
        mut f: impl FnMut(S, &[S], &mut [S]) -> Result<(), E>,
        t: S,
        h: S,
        y: &[S],
    ) -> Result<&[S], E> {
        let euler: Terms = &[(0, 1.0)];
        let (start, rest) = self.rates.split_at_mut(self.n);
        sum(&mut self.argument, Some(y), h, start, euler);
        f(t + h, &self.argument, &mut rest[..self.n])?;
        Ok(&rest[..self.n])
    }

    /// The stages of a step of size `h` from (t, y), and the [state](Stepper::state) at its end.
    pub(crate) fn attempt<E>(
        &mut self,
        mut f: impl FnMut(S, &[S], &mut [S]) -> Result<(), E>,
        t: S,
        h: S,
        y: &[S],
    ) -> Result<(), E> {
        self.evaluate(&mut f, t, h, y, 1, self.tableau.stages)?;
        sum(&mut self.new, Some(y), h, &self.rates, self.tableau.b);
        Ok(())
    }

    /// Evaluates `stages`, of which the first is number `first`.
    fn evaluate<E>(
        &mut self,
        f: &mut impl FnMut(S, &[S], &mut [S]) -> Result<(), E>,
        t: S,
        h: S,
        y: &[S],
        first: usize,
        stages: &[Stage],
    ) -> Result<(), E> {
        for (index, stage) in (first..).zip(stages) {
            let (done, rest) = self.rates.split_at_mut(index * self.n);
            sum(&mut self.argument, Some(y), h, done, stage.a);
            let time = t + S::from_f64(stage.c) * h;
            f(time, &self.argument, &mut rest[..self.n])?;
        }
        Ok(())
    }

    /// State at the end of the attempted step.
    pub(crate) fn state(&self) -> &[S] {
        &self.new
    }

    /// The same, to be projected before [`close`](Stepper::close).
    pub(crate) fn state_mut(&mut self) -> &mut [S] {
        &mut self.new
    }

    /// Evaluates f at the end of the attempted step, which is at `t`.
    pub(crate) fn close<E>(
        &mut self,
        mut f: impl FnMut(S, &[S], &mut [S]) -> Result<(), E>,
        t: S,
    ) -> Result<(), E> {
        let closing = self.tableau.closing() * self.n;
        f(t, &self.new, &mut self.rates[closing..closing + self.n])
    }

    /// Estimated error of the attempted step from y in the [error norm](super): at most 1 if it has the accuracy asked for.
    ///
    /// With two estimates e₁, e₂: |e₁|² / √(|e₁|² + 0.01 |e₂|²), eq. (10.17) of the book, which is of the order of the method.
    pub(crate) fn error(&mut self, h: S, y: &[S], tolerance: f64) -> S {
        let (rates, new) = (&self.rates[..], &self.new[..]);
        match *self.tableau.errors {
            [best] => squares([&mut self.squares], y, new, tolerance, h, rates, [best]),
            [best, other] => {
                let (first, second) = self.squares.split_at_mut(self.n);
                squares([first, second], y, new, tolerance, h, rates, [best, other]);
            }
            _ => unreachable!("a method has one or two estimates"),
        }
        let n = self.n;
        let zero = S::from_f64(0.0);
        let best = total(&self.squares[..n]);
        let other = self.squares.get(n..).map_or(zero, total);
        let both = best + S::from_f64(0.01) * other;
        let divisor = S::select_le(both, zero, S::from_f64(1.0), both);
        best / (S::from_f64(n as f64) * divisor).sqrt()
    }

    /// Makes the [coefficients](Stepper::dense) of the interpolant of the closed step; evaluates stages for it if the method needs them.
    pub(crate) fn interpolate<E>(
        &mut self,
        mut f: impl FnMut(S, &[S], &mut [S]) -> Result<(), E>,
        t: S,
        h: S,
        y: &[S],
    ) -> Result<(), E> {
        let n = self.n;
        let closing = self.tableau.closing();
        self.evaluate(&mut f, t, h, y, closing + 1, self.tableau.extra)?;
        let (cubic, more) = self.dense.split_at_mut(4 * n);
        for (row, terms) in more.chunks_exact_mut(n.max(1)).zip(self.tableau.dense) {
            sum(row, None, h, &self.rates, terms);
        }
        let (c0, cubic) = cubic.split_at_mut(n);
        let (c1, cubic) = cubic.split_at_mut(n);
        let (c2, c3) = cubic.split_at_mut(n);
        let (start, end) = (&self.rates[..n], &self.rates[closing * n..][..n]);
        c0.copy_from_slice(y);
        for (((c1, c2), c3), ((y, new), (start, end))) in
            (c1.iter_mut().zip(c2).zip(c3)).zip(y.iter().zip(&self.new).zip(start.iter().zip(end)))
        {
            *c1 = *new - *y;
            *c2 = h * *start - *c1;
            *c3 = *c1 - h * *end - *c2;
        }
        Ok(())
    }

    /// Coefficients of the interpolant, rows as [`Interpolant`](super::dense::Interpolant) wants them.
    pub(crate) fn dense(&self) -> &[S] {
        &self.dense
    }

    /// Moves on to the end of the closed step. `choose(new, old)` is the new value in the lanes whose step was accepted, the old one in the others.
    pub(crate) fn advance(&mut self, y: &mut [S], choose: impl Fn(S, S) -> S) {
        let (start, rest) = self.rates.split_at_mut(self.n);
        let closing = (self.tableau.closing() - 1) * self.n;
        for (start, end) in start.iter_mut().zip(&rest[closing..]) {
            *start = choose(*end, *start);
        }
        for (y, new) in y.iter_mut().zip(&self.new) {
            *y = choose(*new, *y);
        }
    }
}

/// Sums are added up in so many parts, so that no addition waits for the one before.
const PARTS: usize = 4;

/// Calls `$function` with the number of terms as its constant `N`, which lets the compiler unroll the sum over them.
macro_rules! with_length {
    ($length:expr, $function:ident $arguments:tt for $($n:literal)*) => {
        match $length {
            $($n => with_length!(@call $function $n $arguments),)*
            other => unreachable!("no method has a sum of {other} terms"),
        }
    };
    (@call $function:ident $n:literal ($($argument:expr),*)) => {
        $function::<S, $n>($($argument),*)
    };
}

/// `out` = `base` + h Σ c k over the rows k of `rates`; without a base h Σ c k.
fn sum<S: Scalar>(out: &mut [S], base: Option<&[S]>, h: S, rates: &[S], terms: Terms) {
    with_length!(terms.len(), sum_of(out, base, h, rates, terms) for 1 2 3 4 5 6 7 8 9 12);
}

/// Rows and factors h c of `N` terms.
fn rows<'a, S: Scalar, const N: usize>(
    n: usize,
    h: S,
    rates: &'a [S],
    terms: Terms,
) -> ([&'a [S]; N], [S; N]) {
    (
        std::array::from_fn(|j| &rates[terms[j].0 * n..][..n]),
        std::array::from_fn(|j| h * S::from_f64(terms[j].1)),
    )
}

fn sum_of<S: Scalar, const N: usize>(
    out: &mut [S],
    base: Option<&[S]>,
    h: S,
    rates: &[S],
    terms: Terms,
) {
    let n = out.len();
    let (k, c) = rows::<S, N>(n, h, rates, terms);
    let term = |i: usize| {
        let mut sum = c[0] * k[0][i];
        for j in 1..N {
            sum = sum + c[j] * k[j][i];
        }
        sum
    };
    match base {
        Some(base) => {
            let base = &base[..n];
            for i in 0..n {
                out[i] = base[i] + term(i);
            }
        }
        None => {
            for i in 0..n {
                out[i] = term(i);
            }
        }
    }
}

/// Weighted squares of the errors h Σ c k, a row of `out` for each estimate; `estimates` have the same stages in the same order.
fn squares<S: Scalar, const R: usize>(
    out: [&mut [S]; R],
    y: &[S],
    new: &[S],
    tolerance: f64,
    h: S,
    rates: &[S],
    estimates: [Terms; R],
) {
    match estimates[0].len() {
        6 => squares_of::<S, 6, R>(out, y, new, tolerance, h, rates, estimates),
        8 => squares_of::<S, 8, R>(out, y, new, tolerance, h, rates, estimates),
        other => unreachable!("no method estimates errors with {other} terms"),
    }
}

fn squares_of<S: Scalar, const N: usize, const R: usize>(
    out: [&mut [S]; R],
    y: &[S],
    new: &[S],
    tolerance: f64,
    h: S,
    rates: &[S],
    estimates: [Terms; R],
) {
    let n = y.len();
    let new = &new[..n];
    let out = out.map(|row| &mut row[..n]);
    let parts = estimates.map(|terms| rows::<S, N>(n, h, rates, terms));
    let k = parts[0].0;
    let tolerance = S::from_f64(tolerance);
    for i in 0..n {
        let weight = weight(tolerance, y[i], new[i]);
        for r in 0..R {
            let c = &parts[r].1;
            let mut sum = c[0] * k[0][i];
            for j in 1..N {
                sum = sum + c[j] * k[j][i];
            }
            let weighted = sum * weight;
            out[r][i] = weighted * weighted;
        }
    }
}

/// 1 / (tol + tol max(|old|, |new|)).
#[inline(always)]
fn weight<S: Scalar>(tolerance: S, old: S, new: S) -> S {
    (tolerance + tolerance * old.abs().max(new.abs())).recip()
}

/// Sum of all `terms`, in an order that does not chain each addition to the one before.
fn total<S: Scalar>(terms: &[S]) -> S {
    let mut sums = [S::from_f64(0.0); PARTS];
    let (chunks, rest) = terms.as_chunks::<PARTS>();
    for chunk in chunks {
        for (sum, term) in sums.iter_mut().zip(chunk) {
            *sum = *sum + *term;
        }
    }
    for (sum, term) in sums.iter_mut().zip(rest) {
        *sum = *sum + *term;
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3])
}

/// The [error norm](super) of the change from `raw` to `projected` at the end of a step from `old`.
pub(crate) fn error_norm<S: Scalar>(raw: &[S], projected: &[S], old: &[S], tolerance: f64) -> S {
    let tolerance = S::from_f64(tolerance);
    let term = |raw: S, projected: S, old: S| {
        let weighted = (projected - raw) * weight(tolerance, old, raw);
        weighted * weighted
    };
    let mut sums = [S::from_f64(0.0); PARTS];
    let (raws, raw_rest) = raw.as_chunks::<PARTS>();
    let (projecteds, projected_rest) = projected.as_chunks::<PARTS>();
    let (olds, old_rest) = old.as_chunks::<PARTS>();
    for ((raw, projected), old) in raws.iter().zip(projecteds).zip(olds) {
        for part in 0..PARTS {
            sums[part] = sums[part] + term(raw[part], projected[part], old[part]);
        }
    }
    for ((raw, projected), old) in raw_rest.iter().zip(projected_rest).zip(old_rest) {
        sums[0] = sums[0] + term(*raw, *projected, *old);
    }
    let sum = (sums[0] + sums[1]) + (sums[2] + sums[3]);
    (sum / S::from_f64(raw.len().max(1) as f64)).sqrt()
}
