//! The section on the fish robot.

use crate::html::{Cell, figure, fixed, joined, table};

use super::super::fish::{FishRow, WINDOW, sweep};
use super::super::{Paper, published};
use super::number;

/// Text, tables and figures.
pub(super) fn section(paper: &Paper) -> String {
    let rows = &paper.fish;
    let amplitude = sweep(rows, 0, |r| r);
    let mut html = format!(
        "<h2 id=\"fish\">2. The fish robot</h2>\n\
         <p>Body, peduncle and fin, with drag on each and lift on the fin; peduncle and fin are driven as θ2 = A2 sin ωt and θ3 = A3 sin(ωt − φ) with A2 = {}. \
         The driven angles carry no inertia, so the mass matrix is singular.</p>\n\
         <p class=\"note\"><b>Signs.</b> The tail is at +x, so the fish swims towards −x. The tables (and paper.json) give ẍ1 and ẋ1 as they are: \
         negative numbers swim forward. The figures of velocity show −ẋ1, as the paper's do, so up is forward; those of acceleration show ẍ1, so \
         the start points down.</p>\n",
        published::A2
    );
    html.push_str(&fish_table(rows));
    html.push_str("<h3>Forward velocity (Figs. 9-12)</h3>\n<div class=\"figures\">\n");
    for (i, r) in amplitude.iter().enumerate() {
        html.push_str(&figure(
            &format!("figures/fig{}.svg", 9 + i),
            &format!("Forward velocity for A3 = {}", r.a3),
            &format!(
                "Fig. {}: −ẋ1 for A3 = {}. Mean over {}-{} s: {} m/s.",
                9 + i,
                r.a3,
                WINDOW.0,
                WINDOW.1,
                fixed(-r.mean_speed, 4)
            ),
        ));
    }
    html.push_str("</div>\n<h3>Acceleration (Figs. 13-16)</h3>\n<div class=\"figures\">\n");
    for (i, r) in amplitude.iter().enumerate() {
        html.push_str(&figure(
            &format!("figures/fig{}.svg", 13 + i),
            &format!("Acceleration for A3 = {}", r.a3),
            &format!(
                "Fig. {}: ẍ1 for A3 = {}. It starts at {} m/s².",
                13 + i,
                r.a3,
                fixed(r.start_acceleration, 4)
            ),
        ));
    }
    html.push_str("</div>\n");
    html.push_str(&omitted());
    html.push_str(&turning(&amplitude));
    html
}

fn fish_table(rows: &[FishRow]) -> String {
    let body: Vec<Vec<Cell>> = rows
        .iter()
        .map(|r| {
            vec![
                number(r.a3, 1),
                Cell::Number(format!("{}π", r.gait.omega_pi)),
                Cell::Number(format!("{}°", r.phi_deg)),
                number(r.start_acceleration, 4),
                number(r.mean_speed, 4),
                number(100.0 * r.ripple, 1),
                number(r.t_up_to_speed, 2),
                number(r.swing_deg, 2),
                number(r.swing_omega / r.omega, 3),
                number(r.heading_deg, 1),
                r.t_turned
                    .map_or_else(|| Cell::Number("none".to_owned()), |t| number(t, 2)),
            ]
        })
        .collect();
    table(
        "<b>All gaits.</b> Starting acceleration ẍ1(0); mean of ẋ1 over 3-4 s and half its spread there; time to reach nine tenths of it; amplitude and \
         frequency of the swing of the body about its drift; mean of θ1 over the last period before 4 s; time at which the body first lies across its course (|θ1| = 90°).",
        &[
            &[
                ("fin", 3),
                ("", 1),
                ("speed ẋ1", 3),
                ("swing of the body", 2),
                ("course", 2),
            ],
            &[
                ("A3", 1),
                ("ω (rad/s)", 1),
                ("φ", 1),
                ("ẍ1(0) (m/s²)", 1),
                ("mean (m/s)", 1),
                ("ripple (± %)", 1),
                ("90 % at (s)", 1),
                ("ampl. (°)", 1),
                ("freq./fin's", 1),
                ("θ1 at 4 s (°)", 1),
                ("across at (s)", 1),
            ],
        ],
        &body,
    )
}

