//! Scene from which a weakly compressible simulation starts.

use crate::domain::{AxisBoundary, Domain};
use crate::material::equation_of_state::EquationOfState;
use crate::material::pore_liquid::PoreLiquid;
use crate::material::rheology::Rheology;
use crate::material::rheology::field::Memory;
use crate::parameter::{ParameterProblem, range_problem};
use crate::run::SceneError;
use crate::vector::{Tensor, Vector};
use crate::weakly_compressible::enclosure::BoundarySet;
use crate::weakly_compressible::walls::wall::WallParticle;
use crate::weakly_compressible::{Numerics, SideWalls, Wall};

/// The flow particles at the start; all arrays have the shape `[particles]`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Flow<const D: usize> {
    /// Positions `[m]`.
    pub position: Vec<Vector<D>>,
    /// Velocities `[m/s]`.
    pub velocity: Vec<Vector<D>>,
    /// Densities `[kg/m³]`.
    pub density: Vec<f64>,
    /// Masses `[kg]`, per metre of depth in 2-D.
    pub mass: Vec<f64>,
    /// Deviatoric stresses `[Pa]`.
    pub stress: Vec<Tensor<D>>,
    /// Field of the law for each particle, in its own unit; empty for its initial value, and for a law without a field.
    pub field: Vec<f64>,
    /// Memory of the law beside its field; empty for its initial values, and for a law without a memory.
    pub memory: Vec<Memory<f64>>,
}

impl<const D: usize> Flow<D> {
    /// Particles at rest without stress, of one density `[kg/m³]` and a share `spacing`^D of the volume each.
    #[must_use]
    pub fn at_rest(position: Vec<Vector<D>>, density: f64, spacing: f64) -> Self {
        let count = position.len();
        Self {
            velocity: vec![Vector::zeros(); count],
            density: vec![density; count],
            mass: vec![density * (0..D).map(|_| spacing).product::<f64>(); count],
            stress: vec![Tensor::zeros(); count],
            field: Vec::new(),
            memory: Vec::new(),
            position,
        }
    }
}

/// Material, geometry, numerics and initial state.
#[derive(Debug, Clone)]
pub struct Scene<const D: usize> {
    /// Initial flow.
    pub flow: Flow<D>,
    /// Wall planes.
    pub walls: Vec<Wall<D>>,
    /// Wall particles, see [`crate::weakly_compressible::walls::wall::fill`].
    pub wall_particles: Vec<WallParticle<D>>,
    /// Facet walls, open sides and inlets.
    pub enclosure: BoundarySet<D>,
    /// Plates that rub on a plane flow from both sides.
    pub side_walls: Option<SideWalls>,
    /// Boundaries of the domain.
    pub domain: Domain<D>,
    /// Gravity `[m/s²]`.
    pub gravity: Vector<D>,
    /// Particle spacing Δ `[m]`.
    pub spacing: f64,
    /// Equation of state.
    pub equation_of_state: EquationOfState,
    /// Constitutive law.
    pub rheology: Rheology,
    /// Numerics.
    pub numerics: Numerics,
}

impl<const D: usize> Scene<D> {
    /// A flow without walls, gravity or bounds, by default numerics; the fields refine it.
    #[must_use]
    pub fn unbounded(flow: Flow<D>, spacing: f64, equation_of_state: EquationOfState, rheology: Rheology) -> Self {
        Self {
            flow,
            walls: Vec::new(),
            wall_particles: Vec::new(),
            enclosure: BoundarySet::default(),
            side_walls: None,
            domain: Domain { axes: [AxisBoundary::Open; D] },
            gravity: Vector::zeros(),
            spacing,
            equation_of_state,
            rheology,
            numerics: Numerics::default(),
        }
    }

    /// Largest list radius 2h (1 + skin) `[m]`.
    #[must_use]
    pub fn search_radius(&self) -> f64 {
        2.0 * self.numerics.smoothing_ratio * self.spacing * (1.0 + self.numerics.verlet_skin)
    }

