//! When an elimination that left rows out may be used.
//!
//! The emitted elimination leaves out rows of [`Solve::redundant`](crate::spec::Solve::redundant) by what it sees of them at one state, to
//! rounding of G = A M⁻¹ Aᵀ: what they keep beside the others it knows to √ε alone. So the rank is decided once for a set of parameters, on
//! A itself, at the first state where nothing but rounding seems to be left of them. From then on as many may be left out, neither more (a
//! singular position) nor less. Where drift may lend them what is left, it is for the projection that follows each step to see that their
//! constraints are met: if the motion without them meets them, they do follow from the others; if not, the change by the projection
//! refuses the step, or the projection fails by name.

/// A certificate of an elimination that left out no row.
const WHOLE: f64 = 1.0;
/// The certificate of an elimination that left out no row, where inertias are far apart.
const UNEVEN: f64 = 0.75;
/// What it loses for each row that was left out, and where more than rounding is left of one: as the compiler emits it. Certificates are
/// compared for equality, so no elimination that left rows out is used if the two come to differ.
const DROPPED: f64 = 1.0 / 1024.0;
const DRIFTED: f64 = 0.5;

/// Whether an elimination with this certificate has pivots that are not safe, or has left out rows of which more than rounding is left.
pub(crate) fn doubtful(certificate: f64) -> bool {
    certificate.is_nan() || certificate <= WHOLE - DRIFTED
}

/// Projections that have to succeed after one that failed.
const DOUBT: usize = 8;

/// The certificates of accelerations that may be used: of an elimination that left out no row, or as many as do follow from the others, of
/// which rounding alone is left, or what drift may lend them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Accepted([f64; 6]);

impl Accepted {
    /// The certificates of an elimination that left out no row.
    pub(crate) const WHOLE: Accepted = Accepted([WHOLE; 6]);
    /// The certificates of an elimination that left out no row, whatever the inertias.
    pub(crate) const INDEPENDENT: Accepted =
        Accepted([WHOLE, WHOLE, WHOLE, UNEVEN, UNEVEN, UNEVEN]);

    /// Whether an acceleration with this certificate may be used.
    pub(crate) fn has(self, certificate: f64) -> bool {
        self.0.contains(&certificate)
    }
}

/// What is known of the rows that may be left out.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Dropping {
    /// Whether states are projected onto the constraints after each step.
    projected: bool,
    /// Whether all rows are to count, whatever is known.
    whole: bool,
    /// How many more projections have to succeed before drift explains anything.
    doubt: usize,
    /// How many rows follow from the others with the parameters of now.
    rows: Option<usize>,
    /// No coordinate is light beside the others with the parameters of now.
    even: bool,
    /// The certificate of the elimination last tried.
    pub(super) certificate: f64,
    pub(crate) accepted: Accepted,
}

impl Dropping {
    pub(super) fn new() -> Self {
        Dropping {
            projected: false,
            whole: false,
            doubt: 0,
            rows: None,
            even: false,
            certificate: 0.0,
            accepted: Accepted::WHOLE,
        }
    }

    /// Makes it known that each step of a run from here on ends with a projection, which tells whether constraints are met that are left
    /// out within it.
    pub(crate) fn project(&mut self) {
        self.projected = true;
    }

    /// Makes it known that states drift off the constraints from here on, and nothing shows whether those left out are met.
    pub(crate) fn keep(&mut self) {
        self.forget();
        self.whole = true;
    }

    /// A step was projected, or could not be: then constraints may have come to contradict each other, which solutions of all rows tell
    /// better for a while.
    pub(crate) fn judge(&mut self, met: bool) {
        self.doubt = if met {
            self.doubt.saturating_sub(1)
        } else {
            DOUBT
        };
        if let (0 | DOUBT, Some(rows)) = (self.doubt, self.rows) {
            self.accept(rows);
        }
    }

    /// Accepts that `rows` rows are left out.
    fn accept(&mut self, rows: usize) {
        let lost = rows as f64 * DROPPED;
        let trusted = self.projected && self.doubt == 0;
        let with = |whole: f64| {
            let drifted = if trusted { whole - DRIFTED } else { whole };
            [whole, whole - lost, drifted - lost]
        };
        let ([a, b, c], [d, e, f]) = (with(WHOLE), with(if self.even { UNEVEN } else { WHOLE }));
        self.accepted = Accepted([a, b, c, d, e, f]);
    }

    /// Parameters have changed, or the place where it was decided was a singular position, which rows follow from the others at alone.
    pub(crate) fn forget(&mut self) {
        (self.rows, self.even, self.accepted) = (None, false, Accepted::WHOLE);
    }

    /// Whether the elimination last tried waits for a look at inertias that are far apart.
    pub(super) fn is_uneven(&self) -> bool {
        !self.even && self.certificate > 0.0 && self.certificate <= UNEVEN
    }

    /// No coordinate is light beside the others.
    pub(super) fn even_out(&mut self) {
        self.even = true;
        self.accept(self.rows.unwrap_or(0));
    }

    /// Whether it is not known how many rows follow from the others.
    pub(crate) fn is_unknown(&self) -> bool {
        self.rows.is_none()
    }

    /// The rank of `m` rows, if it is known.
    pub(super) fn rank(&self, m: usize) -> Option<usize> {
        self.rows.map(|rows| m - rows)
    }

    /// Takes a solution of rank `rank` of `m` rows, at the state of the elimination last tried. Whether it confirms that as many rows as
    /// were left out there, of which nothing but rounding was left, follow from the others.
    pub(super) fn confirm(&mut self, rank: usize, m: usize) -> bool {
        let rows = m - rank;
        let lost = rows as f64 * DROPPED;
        let left_out = [WHOLE - lost, UNEVEN - lost].contains(&self.certificate);
        let confirms = !self.whole && rows > 0 && left_out;
        if confirms {
            self.rows = Some(rows);
            self.accept(rows);
        }
        confirms
    }
}
