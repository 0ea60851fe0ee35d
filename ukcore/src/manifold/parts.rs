//! How the constraints fall apart into systems that can be solved one after the other.
//!
//! A coordinate that is held, or that its own rows determine as a driven crank's do, is known to all others; what hangs together through
//! such coordinates alone is not connected. The parts follow from the structure of A by the decomposition of Dulmage and Mendelsohn (1958,
//! Coverings of bipartite graphs, Canad. J. Math. 10, 517-534; Pothen & Fan 1990, Computing the block triangular form of a sparse matrix,
//! ACM Trans. Math. Softw. 16, 303-324): rows that determine their unknowns split into the strongly connected blocks of who depends on
//! whom, rows with more unknowns than there are of them, or fewer, into connected components.

/// Rows, and the unknowns that they are solved for where those of the parts before are known.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Part {
    pub(crate) rows: Vec<usize>,
    pub(crate) unknowns: Vec<usize>,
    /// Places of the parts before with unknowns in these rows.
    pub(crate) needs: Vec<usize>,
}

impl Part {
    /// All of the first `rows`, for the unknowns `free`.
    pub(crate) fn whole(rows: usize, free: Vec<usize>) -> Self {
        Part {
            rows: (0..rows).collect(),
            unknowns: free,
            needs: Vec::new(),
        }
    }

    pub(crate) fn rows(&self) -> impl Iterator<Item = usize> {
        self.rows.iter().copied()
    }

    /// Whether there are as many rows as unknowns, or more, so that solutions lie apart, unless rows depend on others.
    pub(crate) fn is_determined(&self) -> bool {
        self.rows.len() >= self.unknowns.len()
    }
}

/// The parts of the first `rows` of A, which has these entries (row, column), for the unknowns `free`, in an order in which they can be
/// solved. Rows without an unknown are in none.
pub(crate) fn parts(pattern: &[(usize, usize)], rows: usize, free: &[usize]) -> Vec<Part> {
    let mut graph = Graph::new(pattern, rows, free);
    graph.pair();
    let heads = graph.heads();
    let mut blocks = Blocks::new(&graph, &heads);
    (0..free.len()).for_each(|unknown| blocks.visit(unknown));
    // An unknown in no row is no part.
    let found = blocks.found.iter();
    let found = found.filter(|block| block.iter().any(|u| !graph.rows[*u].is_empty()));
    let (mut parts, mut place): (Vec<Part>, _) = (Vec::new(), vec![0; free.len()]);
    for block in found {
        block
            .iter()
            .for_each(|unknown| place[*unknown] = parts.len());
        let mut unknowns: Vec<usize> = block.iter().map(|unknown| free[*unknown]).collect();
        unknowns.sort_unstable();
        parts.push(Part {
            unknowns,
            ..Part::whole(0, Vec::new())
        });
    }
    for (row, heads) in heads.iter().enumerate() {
        if let Some(head) = heads.first() {
            let of = place[*head];
            let needs = graph.unknowns[row].iter().map(|unknown| place[*unknown]);
            parts[of].needs.extend(needs.filter(|part| *part != of));
            parts[of].rows.push(row);
        }
    }
    parts
}

/// Which row has which unknowns, numbered as they come.
struct Graph {
    unknowns: Vec<Vec<usize>>,
    rows: Vec<Vec<usize>>,
    /// The unknown that each row is paired with, and the row of each unknown: as many pairs as there can be.
    unknown_of: Vec<Option<usize>>,
    row_of: Vec<Option<usize>>,
}

impl Graph {
    fn new(pattern: &[(usize, usize)], rows: usize, free: &[usize]) -> Self {
        let mut graph = Graph {
            unknowns: vec![Vec::new(); rows],
            rows: vec![Vec::new(); free.len()],
            unknown_of: vec![None; rows],
            row_of: vec![None; free.len()],
        };
        for &(row, column) in pattern {
            if let (true, Ok(unknown)) = (row < rows, free.binary_search(&column)) {
                graph.unknowns[row].push(unknown);
                graph.rows[unknown].push(row);
            }
        }
        graph
    }

    /// Pairs rows with unknowns.
    fn pair(&mut self) {
        for row in 0..self.unknowns.len() {
            let mut seen = vec![false; self.rows.len()];
            self.pair_row(row, &mut seen);
        }
    }

    /// Pairs `row`, if need be by giving other rows another unknown.
    fn pair_row(&mut self, row: usize, seen: &mut [bool]) -> bool {
        for unknown in self.unknowns[row].clone() {
            if std::mem::replace(&mut seen[unknown], true) {
                continue;
            }
            if self.row_of[unknown].is_none_or(|other| self.pair_row(other, seen)) {
                self.row_of[unknown] = Some(row);
                self.unknown_of[row] = Some(unknown);
                return true;
            }
        }
        false
    }

    /// The unknowns that depend on the others of each row: the one it is paired with where as many rows as unknowns determine them; else
    /// all that alternate with an unknown, or a row, that has no partner.
    fn heads(&self) -> Vec<Vec<usize>> {
        let loose = reached(&self.row_of, &self.rows, &self.unknown_of);
        let over = reached(&self.unknown_of, &self.unknowns, &self.row_of);
        let heads = |row: usize| -> Vec<usize> {
            let mut unknowns = self.unknowns[row].clone();
            if unknowns.iter().any(|unknown| loose[*unknown]) {
                unknowns.retain(|unknown| loose[*unknown]);
            } else if !over[row] {
                unknowns.retain(|unknown| self.row_of[*unknown] == Some(row));
            }
            unknowns
        };
        (0..over.len()).map(heads).collect()
    }
}

