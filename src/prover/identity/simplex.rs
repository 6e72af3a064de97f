//! Nonnegative solutions of linear equations, exactly: the first phase of the simplex method, with
//! Bland's rule, which never runs in a circle.

use rug::Rational;

/// No more pivots are made.
const PIVOTS: usize = 400;

/// Some `x >= 0` with `sum of x[j]*columns[j] == target`, if there is one (and it is found in time).
pub(super) fn solve(columns: &[Vec<Rational>], target: &[Rational]) -> Option<Vec<Rational>> {
    let (width, height) = (columns.len(), target.len());
    let mut rows: Vec<Vec<Rational>> = (0..height)
        .map(|i| {
            let row = columns.iter().map(|column| column[i].clone());
            let mut row: Vec<Rational> = row.chain([target[i].clone()]).collect();
            if target[i] < 0 {
                row.iter_mut().for_each(|value| *value = -value.clone());
            }
            row
        })
        .collect();
    // Each row starts with an artificial variable; the costs are what they add up to.
    let mut basis: Vec<Option<usize>> = vec![None; height];
    let mut costs: Vec<Rational> = (0..=width)
        .map(|j| rows.iter().map(|row| &row[j]).sum())
        .collect();
    for _ in 0..PIVOTS {
        let Some(enters) = (0..width).find(|&j| costs[j] > 0) else {
            break;
        };
        let leaves = leaving(&rows, &basis, enters, width)?;
        pivot(&mut rows, &mut costs, leaves, enters);
        basis[leaves] = Some(enters);
    }
    if costs[width] != 0 {
        return None;
    }
    let mut solution = vec![Rational::new(); width];
    for (row, basic) in rows.iter().zip(&basis) {
        if let Some(j) = basic {
            solution[*j] = row[width].clone();
        }
    }
    Some(solution)
}

/// The row with the least quotient; of those the one whose variable comes first.
fn leaving(
    rows: &[Vec<Rational>],
    basis: &[Option<usize>],
    enters: usize,
    width: usize,
) -> Option<usize> {
    let candidates = (0..rows.len()).filter(|&i| rows[i][enters] > 0);
    let quotient = |i: usize| Rational::from(&rows[i][width] / &rows[i][enters]);
    candidates.min_by_key(|&i| (quotient(i), basis[i]))
}

fn pivot(rows: &mut [Vec<Rational>], costs: &mut [Rational], at: usize, enters: usize) {
    let inverse = Rational::from(rows[at][enters].recip_ref());
    for value in rows[at].iter_mut().filter(|value| **value != 0) {
        *value *= &inverse;
    }
    let chosen = rows[at].clone();
    let subtract = |row: &mut [Rational]| {
        let factor = row[enters].clone();
        if factor == 0 {
            return;
        }
        for (value, by) in row.iter_mut().zip(&chosen) {
            if *by != 0 {
                *value -= Rational::from(&factor * by);
            }
        }
    };
    for (i, row) in rows.iter_mut().enumerate() {
        if i != at {
            subtract(row);
        }
    }
    subtract(costs);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn column(values: &[i64]) -> Vec<Rational> {
        values.iter().map(|v| Rational::from(*v)).collect()
    }

    #[test]
    fn a_solution_solves() {
        let columns = [column(&[1, 0, 1]), column(&[1, -1, 0]), column(&[0, 2, 1])];
        let wanted = column(&[3, -1, 2]);
        let found = solve(&columns, &wanted).expect("a solution");
        for (row, value) in wanted.iter().enumerate() {
            let sum: Rational = columns
                .iter()
                .zip(&found)
                .map(|(column, times)| Rational::from(&column[row] * times))
                .sum();
            assert_eq!(&sum, value);
        }
    }

    #[test]
    fn there_may_be_none() {
        assert_eq!(solve(&[column(&[1, 1])], &column(&[1, 2])), None);
        assert_eq!(solve(&[column(&[1])], &column(&[-1])), None);
    }
}
