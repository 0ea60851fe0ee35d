//! What the compiler decided about a mechanism, for people to read: `Mechanism::plan`.

use std::collections::BTreeSet;
use std::fmt::{self, Display, Formatter, Write};

use crate::spec::{Check, Operations, Pivot, Spec};

mod code;

pub use code::laid_out;

/// Columns that are wide enough for text.
const WIDTH: usize = 110;
/// Largest picture of a matrix, in characters each way; larger ones are folded.
const PICTURE: usize = 60;

/// The decisions of the compiler with their reasons: what is eliminated in which order, hoisted and left out, what the certificate
/// compares, what it all costs, and where the equations are sparse. `Display` writes all of it.
#[derive(Debug, Clone, Copy)]
pub struct Plan {
    spec: &'static Spec,
}

/// A sparse matrix to be drawn: one character an entry.
///
/// `#` is declared, `+` filled in by the elimination, `·` zero; `\` is the diagonal of a square matrix, where elimination divides.
#[derive(Debug, Clone)]
pub struct Picture {
    rows: Vec<&'static str>,
    columns: Vec<&'static str>,
    square: bool,
    /// Row by row.
    entries: Vec<char>,
}

impl Plan {
    pub(crate) fn new(spec: &'static Spec) -> Self {
        Plan { spec }
    }

    /// The operations of one acceleration if its equations were evaluated and then solved by a dense LDLᵀ: what the straight line saves.
    #[must_use]
    pub fn dense(&self) -> Operations {
        let costs = &self.spec.structure.costs;
        costs.dynamics.then(costs.dense)
    }

    /// M, n × n, coordinates in the order of the elimination (as declared where there is none).
    #[must_use]
    pub fn mass(&self) -> Picture {
        let order = self.coordinates();
        let entries = self.spec.structure.mass_pattern;
        self.picture(&order, &order, entries, &[])
    }

    /// A, m × n, coordinates and constraints in the order of the elimination (as declared where there is none).
    #[must_use]
    pub fn jacobian(&self) -> Picture {
        let n = self.spec.n();
        let entries = self.spec.structure.jacobian_pattern.iter();
        let entries: Vec<_> = entries.map(|(row, column)| (n + row, *column)).collect();
        self.picture(&self.constraints(), &self.coordinates(), &entries, &[])
    }

    /// K = [M Aᵀ; A 0], (n + m) × (n + m), in the order of the elimination, with what that fills in.
    #[must_use]
    pub fn system(&self) -> Picture {
        let (n, s) = (self.spec.n(), &self.spec.structure);
        let mut entries = s.mass_pattern.to_vec();
        for (row, column) in s.jacobian_pattern {
            entries.extend([(n + row, *column), (*column, n + row)]);
        }
        let order = self.order();
        self.picture(&order, &order, &entries, s.solve.fill)
    }

    /// Positions in K in the order of the elimination; as declared where there is none.
    fn order(&self) -> Vec<usize> {
        let n = self.spec.n();
        let pivots = self.spec.structure.solve.pivots;
        if pivots.is_empty() {
            return (0..n + self.spec.m()).collect();
        }
        let positions = pivots.iter().flat_map(|pivot| match *pivot {
            Pivot::Prescribed(i, row) | Pivot::Massless(i, row) | Pivot::Substituted(i, row) => {
                vec![i, n + row]
            }
            // The other stays, as what is left free of both.
            Pivot::Turned(_, j, row) => vec![j, n + row],
            Pivot::Coordinate(i) => vec![i],
            Pivot::Constraint(row) => vec![n + row],
        });
        positions.collect()
    }

    fn coordinates(&self) -> Vec<usize> {
        let mut order = self.order();
        order.retain(|k| *k < self.spec.n());
        order
    }

    fn constraints(&self) -> Vec<usize> {
        let mut order = self.order();
        order.retain(|k| *k >= self.spec.n());
        order
    }

    fn picture(
        &self,
        rows: &[usize],
        columns: &[usize],
        entries: &[(usize, usize)],
        fill: &[(usize, usize)],
    ) -> Picture {
        let square = rows == columns;
        let size = self.spec.n() + self.spec.m();
        let places = |order: &[usize]| {
            let mut places = vec![None; size];
            for (at, k) in order.iter().enumerate() {
                places[*k] = Some(at);
            }
            places
        };
        let (down, across) = (places(rows), places(columns));
        let mut drawn = vec!['·'; rows.len() * columns.len()];
        let mut set = |row: usize, column: usize, c: char| {
            if let (Some(i), Some(j)) = (down[row], across[column]) {
                drawn[i * columns.len() + j] = c;
            }
        };
        for (row, column) in entries {
            set(*row, *column, '#');
        }
        for (row, column) in fill {
            set(*row, *column, '+');
            set(*column, *row, '+');
        }
        if square {
            rows.iter().for_each(|k| set(*k, *k, '\\'));
        }
        let names = |order: &[usize]| order.iter().map(|k| self.spec.name_at(*k)).collect();
        Picture {
            rows: names(rows),
            columns: names(columns),
            square,
            entries: drawn,
        }
    }

