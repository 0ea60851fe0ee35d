//! The falling U-chain of Zhao, Zhen & Chen 2013, §3-5.

use crate::{Model, Reference, StartOption, StartOptions, StartSpec, reference};
use ukcore::model::Chosen;
use ukcore::{Error, State};

ukcore::multibody! {
    /// Falling U-chain of 17 particles (Zhao, Zhen & Chen 2013, case 1).
    ///
    /// Falling U-chain: N particles joined by N massless rigid links, of which the last hangs from a fixed support at the origin.
    /// Particle 0 is the free tip. The y axis points down. (Zhao, Zhen & Chen 2013, §3-5.)
    pub UChain {
        const N: usize = 17;
        params {
            /// Mass of each particle
            m = 1.0 [kg],
            /// Length of each link
            l = 1.0 [m],
            /// Acceleration of gravity
            g = 9.8 [m/s^2],
        }
        coords {
            /// Horizontal positions
            x[N] [m],
            /// Vertical positions, downwards
            y[N] [m],
        }
        mass { for i in 0..N { x[i]: m, y[i]: m } }
        potential { for i in 0..N { -m * g * y[i] } }
        holonomic {
            for i in 0..N - 1 { link[i]: sq(x[i + 1] - x[i]) + sq(y[i + 1] - y[i]) = sq(l) }
            support: sq(x[N - 1]) + sq(y[N - 1]) = sq(l)
        }
        output {
            /// Depth of the tip below the support
            fall [m] = y[0],
            /// Downward speed of the tip
            fall_speed [m/s] = dot(y[0]),
            /// Depth of the centre of mass below the support
            centre [m] = sum(0..N, |i| y[i]) / N,
        }
        draw {
            for i in 0..N - 1 { line([x[i], -y[i]], [x[i + 1], -y[i + 1]]) }
            line([x[N - 1], -y[N - 1]], [0, 0]) trace([x[0], -y[0]])
        }
    }
}

/// A row of the paper's Table 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TableRow {
    /// Horizontal distance of the tip from the support at the start, m.
    pub x0: f64,
    /// Greatest depth of the tip's fall, m (printed to 1e-3).
    pub h_max: f64,
    /// Time of the greatest depth, s (printed to 1e-3).
    pub t_max: f64,
    /// How far a free body falls in `t_max`, m (printed to 1e-3).
    pub free_fall: f64,
    /// Figure that shows the vertical force on the tip.
    pub figure: u32,
}

/// Table 1 as printed, for [`UChain`] with default parameters.
pub const TABLE_1: [TableRow; 5] = [
    row(12.0, 15.943, 1.635, 13.099, 2),
    row(13.0, 15.990, 1.685, 13.912, 3),
    row(14.0, 16.070, 1.749, 14.989, 4),
    row(15.0, 16.323, 1.802, 15.911, 5),
    row(16.0, 16.671, 1.842, 16.625, 6),
];

const fn row(x0: f64, h_max: f64, t_max: f64, free_fall: f64, figure: u32) -> TableRow {
    TableRow {
        x0,
        h_max,
        t_max,
        free_fall,
        figure,
    }
}

/// Number of particles, and of links.
const N: usize = UChain::X.len();
const LINKS: f64 = N as f64;

const X0: StartOption = StartOption {
    name: "x0",
    doc: "horizontal distance of the tip from the support",
    default: 12.0,
    unit: "m",
    written: "",
};

impl Model for UChain {
    const ID: &'static str = "uchain";

    fn starts() -> &'static [StartSpec] {
        &[
            StartSpec {
                name: "trapezoid",
                doc: "at rest as an isosceles trapezoid, legs at 60° for integer x0 (the paper's start)",
                options: &[X0],
                duration: 2.0,
            },
            StartSpec {
                name: "catenary",
                doc: "at rest in the equilibrium shape between the support and the tip held at (x0, 0)",
                options: &[X0],
                duration: 2.0,
            },
        ]
    }

    fn start(&self, name: &str, options: &StartOptions) -> Result<State, Error> {
        let start = Chosen::among(Self::starts(), name, options)?;
        let [x0] = start.values();
        let span = x0 / self.l;
        let directions = if start.spec.name == "catenary" {
            catenary(span)?
        } else {
            trapezoid(span)?
        };
        Ok(self.hang(&directions))
    }

    /// To 1.5 s, and to 1.6 s: shortly before the tip turns, where errors grow fast.
    fn references() -> Vec<Reference> {
        let whole = Reference {
            source: "integration in 113-bit arithmetic by two methods",
            // They agree to 1e-26; an `f64` holds 17 digits of speeds of some 20 m/s.
            error: 4e-15,
            states: reference::states(include_str!("../data/uchain.json"), "states"),
        };
        vec![whole.up_to(1.5), whole]
    }
}

