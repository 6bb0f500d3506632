//! Cutting curves to the plot, thinning what is finer than a pixel, and dashes.

use super::canvas::{Point, Rectangle};

/// The parts of a chain of points inside `window`; `None` in the chain is a gap (a value that is missing).
pub(super) fn clip_chain(chain: &[Option<Point>], window: &Rectangle) -> Vec<Vec<Point>> {
    let mut pieces: Vec<Vec<Point>> = Vec::new();
    let mut open = false;
    for pair in chain.windows(2) {
        let segment = match (pair[0], pair[1]) {
            (Some(from), Some(to)) => clip_segment(from, to, window).map(|cut| (cut, to)),
            _ => None,
        };
        let Some(((from, to), uncut_end)) = segment else {
            open = false;
            continue;
        };
        match pieces.last_mut() {
            Some(piece) if open => piece.push(to),
            _ => pieces.push(vec![from, to]),
        }
        // The next segment continues this piece only if this one ended inside.
        open = to == uncut_end;
    }
    pieces
}

/// The part of a segment inside `window` (Liang and Barsky).
fn clip_segment(from: Point, to: Point, window: &Rectangle) -> Option<(Point, Point)> {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let (mut enter, mut leave) = (0.0f64, 1.0f64);
    let borders = [
        (-dx, from.0 - window.left),
        (dx, window.right - from.0),
        (-dy, from.1 - window.top),
        (dy, window.bottom - from.1),
    ];
    for (outward, distance) in borders {
        if outward == 0.0 {
            if distance < 0.0 {
                return None;
            }
        } else if outward < 0.0 {
            enter = enter.max(distance / outward);
        } else {
            leave = leave.min(distance / outward);
        }
    }
    if enter > leave {
        return None;
    }
    let along = |share: f64| (from.0 + share * dx, from.1 + share * dy);
    let start = if enter > 0.0 { along(enter) } else { from };
    let end = if leave < 1.0 { along(leave) } else { to };
    Some((start, end))
}

/// The part of a polygon inside `window` (Sutherland and Hodgman).
pub(super) fn clip_polygon(polygon: &[Point], window: &Rectangle) -> Vec<Point> {
    let mut points = polygon.to_vec();
    // Each border: signed distance inwards.
    let borders: [&dyn Fn(Point) -> f64; 4] =
        [&|(x, _)| x - window.left, &|(x, _)| window.right - x, &|(_, y)| y - window.top, &|(_, y)| window.bottom - y];
    for inside in borders {
        let Some(&last) = points.last() else { break };
        let mut kept = Vec::with_capacity(points.len() + 4);
        let mut previous = last;
        for &point in &points {
            let (before, after) = (inside(previous), inside(point));
            if (before < 0.0) != (after < 0.0) {
                let share = before / (before - after);
                kept.push((previous.0 + share * (point.0 - previous.0), previous.1 + share * (point.1 - previous.1)));
            }
            if after >= 0.0 {
                kept.push(point);
            }
            previous = point;
        }
        points = kept;
    }
    points
}

/// Leaves out what a reader cannot see: of a run of points in one pixel column, only the first, the extremes and
/// the last stay. A time series of a million samples keeps its envelope in a few thousand points.
pub(super) fn thin(chain: Vec<Point>) -> Vec<Point> {
    const ENOUGH: usize = 4000;
    if chain.len() <= ENOUGH {
        return chain;
    }
    let mut kept = Vec::new();
    let mut start = 0;
    while start < chain.len() {
        let column = chain[start].0.floor();
        let length = chain[start..].iter().take_while(|point| point.0.floor() == column).count().max(1);
        let run = &chain[start..start + length];
        let extreme = |better: fn(f64, f64) -> bool| {
            (1..length).fold(0, |best, index| if better(run[index].1, run[best].1) { index } else { best })
        };
        let mut indices = [0, extreme(|a, b| a < b), extreme(|a, b| a > b), length - 1];
        indices.sort_unstable();
        let mut previous = None;
        for index in indices {
            if previous != Some(index) {
                kept.push(run[index]);
            }
            previous = Some(index);
        }
        start += length;
    }
    kept
}

