//! Particle arrays at the start of a scene.

use crate::lanes::LaneTensors;
use crate::material::rheology::field::Memory;
use crate::vector::{Tensor, Vector};
use crate::weakly_compressible::enclosure::boundary_state::BoundaryState;
use crate::weakly_compressible::enclosure::facet_wall::BackingParticle;
use crate::weakly_compressible::memory;
use crate::weakly_compressible::wall_fields::WallFields;
use crate::weakly_compressible::{Particles, Scene, Surface};

impl<const D: usize> Particles<D> {
    /// Arrays for the flow and the walls of a scene, with the dummy particles of each facet wall.
    pub(crate) fn new(scene: &Scene<D>, backing: &[Vec<BackingParticle<D>>], enclosure: &BoundaryState<D>) -> Self {
        let Scene { flow, walls, wall_particles, .. } = scene;
        let (n, m) = (flow.position.len(), wall_particles.len() + backing.iter().map(Vec::len).sum::<usize>());
        let real = n + m;
        let mut particles = Self {
            position: flow.position.clone(),
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
        let of_planes = wall_particles.iter().map(|particle| {
            let wall = &walls[particle.wall];
            let (position, depth) = (particle.position, -wall.distance(&particle.position));
            let backing =
                BackingParticle { position, normal: wall.normal(), depth, volume: scene.spacing.powi(D as i32) };
            (backing, wall.velocity, wall.roughness, particle.wall)
        });
        let of_facets = backing.iter().enumerate().flat_map(|(index, backing)| {
            let (velocity, roughness) = (enclosure.velocity(index, 0.0), enclosure.walls[index].roughness);
            let shift = enclosure.poses[index].shift;
            let placed = move |own: &BackingParticle<D>| BackingParticle { position: own.position + shift, ..*own };
            backing.iter().map(move |own| (placed(own), velocity, roughness, walls.len() + index))
        });
        for (BackingParticle { position, normal, depth, volume }, velocity, roughness, wall) in
            of_planes.chain(of_facets)
        {
            particles.position.push(position);
            particles.volume.push(volume);
            particles.walls.push(normal, depth, velocity, roughness == Surface::Smooth);
            particles.wall.push(wall as u32);
        }
        particles
    }
}
