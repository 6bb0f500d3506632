//! A gate: a smooth plate across the flow that is pulled up along its own plane.

use super::wall::{Surface, Wall, WallParticle};
use crate::vector::Vector;

/// A plate normal to the first axis, lifted along the second.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gate {
    /// Position of the gate's upstream face `[m]`.
    pub position: f64,
    /// Coordinate of the gate's lower edge at the start `[m]`.
    pub edge: f64,
    /// Height `[m]`.
    pub height: f64,
    /// Speed at which it is pulled up `[m/s]`.
    pub speed: f64,
    /// Distance by which the gate is pulled up `[m]`.
    pub lift: f64,
    /// Rows of particles through its thickness: enough to keep both sides apart.
    pub rows: usize,
}

impl Gate {
    /// Walls and particles at the flow's spacing `[m]`, in the plane; `first_wall` is the place of its first wall
    /// among those of the scene.
    #[must_use]
    pub fn build(&self, spacing: f64, first_wall: usize) -> (Vec<Wall<2>>, Vec<WallParticle<2>>) {
        let thickness = self.rows as f64 * spacing;
        let downstream = self.position + thickness;
        let middle = self.position + 0.5 * thickness;
        let (far, velocity) = (f64::INFINITY, Vector::<2>::new(0.0, self.speed));
        let travel = if self.speed > 0.0 { self.lift } else { 0.0 };
        let velocity = if travel > 0.0 { velocity } else { Vector::zeros() };
        let face = |axis: usize, surface: f64, side: f64, region: ([f64; 2], [f64; 2])| Wall {
            axis,
            surface,
            side,
            velocity,
            roughness: Surface::Smooth,
            travel,
            region: Some((Vector::<2>::from(region.0), Vector::<2>::from(region.1))),
        };
        let walls = vec![
            face(0, self.position, -1.0, ([-far, self.edge], [middle, far])),
            face(0, downstream, 1.0, ([middle, self.edge], [far, far])),
            face(1, self.edge, -1.0, ([self.position, -far], [downstream, self.edge + 0.5 * thickness])),
        ];
        let mut particles = Vec::new();
        for row in 0..(self.height / spacing).ceil() as usize {
            for column in 0..self.rows {
                let along = |cells: usize| (cells as f64 + 0.5) * spacing;
                let position = Vector::<2>::new(self.position + along(column), self.edge + along(row));
                // in half spacings: a corner is as near to two faces, and rounding must not choose between them
                let depth = |wall: &Wall<2>| (-wall.distance(&position) / (0.5 * spacing)).round();
                let nearest = (0..walls.len()).min_by(|&a, &b| depth(&walls[a]).total_cmp(&depth(&walls[b])));
                particles.push(WallParticle { position, wall: first_wall + nearest.unwrap_or(0) });
            }
        }
        (walls, particles)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GATE: Gate = Gate { position: 0.2, edge: 0.0, height: 0.1, speed: 1.5, lift: 0.3, rows: 4 };

    #[test]
    fn its_particles_belong_to_the_face_they_are_nearest_to() {
        let (walls, particles) = GATE.build(0.01, 1);
        assert_eq!((walls.len(), particles.len()), (3, 40));
        let owner = |x: f64, y: f64| {
            let near = |p: &&WallParticle<2>| (p.position - Vector::<2>::new(x, y)).norm() < 1e-9;
            particles.iter().find(near).map(|p| p.wall)
        };
        assert_eq!(owner(0.205, 0.045), Some(1));
        assert_eq!(owner(0.235, 0.045), Some(2));
        assert_eq!(owner(0.215, 0.005), Some(3));
        assert!(particles.iter().all(|p| walls[p.wall - 1].distance(&p.position) < 0.0));
    }

    #[test]
    fn it_rises_by_its_lift_and_then_stands_still() {
        let (mut walls, _) = GATE.build(0.01, 0);
        let below = Vector::<2>::new(0.21, 0.05);
        assert!(walls[2].faces(&Vector::<2>::new(0.21, -0.01)) && walls[0].faces(&Vector::<2>::new(0.19, 0.05)));
        let mut risen = 0.0;
        for _ in 0..300 {
            risen += walls[2].advance(0.001)[1];
        }
        assert!((risen - 0.3).abs() < 1e-12 && (walls[2].surface - 0.3).abs() < 1e-12);
        assert_eq!((walls[2].travel, walls[2].velocity), (0.0, Vector::zeros()));
        assert!(walls[2].faces(&below), "what flows under it is faced by its edge");
        for _ in 0..300 {
            let _ = walls[0].advance(0.001);
        }
        assert!(!walls[0].faces(&Vector::<2>::new(0.19, 0.05)), "an open gate holds nothing back");
        assert!(walls[0].surface == 0.2);
    }
}
