//! The page.

use crate::html::{Cell, escape, figure, fixed, joined, page, power_of_ten, signed, table};

use super::chain::ChainRow;
use super::claims::{self, Claim, Verdict};
use super::fish::{FishRow, WINDOW};
use super::motion::RunRow;
use super::{Paper, published};

/// index.html.
pub(super) fn html(paper: &Paper) -> String {
    let mut body = head(paper);
    body.push_str(&chain(paper));
    body.push_str(&fish(paper));
    body.push_str(&claims_section(&paper.claims));
    body.push_str(&accuracy(paper));
    page("Zhao, Zhen & Chen 2013, recomputed", &body)
}

fn number(value: f64, digits: usize) -> Cell {
    Cell::Number(fixed(value, digits))
}

fn count(value: usize) -> Cell {
    Cell::Number(value.to_string())
}

fn head(paper: &Paper) -> String {
    let worst = paper
        .uchain
        .iter()
        .map(|r| (r.h_max - r.paper.h_max).abs())
        .fold(0.0, f64::max);
    let hold = |v| paper.claims.iter().filter(|c| c.verdict == v).count();
    format!(
        "<h1>The falling U-chain and the fish robot, recomputed</h1>\n\
         <p class=\"lead\">After Zhao H., Zhen S., Chen Y.-H.: Dynamic Modeling and Simulation of Multi-body Systems Using the \
         Udwadia-Kalaba Theory. Chinese Journal of Mechanical Engineering 26 (2013) 839-850.</p>\n\
         <p>Both mechanisms are declared in a few lines of Rust; constraints are differentiated at compile time, and the equations of \
         Udwadia and Kalaba (regular mass matrix) or Udwadia and Phohomsiri (singular) are integrated with DOP853 at tolerance {}, with \
         projection onto the constraints after each step. Table 1 is met to {} m. Of {} claims of the paper {} hold, {} nearly, and {} \
         not (<a href=\"#claims\">each with its number</a>).</p>\n\
         <nav><a href=\"#chain\">U-chain</a><a href=\"#fish\">Fish robot</a><a href=\"#claims\">Claims</a>\
         <a href=\"#accuracy\">Accuracy and cost</a><a href=\"paper.json\">All numbers (JSON)</a></nav>\n",
        power_of_ten(paper.tolerance),
        fixed(worst, 4),
        paper.claims.len(),
        hold(Verdict::Holds),
        hold(Verdict::Nearly),
        hold(Verdict::Fails),
    )
}

fn chain(paper: &Paper) -> String {
    let rows = &paper.uchain;
    let mut html = String::from(
        "<h2 id=\"chain\">1. The falling U-chain</h2>\n\
         <p>Seventeen particles of 1 kg, joined by rigid massless links of 1 m, the last link fixed to a support at the origin. At t = 0 the tip, \
         x0 away from the support and level with it, is let go. y points down, g = 9.8 m/s². The paper does not say how the chain \
         hangs at the start; an isosceles trapezoid with legs at 60° reproduces its table, a catenary does not.</p>\n",
    );
    html.push_str("<div class=\"figures\">\n");
    html.push_str(&figure(
        "figures/chain-falling.svg",
        "Shapes of the chain from its start to the turn of the tip",
        &format!(
            "The chain with x0 = {} m, from the support (origin) to the tip. The fold runs down ahead of the tip, which follows faster and faster \
             along the dashed path until the straightened chain pulls it round (orange).",
            rows.first().map_or(0.0, |r| r.x0)
        ),
    ));
    html.push_str(&figure(
        "figures/chain-lead.svg",
        "Fall of the tip less the fall of a free body",
        "How far the tip is ahead of a body that falls freely, up to its turn. The closer the ends of the chain are at the start, the greater the lead. \
         It shrinks once the chain pulls the tip back, but is positive still where the curves end, at the turn.",
    ));
    html.push_str("</div>\n");
    html.push_str(&table_1(rows));
    html.push_str(
        "<h3>Acceleration of the tip (Figs. 2-6)</h3>\n<p>For m = 1 kg the vertical force on the tip and its acceleration ÿ1 have the \
         same number. It stays somewhat above g for most of the fall; then the tip is stopped within some hundredths of a second.</p>\n",
    );
    html.push_str("<div class=\"figures\">\n");
    for row in rows {
        let name = format!("figures/fig{}.svg", row.paper.figure);
        html.push_str(&figure(
            &name,
            &format!("Vertical acceleration of the tip for x0 = {} m", row.x0),
            &format!(
                "Fig. {}: ÿ1 for x0 = {} m. Deepest {} m/s² at {} s.",
                row.paper.figure,
                row.x0,
                fixed(row.peak, 1),
                fixed(row.t_peak, 3)
            ),
        ));
    }
    html.push_str(&figure(
        "figures/chain-accelerations.svg",
        "The same five curves near g",
        "The same five curves near g, each up to where it leaves the picture.",
    ));
    html.push_str("</div>\n");
    html.push_str(&tip_table(rows));
    html
}

