//! Direct solution of a block-tridiagonal system of 2 × 2 blocks, by elimination without pivoting.

/// Two unknowns of a cell.
pub(super) type CellUnknowns = [f64; 2];

/// One row of blocks. The blocks beside the diagonal are diagonal themselves: stress couples a phase to itself only.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct BlockRow {
    /// Entries below the diagonal.
    pub(super) lower: CellUnknowns,
    /// Entries on the diagonal, row by row.
    pub(super) diagonal: [CellUnknowns; 2],
    /// Entries above the diagonal.
    pub(super) upper: CellUnknowns,
    /// Right-hand side.
    pub(super) right: CellUnknowns,
}

/// Solves the system in place: afterwards `right` holds the solution.
pub(super) fn solve(rows: &mut [BlockRow]) {
    for i in 1..rows.len() {
        let (below, inverse) = (rows[i - 1], inverse(rows[i - 1].diagonal));
        let row = &mut rows[i];
        for a in 0..2 {
            for b in 0..2 {
                row.diagonal[a][b] -= row.lower[a] * inverse[a][b] * below.upper[b];
                row.right[a] -= row.lower[a] * inverse[a][b] * below.right[b];
            }
        }
    }
    let mut above = [0.0; 2];
    for row in rows.iter_mut().rev() {
        let right = [row.right[0] - row.upper[0] * above[0], row.right[1] - row.upper[1] * above[1]];
        let inverse = inverse(row.diagonal);
        above = [0, 1].map(|a| inverse[a][0] * right[0] + inverse[a][1] * right[1]);
        row.right = above;
    }
}

fn inverse([[a, b], [c, d]]: [CellUnknowns; 2]) -> [CellUnknowns; 2] {
    let scale = 1.0 / (a * d - b * c);
    [[d * scale, -b * scale], [-c * scale, a * scale]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_solution_solves_the_system() {
        let number = |k: usize, salt: usize| ((k * 37 + salt * 101) % 17) as f64 / 17.0 - 0.5;
        let system: Vec<BlockRow> = (0..30)
            .map(|k| BlockRow {
                lower: if k == 0 { [0.0; 2] } else { [number(k, 1), number(k, 2)] },
                diagonal: [[3.0 + number(k, 3), number(k, 4)], [number(k, 5), 3.0 + number(k, 6)]],
                upper: if k == 29 { [0.0; 2] } else { [number(k, 7), number(k, 8)] },
                right: [number(k, 9), number(k, 10)],
            })
            .collect();
        let mut rows = system.clone();
        solve(&mut rows);
        let solution = |k: usize| rows.get(k).map_or([0.0; 2], |row| row.right);
        for (k, row) in system.iter().enumerate() {
            let (below, here, above) = (solution(k.wrapping_sub(1)), solution(k), solution(k + 1));
            for a in 0..2 {
                let product = row.lower[a] * below[a]
                    + row.diagonal[a][0] * here[0]
                    + row.diagonal[a][1] * here[1]
                    + row.upper[a] * above[a];
                assert!((product - row.right[a]).abs() < 1e-14, "row {k}");
            }
        }
    }
}
