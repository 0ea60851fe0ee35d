//! Measures contenders in turn, batch after batch, so that the noise of the machine hits all alike, and prints medians and ratios.
//!
//! The known frameworks measure one contender after the other and leave the ratios to the reader; on a machine whose clock and neighbours
//! change within seconds such ratios are worth little. Here each round measures every contender once, a ratio is formed within each
//! round, and the median is taken over the rounds.

use std::time::{Duration, Instant};

use serde_json::{Value, json};

/// Time spent on a group.
const GROUP: Duration = Duration::from_secs(5);
/// Time of a batch: far above the resolution of the clock, far below the time in which the machine changes.
const BATCH: Duration = Duration::from_micros(200);
/// Rounds at least, where one call takes longer than a batch.
const ROUNDS: usize = 15;

/// Something to measure.
pub(crate) struct Contender<'a> {
    /// What it is, in a few words.
    pub(crate) name: String,
    /// Written by hand: the fastest of these is the reference of its group.
    pub(crate) by_hand: bool,
    /// Evaluations in one call of `work`.
    pub(crate) evaluations: usize,
    /// The work.
    pub(crate) work: Box<dyn FnMut() + 'a>,
    /// Said behind the figures.
    pub(crate) remark: String,
}

/// Contenders at the same work.
pub(crate) struct Group<'a> {
    /// Name, with its path.
    pub(crate) name: &'static str,
    /// Said below the table.
    pub(crate) remarks: Vec<String>,
    /// The contenders.
    pub(crate) contenders: Vec<Contender<'a>>,
}

/// Figures of a contender.
struct Figures {
    /// Seconds per evaluation: median, and the value that a tenth of the batches stay below.
    median: f64,
    low: f64,
    /// Median over the rounds of the ratio to the reference.
    ratio: f64,
}

impl Group<'_> {
    /// Measures, prints a table, and gives the figures as JSON.
    pub(crate) fn run(mut self) -> Value {
        let calls: Vec<usize> = self.contenders.iter_mut().map(calibrate).collect();
        let mut times: Vec<Vec<f64>> = vec![Vec::new(); calls.len()];
        let start = Instant::now();
        while start.elapsed() < GROUP || times[0].len() < ROUNDS {
            for ((contender, calls), times) in
                self.contenders.iter_mut().zip(&calls).zip(&mut times)
            {
                let evaluations = (calls * contender.evaluations) as f64;
                times.push(batch(contender, *calls).as_secs_f64() / evaluations);
            }
        }
        let hands = (0..calls.len()).filter(|&k| self.contenders[k].by_hand);
        let reference = hands
            .min_by(|&a, &b| quantile(&times[a], 0.5).total_cmp(&quantile(&times[b], 0.5)))
            .unwrap_or(0);
        let figures: Vec<Figures> = times
            .iter()
            .map(|own| {
                let pairs = own.iter().zip(&times[reference]);
                Figures {
                    median: quantile(own, 0.5),
                    low: quantile(own, 0.1),
                    ratio: quantile(&pairs.map(|(t, r)| t / r).collect::<Vec<_>>(), 0.5),
                }
            })
            .collect();
        self.print(&figures, times[0].len());
        self.json(&figures)
    }

    fn print(&self, figures: &[Figures], rounds: usize) {
        println!("\n{} ({rounds} rounds)", self.name);
        println!(
            "  {:<44} {:>11} {:>11} {:>8}",
            "", "median", "10 %", "ratio"
        );
        for (contender, f) in self.contenders.iter().zip(figures) {
            let (name, remark) = (&contender.name, &contender.remark);
            let (median, low) = (time(f.median), time(f.low));
            println!(
                "  {name:<44} {median:>11} {low:>11} {:>8.2}  {remark}",
                f.ratio
            );
        }
        for remark in &self.remarks {
            println!("  {remark}");
        }
    }

    fn json(&self, figures: &[Figures]) -> Value {
        let rows: Vec<Value> = self
            .contenders
            .iter()
            .zip(figures)
            .map(|(c, f)| {
                json!({
                    "name": c.name, "by_hand": c.by_hand, "remark": c.remark,
                    "median_s": f.median, "low_s": f.low, "ratio": f.ratio,
                })
            })
            .collect();
        json!({ "group": self.name, "contenders": rows })
    }
}

/// Calls that fill a batch.
fn calibrate(contender: &mut Contender) -> usize {
    let mut calls = 1;
    loop {
        let took = batch(contender, calls);
        if took >= BATCH / 2 {
            return (calls as f64 * (BATCH.as_secs_f64() / took.as_secs_f64())).ceil() as usize;
        }
        calls *= 2;
    }
}

fn batch(contender: &mut Contender, calls: usize) -> Duration {
    let start = Instant::now();
    for _ in 0..calls {
        (contender.work)();
    }
    start.elapsed()
}

fn quantile(values: &[f64], part: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted[(part * (sorted.len() - 1) as f64).round() as usize]
}

fn time(seconds: f64) -> String {
    match seconds {
        s if s < 1e-6 => format!("{:.1} ns", s * 1e9),
        s if s < 1e-3 => format!("{:.2} µs", s * 1e6),
        s => format!("{:.2} ms", s * 1e3),
    }
}
