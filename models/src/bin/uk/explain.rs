//! `uk explain`: what the compiler derived and decided, what the solver says at the start, and the emitted code.

use std::io::{self, Write};

use models::{Model, Visitor};
use ukcore::{ConstraintKind, ParamSpec, Solution, Solver, SolverOptions, Spec};

use crate::args::ExplainArgs;
use crate::failure::Failure;
use crate::numbers::{fixed, short, width};
use crate::output;
use crate::scene::{self, Ready};

/// Decimals of values.
const DIGITS: usize = 8;

/// Prints all that is known about a model.
///
/// # Errors
/// [`Failure::Usage`] for what is wrong with the command line, [`Failure::Failed`] if the equations cannot be solved at the start.
pub(crate) fn explain(args: &ExplainArgs) -> Result<(), Failure> {
    match &args.code {
        None => models::visit(&args.scene.model, Explain { args })?,
        Some(function) => models::visit(&args.scene.model, Code { function })?,
    }
}

/// Prints emitted functions.
struct Code<'a> {
    /// Its name; all if empty.
    function: &'a str,
}

impl Visitor for Code<'_> {
    type Output = Result<(), Failure>;

    fn visit<M: Model>(self) -> Self::Output {
        let wanted = |name: &str| self.function.is_empty() || name == self.function;
        let texts: Vec<String> = M::CODE
            .iter()
            .filter_map(|(name, text)| wanted(name).then(|| ukcore::code::laid_out(text)))
            .collect();
        if texts.is_empty() {
            let names: Vec<&str> = M::CODE.iter().map(|(name, _)| *name).collect();
            return Err(Failure::Usage(format!(
                "`{}` has no function `{}`; it has {}",
                M::ID,
                self.function,
                names.join(", ")
            )));
        }
        output::to_stdout(|out| write!(out, "{}", texts.join("\n")))
    }
}

struct Explain<'a> {
    args: &'a ExplainArgs,
}

impl Visitor for Explain<'_> {
    type Output = Result<(), Failure>;

    fn visit<M: Model>(self) -> Self::Output {
        let ready = scene::ready::<M>(&self.args.scene)?;
        let state = &ready.state;
        let solution = Solver::new::<M>(SolverOptions::default()).solve(
            &ready.mechanism.prepared(),
            state.t,
            &state.q,
            &state.v,
        );
        output::to_stdout(|out| {
            writeln!(out, "{}: {}", M::ID, M::summary())?;
            let spec = M::SPEC;
            if !spec.doc.trim().is_empty() {
                writeln!(out, "\n{}", spec.doc.trim())?;
            }
            coordinates(out, &ready)?;
            parameters(out, &ready)?;
            unconstrained(out, spec)?;
            constraints(out, spec)?;
            if !spec.outputs.is_empty() {
                heading(out, "Outputs")?;
                let wide = width(spec.outputs.iter().map(|o| o.name));
                for o in spec.outputs {
                    writeln!(out, "  {:<wide$}  {}", o.name, o.doc.trim())?;
                }
            }
            structure(out, spec)?;
            write!(out, "\n{}", M::plan())?;
            if let Ok(solution) = &solution {
                at_start(out, &ready, solution)?;
            }
            Ok(())
        })?;
        solution.map(|_| ()).map_err(Failure::from)
    }
}

fn heading(out: &mut dyn Write, text: &str) -> io::Result<()> {
    writeln!(out, "\n{text}")
}

fn coordinates<M: Model>(out: &mut dyn Write, ready: &Ready<M>) -> io::Result<()> {
    let spec = M::SPEC;
    heading(
        out,
        &format!(
            "Coordinates q ({}), with their value and rate at the start `{}`",
            spec.n(),
            ready.start
        ),
    )?;
    let wide = width(spec.coords.iter().copied());
    for (i, name) in spec.coords.iter().enumerate() {
        let massless = if spec.structure.massless.contains(&i) {
            "  (no mass)"
        } else {
            ""
        };
        writeln!(
            out,
            "  {name:<wide$} {:>14} {:>14}{massless}",
            fixed(ready.state.q[i], DIGITS),
            fixed(ready.state.v[i], DIGITS)
        )?;
    }
    Ok(())
}

fn parameters<M: Model>(out: &mut dyn Write, ready: &Ready<M>) -> io::Result<()> {
    if M::SPEC.params.is_empty() {
        return Ok(());
    }
    heading(out, "Parameters")?;
    let setting = |(i, p): (usize, &ParamSpec)| {
        let value = ready.mechanism.parameter(i);
        let changed = if value == p.default {
            String::new()
        } else {
            format!(" (default {})", short(p.default, DIGITS))
        };
        format!("{} = {}{changed}", p.name, short(value, DIGITS))
    };
    let settings: Vec<String> = M::SPEC.params.iter().enumerate().map(setting).collect();
    let wide = width(settings.iter().map(String::as_str));
    for (setting, p) in settings.iter().zip(M::SPEC.params) {
        writeln!(out, "  {setting:<wide$}  {}", p.doc.trim())?;
    }
    Ok(())
}

