//! Particle arrays at the start of a scene.

use crate::lanes::LaneTensors;
use crate::material::rheology::field::Memory;
use crate::vector::{Tensor, Vector};
use crate::weakly_compressible::enclosure::shell::BackingParticle;
use crate::weakly_compressible::memory;
use crate::weakly_compressible::particles::Particles;
use crate::weakly_compressible::scene::Scene;
use crate::weakly_compressible::wall_fields::WallFields;
use crate::weakly_compressible::walls::Surface;

impl<const D: usize> Particles<D> {
    /// Arrays for the flow, the walls and the shells of a scene, with the dummy particles of each shell.
    pub(crate) fn new(scene: &Scene<D>, backing: &[Vec<BackingParticle<D>>]) -> Self {
        let Scene { flow, walls, wall_particles, .. } = scene;
        let (n, m) = (flow.position.len(), wall_particles.len() + backing.iter().map(Vec::len).sum::<usize>());
        let real = n + m;
        let surfaces = scene.enclosure.surfaces();
        let first_inlet = scene.enclosure.shells.len();
        let places = wall_particles
            .iter()
            .map(|wall| wall.position)
            .chain(backing.iter().flatten().map(|particle| particle.position));
        let mut particles = Self {
            position: flow.position.iter().copied().chain(places).collect(),
            velocity: flow.velocity.clone(),
            velocity_gradient: vec![Tensor::zeros(); real],
            stress: flow.stress.clone(),
            density: flow.density.clone(),
            pressure: vec![0.0; real],
            volume: flow.mass.iter().zip(&flow.density).map(|(m, rho)| m / rho).collect(),
            artificial_viscosity: vec![0.0; real],
            corrected_stress: vec![Tensor::zeros(); real],
            pressure_gradient: vec![Vector::zeros(); real],
            viscosity: vec![0.0; real],
            field: scene.rheology.field().map(|field| {
                let given = !flow.field.is_empty();
                let mut values = if given { flow.field.clone() } else { vec![field.initial; n] };
                values.resize(real, 0.0);
                values
            }),
            memory: memory::initial(scene.rheology.memories()).map(|initial| {
                let given = !flow.memory.is_empty();
                let mut values = if given { flow.memory.clone() } else { vec![initial; n] };
                values.resize(real, Memory::default());
                values
            }),
            walls: WallFields::default(),
            mirrored: Vec::new(),
            identity: (0..n as u32).collect(),
            mass: flow.mass.clone(),
            correction: LaneTensors::new(n),
            force_correction: LaneTensors::new(n),
            acceleration: vec![Vector::zeros(); n],
            support: vec![Vector::zeros(); n],
            by_walls: vec![Vector::zeros(); n],
            by_damping: vec![Vector::zeros(); n],
            by_wall_control: vec![Vector::zeros(); n],
            support_impulse: vec![Vector::zeros(); n],
            wall: Vec::with_capacity(m),
            flow: n,
        };
        particles.velocity.resize(real, Vector::zeros());
        particles.stress.resize(real, Tensor::zeros());
        particles.density.resize(real, scene.equation_of_state.reference_density);
        particles.volume.resize(n + wall_particles.len(), scene.spacing.powi(D as i32));
        particles.volume.extend(backing.iter().flatten().map(|particle| particle.volume));
        for particle in wall_particles {
            let wall = &walls[particle.wall];
            let depth = -wall.distance(&particle.position);
            particles.walls.push(wall.normal(), depth, wall.velocity, wall.roughness == Surface::Smooth);
            particles.wall.push(particle.wall as u32);
        }
        for (index, (shell, backing)) in surfaces.iter().zip(backing).enumerate() {
            let of_inlet = index.checked_sub(first_inlet).map(|inlet| &scene.enclosure.inlets[inlet]);
            let rows = of_inlet.map(|inlet| inlet.direction() * inlet.speed(0.0));
            for particle in backing {
                let is_smooth = shell.roughness == Surface::Smooth;
                let velocity = rows.unwrap_or_else(|| shell.motion.velocity(0.0));
                particles.walls.push(particle.normal, particle.depth, velocity, is_smooth);
                particles.wall.push((walls.len() + index) as u32);
            }
        }
        particles
    }
}