/// The figures that the paper mentions and does not print.
fn omitted() -> String {
    let mut html = String::from(
        "<h3>What the paper omits: sweeps of frequency and phase, and the swing</h3>\n<p>A3 = 0.6 rad, ω = 2π rad/s and φ = 15° unless varied.</p>\n<div class=\"figures\">\n",
    );
    let figures = [
        (
            "fish-frequency-speed",
            "Forward velocity for four frequencies",
            "Forward velocity for four frequencies: it grows with ω, the ripple becomes finer.",
        ),
        (
            "fish-phase-speed",
            "Forward velocity for four phases",
            "Forward velocity for four phases: it falls as the fin lags more.",
        ),
        (
            "fish-frequency-acceleration",
            "Acceleration for four frequencies",
            "Acceleration for four frequencies.",
        ),
        (
            "fish-phase-acceleration",
            "Acceleration for four phases",
            "Acceleration for four phases.",
        ),
        (
            "fish-amplitude-swing",
            "Swing angle for four amplitudes",
            "Swing angle θ1 for four amplitudes: an oscillation at the frequency of the fin about a course that drifts.",
        ),
        (
            "fish-frequency-swing",
            "Swing angle for four frequencies",
            "Swing angle for four frequencies: the faster the gait, the sooner the course is lost.",
        ),
        (
            "fish-phase-swing",
            "Swing angle for four phases",
            "Swing angle for four phases.",
        ),
        (
            "fish-amplitude-speed",
            "Forward velocity for four amplitudes",
            "The curves of Figs. 9-12 together.",
        ),
    ];
    for (name, text, caption) in figures {
        html.push_str(&figure(&format!("figures/{name}.svg"), text, caption));
    }
    html.push_str("</div>\n");
    html
}

fn turning(amplitude: &[&FishRow]) -> String {
    let heading = joined(
        amplitude
            .iter()
            .map(|r| format!("{}°", fixed(r.heading_deg, 1))),
    );
    let turned = amplitude.iter().filter(|r| r.t_turned.is_some()).count();
    let time = |r: &&FishRow| {
        r.t_turned
            .map_or_else(|| "never".to_owned(), |t| fixed(t, 1))
    };
    let times = joined(amplitude.iter().map(time));
    let end = joined(
        amplitude
            .iter()
            .map(|r| format!("{}°", fixed(r.end_deg, 0))),
    );
    let mut html = format!(
        "<h3>What the paper does not mention: the fish turns over</h3>\n\
         <p>With these numbers the body is directionally unstable. The mean of θ1 over the period before t = 4 s is {heading} for A3 = {}, and it keeps \
         growing: {turned} of {} bodies pass 90° within ten seconds (after {times} s), and end at {end}. The model ties the angles of peduncle and fin to \
         fixed axes and not to the body, so these two keep their course, and the body folds back over them and is dragged along. A real fish would have lost its \
         course; the paper's steady swimming is that of the first four or five seconds.</p>\n<div class=\"figures\">\n",
        joined(amplitude.iter().map(|r| r.a3.to_string())),
        amplitude.len()
    );
    for (name, text, caption) in [
        (
            "fish-turning",
            "Swing angle over ten seconds",
            "θ1 over ten seconds: the swing rides on a deviation that grows from about 4 s on, until the fish has turned over.",
        ),
        (
            "fish-turning-speed",
            "Forward velocity over ten seconds",
            "−ẋ1 over the same time: the settled ripple is lost as the body turns.",
        ),
    ] {
        html.push_str(
            &figure(&format!("figures/{name}.svg"), text, caption).replacen(
                "<figure>",
                "<figure class=\"wide\">",
                1,
            ),
        );
    }
    html.push_str("</div>\n");
    html
}