    fn solve(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let spec = self.spec;
        let solve = &spec.structure.solve;
        let size = spec.n() + spec.m();
        writeln!(f, "How q̈ is computed")?;
        if !spec.structure.straight_line {
            let text = format!(
                "by the dense, rank-revealing solve at each evaluation; there is no straight line, since {}",
                solve.refusal
            );
            return paragraph(f, &text);
        }
        let system = match spec.m() {
            0 => "M q̈ = Q",
            _ => "K = [M Aᵀ; A 0]",
        };
        let text = format!(
            "by straight-line code: {system}, {size} × {size}, was eliminated symbolically when the crate was compiled, \
             which fills in {} of its entries. In this order:",
            2 * solve.fill.len()
        );
        paragraph(f, &text)?;
        let rows = |rows: &[usize]| -> Vec<&str> {
            let rows = rows.iter();
            rows.map(|row| spec.constraints[*row].name).collect()
        };
        if !solve.regular.is_empty() {
            let text = format!(
                "M alone is singular, at any state or at some: for the row a of A of each of {}, μ aᵀa was added to M and μ aᵀb to Q, \
                 with μ the trace of M over |a|². It leaves q̈ as it is.",
                rows(solve.regular).join(" ")
            );
            paragraph(f, &text)?;
        }
        if !solve.velocities.is_empty() {
            let text = format!(
                "M is not expanded: the kinetic energy is written in the {} velocities {}, which are unknowns too, each eliminated with \
                 its definition, the last first. Between them:",
                solve.velocities.len(),
                shortened(solve.velocities)
            );
            paragraph(f, &text)?;
        }
        if !solve.turned.is_empty() {
            let text = format!(
                "The coordinates of {} stand for rates of these velocities: a of the constraint and c of the velocities y = c·q̇ are at \
                 right angles, so that their q̈ are Σ c ẏ/|c|² + a b/|a|².",
                shortened(&rows(solve.turned))
            );
            paragraph(f, &text)?;
        }
        if !solve.solved.is_empty() {
            let text = format!(
                "{} are solved for such rates of one body each beforehand, which then stand alone in them.",
                shortened(&rows(solve.solved))
            );
            paragraph(f, &text)?;
        }
        let mut hubs = solve.copies;
        while let Some(hub) = hubs.first() {
            let of = hubs.iter().take_while(|i| *i == hub).count();
            hubs = &hubs[of..];
            let text = format!(
                "{} is written {} times, once for each of the parts that share it, tied one to the next.",
                spec.coords[*hub],
                of + 1
            );
            paragraph(f, &text)?;
        }
        self.pivots(f)
    }

    /// What is eliminated, those that are alike in one line.
    fn pivots(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let coord = |i: usize| self.spec.coords[i];
        let row = |i: usize| self.spec.constraints[i].name;
        let mut rest = self.spec.structure.solve.pivots;
        while let Some(first) = rest.first() {
            let alike = |p: &Pivot| std::mem::discriminant(p) == std::mem::discriminant(first);
            let count = rest.iter().position(|p| !alike(p)).unwrap_or(rest.len());
            let (run, others) = rest.split_at(count);
            rest = others;
            let names = run.iter().map(|p| match *p {
                Pivot::Constraint(c) => row(c).to_owned(),
                Pivot::Coordinate(i) => coord(i).to_owned(),
                Pivot::Prescribed(i, c) | Pivot::Massless(i, c) | Pivot::Substituted(i, c) => {
                    format!("{} with {}", coord(i), row(c))
                }
                Pivot::Turned(i, j, c) => format!("{} {} by {}", coord(i), coord(j), row(c)),
            });
            let kind = match first {
                Pivot::Prescribed(..) => "prescribed by one constraint alone",
                Pivot::Massless(..) => "without mass, given by a constraint",
                Pivot::Substituted(..) => {
                    "given by other coordinates, their factor in the constraint being the same at any state"
                }
                Pivot::Turned(..) => {
                    "two coordinates that are alone in a constraint, turned into the direction that it prescribes and the one that it \
                     leaves free, which stands for both under the name of the first"
                }
                Pivot::Coordinate(_) => "coordinates with inertia",
                Pivot::Constraint(_) => "constraints whose coordinates are gone",
            };
            let separator = match first {
                Pivot::Coordinate(_) | Pivot::Constraint(_) => " ",
                _ => ", ",
            };
            let names: Vec<String> = names.collect();
            item(f, &format!("{kind}: {}", names.join(separator)))?;
        }
        Ok(())
    }

