//! Rows of A that have entries of their own: leaves of its pattern, taken off one after the other.
//!
//! Where a combination of rows vanishes a row takes no part in it that has an entry, not zero, in a column where no other row has one; and,
//! that row taken off, so on. On the straight way from A₀ to A₁ a row's own entries a do not vanish if a₀·a₁ > 0. For chains and trees this
//! tells of every row, by a product each, that it is in no combination that vanishes on the way.

use crate::mechanism::Prepared;

/// Entries of its own that are less than this share of a row where the run begins are not counted on.
const OWN: f64 = 0.1;

/// The pattern of A by rows.
#[derive(Debug, Clone, Default)]
pub(super) struct Leaves {
    rows: Vec<Row>,
    /// Places of entries in A, column-major: of each row, those of its own first.
    places: Vec<u32>,
}

/// A row: where its entries end, and how many are its own.
#[derive(Debug, Clone)]
struct Row {
    row: usize,
    own: usize,
    end: usize,
}

/// What has become of the rows of A between two states.
#[derive(Debug, Default, Clone, Copy)]
pub(super) struct Compared {
    /// The largest change of a row, as a share of what it is at the last; and half of what such changes gain in as much time again, going
    /// on to gain as they did since those before them.
    pub(super) rows: [f64; 2],
    /// Both numbers for the entries that a row has of its own, where it has some.
    pub(super) own: [f64; 2],
    /// Whether these are not reversed.
    pub(super) kept: bool,
}

/// |y|², |y − x|², x·y and |y − x − r (x − w)|² of vectors w, x and y, of which y is the last.
#[derive(Default, Clone, Copy)]
struct Sums {
    square: f64,
    change: f64,
    product: f64,
    bend: f64,
}

impl Sums {
    #[inline]
    fn add(mut self, places: &[u32], [w, x, y]: [&[f64]; 3], r: f64) -> Self {
        for place in places {
            let place = *place as usize;
            let (w, x, y) = (w[place], x[place], y[place]);
            let change = y - x;
            let bend = change - r * (x - w);
            self.square += y * y;
            self.change += change * change;
            self.product += x * y;
            self.bend += bend * bend;
        }
        self
    }

    /// Makes the largest change and bend at least those of the vector, as shares of what it is at the last, squared.
    fn share(self, most: &mut [f64; 2]) {
        let scale = self.square.recip();
        for (most, x) in most.iter_mut().zip([self.change, self.bend]) {
            *most = most.max(x * scale);
        }
    }
}

impl Leaves {
    /// The rows of a mechanism by their entries, for A (column-major) where the run begins.
    pub(super) fn new(mech: &Prepared, jacobian: &[f64]) -> Self {
        let (n, m) = (mech.spec().n(), mech.spec().m());
        let mut columns: Vec<Vec<usize>> = vec![Vec::new(); m];
        // How many rows are left in a column, and the sum of their numbers: of one row, its own.
        let mut left = vec![(0, 0); n];
        for (c, i) in mech.spec().structure.jacobian_pattern {
            columns[*c].push(*i);
            left[*i] = (left[*i].0 + 1, left[*i].1 + c);
        }
        let mut all = Leaves::default();
        let mut taken = vec![false; m];
        let single = |column: &(usize, usize)| column.0 == 1;
        let mut next: Vec<usize> = left.iter().filter(|x| single(x)).map(|x| x.1).collect();
        while let Some(c) = next.pop() {
            let square = |i: &usize| jacobian[i * m + c].powi(2);
            let own = columns[c].iter().filter(|i| single(&left[**i]));
            let sizes = [own.map(square).sum(), columns[c].iter().map(square).sum()];
            let [own, row]: [f64; 2] = sizes;
            if taken[c] || own.is_nan() || own <= OWN * OWN * row {
                continue;
            }
            taken[c] = true;
            columns[c].sort_by_key(|i| !single(&left[*i]));
            let own = columns[c].iter().filter(|i| single(&left[**i])).count();
            all.push(c, own, &columns[c], m);
            for i in &columns[c] {
                left[*i] = (left[*i].0 - 1, left[*i].1 - c);
                next.extend(Some(left[*i]).filter(single).map(|x| x.1));
            }
        }
        (0..m)
            .filter(|c| !taken[*c])
            .for_each(|c| all.push(c, 0, &columns[c], m));
        all
    }

