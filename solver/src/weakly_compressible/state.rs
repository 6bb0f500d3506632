//! State of a run that changes from step to step.

use crate::kernel::Kernel;
use crate::lanes::InstructionSet;
use crate::material::equation_of_state::Tension;
use crate::run::Divergence;
use crate::vector::Vector;
use crate::weakly_compressible::divergence::{OutOfRange, Quantity};
use crate::weakly_compressible::enclosure::boundary_state::BoundaryState;
use crate::weakly_compressible::enclosure::facet_wall::BackingParticle;
use crate::weakly_compressible::neighbours::LARGEST_ROW;
use crate::weakly_compressible::search::Search;
use crate::weakly_compressible::terms::artificial_stress::ArtificialStress;
use crate::weakly_compressible::time_step::TimeStepBounds;
use crate::weakly_compressible::viscous_solve::ViscousSystem;
use crate::weakly_compressible::{
    EnergyLedger, Images, Model, Numerics, PairData, Particles, Scene, SideWalls, VerletList, Wall,
};

/// Particles, walls and neighbours, time, and what the next step's length follows from.
#[derive(Debug)]
pub struct State<const D: usize> {
    /// The particles.
    pub particles: Particles<D>,
    /// Images of particles across periodic and mirrored axes.
    pub images: Images<D>,
    pub(crate) walls: Vec<Wall<D>>,
    /// Displacement of each wall in a step `[m]`.
    pub(crate) wall_displacements: Vec<Vector<D>>,
    /// Facet walls, open sides and inlets.
    pub(crate) enclosure: BoundaryState<D>,
    pub(crate) side_walls: Option<SideWalls>,
    /// Impulse that side walls have given to the flow since the start `[kg m/s]`, and in a step block by block.
    pub(crate) side_wall_impulse: Vector<D>,
    pub(crate) side_wall_blocks: Vec<Vector<D>>,
    /// Material and numerics.
    pub model: Model<D>,
    /// Data of pairs.
    pub pairs: PairData<D>,
    /// The implicit viscous step.
    pub viscous: ViscousSystem<D>,
    pub(crate) search: Search<D>,
    pub(crate) energy: EnergyLedger,
    pub(crate) time: f64,
    pub(crate) steps: u64,
    pub(crate) largest_speed: f64,
    /// Largest speed of a particle relative to the frame of the boundaries `[m/s]`.
    pub(crate) relative_speed: f64,
    /// Largest diffusivity that bounds an explicit step `[m²/s]`.
    pub(crate) diffusivity: f64,
    /// Upper bound of any particle's displacement since the neighbour search `[m]`.
    pub(crate) displacement: f64,
}

impl<const D: usize> State<D> {
    /// The state of a checked scene with the dummy particles of each facet wall, before its first neighbour search.
    pub(crate) fn new(mut scene: Scene<D>, backing: &[Vec<BackingParticle<D>>]) -> Self {
        let numerics = scene.numerics;
        let kernel = Kernel::new(numerics.kernel, numerics.smoothing_ratio * scene.spacing);
        let planes = (scene.walls.len(), scene.wall_particles.len());
        let (enclosure, flow) = (std::mem::take(&mut scene.enclosure), scene.flow.position.len());
        let enclosure = BoundaryState::new(enclosure, scene.spacing, planes, flow, backing);
        let mut particles = Particles::new(&scene, backing, &enclosure);
        enclosure.turn(&mut particles, &scene.domain, 0.0);
        particles.viscosity.fill(scene.rheology.viscosity(0.0, 0.0));
        let model = Model {
            list: VerletList::default(),
            kernel,
            equation_of_state: scene.equation_of_state,
            rheology: scene.rheology,
            numerics,
            gravity: scene.gravity,
            spacing: scene.spacing,
            contact_friction: scene.rheology.contact_friction(),
            instruction_set: InstructionSet::best(),
            field: scene.rheology.field(),
            full_weight: lattice_weight::<D>(&numerics, scene.spacing),
            lone_density_per_mass: match scene.equation_of_state.tension {
                Tension::Cut => kernel.value_at(0.0),
                Tension::Kept => 0.0,
            },
            dilates: scene.rheology.dilates(),
            pore_liquid: scene.rheology.pore_liquid(),
            turns: enclosure.walls.iter().any(|wall| wall.motion.turn.is_some()),
            artificial_stress: (scene.rheology.is_cohesive()).then(|| ArtificialStress::new(&kernel, scene.spacing)),
        };
        particles.artificial_viscosity.fill(model.initial_artificial_viscosity());
        Self {
            particles,
            images: Images::default(),
            wall_displacements: vec![Vector::zeros(); scene.walls.len()],
            walls: scene.walls,
            enclosure,
            side_walls: scene.side_walls,
            side_wall_impulse: Vector::zeros(),
            side_wall_blocks: Vec::new(),
            model,
            pairs: PairData::default(),
            viscous: ViscousSystem::new(),
            search: Search::new(scene.domain),
            energy: EnergyLedger::default(),
            time: 0.0,
            steps: 0,
            largest_speed: 0.0,
            relative_speed: 0.0,
            diffusivity: 0.0,
            displacement: f64::INFINITY,
        }
    }