/// Cuts a chain into dashes; `pattern` alternates drawn and blank lengths `[px]`.
pub(super) fn dashes(chain: &[Point], pattern: &[f64]) -> Vec<Vec<Point>> {
    let mut pieces = Vec::new();
    let mut current: Vec<Point> = Vec::new();
    let mut slot = 0;
    let (Some(&first), true) = (chain.first(), pattern.iter().all(|&length| length > 0.0) && !pattern.is_empty())
    else {
        return pieces;
    };
    let mut left = pattern[0];
    current.push(first);
    for pair in chain.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        let length = (to.0 - from.0).hypot(to.1 - from.1);
        let mut done = 0.0;
        while length - done > left {
            done += left;
            let share = done / length;
            let corner = (from.0 + share * (to.0 - from.0), from.1 + share * (to.1 - from.1));
            if slot % 2 == 0 {
                current.push(corner);
                pieces.push(std::mem::take(&mut current));
            } else {
                current = vec![corner];
            }
            slot += 1;
            left = pattern[slot % pattern.len()];
        }
        left -= length - done;
        if slot % 2 == 0 {
            current.push(to);
        }
    }
    if slot % 2 == 0 && current.len() > 1 {
        pieces.push(current);
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    const WINDOW: Rectangle = Rectangle { left: 0.0, top: 0.0, right: 10.0, bottom: 10.0 };

    #[test]
    fn a_curve_that_leaves_and_returns_is_two_pieces() {
        let chain = [(5.0, 5.0), (5.0, 15.0), (8.0, 15.0), (8.0, 5.0)].map(Some);
        let pieces = clip_chain(&chain, &WINDOW);
        assert_eq!(pieces, vec![vec![(5.0, 5.0), (5.0, 10.0)], vec![(8.0, 10.0), (8.0, 5.0)]]);
    }

    #[test]
    fn a_missing_value_is_a_gap() {
        let chain = [Some((1.0, 1.0)), Some((2.0, 2.0)), None, Some((4.0, 4.0)), Some((5.0, 5.0))];
        assert_eq!(clip_chain(&chain, &WINDOW).len(), 2);
        assert!(clip_chain(&[Some((1.0, 1.0)), None], &WINDOW).is_empty());
    }

    #[test]
    fn a_polygon_is_cut_at_the_border() {
        let cut = clip_polygon(&[(5.0, 5.0), (15.0, 5.0), (15.0, 8.0), (5.0, 8.0)], &WINDOW);
        assert!(cut.iter().all(|&point| WINDOW.contains(point)));
        assert!(cut.contains(&(10.0, 5.0)) && cut.contains(&(10.0, 8.0)));
        assert!(clip_polygon(&[(20.0, 5.0), (30.0, 5.0), (30.0, 8.0)], &WINDOW).is_empty());
    }

    #[test]
    fn thinning_keeps_the_spike() {
        let mut chain: Vec<Point> = (0..100_000).map(|index| (f64::from(index) * 0.01, 50.0)).collect();
        chain[54_321].1 = 3.0;
        let thinned = thin(chain);
        assert!(thinned.len() < 4100, "{}", thinned.len());
        assert!(thinned.contains(&(543.21, 3.0)));
        assert_eq!(thinned.last(), Some(&(999.99, 50.0)));
    }

    #[test]
    fn dashes_keep_their_rhythm_round_corners() {
        let pieces = dashes(&[(0.0, 0.0), (5.0, 0.0), (5.0, 5.0)], &[3.0, 1.0]);
        assert_eq!(pieces[0], vec![(0.0, 0.0), (3.0, 0.0)]);
        assert_eq!(pieces[1], vec![(4.0, 0.0), (5.0, 0.0), (5.0, 2.0)]);
        assert_eq!(pieces[2], vec![(5.0, 3.0), (5.0, 5.0)]);
        assert_eq!(pieces.len(), 3);
    }
}