    fn certificate(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let solve = &self.spec.structure.solve;
        if !self.spec.structure.straight_line {
            return Ok(());
        }
        writeln!(f, "\nCertificate")?;
        if solve.checks.is_empty() && solve.met.is_empty() && solve.redundant.is_empty() {
            return item(f, "nothing is checked: no pivot can vanish");
        }
        let [positive, shares] = [true, false].map(|positive| {
            let wanted = |check: &Check| match *check {
                Check::Positive(k) => positive.then_some(k),
                Check::Share(k) => (!positive).then_some(k),
            };
            let names = solve.checks.iter().filter_map(wanted);
            let mut known = BTreeSet::new();
            let names = names
                .map(|k| self.spec.name_at(k))
                .filter(|name| known.insert(*name));
            names.collect::<Vec<_>>().join(" ")
        });
        if !positive.is_empty() {
            item(f, &format!("positive: the inertia or pivots of {positive}"))?;
        }
        if !shares.is_empty() {
            let text = format!(
                "at least 1/{} of the diagonal they started from: the pivots of {shares}",
                1.0 / solve.least_share
            );
            item(f, &text)?;
        }
        if !solve.met.is_empty() {
            let text = format!(
                "met by q̈ to rounding, since they act on inertia that may vanish: the rows of {}",
                self.spec.constraint_names(solve.met).join(" ")
            );
            item(f, &text)?;
        }
        if !solve.redundant.is_empty() {
            let text = format!(
                "`{}` follow from each other, or from all, where the constraints are met: as many as do at a state are dropped there, \
                 those of whose pivot and right-hand side nothing is left but rounding, or drift off the constraints",
                self.spec.constraint_names(solve.redundant).join("` `")
            );
            item(f, &text)?;
        }
        item(
            f,
            "where one of these does not hold, the rank-revealing solve takes over",
        )
    }

    fn hoisted(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let prepared = self.spec.prepared;
        if prepared.is_empty() {
            return Ok(());
        }
        writeln!(f, "\nHoisted: computed once for a set of parameters")?;
        let parameter = |text: &str| self.spec.params.iter().any(|p| p.name == text);
        let (plain, computed): (Vec<_>, Vec<_>) =
            prepared.iter().partition(|(_, text)| parameter(text));
        if !plain.is_empty() {
            let names: Vec<&str> = plain.iter().map(|(_, text)| *text).collect();
            item(f, &format!("parameters as they are: {}", names.join(" ")))?;
        }
        let wide = widest(computed.iter().map(|(name, _)| *name));
        for (name, text) in computed {
            item(f, &format!("{name:<wide$} = {text}"))?;
        }
        Ok(())
    }

    fn switches(&self, f: &mut Formatter<'_>) -> fmt::Result {
        for (length, head) in [
            (false, "Switches: a run steps onto the zeros of"),
            (
                true,
                "Lengths: a run steps across zeros of these, and ends where it comes to rest at one",
            ),
        ] {
            let switches = || self.spec.switches.iter().filter(|s| s.length == length);
            if switches().next().is_some() {
                writeln!(f, "\n{head}")?;
            }
            let wide = widest(switches().map(|switch| switch.function));
            for switch in switches() {
                let (function, terms) = (switch.function, switch.terms.join(", "));
                item(f, &format!("{function:<wide$} in {terms}"))?;
            }
        }
        Ok(())
    }

    fn left_out(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let left_out = self.spec.structure.left_out;
        if !left_out.is_empty() {
            writeln!(f, "\nLeft out")?;
        }
        left_out.iter().try_for_each(|reason| item(f, reason))
    }

    fn costs(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let costs = &self.spec.structure.costs;
        let mut rows = vec![
            ("M, Q, c, A and b", costs.dynamics),
            ("the same and a dense LDLᵀ of K", self.dense()),
        ];
        if self.spec.structure.straight_line {
            rows.extend([
                ("straight line, nothing hoisted", costs.unprepared),
                ("straight line, as emitted", costs.acceleration),
                ("correction of a projection", costs.correction),
            ]);
        }
        rows.push(("once for a set of parameters", costs.prepare));
        let wide = widest(rows.iter().map(|(name, _)| *name));
        writeln!(
            f,
            "\n{:<wide$}  {:>8} {:>8} {:>8} {:>8} {:>8} {:>8}",
            "Operations",
            "add",
            "multiply",
            "divide",
            "root",
            "function",
            "select",
            wide = wide + 2
        )?;
        for (name, operations) in rows {
            write!(f, "  {name:<wide$} ")?;
            for count in operations.counts() {
                write!(f, " {count:>8}")?;
            }
            writeln!(f)?;
        }
        Ok(())
    }