/// What is reached from the nodes without a partner: through their neighbours on the other side to these nodes' partners, and so on.
fn reached(
    partner: &[Option<usize>],
    neighbours: &[Vec<usize>],
    back: &[Option<usize>],
) -> Vec<bool> {
    let mut reached: Vec<bool> = partner.iter().map(Option::is_none).collect();
    let mut open: Vec<usize> = (0..reached.len()).filter(|node| reached[*node]).collect();
    while let Some(node) = open.pop() {
        for next in neighbours[node].iter().filter_map(|other| back[*other]) {
            if !std::mem::replace(&mut reached[next], true) {
                open.push(next);
            }
        }
    }
    reached
}

/// Tarjan's strongly connected components of the unknowns (1972, Depth-first search and linear graph algorithms, SIAM J. Comput. 1,
/// 146-160): those that a block depends on are found before it.
struct Blocks {
    depends: Vec<Vec<usize>>,
    found: Vec<Vec<usize>>,
    /// The block of each unknown that is in one.
    of: Vec<usize>,
    /// When each was met, and the earliest one met that it leads back to.
    met: Vec<Option<usize>>,
    earliest: Vec<usize>,
    open: Vec<usize>,
    count: usize,
}

const NONE: usize = usize::MAX;

impl Blocks {
    fn new(graph: &Graph, heads: &[Vec<usize>]) -> Self {
        let n = graph.rows.len();
        let mut depends = vec![Vec::new(); n];
        for (row, heads) in heads.iter().enumerate() {
            for head in heads {
                depends[*head].extend_from_slice(&graph.unknowns[row]);
            }
        }
        Blocks {
            depends,
            found: Vec::new(),
            of: vec![NONE; n],
            met: vec![None; n],
            earliest: vec![0; n],
            open: Vec::new(),
            count: 0,
        }
    }

    fn visit(&mut self, unknown: usize) {
        if self.met[unknown].is_some() {
            return;
        }
        let now = self.count;
        (self.met[unknown], self.earliest[unknown]) = (Some(now), now);
        self.count += 1;
        self.open.push(unknown);
        for other in std::mem::take(&mut self.depends[unknown]) {
            self.visit(other);
            if self.of[other] == NONE {
                self.earliest[unknown] = self.earliest[unknown].min(self.earliest[other]);
            }
        }
        if self.earliest[unknown] == now {
            let first = self.open.iter().rposition(|open| *open == unknown);
            let block = self.open.split_off(first.unwrap_or(0));
            block.iter().for_each(|u| self.of[*u] = self.found.len());
            self.found.push(block);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows and unknowns of each part of a pattern given by the columns of its rows.
    fn found(rows: &[&[usize]], free: &[usize]) -> Vec<(Vec<usize>, Vec<usize>)> {
        let pairs = rows.iter().enumerate();
        let pattern: Vec<(usize, usize)> = pairs
            .flat_map(|(row, columns)| columns.iter().map(move |column| (row, *column)))
            .collect();
        let parts = parts(&pattern, rows.len(), free).into_iter();
        parts.map(|part| (part.rows, part.unknowns)).collect()
    }

    #[test]
    fn what_is_held_connects_nothing() {
        let legs: [&[usize]; 4] = [&[0, 1, 2], &[1, 2], &[0, 3, 4], &[3, 4]];
        let all: Vec<usize> = (0..5).collect();
        assert_eq!(found(&legs, &all), [((0..4).collect(), all.clone())]);
        let apart = [(vec![0, 1], vec![1, 2]), (vec![2, 3], vec![3, 4])];
        assert_eq!(found(&legs, &all[1..]), apart);
    }

    #[test]
    fn what_is_determined_comes_first() {
        // A crank driven by row 4 before the loops that it drives, the first of which has a freedom left.
        let legs: [&[usize]; 5] = [&[0, 1, 2, 5], &[1, 2, 5], &[0, 3, 4], &[3, 4], &[0]];
        let parts = found(&legs, &[0, 1, 2, 3, 4, 5]);
        assert_eq!(
            parts,
            [
                (vec![4], vec![0]),
                (vec![0, 1], vec![1, 2, 5]),
                (vec![2, 3], vec![3, 4])
            ]
        );
        // Two unknowns that one row each needs the other for, and one that follows.
        let parts = found(&[&[0, 1], &[0, 1], &[1, 2]], &[0, 1, 2]);
        assert_eq!(parts, [(vec![0, 1], vec![0, 1]), (vec![2], vec![2])]);
    }

    #[test]
    fn rows_too_many_stay_together() {
        // Three rows for two unknowns, a third that follows, and a row of what is held.
        let parts = found(&[&[0, 1], &[0, 1], &[0, 1], &[1, 2], &[7]], &[0, 1, 2]);
        assert_eq!(parts, [(vec![0, 1, 2], vec![0, 1]), (vec![3], vec![2])]);
    }

    #[test]
    fn an_unknown_in_no_row_is_in_no_part() {
        assert_eq!(found(&[&[1]], &[0, 1]), [(vec![0], vec![1])]);
        assert_eq!(found(&[], &[0]), []);
    }
}