    /// Takes in the rows of inlets that have reached their openings; whether there were any, so that neighbours have to be searched.
    ///
    /// # Errors
    /// A row that the material before its opening does not give way to.
    pub(crate) fn feed(&mut self) -> Result<bool, Divergence<D>> {
        let fed = self.enclosure.feed(&mut self.particles, &self.model, self.time);
        let fastest = fed.map_err(|out_of_range| self.diverged(out_of_range))?;
        self.largest_speed = self.largest_speed.max(fastest.unwrap_or(0.0));
        Ok(fastest.is_some())
    }

    /// Searches the neighbours anew and sorts the particles.
    ///
    /// # Errors
    /// A particle with more neighbours than a list row can hold.
    pub(crate) fn search_neighbours(&mut self) -> Result<(), Divergence<D>> {
        self.enclosure.release(&mut self.particles, &self.model, self.time);
        let filled = self.search.run(&mut self.particles, &mut self.images, &mut self.model);
        self.displacement = 0.0;
        self.enclosure.assign_owners(&self.particles, &self.images);
        if let Some(found) = self.enclosure.find_driven_out(self.model.equation_of_state.sound_speed(), self.time) {
            return Err(self.diverged(found));
        }
        filled.map_err(|crowded| {
            self.divergence(crowded, Quantity::Neighbours { limit: LARGEST_ROW }, LARGEST_ROW as f64)
        })
    }

    /// The bounds of a step with a largest diffusivity `[m²/s]`.
    pub(crate) fn bounds_with(&self, diffusivity: f64) -> TimeStepBounds {
        TimeStepBounds::new(
            &self.model.numerics,
            self.model.kernel.smoothing_length(),
            self.model.equation_of_state.sound_speed(),
            self.relative_speed + self.enclosure.largest_speed(),
            diffusivity,
        )
    }

    /// A divergence at the particle with this storage index.
    pub fn divergence(&self, index: usize, quantity: Quantity, value: f64) -> Divergence<D> {
        let identity = self.particles.identity.get(index).copied().unwrap_or(index as u32);
        self.diverged(OutOfRange { index, identity, quantity, value })
    }

    /// The divergence of a particle now.
    pub(crate) fn diverged(&self, OutOfRange { index, identity, quantity, value }: OutOfRange) -> Divergence<D> {
        let (name, unit, mut rule) = quantity.texts();
        let law = self.model.rheology.name();
        let mut given = self.particles.viscosity.iter().chain(self.particles.stress.iter().flatten());
        if given.any(|number| !number.is_finite()) {
            rule += &format!("; the law `{law}` gives a viscosity or stress that is not finite");
        }
        Divergence {
            time: self.time,
            step: self.steps,
            particle: identity,
            position: self.particles.position[index],
            quantity: name,
            value,
            unit,
            rule,
        }
    }
}

/// Σ −2 V F over the neighbours of a particle of a lattice `[1/m²]`.
fn lattice_weight<const D: usize>(numerics: &Numerics, spacing: f64) -> f64 {
    let kernel = Kernel::<D>::new(numerics.kernel, numerics.smoothing_ratio * spacing);
    let volume = spacing.powi(D as i32);
    let reach = (kernel.support() / spacing) as i32;
    let side = 2 * reach as usize + 1;
    let mut sum = 0.0;
    for site in 0..side.pow(D as u32) {
        let (mut rest, mut square) = (site, 0.0);
        for _ in 0..D {
            square += f64::from((rest % side) as i32 - reach).powi(2);
            rest /= side;
        }
        if square > 0.0 {
            sum -= 2.0 * kernel.gradient_weight(square * spacing * spacing, volume);
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_weight_of_a_lattice_is_that_of_all_its_sites_within_reach() {
        // two diagonals of two spacings are just within reach
        let (numerics, spacing) = (Numerics { smoothing_ratio: 1.49, ..Numerics::default() }, 0.02);
        let (plane, space) = (Kernel::<2>::new(numerics.kernel, 0.0298), Kernel::<3>::new(numerics.kernel, 0.0298));
        let (mut in_plane, mut in_space) = (0.0, 0.0);
        let sites = || (-4..=4).map(|site| f64::from(site) * spacing);
        for (x, y) in sites().flat_map(|x| sites().map(move |y| (x, y))).filter(|site| *site != (0.0, 0.0)) {
            in_plane -= 2.0 * spacing.powi(2) * plane.gradient_factor_at(x.hypot(y));
        }
        for (x, y, z) in sites().flat_map(|x| sites().flat_map(move |y| sites().map(move |z| (x, y, z)))) {
            let distance = x.hypot(y).hypot(z);
            in_space -= if distance > 0.0 { 2.0 * spacing.powi(3) * space.gradient_factor_at(distance) } else { 0.0 };
        }
        assert!((lattice_weight::<2>(&numerics, spacing) / in_plane - 1.0).abs() < 1e-13);
        assert!((lattice_weight::<3>(&numerics, spacing) / in_space - 1.0).abs() < 1e-13);
    }
}
