//! Friction of the grains of a column, implicit: m (u − uⁿ) = Δt (forces + τ above − τ below) with τ = η(γ, p′) γ of any
//! law at the faces between nodes, γ = ∂_z u and the overburden p′ as its pressure, and what the water between the grains
//! adds, (1 − φ) ρ_f ν (η_r − 1) γ.
//!
//! Newton's method with the tangent of the stress and a share of the way from it to the secant: tangents alone overshoot
//! where the friction yields, secants alone crawl. The share grows until secants are all there is, so that the iteration
//! ends. A node without mass needs no special case: the stress above it is that below.

use super::super::{ColumnNumerics, MOST_ITERATIONS};
use crate::material::rheology::Rheology;

/// Free nodes of a column that rub on each other, from the lowest one up; the first lies above one that is held.
#[derive(Debug, Default)]
pub(crate) struct Chain {
    /// Indices of the nodes.
    pub(crate) node: Vec<usize>,
    /// Masses `[kg/m²]`.
    pub(crate) mass: Vec<f64>,
    /// Momenta without friction `[kg/(m s)]`.
    pub(crate) momentum: Vec<f64>,
    /// Velocities `[m/s]`: a guess before the solve.
    pub(crate) velocity: Vec<f64>,
    /// Distances from the node below `[m]`.
    pub(crate) distance: Vec<f64>,
    /// p′ of the face below `[Pa]`.
    pub(crate) load_below: Vec<f64>,
    /// Viscosity that the water between the grains adds there `[Pa·s]`.
    pub(crate) added_below: Vec<f64>,
}

impl Chain {
    /// No nodes.
    pub(crate) fn clear(&mut self) {
        self.node.clear();
        self.fields().into_iter().for_each(Vec::clear);
    }

    /// Room for a number of nodes.
    pub(crate) fn reserve(&mut self, nodes: usize) {
        self.node.reserve(nodes);
        self.fields().into_iter().for_each(|field| field.reserve(nodes));
    }

    fn fields(&mut self) -> impl IntoIterator<Item = &mut Vec<f64>> {
        let Self { node: _, mass, momentum, velocity, distance, load_below, added_below } = self;
        [mass, momentum, velocity, distance, load_below, added_below]
    }
}

/// Storage of the solve, and the stress on the held node in the last one.
#[derive(Debug, Default)]
pub(crate) struct FrictionSolve {
    lower: Vec<f64>,
    diagonal: Vec<f64>,
    right: Vec<f64>,
}

/// A stress at a shear rate.
#[derive(Debug, Clone, Copy)]
struct Stress {
    /// τ `[Pa]`.
    value: f64,
    /// dτ/dγ `[Pa·s]`.
    tangent: f64,
    /// τ/γ `[Pa·s]`.
    secant: f64,
}

/// τ of a law and of an added viscosity `[Pa·s]`, with its derivative from a difference of rates `[1/s]`.
fn stress(law: &Rheology, rate: f64, pressure: f64, added: f64, difference: f64) -> Stress {
    let speed = rate.abs();
    let friction = law.viscosity(speed, pressure);
    let beside = speed + difference;
    let tangent = ((law.viscosity(beside, pressure) * beside - friction * speed) / difference).max(0.0);
    let secant = friction + added;
    Stress { value: secant * rate, tangent: tangent + added, secant }
}

impl FrictionSolve {
    /// Room for columns of a number of nodes.
    pub(crate) fn reserve(&mut self, nodes: usize) {
        for array in [&mut self.lower, &mut self.diagonal, &mut self.right] {
            array.reserve(nodes);
        }
    }

    /// Velocities of a chain after a step `[s]`; returns the stress on what is held `[Pa]`.
    ///
    /// # Errors
    /// No convergence: the last change of a velocity `[m/s]`.
    pub(crate) fn solve(
        &mut self,
        law: &Rheology,
        time_step: f64,
        chain: &mut Chain,
        numerics: &ColumnNumerics,
    ) -> Result<f64, f64> {
        let mut change = 0.0;
        for iteration in 0..MOST_ITERATIONS {
            let share = (numerics.secant_share * (1 + iteration) as f64).min(1.0);
            let (stress, stiffness) = self.assemble(law, time_step, chain, (share, numerics.friction_tolerance));
            change = self.correct(&mut chain.velocity);
            if change < numerics.friction_tolerance {
                // with the last correction the sum of all rows closes to rounding, whatever the tolerance is
                return Ok(stress + stiffness * self.right.first().copied().unwrap_or_default() / time_step);
            }
            if change.is_nan() {
                break;
            }
        }
        Err(change)
    }