impl UChain {
    /// ½ g t²: how far a free body falls in the time `t`, m.
    #[must_use]
    pub fn free_fall(&self, t: f64) -> f64 {
        0.5 * self.g * t * t
    }

    /// The state at rest whose links, counted from the support, have these directions (cos, sin; sin positive downwards).
    fn hang(&self, directions: &[(f64, f64); N]) -> State {
        let mut q = vec![0.0; 2 * N];
        let (mut x, mut y) = (0.0, 0.0);
        for (i, (cos, sin)) in (0..N).rev().zip(directions) {
            x += self.l * cos;
            y += self.l * sin;
            q[UChain::X[i]] = x;
            q[UChain::Y[i]] = y;
        }
        State {
            t: 0.0,
            q,
            v: vec![0.0; 2 * N],
        }
    }
}

/// Directions (cos, sin) of the links, from the support, of the trapezoid with the span `span` = x0/l: k links down, 17 − 2k level,
/// k up, all k at the angle α with (17 − 2k) + 2k cos α = x0/l.
///
/// k = ⌈17 − x0/l⌉ but at most 8. For an integer x0/l from 9 on that gives cos α = ½, the legs at 60° of the paper.
///
/// # Errors
/// [`Error::InvalidSetting`] unless 1 ≤ x0/l ≤ 17.
pub fn trapezoid(span: f64) -> Result<[(f64, f64); N], Error> {
    if !(1.0..=LINKS).contains(&span) {
        return Err(infeasible(span, "from l to 17 l"));
    }
    let legs = (LINKS - span).ceil().min(((N - 1) / 2) as f64);
    if legs == 0.0 {
        return Ok([(1.0, 0.0); N]);
    }
    let cos = (span - (LINKS - 2.0 * legs)) / (2.0 * legs);
    let sin = (1.0 - cos * cos).sqrt();
    Ok(std::array::from_fn(|link| {
        let link = link as f64;
        if link < legs {
            (cos, sin)
        } else if link < LINKS - legs {
            (1.0, 0.0)
        } else {
            (cos, -sin)
        }
    }))
}

/// Directions (cos, sin) of the links, from the support, of the hanging chain in equilibrium with the span `span` = x0/l.
///
/// Balance of the particle between links j and j + 1: all links have the same horizontal tension H, and their vertical tension drops
/// by m g from one to the next. By symmetry it is k m g with k = 8, 7, …, −8, so tan θ = k/η with η = H/(m g), and
/// x0/l = Σ η/√(η² + k²), which grows with η from 1 to 17.
///
/// # Errors
/// [`Error::InvalidSetting`] unless 1 < x0/l < 17.
pub fn catenary(span: f64) -> Result<[(f64, f64); N], Error> {
    if !(span > 1.0 && span < LINKS) {
        return Err(infeasible(span, "between l and 17 l"));
    }
    let steps = |link: usize| ((N - 1) / 2) as f64 - link as f64;
    let width = |eta: f64| -> f64 { (0..N).map(|j| eta / eta.hypot(steps(j))).sum() };
    // Bisection of η = tan u: it cannot miss, and ends when u has no more digits.
    let (mut low, mut high) = (0.0, std::f64::consts::FRAC_PI_2);
    loop {
        let middle: f64 = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if width(middle.tan()) < span {
            low = middle;
        } else {
            high = middle;
        }
    }
    let eta = high.tan();
    Ok(std::array::from_fn(|j| {
        let length = eta.hypot(steps(j));
        (eta / length, steps(j) / length)
    }))
}

fn infeasible(span: f64, range: &str) -> Error {
    Error::InvalidSetting {
        what: "x0",
        reason: format!("is {span} l; the 17 links of length l allow x0 {range}"),
    }
}