fn table_1(rows: &[ChainRow]) -> String {
    let body: Vec<Vec<Cell>> = rows
        .iter()
        .map(|r| {
            let p = &r.paper;
            let compare = |printed: f64, ours: f64| {
                [
                    number(printed, 3),
                    number(ours, 6),
                    Cell::Number(signed(ours - printed, 4)),
                ]
            };
            let mut cells = vec![number(r.x0, 0)];
            cells.extend(compare(p.h_max, r.h_max));
            cells.extend(compare(p.t_max, r.t_max));
            cells.extend(compare(p.free_fall, r.free_fall));
            cells
        })
        .collect();
    let three = [("paper", 1), ("here", 1), ("diff.", 1)];
    let mut second = vec![("x0 (m)", 1)];
    second.extend(three.iter().cycle().take(9));
    table(
        "<b>Table 1.</b> Greatest fall h<sub>max</sub> of the tip, its time t<sub>max</sub>, and the fall ½ g t<sub>max</sub>² of a free body in that time. The paper prints \
         output points of its solver, so its last digit is uncertain by one; a free body falls some 17 mm in that last millisecond.",
        &[
            &[
                ("", 1),
                ("h_max (m)", 3),
                ("t_max (s)", 3),
                ("free fall (m)", 3),
            ],
            &second,
        ],
        &body,
    )
}

fn tip_table(rows: &[ChainRow]) -> String {
    let body: Vec<Vec<Cell>> = rows
        .iter()
        .map(|r| {
            vec![
                number(r.x0, 0),
                number(r.peak, 2),
                number(r.t_peak, 4),
                number(r.pull, 1),
                number(r.highest, 2),
                number(r.t_highest, 3),
                number(r.mean_above_g, 3),
                number(r.t_above_g, 3),
                number(100.0 * r.t_above_g / r.t_max, 0),
                number(r.lead, 3),
            ]
        })
        .collect();
    table(
        "<b>The tip.</b> The pull is that of the chain, in weights of one particle. ÿ1 is above g from the start until the time given; the mean excess is taken up to it.",
        &[
            &[
                ("", 1),
                ("deepest ÿ1", 3),
                ("ÿ1 above g = 9.8 m/s²", 5),
                ("", 1),
            ],
            &[
                ("x0 (m)", 1),
                ("(m/s²)", 1),
                ("at (s)", 1),
                ("pull (m g)", 1),
                ("greatest (m/s²)", 1),
                ("at (s)", 1),
                ("mean excess (m/s²)", 1),
                ("until (s)", 1),
                ("in % of t<sub>max</sub>", 1),
                ("lead at turn (m)", 1),
            ],
        ],
        &body,
    )
}