fn unconstrained(out: &mut dyn Write, spec: &Spec) -> io::Result<()> {
    let e = &spec.equations;
    heading(
        out,
        "M q̈ = Q without constraints (eq. 1); entries that are not listed are zero",
    )?;
    for (row, column, text) in e.mass {
        writeln!(
            out,
            "  M[{}, {}] = {text}",
            spec.coords[*row], spec.coords[*column]
        )?;
    }
    for (row, text) in e.force {
        writeln!(out, "  Q[{}] = {text}", spec.coords[*row])?;
    }
    if !e.nonideal.is_empty() {
        heading(out, "Non-ideal constraint force c (eq. 8)")?;
        for (row, text) in e.nonideal {
            writeln!(out, "  c[{}] = {text}", spec.coords[*row])?;
        }
    }
    Ok(())
}

fn constraints(out: &mut dyn Write, spec: &Spec) -> io::Result<()> {
    if spec.constraints.is_empty() {
        return heading(out, "No constraints");
    }
    heading(
        out,
        &format!(
            "Constraints ({} holonomic, {} nonholonomic) and A q̈ = b (eq. 5)",
            spec.holonomic,
            spec.m() - spec.holonomic
        ),
    )?;
    for (row, constraint) in spec.constraints.iter().enumerate() {
        let kind = match constraint.kind {
            ConstraintKind::Holonomic => "",
            ConstraintKind::Nonholonomic => "  (nonholonomic)",
        };
        writeln!(out, "  {}: {}{kind}", constraint.name, constraint.equation)?;
        for (_, column, text) in spec.equations.jacobian.iter().filter(|(r, ..)| *r == row) {
            writeln!(out, "      A[{}] = {text}", spec.coords[*column])?;
        }
        let b = spec.equations.rhs.iter().find(|(r, _)| *r == row);
        writeln!(out, "      b = {}", b.map_or("0", |(_, text)| text))?;
    }
    Ok(())
}

fn structure(out: &mut dyn Write, spec: &Spec) -> io::Result<()> {
    let s = &spec.structure;
    let (n, m) = (spec.n(), spec.m());
    let constant = |yes| if yes { "constant" } else { "varies" };
    let yes_no = |yes| if yes { "yes" } else { "no" };
    heading(out, "Structure")?;
    writeln!(
        out,
        "  M  {n} × {n}, {} of {} entries, {}{}",
        s.mass_pattern.len(),
        n * n,
        if s.mass_diagonal { "diagonal, " } else { "" },
        constant(s.mass_constant)
    )?;
    writeln!(
        out,
        "  A  {m} × {n}, {} of {} entries, {}",
        s.jacobian_pattern.len(),
        m * n,
        constant(s.jacobian_constant)
    )?;
    writeln!(out, "  explicit time: {}", yes_no(!s.scleronomic))?;
    writeln!(out, "  energy conserved: {}", yes_no(s.conservative))?;
    if !s.massless.is_empty() {
        let names: Vec<&str> = s.massless.iter().map(|&i| spec.coords[i]).collect();
        writeln!(out, "  without mass: {}", names.join(", "))?;
    }
    Ok(())
}

fn at_start<M: Model>(
    out: &mut dyn Write,
    ready: &Ready<M>,
    solution: &Solution,
) -> io::Result<()> {
    let spec = M::SPEC;
    heading(
        out,
        &format!("At the start `{}`, t = {} s", ready.start, ready.state.t),
    )?;
    writeln!(out, "  rank of A: {} of {}", solution.rank, spec.m())?;
    writeln!(out, "  degrees of freedom: {}", solution.degrees_of_freedom)?;
    let redundant: Vec<&str> = solution
        .redundant
        .iter()
        .map(|&i| spec.constraints[i].name)
        .collect();
    let redundant = if redundant.is_empty() {
        "none".to_owned()
    } else {
        redundant.join(", ")
    };
    writeln!(out, "  redundant constraints: {redundant}")?;
    writeln!(out, "  formula: {}", formula_name(solution.formula))?;
    writeln!(out, "  accelerations:")?;
    let wide = width(spec.coords.iter().copied());
    for (name, value) in spec.coords.iter().zip(&solution.acceleration) {
        writeln!(out, "    {name:<wide$} {:>14}", fixed(*value, DIGITS))?;
    }
    Ok(())
}

fn formula_name(formula: ukcore::Formula) -> &'static str {
    match formula {
        ukcore::Formula::Auto => "chosen by the rank of M",
        ukcore::Formula::UdwadiaKalaba => "Udwadia-Kalaba (eq. 13; M is regular)",
        ukcore::Formula::UdwadiaPhohomsiri => "Udwadia-Phohomsiri (eq. 19; M is singular)",
        ukcore::Formula::Kkt => "saddle-point system",
    }
}
