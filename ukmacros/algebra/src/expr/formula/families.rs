//! Rows that differ in their indices alone, and in these evenly, as one row for each run of them.

use super::{Formula, Index};
use std::collections::HashSet;
use std::fmt::Write as _;

/// Blocks in a row that are looked at as the unit that repeats.
const PERIOD: usize = 8;
/// Families of families of families are enough.
const ROUNDS: usize = 3;
/// Rows that a family says in fewer: from so many on it is easier to read than its members. Two members are one only if no index steps
/// by more than one: any two are even.
const LEAST: usize = 2;

/// Rows that belong together, for the values of letters in their indices.
#[derive(Clone)]
pub struct Block {
    pub rows: Vec<Formula>,
    pub runs: Vec<Run>,
}

/// A letter, with its first and last value.
#[derive(Clone, PartialEq, Eq)]
pub struct Run {
    pub(super) letter: String,
    pub(super) from: i64,
    pub(super) to: i64,
}

/// Letters that mean nothing else.
pub struct Letters(Vec<String>);

impl Letters {
    /// Letters that are not in `taken`.
    pub fn beside(taken: &HashSet<String>) -> Self {
        let letters = ["i", "j", "k", "n", "p", "r", "u", "w"].map(str::to_owned);
        let numbered = (1..=ROUNDS).map(|k| format!("i{k}"));
        let free = letters.into_iter().chain(numbered);
        let free = free.filter(|letter| !taken.contains(letter));
        Letters(free.take(ROUNDS).collect())
    }
}

impl From<Formula> for Block {
    fn from(row: Formula) -> Self {
        Block::from(vec![row])
    }
}

impl From<Vec<Formula>> for Block {
    fn from(rows: Vec<Formula>) -> Self {
        Block {
            rows,
            runs: Vec::new(),
        }
    }
}

impl Block {
    /// The text of each row; the first ends with the values of letters.
    pub fn texts(&self) -> Vec<String> {
        let mut texts: Vec<String> = self.rows.iter().map(Formula::to_string).collect();
        if let Some(first) = texts.first_mut() {
            *first += &self.runs();
        }
        texts
    }

    /// The values of letters: `, i = 0 … 16`; empty where there is none.
    fn runs(&self) -> String {
        let mut text = String::new();
        for Run { letter, from, to } in &self.runs {
            let _ = write!(text, ",  {letter} = {from} … {to}");
        }
        text
    }

    /// What members of a family have in common, and their indices.
    fn member(&mut self) -> Member {
        let mut shape = String::new();
        let mut indices = Vec::new();
        for row in &mut self.rows {
            let _ = writeln!(shape, "{row:#}");
            row.each_index(&mut |index| indices.push(index.clone()));
        }
        shape += &self.runs();
        Member {
            rows: self.rows.len(),
            shape,
            indices,
        }
    }
}

/// A block as it is compared.
struct Member {
    rows: usize,
    shape: String,
    indices: Vec<Index>,
}

impl Member {
    /// The amounts by which the indices of `next` are greater, where all else is the same.
    fn step(&self, next: &Member) -> Option<Vec<i64>> {
        if self.shape != next.shape {
            return None;
        }
        let pairs = self.indices.iter().zip(&next.indices);
        let steps = pairs.map(|(a, b)| (a.letters == b.letters).then(|| b.constant - a.constant));
        steps.collect()
    }
}

/// `blocks` with families in place of their members; families of families, too.
pub fn families(mut blocks: Vec<Block>, letters: &Letters) -> Vec<Block> {
    for letter in &letters.0 {
        let before = blocks.len();
        blocks = folded(blocks, letter);
        if blocks.len() == before {
            break;
        }
    }
    blocks
}

/// One round: families over `letter`.
fn folded(mut blocks: Vec<Block>, letter: &str) -> Vec<Block> {
    let members: Vec<Member> = blocks.iter_mut().map(Block::member).collect();
    let mut out = Vec::new();
    let mut at = 0;
    while at < blocks.len() {
        // The shortest unit first: what it leaves may be a family again.
        let found = (1..=PERIOD).find_map(|period| {
            let plain = |block: &Block| block.runs.is_empty();
            let whole = blocks.get(at..at + period)?;
            if period > 1 && !whole.iter().all(plain) {
                return None;
            }
            let (count, steps) = repetitions(&members[at..], period)?;
            Some((period, count, steps))
        });
        let Some((period, count, steps)) = found else {
            out.push(blocks[at].clone());
            at += 1;
            continue;
        };
        out.push(family(&blocks[at..at + period], &steps, count, letter));
        at += period * count;
    }
    out
}