    fn pictures(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let s = &self.spec.structure;
        if !s.mass_diagonal {
            write!(f, "\nM\n{}", self.mass())?;
        }
        if self.spec.m() > 0 {
            write!(f, "\nA\n{}", self.jacobian())?;
            let fill = match s.straight_line {
                true => ", in the order of its elimination (+ filled in by it)",
                false => "",
            };
            write!(f, "\nK = [M Aᵀ; A 0]{fill}\n{}", self.system())?;
        }
        Ok(())
    }
}

impl Display for Plan {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.solve(f)?;
        self.certificate(f)?;
        self.hoisted(f)?;
        self.switches(f)?;
        self.left_out(f)?;
        self.costs(f)?;
        self.pictures(f)
    }
}

impl Picture {
    /// The entry at `row` and `column`, unfolded.
    ///
    /// # Panics
    /// If there is no such entry.
    #[must_use]
    pub fn entry(&self, row: usize, column: usize) -> char {
        assert!(column < self.columns.len(), "there is no column {column}");
        self.entries[row * self.columns.len() + column]
    }

    /// Names of the rows.
    #[must_use]
    pub fn rows(&self) -> &[&'static str] {
        &self.rows
    }

    /// Names of the columns.
    #[must_use]
    pub fn columns(&self) -> &[&'static str] {
        &self.columns
    }

    /// What stands for a block of entries: the diagonal, else what is declared, else what is filled in.
    fn block(&self, rows: std::ops::Range<usize>, columns: std::ops::Range<usize>) -> char {
        let entries = rows.flat_map(|i| columns.clone().map(move |j| self.entry(i, j)));
        let rank = |c: &char| "·+#\\".chars().position(|known| known == *c);
        entries.max_by_key(rank).unwrap_or('·')
    }
}

/// Names beside the rows, and above the columns unless those are the rows'. More than 60 rows or columns are folded: a character then
/// stands for a block of entries, and a line is named for its first row.
impl Display for Picture {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (m, n) = (self.rows.len(), self.columns.len());
        let fold = m.max(n).div_ceil(PICTURE).max(1);
        let wide = widest(self.rows.iter().copied());
        let named: Vec<&str> = self.columns.iter().step_by(fold).copied().collect();
        if !self.square {
            let high = widest(named.iter().copied());
            for line in 0..high {
                write!(f, "  {:wide$} ", "")?;
                let mut text = String::new();
                for name in &named {
                    // Names stand on the picture.
                    let above = high - name.chars().count();
                    let c = line.checked_sub(above).and_then(|k| name.chars().nth(k));
                    text.push(c.unwrap_or(' '));
                }
                writeln!(f, "{}", text.trim_end())?;
            }
        }
        for i in (0..m).step_by(fold) {
            write!(f, "  {:>wide$} ", self.rows[i])?;
            for j in (0..n).step_by(fold) {
                f.write_char(self.block(i..(i + fold).min(m), j..(j + fold).min(n)))?;
            }
            writeln!(f)?;
        }
        if fold > 1 {
            writeln!(f, "  (one character stands for {fold} × {fold} entries)")?;
        }
        Ok(())
    }
}

/// How many characters the longest of `names` has.
pub(crate) fn widest<'a>(names: impl Iterator<Item = &'a str>) -> usize {
    names.map(|name| name.chars().count()).max().unwrap_or(0)
}

fn item(f: &mut Formatter<'_>, text: &str) -> fmt::Result {
    wrapped(f, text, "  - ", "    ")
}

/// The names, of many the first and the last.
fn shortened(names: &[&str]) -> String {
    match names {
        [first, second, .., last] if names.len() > 8 => format!("{first} {second} … {last}"),
        names => names.join(" "),
    }
}

fn paragraph(f: &mut Formatter<'_>, text: &str) -> fmt::Result {
    wrapped(f, text, "  ", "  ")
}

/// `text` in lines of at most [`WIDTH`] characters, broken at single spaces.
fn wrapped(f: &mut Formatter<'_>, text: &str, first: &str, indent: &str) -> fmt::Result {
    let mut line = first.to_owned();
    let mut fresh = true;
    for word in text.split(' ') {
        let length = line.chars().count() + 1 + word.chars().count();
        if !fresh && length > WIDTH {
            writeln!(f, "{line}")?;
            indent.clone_into(&mut line);
            fresh = true;
        }
        if !fresh {
            line.push(' ');
        }
        line.push_str(word);
        fresh = false;
    }
    writeln!(f, "{line}")
}