    /// The rows (M + Δt dτ/du) δ = m (uⁿ − u) + Δt (forces + friction); returns the stress on what is held `[Pa]`, and its
    /// Δt dτ/du `[kg/m²]`.
    fn assemble(
        &mut self,
        law: &Rheology,
        time_step: f64,
        chain: &Chain,
        (share, tolerance): (f64, f64),
    ) -> (f64, f64) {
        let Chain { mass, momentum, velocity, distance, load_below, added_below, .. } = chain;
        let Self { lower, diagonal, right } = self;
        diagonal.clear();
        diagonal.extend_from_slice(mass);
        right.clear();
        right.extend(momentum.iter().zip(mass).zip(velocity).map(|((momentum, mass), u)| momentum - mass * u));
        lower.clear();
        lower.resize(mass.len(), 0.0);
        let mut held = (0.0, 0.0);
        for node in 0..mass.len() {
            let below = if node == 0 { 0.0 } else { velocity[node - 1] };
            let cell = distance[node];
            let rate = (velocity[node] - below) / cell;
            let difference = tolerance / cell + f64::EPSILON.sqrt() * rate.abs();
            let stress = stress(law, rate, load_below[node], added_below[node], difference);
            let stiffness = (stress.tangent + share * (stress.secant - stress.tangent).max(0.0)) * time_step / cell;
            diagonal[node] += stiffness;
            right[node] -= stress.value * time_step;
            if node == 0 {
                held = (stress.value, stiffness);
            } else {
                lower[node] = -stiffness;
                diagonal[node - 1] += stiffness;
                right[node - 1] += stress.value * time_step;
            }
        }
        held
    }

    /// Solves the symmetric tridiagonal rows and adds the corrections; returns the largest of them `[m/s]`.
    fn correct(&mut self, velocity: &mut [f64]) -> f64 {
        let Self { lower, diagonal, right } = self;
        for node in 1..velocity.len() {
            let factor = lower[node] / diagonal[node - 1];
            diagonal[node] -= factor * lower[node];
            right[node] -= factor * right[node - 1];
        }
        let mut largest = 0.0_f64;
        for node in (0..velocity.len()).rev() {
            if let (Some(above), Some(coupling)) = (right.get(node + 1).copied(), lower.get(node + 1)) {
                right[node] -= coupling * above;
            }
            right[node] /= diagonal[node];
            velocity[node] += right[node];
            largest = if right[node].is_nan() { f64::NAN } else { largest.max(right[node].abs()) };
            if largest.is_nan() {
                break;
            }
        }
        largest
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::rheology::RootMuI;

    const PACKING: f64 = 0.6;
    const DENSITY: f64 = 2600.0;

    const LAW: Rheology = Rheology::RootMuI(RootMuI {
        static_friction: 0.35,
        limiting_friction: 0.97,
        reference_inertia: 0.69,
        grain_diameter: 5e-3,
        grain_density: DENSITY,
        regularisation_rate: 5e-3,
    });

    /// In steady motion the stress at every face is what drives the nodes above it, and the law says the rate there.
    #[test]
    fn friction_tends_to_the_profile_of_the_law() {
        let (count, cell, time_step) = (40, 5e-4, 1e-3);
        let mass = vec![PACKING * DENSITY * cell; count];
        let load = |face: usize| (count - face) as f64 * PACKING * cell * 15_696.0;
        let load_below: Vec<f64> = (0..count).map(load).collect();
        // 0.36 to 0.6 of the load, from the base up
        let stress = |face: usize| load(face) * (0.36 + 0.24 * face as f64 / count as f64);
        let force: Vec<f64> =
            (0..count).map(|node| stress(node) - if node + 1 < count { stress(node + 1) } else { 0.0 }).collect();
        let mut chain = Chain {
            node: (0..count).collect(),
            mass: mass.clone(),
            momentum: vec![0.0; count],
            velocity: vec![0.0; count],
            distance: vec![cell; count],
            load_below,
            added_below: vec![0.0; count],
        };
        let mut solve = FrictionSolve::default();
        let numerics = ColumnNumerics { friction_tolerance: 1e-12, ..ColumnNumerics::default() };
        for _ in 0..20_000 {
            for node in 0..count {
                chain.momentum[node] = mass[node] * chain.velocity[node] + force[node] * time_step;
            }
            let held = solve.solve(&LAW, time_step, &mut chain, &numerics).expect("solved");
            assert!(held <= stress(0) * (1.0 + 1e-9));
        }
        let mut expected = 0.0;
        for node in 0..count {
            let (mut low, mut high) = (0.0, 1e3);
            for _ in 0..100 {
                let middle = 0.5 * (low + high);
                if LAW.viscosity(middle, load(node)) * middle < stress(node) { low = middle } else { high = middle }
            }
            expected += low * cell;
            let velocity = chain.velocity[node];
            assert!((velocity / expected - 1.0).abs() < 1e-6, "node {node}: {velocity} or {expected}");
        }
    }

    #[test]
    fn a_node_without_mass_passes_the_stress_on() {
        let (cell, time_step) = (5e-4, 1e-4);
        let solve = |mass: &[f64], momentum: &[f64], load_below: &[f64]| {
            let [mass, momentum, load_below] = [mass, momentum, load_below].map(<[f64]>::to_vec);
            let [velocity, distance, added_below] = [0.0, cell, 0.0].map(|value| vec![value; 3]);
            let mut chain = Chain { node: vec![0, 1, 2], mass, momentum, velocity, distance, load_below, added_below };
            FrictionSolve::default().solve(&LAW, time_step, &mut chain, &ColumnNumerics::default()).expect("solved");
            chain.velocity
        };
        let velocity = solve(&[0.8, 0.0, 0.8], &[1e-3, 0.0, 4e-3], &[9.4, 4.7, 4.7]);
        assert!(velocity.iter().all(|u| u.is_finite()) && velocity.is_sorted(), "{velocity:?}");
        assert!((velocity[1] - 0.5 * (velocity[0] + velocity[2])).abs() < 1e-6, "{velocity:?}");
    }
}