/// How often the first `period` members are repeated with even steps of their indices, and these steps, if often enough.
fn repetitions(members: &[Member], period: usize) -> Option<(usize, Vec<i64>)> {
    let steps = |at: usize| -> Option<Vec<i64>> {
        let of = |k: usize| members.get(at + k)?.step(members.get(at + period + k)?);
        let all: Option<Vec<Vec<i64>>> = (0..period).map(of).collect();
        all.map(|all| all.concat())
    };
    let first = steps(0)?;
    if first.iter().all(|step| *step == 0) {
        return None;
    }
    let mut count = 2;
    while steps((count - 1) * period).is_some_and(|next| next == first) {
        count += 1;
    }
    let rows: usize = members[..period].iter().map(|member| member.rows).sum();
    let near = count > 2 || first.iter().all(|step| matches!(step, 0 | 1));
    (near && rows * (count - 1) >= LEAST).then_some((count, first))
}

/// The family of `blocks` and those that follow it by `steps` of the indices.
fn family(blocks: &[Block], steps: &[i64], count: usize, letter: &str) -> Block {
    let mut rows: Vec<Formula> = blocks.iter().flat_map(|block| block.rows.clone()).collect();
    let mut runs = blocks[0].runs.clone();
    let mut steps = steps.iter();
    // The letter is the first index that runs, where that runs by ones.
    let mut start: Option<i64> = None;
    for row in &mut rows {
        row.each_index(&mut |index| {
            let step = *steps.next().unwrap_or(&0);
            if step == 0 {
                return;
            }
            let start = *start.get_or_insert(if step == 1 { index.constant } else { 0 });
            index.constant -= step * start;
            index.letters.push((letter.to_owned(), step));
        });
    }
    let from = start.unwrap_or(0);
    runs.push(Run {
        letter: letter.to_owned(),
        from,
        to: from + count as i64 - 1,
    });
    Block { rows, runs }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expr::Name;

    fn texts(names: &[&str]) -> Vec<String> {
        let rows = names.iter().map(|name| {
            let (left, right) = name.split_once('=').unwrap();
            let right = right.split('+').map(|term| (false, Formula::name(term)));
            Block::from(
                Formula::Entry("M", vec![Name::from(left)]).equal(Formula::Sum(right.collect())),
            )
        });
        let taken = ["j".to_owned()].into();
        let blocks = families(rows.collect(), &Letters::beside(&taken));
        blocks.iter().flat_map(Block::texts).collect()
    }

    #[test]
    fn rows_whose_indices_run_are_one() {
        let rows = ["x[2]=m", "x[3]=m", "x[4]=m", "y[0]=m", "y[1]=k"];
        assert_eq!(
            texts(&rows),
            ["M[x[i]] = m,  i = 2 … 4", "M[y[0]] = m", "M[y[1]] = k"]
        );
    }

    #[test]
    fn two_are_no_family() {
        assert_eq!(texts(&["x[2]=m", "x[3]=m"]).len(), 2);
    }

    #[test]
    fn other_indices_follow_the_first_one() {
        let rows = ["x[1]=a[0]+p[9]", "x[2]=a[2]+p[8]", "x[3]=a[4]+p[7]"];
        assert_eq!(
            texts(&rows),
            ["M[x[i]] = a[2*i - 2] + p[-i + 10],  i = 1 … 3"]
        );
        // The odd one out stays.
        let rows = ["x[1]=a[0]", "x[2]=a[2]", "x[3]=a[4]", "x[4]=a[7]"];
        assert_eq!(
            texts(&rows),
            ["M[x[i]] = a[2*i - 2],  i = 1 … 3", "M[x[4]] = a[7]"]
        );
    }

    #[test]
    fn rows_that_alternate_and_families_of_families() {
        let mut rows = Vec::new();
        for leg in 0..4 {
            for bar in 0..3 {
                rows.push(format!("leg[{leg}].bar[{bar}].x=m[{bar}]"));
                rows.push(format!("leg[{leg}].bar[{bar}].y=c[{leg}]"));
            }
        }
        let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
        // `j` has another meaning.
        let expected = [
            "M[leg[k].bar[i].x] = m[i],  i = 0 … 2,  k = 0 … 3",
            "M[leg[k].bar[i].y] = c[k]",
        ];
        assert_eq!(texts(&rows), expected);
    }
}
