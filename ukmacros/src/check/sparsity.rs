//! Structural rank: what no choice of parameters can mend.

/// The rows, of those with the given `columns`, that a maximum matching of rows to columns leaves out. If none is left out the matrix has
/// full row rank for almost all values of its entries.
pub(super) fn unmatched_rows(columns_of_row: &[Vec<usize>], columns: usize) -> Vec<usize> {
    let mut row_of_column: Vec<Option<usize>> = vec![None; columns];
    // For which row each column was visited last.
    let mut visited = vec![usize::MAX; columns];
    (0..columns_of_row.len())
        .filter(|row| !augment(*row, columns_of_row, &mut row_of_column, &mut visited))
        .collect()
}

fn augment(
    row: usize,
    columns_of_row: &[Vec<usize>],
    row_of_column: &mut [Option<usize>],
    visited: &mut [usize],
) -> bool {
    // An augmenting path found iteratively: the depth can reach the number of rows.
    let mut path: Vec<(usize, usize)> = vec![(row, 0)];
    while let Some((current, next)) = path.last_mut() {
        let Some(&column) = columns_of_row[*current].get(*next) else {
            path.pop();
            continue;
        };
        *next += 1;
        if std::mem::replace(&mut visited[column], row) == row {
            continue;
        }
        match row_of_column[column] {
            Some(other) => path.push((other, 0)),
            None => {
                for (r, next) in path {
                    row_of_column[columns_of_row[r][next - 1]] = Some(r);
                }
                return true;
            }
        }
    }
    false
}