    /// Checks that the scene can be simulated.
    ///
    /// # Errors
    /// The first rule that is broken.
    pub fn check(&self) -> Result<(), SceneError> {
        self.check_lengths()?;
        self.check_parameters()?;
        self.check_values()?;
        self.enclosure.check(self.spacing, self.equation_of_state.sound_speed())?;
        SceneError::check_periods(&self.domain, self.search_radius())
    }

    /// Arrays of one length, and empty only where an inlet feeds the flow.
    fn check_lengths(&self) -> Result<(), SceneError> {
        let expected = self.flow.position.len();
        if expected == 0 && self.enclosure.inlets.is_empty() {
            return Err(SceneError::Empty);
        }
        let lengths = [
            ("velocity", self.flow.velocity.len()),
            ("density", self.flow.density.len()),
            ("mass", self.flow.mass.len()),
            ("stress", self.flow.stress.len()),
        ];
        let field = self.rheology.field();
        let field_length = match field {
            Some(_) if !self.flow.field.is_empty() => Some(("field", self.flow.field.len())),
            None if !self.flow.field.is_empty() => {
                return Err(SceneError::NoField { law: self.rheology.name(), found: self.flow.field.len() });
            }
            _ => None,
        };
        let memory_length = match self.flow.memory.len() {
            0 => None,
            found if self.rheology.memories().is_empty() => {
                return Err(SceneError::NoMemory { law: self.rheology.name(), found });
            }
            found => Some(("memory", found)),
        };
        for (array, found) in lengths.into_iter().chain(field_length).chain(memory_length) {
            if found != expected {
                return Err(SceneError::Length { array, found, expected });
            }
        }
        Ok(())
    }

    /// Parameters in their ranges, alone and together.
    fn check_parameters(&self) -> Result<(), SceneError> {
        let parameters = [
            ("spacing", self.spacing),
            ("reference_density", self.equation_of_state.reference_density),
            ("bulk_modulus", self.equation_of_state.bulk_modulus),
        ];
        for (field, value) in parameters {
            if !is_positive(value) {
                let (rule, remedy) = ("positive and finite", "give it in SI units");
                return Err(ParameterProblem::new(field, value, rule, remedy).into());
            }
        }
        let facet_walls = self.enclosure.walls.iter().map(|wall| wall.roughness);
        let mut surfaces = self.walls.iter().map(|wall| wall.roughness).chain(facet_walls);
        let problem = range_problem(&self.numerics)
            .or_else(|| self.rheology.parameter_problem())
            .or_else(|| surfaces.find_map(|roughness| self.numerics.wall_problem(roughness)))
            .or_else(|| self.numerics.step_problem(&self.rheology))
            .or_else(|| self.numerics.field_problem(&self.rheology))
            .or_else(|| self.enclosure.numerics_problem(&self.numerics))
            .or_else(|| {
                let scale = (self.spacing, self.equation_of_state.bulk_modulus);
                let parts = (!self.enclosure.inlets.is_empty(), self.side_walls.is_some());
                let problem = |pore| pore_problem(&pore, &self.numerics, scale, parts);
                self.rheology.pore_liquid().and_then(problem)
            })
            .or_else(|| self.side_walls.and_then(|walls| walls.problem(D)));
        problem.map_or(Ok(()), |problem| Err(problem.into()))
    }