fn fish(paper: &Paper) -> String {
    let rows = &paper.fish;
    let amplitude = claims::sweep(rows, 0);
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

fn turning(amplitude: &[FishRow]) -> String {
    let heading = joined(
        amplitude
            .iter()
            .map(|r| format!("{}°", fixed(r.heading_deg, 1))),
    );
    let turned: Vec<&FishRow> = amplitude.iter().filter(|r| r.t_turned.is_some()).collect();
    let times = joined(
        turned
            .iter()
            .filter_map(|r| r.t_turned)
            .map(|t| fixed(t, 1)),
    );
    let across = if turned.is_empty() {
        "within ten seconds none of them lies across its course.".to_owned()
    } else {
        format!(
            "{} of {} lie across their course (|θ1| = 90°) within ten seconds, after {times} s; then nothing of the steady swimming is left.",
            turned.len(),
            amplitude.len()
        )
    };
    let mut html = format!(
        "<h3>What the paper does not mention: the fish turns over</h3>\n\
         <p>With these numbers the body is directionally unstable. For A3 = {} the mean of θ1 about t = 4 s is {heading}, and it grows: {across} \
         The paper's steady velocity is therefore that of the first four or five seconds.</p>\n<div class=\"figures\">\n",
        joined(amplitude.iter().map(|r| r.a3.to_string()))
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
            "−ẋ1 over the same time: steady until the fish turns.",
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

fn claims_section(claims: &[Claim]) -> String {
    let mut html = String::from(
        "<h2 id=\"claims\">3. The paper's claims</h2>\n<p>Verdicts are computed from the numbers. “Nearly” means that a stated bound is missed by less than a \
         tenth of it. Lists are in the order of x0 = 12 … 16, or of the sweep.</p>\n",
    );
    for (case, title) in [("uchain", "U-chain"), ("fish", "Fish robot")] {
        let rows: Vec<Vec<Cell>> = claims
            .iter()
            .filter(|c| c.case == case)
            .map(|c| {
                let class = match c.verdict {
                    Verdict::Holds => "verdict holds",
                    Verdict::Nearly => "verdict nearly",
                    Verdict::Fails => "verdict fails",
                };
                vec![
                    Cell::Text(format!(
                        "{} <small>(§{})</small>",
                        escape(c.claim),
                        escape(c.section)
                    )),
                    Cell::Text(unbroken(&escape(&c.found))),
                    Cell::Class(class, c.verdict.word().to_owned()),
                ]
            })
            .collect();
        let html_table = table(
            &format!("<b>{title}</b>"),
            &[&[("claim", 1), ("found here", 1), ("verdict", 1)]],
            &rows,
        );
        html.push_str(&html_table.replacen("<table>", "<table class=\"claims\">", 1));
    }
    html
}

/// Keeps units on the line of their number.
fn unbroken(text: &str) -> String {
    [" %", " m", " s"]
        .iter()
        .fold(text.to_owned(), |text, unit| {
            text.replace(unit, &unit.replace(' ', "&nbsp;"))
        })
}

fn accuracy(paper: &Paper) -> String {
    let rows: Vec<Vec<Cell>> = paper.runs.iter().map(run_row).collect();
    let mut html = String::from("<h2 id=\"accuracy\">4. Accuracy and cost</h2>\n");
    html.push_str(&table(
        &format!(
            "All runs at tolerance {}. Residuals are the largest at samples every 10 ms: |φ| of the constraints as declared, |φ̇| of their rates. The energy drift is \
             a part of the energy exchanged (the fish is driven and damped, so it has none). Fallbacks are evaluations that left the fast formula.",
            power_of_ten(paper.tolerance)
        ),
        &[&[
            ("run", 1),
            ("to (s)", 1),
            ("|φ|", 1),
            ("|φ̇|", 1),
            ("energy drift", 1),
            ("steps", 1),
            ("rejected", 1),
            ("evaluations", 1),
            ("projections", 1),
            ("fallbacks", 1),
            ("time (s)", 1),
        ]],
        &rows,
    ));
    html.push_str(&format!(
        "<p>Computing and drawing took {} s in all. Samples of every run are in <a href=\"csv/\">csv/</a>, named as here.</p>\n",
        fixed(paper.seconds, 1)
    ));
    html
}

fn run_row(r: &RunRow) -> Vec<Cell> {
    let power = |value: f64| Cell::Number(power_of_ten(value));
    vec![
        Cell::Text(escape(&r.name)),
        number(r.until, 0),
        power(r.drift.position_residual),
        power(r.drift.velocity_residual),
        r.drift
            .energy_drift
            .map_or_else(|| Cell::Number("–".to_owned()), power),
        count(r.steps),
        count(r.rejected),
        count(r.evaluations),
        count(r.projections),
        count(r.fallbacks),
        number(r.seconds, 2),
    ]
}
