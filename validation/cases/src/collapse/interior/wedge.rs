//! What never moved: the part of a heap that the collapse leaves in its place, and the surface that bounds it.

use crate::collapse::ColumnFlow;
use crate::figure::{Axis, Field, Panel};
use crate::observation::Frame;
use crate::statistics::linear_fit;

/// The failure surface is read where the undisturbed part of a row has a length between these shares of the initial
/// half width `[-]`: beyond, symmetry plane and bed round it off.
const READ: (f64, f64) = (0.1, 0.95);

/// The undisturbed part of a heap. All particles are taken to have the same volume.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Wedge {
    /// Way from start to deposit `[m]`, one per particle.
    pub(crate) displacement: Vec<f64>,
    /// Share of the particles that moved by less than a spacing `[-]`.
    pub(crate) undisturbed: f64,
    /// The failure surface as (x, y), one point per row of the start `[m]`.
    pub(crate) boundary: Vec<(f64, f64)>,
    /// x = `line.0` + `line.1` y through the boundary `[m]` and `[-]`; none for fewer than three rows.
    pub(crate) line: Option<(f64, f64)>,
}

impl Wedge {
    /// Compares two pictures of the same particles, `half_width` wide at the start; of a heap in space the boundary is
    /// that of the slab beside the plane z = 0.
    pub(crate) fn between(start: &Frame, end: &Frame, half_width: f64, spacing: f64) -> Self {
        let way = |(from, to): (&[f64; 3], &[f64; 3])| {
            from.iter().zip(to).map(|(from, to)| (to - from) * (to - from)).sum::<f64>().sqrt()
        };
        let displacement: Vec<f64> = start.position.iter().zip(&end.position).map(way).collect();
        let still = displacement.iter().filter(|&&way| way < spacing).count();
        let mut rows: Vec<usize> = Vec::new();
        for (position, way) in start.position.iter().zip(&displacement) {
            let row = (position[1] / spacing).max(0.0) as usize;
            if rows.len() <= row {
                rows.resize(row + 1, 0);
            }
            if *way < spacing && position[2] < spacing {
                rows[row] += 1;
            }
        }
        let length = |(row, &count): (usize, &usize)| (count as f64 * spacing, (row as f64 + 0.5) * spacing);
        let boundary: Vec<(f64, f64)> = rows.iter().enumerate().map(length).collect();
        let read = |point: &&(f64, f64)| point.0 > READ.0 * half_width && point.0 < READ.1 * half_width;
        let points: Vec<(f64, f64)> = boundary.iter().filter(read).map(|&(x, y)| (y, x)).collect();
        let fit = if points.len() >= 3 { linear_fit(&points) } else { None };
        Self {
            undisturbed: still as f64 / displacement.len().max(1) as f64,
            displacement,
            boundary,
            line: fit.map(|fit| (fit.intercept, fit.slope)),
        }
    }

    /// Inclination of the failure surface against the bed `[°]`; none where it cannot be read or leans outwards.
    pub(crate) fn angle(&self) -> Option<f64> {
        self.line.filter(|line| line.1 < 0.0).map(|(_, lean)| libm::atan(-1.0 / lean).to_degrees())
    }
}

/// A deposit in the colours of the displacement, undisturbed particles in grey, dashed the initial column and the line
/// through the failure surface.
pub(crate) fn panel<const D: usize>(title: &str, run: &ColumnFlow<D>, end: &Frame, wedge: &Wedge) -> Panel {
    let (unit, spacing, height) = (run.half_width, run.spacing(), run.initial_height() * run.half_width);
    let mut panel = Panel::new(title, Axis::linear("x/r0 [-]"), Axis::linear("y/r0 [-]"));
    let seen: Vec<usize> = (0..end.position.len()).filter(|&index| end.position[index][2] < spacing).collect();
    let place = |&index: &usize| (end.position[index][0] / unit, end.position[index][1] / unit);
    let far = seen.iter().map(place).fold(1.0, |far: f64, place| far.max(place.0));
    let high = seen.iter().map(place).fold(0.0, |high: f64, place| high.max(place.1));
    panel.x.limits = Some((0.0, far + spacing / unit));
    // tall columns are cut: what is of interest is the deposit
    panel.y.limits = Some((0.0, 1.15 * high));
    let way = |&index: &usize| {
        let way = wedge.displacement[index];
        // grey
        if way < spacing { f64::NAN } else { way / unit }
    };
    let farthest = wedge.displacement.iter().copied().fold(0.0, f64::max) / unit;
    let (points, values) = (seen.iter().map(place), seen.iter().map(way));
    panel.field = Some(Field::new("d/r0 [-]", spacing / unit, (0.0, farthest), points, values));
    panel.reference("", [(0.0, height / unit), (1.0, height / unit), (1.0, 0.0)]);
    if let (Some((start, lean)), Some(_)) = (wedge.line, wedge.angle()) {
        let top = (-start / lean).min(height);
        panel.line("", 1, [(start / unit, 0.0), ((start + lean * top) / unit, top / unit)]);
    }
    panel
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(position: Vec<[f64; 3]>) -> Frame {
        Frame { time: 0.0, position, scalars: Vec::new(), vectors: Vec::new() }
    }

    #[test]
    fn a_block_that_slides_off_a_plane_of_sixty_degrees_leaves_that_plane() {
        // 40 × 40 particles; what lies above y = (1 − x) tan 60° moves away
        let spacing = 0.025;
        let place = |cell: usize| (cell as f64 + 0.5) * spacing;
        let start: Vec<[f64; 3]> = (0..1600).map(|k| [place(k % 40), place(k / 40), 0.0]).collect();
        let slope = 3f64.sqrt();
        let slides = |x: &[f64; 3]| x[1] > (1.0 - x[0]) * slope;
        let end = start.iter().map(|x| if slides(x) { [x[0] + 0.2, x[1], 0.0] } else { *x }).collect();
        let wedge = Wedge::between(&frame(start), &frame(end), 1.0, spacing);
        // the triangle above the plane has the area 1/(2 tan 60°)
        assert!((wedge.undisturbed - (1.0 - 0.5 / slope)).abs() < 0.01, "{}", wedge.undisturbed);
        let angle = wedge.angle().expect("a failure surface");
        assert!((angle - 60.0).abs() < 0.5, "{angle}");
        assert!((wedge.displacement.iter().copied().fold(0.0, f64::max) - 0.2).abs() < 1e-12);
    }

    #[test]
    fn uniform_motion_has_no_failure_surface() {
        let start: Vec<[f64; 3]> = (0..100).map(|k| [f64::from(k % 10), f64::from(k / 10), 0.0]).collect();
        let still = Wedge::between(&frame(start.clone()), &frame(start.clone()), 10.0, 1.0);
        assert_eq!((still.undisturbed, still.angle()), (1.0, None));
        let moved = start.iter().map(|x| [x[0], x[1] - 2.0, 0.0]).collect();
        let moved = Wedge::between(&frame(start), &frame(moved), 10.0, 1.0);
        assert_eq!((moved.undisturbed, moved.angle()), (0.0, None));
    }
}