    /// Values of every particle that make sense.
    fn check_values(&self) -> Result<(), SceneError> {
        let rule = "finite and in the range that its law gives";
        if let Some(field) = self.rheology.field() {
            for (particle, &value) in self.flow.field.iter().enumerate() {
                if !field.holds(value) {
                    return Err(SceneError::Value { quantity: field.name, particle, value, rule });
                }
            }
        }
        for (place, memory) in self.rheology.memories().iter().enumerate() {
            for (particle, values) in self.flow.memory.iter().enumerate() {
                if !memory.holds(values[place]) {
                    return Err(SceneError::Value { quantity: memory.name, particle, value: values[place], rule });
                }
            }
        }
        for (particle, position) in self.flow.position.iter().enumerate() {
            let finite = [
                ("position", position.sum()),
                ("velocity", self.flow.velocity[particle].sum()),
                ("stress", self.flow.stress[particle].sum()),
            ];
            for (quantity, value) in finite {
                if !value.is_finite() {
                    return Err(SceneError::Value { quantity, particle, value, rule: "finite" });
                }
            }
            for (quantity, value) in [("density", self.flow.density[particle]), ("mass", self.flow.mass[particle])] {
                if !is_positive(value) {
                    return Err(SceneError::Value { quantity, particle, value, rule: "positive and finite" });
                }
            }
        }
        Ok(())
    }
}

/// A mixture of grains and liquid that is not served, if it is one: whose pores drain too fast for explicit steps at a spacing `[m]` and a
/// bulk modulus `[Pa]`, which is fed, or which side walls rub.
#[must_use]
pub fn pore_problem(
    pore: &PoreLiquid,
    numerics: &Numerics,
    (spacing, bulk_modulus): (f64, f64),
    (has_inlets, has_side_walls): (bool, bool),
) -> Option<ParameterProblem> {
    if has_inlets {
        let defect = "not supported with a pore liquid, because fed material has no pore pressure";
        return Some(ParameterProblem::new("inlets", defect, "", "leave them out, and give all material as `bodies`"));
    }
    if has_side_walls {
        let defect = "not supported with a pore liquid, whose pressure would count as pressure of the grains";
        return Some(ParameterProblem::new("side_walls", defect, "", "leave them out"));
    }
    let sound_speed = (bulk_modulus / pore.mixture_density()).sqrt();
    let least = pore.least_length(bulk_modulus, numerics.acoustic_courant / sound_speed) / numerics.smoothing_ratio;
    (spacing < least).then(|| {
        // rounded upwards
        let least = format!("{:.3e}", 1.0005 * least).parse().unwrap_or(least);
        let rule = format!("at least {least} m for a stable time step of the pore pressure");
        let remedy = "raise it, lower `stiffness`, or check `grain_diameter` and `liquid_viscosity`";
        ParameterProblem::new("spacing", format!("{spacing} m"), &rule, remedy)
    })
}

fn is_positive(value: f64) -> bool {
    value > 0.0 && value.is_finite()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::equation_of_state::Tension;
    use crate::material::rheology::Newtonian;

    type Spoil = fn(&mut Scene<2>, f64);

    #[test]
    fn values_that_must_be_positive_are_refused_by_their_field() {
        let equation_of_state = EquationOfState { reference_density: 1e3, bulk_modulus: 1e5, tension: Tension::Kept };
        let flow = Flow::at_rest(vec![Vector::<2>::zeros()], 1e3, 0.01);
        let law = Rheology::Newtonian(Newtonian { viscosity: 1.0 });
        let scene = Scene::unbounded(flow, 0.01, equation_of_state, law);
        assert!(scene.check().is_ok());
        let fields: [(&str, Spoil); 5] = [
            ("spacing", |scene, value| scene.spacing = value),
            ("reference_density", |scene, value| scene.equation_of_state.reference_density = value),
            ("bulk_modulus", |scene, value| scene.equation_of_state.bulk_modulus = value),
            ("density", |scene, value| scene.flow.density[0] = value),
            ("mass", |scene, value| scene.flow.mass[0] = value),
        ];
        for (name, spoil) in fields {
            for value in [0.0, -1.0, f64::INFINITY, f64::NAN] {
                let mut bad = scene.clone();
                spoil(&mut bad, value);
                let message = bad.check().expect_err("refused").to_string();
                assert!(message.contains(name) && message.contains("positive and finite"), "{message}");
            }
        }
    }
}
