//! The section on the fish robot.

use maud::{Markup, html};
use uktool::html::{Cell, embedded, figure, figure_of, fixed, joined, table};

use super::super::fish::{FILM, FishRow, WINDOW, sweep};
use super::super::{Paper, published};

pub(super) fn section(paper: &Paper<'_>) -> Markup {
    let amplitude = sweep(&paper.fish, 0, |r| r);
    let (from, to) = WINDOW;
    html! {
        p {
            "Body, peduncle and fin, with drag on each and lift on the fin; peduncle and fin are driven as θ2 = A2 sin ωt and θ3 = A3 \
             sin(ωt − φ) with A2 = "
            (published::A2) ". The driven angles carry no inertia, so the mass matrix is singular."
        }
        p.note {
            b { "Signs." } " The tail is at +x, so the fish swims towards −x. The tables (and paper.json) give ẍ1 and ẋ1 as they are: \
             negative numbers swim forward. The figures of velocity show −ẋ1, as the paper's do, so up is forward; those of acceleration \
             show ẍ1, so the start points down."
        }
        div.figures {
            (embedded(
                FILM,
                "The swimming fish, to play",
                "The fish with the least and the greatest amplitude of its fin: press Play. The brown line is the path of the fin's edge."
            ))
        }
        (fish_table(&paper.fish))
        h3 { "Forward velocity (Figs. 9-12)" }
        div.figures {
            @for (n, r) in (9..).zip(&amplitude) {
                (figure(
                    &format!("figures/fig{n}.svg"),
                    &format!("Forward velocity for A3 = {}", r.a3),
                    format!("Fig. {n}: −ẋ1 for A3 = {}. Mean over {from}-{to} s: {} m/s.", r.a3, fixed(-r.mean_speed, 4))
                ))
            }
        }
        h3 { "Acceleration (Figs. 13-16)" }
        div.figures {
            @for (n, r) in (13..).zip(&amplitude) {
                (figure(
                    &format!("figures/fig{n}.svg"),
                    &format!("Acceleration for A3 = {}", r.a3),
                    format!("Fig. {n}: ẍ1 for A3 = {}. It starts at {} m/s².", r.a3, fixed(r.start_acceleration, 4))
                ))
            }
        }
        h3 { "What the paper omits: sweeps of frequency and phase, and the swing" }
        p { "A3 = 0.6 rad, ω = 2π rad/s and φ = 15° unless varied." }
        div.figures {
            @for (name, text, caption) in OMITTED { (figure(&format!("figures/fish-{name}.svg"), text, caption)) }
        }
        (turning(&amplitude))
    }
}

fn fish_table(rows: &[FishRow]) -> Markup {
    let row = |r: &FishRow| {
        vec![
            Cell::fixed(r.a3, 1),
            Cell::number(format!("{}π", r.gait.omega_pi)),
            Cell::number(format!("{}°", r.phi_deg)),
            Cell::fixed(r.start_acceleration, 4),
            Cell::fixed(r.mean_speed, 4),
            Cell::fixed(100.0 * r.ripple, 1),
            Cell::fixed(r.t_up_to_speed, 2),
            Cell::fixed(r.swing_deg, 2),
            Cell::fixed(r.swing_omega / r.omega, 3),
            Cell::fixed(r.heading_deg, 1),
            r.t_turned
                .map_or_else(|| Cell::number("none"), |t| Cell::fixed(t, 2)),
        ]
    };
    let caption = html! {
        b { "All gaits." } " Starting acceleration ẍ1(0); mean of ẋ1 over 3-4 s and half its spread there; time to reach nine tenths of \
         it; amplitude and frequency of the swing of the body about its drift; mean of θ1 over the last period before 4 s; time at which \
         the body first lies across its course (|θ1| = 90°)."
    };
    let heads = "fin: A3; ω (rad/s); φ | ẍ1(0) (m/s²) | speed ẋ1: mean (m/s); ripple (± %); 90 % at (s) | swing of the body: ampl. (°); \
         freq./fin's | course: θ1 at 4 s (°); across at (s)";
    table(caption, heads, rows.iter().map(row))
}

/// The figures that the paper mentions and does not print: file, description, caption.
const OMITTED: [(&str, &str, &str); 8] = [
    (
        "frequency-speed",
        "Forward velocity for four frequencies",
        "Forward velocity for four frequencies: it grows with ω, the ripple becomes finer.",
    ),
    (
        "phase-speed",
        "Forward velocity for four phases",
        "Forward velocity for four phases: it falls as the fin lags more.",
    ),
    (
        "frequency-acceleration",
        "Acceleration for four frequencies",
        "Acceleration for four frequencies.",
    ),
    (
        "phase-acceleration",
        "Acceleration for four phases",
        "Acceleration for four phases.",
    ),
    (
        "amplitude-swing",
        "Swing angle for four amplitudes",
        "Swing angle θ1 for four amplitudes: an oscillation at the frequency of the fin about a course that drifts.",
    ),
    (
        "frequency-swing",
        "Swing angle for four frequencies",
        "Swing angle for four frequencies: the faster the gait, the sooner the course is lost.",
    ),
    (
        "phase-swing",
        "Swing angle for four phases",
        "Swing angle for four phases.",
    ),
    (
        "amplitude-speed",
        "Forward velocity for four amplitudes",
        "The curves of Figs. 9-12 together.",
    ),
];

fn turning(amplitude: &[&FishRow]) -> Markup {
    let each = |text: fn(&FishRow) -> String| joined(amplitude.iter().map(|r| text(r)));
    let turned = amplitude.iter().filter(|r| r.t_turned.is_some()).count();
    html! {
        h3 { "What the paper does not mention: the fish turns over" }
        p {
            "With these numbers the body is directionally unstable. The mean of θ1 over the period before t = 4 s is "
            (each(|r| format!("{}°", fixed(r.heading_deg, 1)))) " for A3 = " (each(|r| r.a3.to_string())) ", and it keeps growing: "
             (turned) " of "
            (amplitude.len()) " bodies pass 90° within ten seconds (after "
            (each(|r| r.t_turned.map_or_else(|| "never".to_owned(), |t| fixed(t, 1)))) " s), and end at " (each(|r| format!("{}°",
             fixed(r.end_deg, 0))))
            ". The model ties the angles of peduncle and fin to fixed axes and not to the body, so these two keep their course, and the \
             body folds back over them and is dragged along. A real fish would have lost its course; the paper's steady swimming is that \
             of the first four or five seconds."
        }
        div.figures {
            (figure_of(
                "wide",
                "figures/fish-turning.svg",
                "Swing angle over ten seconds",
                "θ1 over ten seconds: the swing rides on a deviation that grows from about 4 s on, until the fish has turned over."
            ))
            (figure_of(
                "wide",
                "figures/fish-turning-speed.svg",
                "Forward velocity over ten seconds",
                "−ẋ1 over the same time: the settled ripple is lost as the body turns."
            ))
        }
    }
}
