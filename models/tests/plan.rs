//! What the compiler says it does, against elimination with numbers.

use crate::every::every_model;
use models::FishRobot;
use nalgebra::DMatrix;
use std::collections::BTreeSet;
use tests::Random;
use ukcore::Mechanism;
use ukcore::plan::Plan;
use ukcore::spec::Pivot;

ukcore::multibody! {
    /// A chain whose [M Aᵀ; A 0] is too wide for a line.
    Long {
        const N: usize = 40;
        params { m = 1.0, g = 9.81 }
        coords { x[N], y[N] }
        mass { for i in 0..N { x[i]: m, y[i]: m } }
        potential { for i in 0..N { m * g * y[i] } }
        holonomic {
            support: sq(x[0]) + sq(y[0]) = 1.0
            for i in 0..N - 1 { link[i]: sq(x[i + 1] - x[i]) + sq(y[i + 1] - y[i]) = 1.0 }
        }
    }
}

ukcore::multibody! {
    /// A pointer without mass that is nowhere the same multiple of what it points at.
    Pointer {
        coords { x, angle }
        mass { x: 1.0 }
        holonomic { points: x = sin(angle) }
    }
}

/// Any numbers at the declared places of K, eliminated in the order of the plan, are non-zero exactly where the picture says so.
#[test]
fn fill_is_what_elimination_fills() {
    every_model(|model| {
        let mechanism = &model.mechanism;
        let spec = mechanism.spec();
        let (n, m) = (spec.n(), spec.m());
        let s = &spec.structure;
        let mut random = Random::new(21);
        let mut k = DMatrix::zeros(n + m, n + m);
        let entries = s
            .jacobian_pattern
            .iter()
            .map(|(row, column)| (n + row, *column));
        for (i, j) in s.mass_pattern.iter().copied().chain(entries) {
            let x = 1.5 + random.signed();
            (k[(i, j)], k[(j, i)]) = (x, x);
        }
        let mut seen = nonzero(&k, &(0..n + m).collect::<Vec<_>>());
        let mut left: Vec<usize> = (0..n + m).collect();
        for pivot in s.solve.pivots {
            let taken = match *pivot {
                Pivot::Prescribed(i, row)
                | Pivot::Massless(i, row)
                | Pivot::Substituted(i, row) => vec![i, n + row],
                Pivot::Turned(_, j, row) => vec![j, n + row],
                Pivot::Coordinate(i) => vec![i],
                Pivot::Constraint(row) => vec![n + row],
            };
            if let Pivot::Turned(i, j, row) = *pivot {
                // The first becomes what the constraint leaves free.
                let mut turn = DMatrix::identity(n + m, n + m);
                (turn[(i, i)], turn[(j, i)]) = (k[(n + row, j)], -k[(n + row, i)]);
                k = turn.transpose() * k * turn;
            }
            left.retain(|i| !taken.contains(i));
            let block = k.select_rows(&taken).select_columns(&taken);
            let Some(inverse) = block.try_inverse() else {
                // Nothing is left of a row that follows from others whatever the state: it is left out.
                let redundant = s.solve.redundant.iter().any(|row| taken == [n + row]);
                assert!(redundant, "{}: {pivot:?}", model.id);
                continue;
            };
            let beside = k.select_columns(&taken);
            k -= &beside * inverse * beside.transpose();
            seen.extend(nonzero(&k, &left));
        }
        assert!(
            left.is_empty() || !s.straight_line,
            "{}: all is eliminated",
            model.id
        );
        let picture = mechanism.plan().system();
        let position = |name: &str| {
            (0..n + m)
                .find(|k| spec.name_at(*k) == name)
                .expect("a name")
        };
        for (i, row) in picture.rows().iter().enumerate() {
            for (j, column) in picture
                .columns()
                .iter()
                .enumerate()
                .filter(|(j, _)| *j != i)
            {
                let drawn = picture.entry(i, j) != '·';
                let place = (position(row), position(column));
                assert_eq!(
                    drawn,
                    seen.contains(&place),
                    "{}: {row}, {column}",
                    model.id
                );
            }
        }
    });
}

/// The places of `k` among `rows` and the same columns that are not zero.
fn nonzero(k: &DMatrix<f64>, rows: &[usize]) -> BTreeSet<(usize, usize)> {
    let pairs = rows.iter().flat_map(|i| rows.iter().map(move |j| (*i, *j)));
    pairs.filter(|at| k[*at].abs() > 1e-10).collect()
}

/// Additions, multiplications and divisions of an LDLᵀ solve, counted while it is done.
#[test]
fn the_dense_count_is_that_of_a_dense_solve() {
    let size = FishRobot::SPEC.n() + FishRobot::SPEC.m();
    let mut random = Random::new(22);
    let mut a = DMatrix::from_fn(size, size, |_, _| random.signed());
    a = &a * a.transpose() + DMatrix::identity(size, size);
    let right = random.vector(size);
    let (mut l, mut x) = (a.clone(), right.clone());
    let [mut add, mut multiply, mut divide] = [0; 3];
    let mut reciprocals = Vec::new();
    for k in 0..size {
        divide += 1;
        let reciprocal = 1.0 / l[(k, k)];
        reciprocals.push(reciprocal);
        for i in k + 1..size {
            multiply += 1;
            let factor = l[(i, k)] * reciprocal;
            for j in k + 1..=i {
                (add, multiply) = (add + 1, multiply + 1);
                // Column k still holds the entries; the factors of rows before i are used up.
                let update = factor * if j == i { l[(i, k)] } else { l[(k, j)] };
                l[(i, j)] -= update;
            }
            l[(k, i)] = l[(i, k)];
            l[(i, k)] = factor;
        }
    }
    for i in 0..size {
        for k in 0..i {
            (add, multiply) = (add + 1, multiply + 1);
            x[i] -= l[(i, k)] * x[k];
        }
    }
    for (x, reciprocal) in x.iter_mut().zip(reciprocals) {
        multiply += 1;
        *x *= reciprocal;
    }
    for i in (0..size).rev() {
        for k in i + 1..size {
            (add, multiply) = (add + 1, multiply + 1);
            x[i] -= l[(k, i)] * x[k];
        }
    }
    let residual = a * nalgebra::DVector::from_vec(x) - nalgebra::DVector::from_vec(right);
    assert!(residual.norm() < 1e-10, "{residual}");
    let dense = FishRobot::SPEC.structure.costs.dense;
    assert_eq!(dense.counts(), [add, multiply, divide, 0, 0, 0]);
}

#[test]
fn what_has_no_straight_line_says_why() {
    let refusal = Pointer::SPEC.structure.solve.refusal;
    assert!(refusal.contains("`angle`"), "{refusal}");
    let text = Pointer::plan().to_string();
    assert!(text.contains("there is no straight line"), "{text}");
}

#[test]
fn large_pictures_are_folded() {
    let plan: Plan = Long::plan();
    let text = plan.system().to_string();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 61, "{text}");
    assert_eq!(lines[60], "  (one character stands for 2 × 2 entries)");
    let drawn = |line: &str| line.chars().filter(|c| "·+#\\".contains(*c)).count();
    assert!(lines[..60].iter().all(|line| drawn(line) == 60), "{text}");
    // Each link fills in between its neighbours only.
    assert_eq!(Long::SPEC.structure.solve.fill.len(), 39);
    assert!(
        plan.to_string()
            .lines()
            .all(|line| line.chars().count() < 130)
    );
}
