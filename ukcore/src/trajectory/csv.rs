//! Samples as comma-separated values.

use std::io::{self, Write};

use super::{Residual, Sample};
use crate::mechanism::Prepared;

/// Writes samples as comma-separated values: first a line of names, then a row for each sample.
///
/// The columns are `t`, the coordinates (`x[0]`), their rates (`dot(x[0])`), the outputs, the integrals (empty for a state that belongs to
/// no run), `energy` (T + V) and `residual` ([`Residual::largest`](super::Residual::largest)). Numbers have the fewest digits that read
/// back as the same number.
///
/// ```
/// # use std::ops::ControlFlow;
/// # use ukcore::simulate::{CsvWriter, Record};
/// # use ukcore::{Simulation, State};
/// # ukcore::multibody! {
/// #     /// A mass on a spring.
/// #     pub Oscillator { params { m = 1.0, k = 4.0 } coords { x } mass { x: m } potential { k * sq(x) / 2 } }
/// # }
/// # let start = State { t: 0.0, q: vec![1.0], v: vec![0.0] };
/// let oscillator = Oscillator::default();
/// let mut csv = CsvWriter::new(&oscillator, Vec::new())?;
/// let mut written = Ok(());
/// Simulation::new(&oscillator).start(start).every(0.1).stream(1.0, |record| {
///     if let Record::Sample(sample) = record {
///         written = csv.write(sample);
///     }
///     if written.is_ok() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
/// })?;
/// written?;
/// assert_eq!(String::from_utf8(csv.into_inner())?.lines().count(), 12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct CsvWriter<W> {
    mechanism: Prepared,
    outputs: Vec<f64>,
    out: W,
}

impl<W: Write> CsvWriter<W> {
    /// Writes the line of names of `mechanism` to `out`, which should be buffered: it is written to number by number.
    ///
    /// # Errors
    /// What writing to `out` reports.
    pub fn new(mechanism: impl Into<Prepared>, mut out: W) -> io::Result<Self> {
        let mechanism = mechanism.into();
        let spec = mechanism.spec();
        write!(out, "t")?;
        for name in spec.coords {
            write!(out, ",{name}")?;
        }
        for name in spec.coords {
            write!(out, ",dot({name})")?;
        }
        for output in spec.outputs.iter().chain(mechanism.integrals()) {
            write!(out, ",{}", output.name)?;
        }
        writeln!(out, ",energy,residual")?;
        Ok(CsvWriter {
            outputs: vec![0.0; spec.outputs.len()],
            mechanism,
            out,
        })
    }

    /// Writes the row of `sample`. The writer is not flushed.
    ///
    /// # Errors
    /// What writing reports.
    ///
    /// # Panics
    /// If the sample has not as many coordinates as the mechanism.
    pub fn write(&mut self, sample: Sample<'_>) -> io::Result<()> {
        let Sample { t, q, v, integrals } = sample;
        let mechanism = &self.mechanism;
        // Of a state that belongs to no run.
        let missing = mechanism.integrals().len().saturating_sub(integrals.len());
        mechanism.outputs(t, q, v, &mut self.outputs);
        let energy = mechanism.energy(t, q, v).total();
        let residual = Residual::of(mechanism, sample).largest();
        let out = &mut self.out;
        write!(out, "{t:?}")?;
        for value in q.iter().chain(v).chain(&self.outputs).chain(integrals) {
            write!(out, ",{value:?}")?;
        }
        write!(out, "{}", ",".repeat(missing))?;
        writeln!(out, ",{energy:?},{residual:?}")
    }

    /// The writer that was given.
    pub fn into_inner(self) -> W {
        self.out
    }
}