    fn push(&mut self, row: usize, own: usize, columns: &[usize], m: usize) {
        self.places
            .extend(columns.iter().map(|i| (i * m + row) as u32));
        let end = self.places.len();
        self.rows.push(Row { row, own, end });
    }

    pub(super) fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Whether each row has entries of its own.
    pub(super) fn are_all(&self) -> bool {
        self.rows.last().is_none_or(|row| row.own > 0)
    }

    /// Which rows have none.
    pub(super) fn others(&self) -> Vec<bool> {
        let mut others = vec![false; self.rows.len()];
        self.rows
            .iter()
            .for_each(|row| others[row.row] = row.own == 0);
        others
    }

    /// Squares of the lengths of rows, for A at a state.
    pub(super) fn squares(&self, a: &[f64], squares: &mut Vec<f64>) {
        squares.resize(self.rows.len(), 0.0);
        let mut begin = 0;
        for row in &self.rows {
            let places = self.places[begin..row.end].iter();
            begin = row.end;
            squares[row.row] = places.fold(0.0, |sum, i| sum + a[*i as usize] * a[*i as usize]);
        }
    }

    /// Calls `f` with the number of each row, the square of its change from one state to another, and the product of what it is at both,
    /// for A at these.
    pub(super) fn changes(&self, [from, to]: [&[f64]; 2], mut f: impl FnMut(usize, f64, f64)) {
        let mut begin = 0;
        for row in &self.rows {
            let (mut change, mut product) = (0.0, 0.0);
            for place in &self.places[begin..row.end] {
                let (x, y) = (from[*place as usize], to[*place as usize]);
                change += (y - x) * (y - x);
                product += x * y;
            }
            begin = row.end;
            f(row.row, change, product);
        }
    }

    /// Calls `f` with each row, and sums over the entries of its own and over all of them, for A at three states.
    #[inline]
    fn each(&self, a: [&[f64]; 3], ratio: f64, mut f: impl FnMut(&Row, Sums, Sums)) {
        let mut begin = 0;
        for row in &self.rows {
            let (mine, rest) = self.places[begin..row.end].split_at(row.own);
            begin = row.end;
            let own = Sums::default().add(mine, a, ratio);
            f(row, own, own.add(rest, a, ratio));
        }
    }

    /// Squares of the lengths of rows at the last of three states, and their products with those before, for A at these. The time between
    /// the last two is `ratio` times that between the first two.
    pub(super) fn compare(
        &self,
        a: [&[f64]; 3],
        ratio: f64,
        squares: &mut Vec<f64>,
        products: &mut Vec<f64>,
    ) -> Compared {
        squares.resize(self.rows.len(), 0.0);
        products.resize(self.rows.len(), 0.0);
        let mut compared = Compared {
            kept: true,
            ..Compared::default()
        };
        self.each(a, ratio, |row, own, all| {
            (squares[row.row], products[row.row]) = (all.square, all.product);
            all.share(&mut compared.rows);
            if row.own > 0 {
                own.share(&mut compared.own);
                compared.kept &= own.product > 0.0;
            }
        });
        // In the middle of the time between the first two it was as fast as it went there on an average; at rest, where nothing came
        // before.
        let half = match ratio {
            0.0 => 1.0,
            ratio => ratio / (1.0 + ratio),
        };
        for [change, gain] in [&mut compared.rows, &mut compared.own] {
            (*change, *gain) = (change.sqrt(), half * gain.sqrt());
        }
        compared
    }
}
