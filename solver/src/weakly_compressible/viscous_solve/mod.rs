//! The implicit viscous step: (M + Δt K) δ = M Δt a(vⁿ), vⁿ⁺¹ = vⁿ + δ.
//!
//! a is the acceleration of the explicit step, viscous forces included, and K their response to a change of the
//! velocities at the viscosity of the old state: implicit Euler with η lagged, written in increments. So a steady
//! state is that of the explicit step, whatever K and the tolerance are, with its wall stresses and its force
//! correction; K decides how a step answers to forces that are out of balance. (Solved for vⁿ⁺¹ with −K v as the only
//! viscous force, the symmetric wall below makes Bagnold's layer at 24° slip by 3 % of its velocity at 20 rows, and what
//! the tolerance leaves does not average out: 3 % of the forces were 0.4 % of the stress and 2 % of the velocity.)
//!
//! K = Gᵀ (2 η V) G with G the deviatoric symmetric part of the velocity gradient. For v_ab = v_a − v_b, the weight
//! w_ab = V_b F of a pair and the correction L of (9),
//!
//! (∇v)_a = −[Σ_b w_ab v_ab ⊗ r + Σ_w w_aw β v_a ⊗ r] L_a, s = 2 η dev sym ∇v,
//! (−K v)_a = V_a [Σ_b w_ab (s_a L_a + s_b L_b) r + Σ_w w_aw β s_a L_a r].
//!
//! The second line is the exact transpose of the first, because V_a w_ab and L are symmetric; images keep that, since
//! their velocities and stresses are the source's by the same signs. So K is symmetric and not negative. Inside the
//! flow L is the correction E of the forces, and −K v the divergence that the explicit step takes. At free surfaces and
//! walls K is only near to it. Grains do not feel the difference, because their viscosity falls where they move. A
//! liquid does: of Δt η/(ρh²) near 20 and more, a rough start with such surfaces can diverge. With s L in the place of
//! s E in the forces a block without walls is stable whatever its viscosity, but a column's centroid then differs from
//! that by return mapping by 1.3 % and not 0.1 %, because the pressure keeps E.
//!
//! A wall partner's velocity is that of (18)–(20), v_a − v_w = β (v_a − v_wall) with β = 1 + d_w/d_a up to a limit:
//! linear in v_a alone, so that the walls join the sums that are made once a step.
//! Of a liquid the walls hold by the velocity itself (`terms/no_slip.rs`), whatever the strain is: for the share χ of the viscosity
//! that needs no pressure the second line has no wall in it, but −Σ_w w 2 χη β min(β, 2) (n·L r)/(n·r) v_a, as much as a zigzag
//! feels: a straight shear feels half, and with that half a zigzag would not be damped. The two lines are then no transposes; K is
//! their mean, with 1 − χ/2 before both sums over walls, and what that counts of the resistance is taken from it.
//!
//! Conjugate gradients, preconditioned with the diagonal, end when the residual has fallen to a share of its start,
//! ‖r‖ ≤ ε ‖M Δt a‖ with ‖x‖² = Σ x_a²/m_a: the net force, not the forces that balance each other, is the scale. The
//! sum of what is left is missing in the momentum: at ε = 0.1 it was 3e-5 of the impulses of a disordered block's step.

mod reaction;
mod start;
mod system;
mod update;

pub use system::ViscousSystem;

use crate::linear::{Descent, Stalled, descend};
use crate::vector::Vector;
use crate::weakly_compressible::PairData;
use crate::weakly_compressible::{Images, Model, Particles};

/// Iterations after which a solve is given up.
pub const MOST_ITERATIONS: usize = 1000;

/// A solve that did not reach its tolerance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NotConverged {
    /// Storage index of the particle with the largest residual acceleration, or the first whose is not a number.
    pub worst: usize,
}

/// The constants of a step's solve.
#[derive(Debug, Clone, Copy)]
pub struct ViscousSolve<'a, const D: usize> {
    /// Material and numerics.
    pub model: &'a Model<D>,
    /// Weights of the pairs.
    pub pairs: &'a PairData<D>,
    /// Δt `[s]`.
    pub time_step: f64,
}

impl<const D: usize> ViscousSolve<'_, D> {
    /// Replaces the accelerations a(vⁿ) of the flow by (vⁿ⁺¹ − vⁿ)/Δt.
    ///
    /// # Errors
    /// A solve that did not reach its tolerance.
    pub fn run(
        &self,
        particles: &mut Particles<D>,
        images: &Images<D>,
        system: &mut ViscousSystem<D>,
    ) -> Result<(), NotConverged> {
        system.resize(particles, self.model.list.region);
        self.prepare(particles, system);
        system.copy_stresses(images);
        self.residual_of_start(particles, system);
        let start = system.sum(|sums| sums.residual);
        let tolerance = self.model.numerics.viscous_tolerance;
        let flow = particles.flow_count();
        let solved = descend(
            &mut Iteration { solve: self, system, images, flow },
            tolerance * tolerance * start,
            MOST_ITERATIONS,
        );
        match solved {
            Ok(iterations) => system.iterations += iterations as u64,
            Err(Stalled { square }) => {
                system.residual = (square / start).sqrt();
                return Err(NotConverged { worst: system.worst(flow) });
            }
        }
        system.write_accelerations(particles, self.time_step);
        Ok(())
    }

    /// (M + Δt K) times the direction.
    pub fn product(&self, system: &mut ViscousSystem<D>, flow: usize, images: &Images<D>) {
        self.product_stresses(system, flow, images);
        self.divergence(system);
    }

    /// s L of the velocities that the records show, images included.
    fn product_stresses(&self, system: &mut ViscousSystem<D>, flow: usize, images: &Images<D>) {
        system.copy_velocities(images);
        self.stresses(system, flow);
        system.copy_stresses(images);
    }
}

/// The iteration; its sums are taken on the way, by the passes that make what they add up.
struct Iteration<'a, const D: usize> {
    solve: &'a ViscousSolve<'a, D>,
    system: &'a mut ViscousSystem<D>,
    images: &'a Images<D>,
    flow: usize,
}

impl<const D: usize> Descent for Iteration<'_, D> {
    fn square(&mut self) -> f64 {
        self.system.sum(|sums| sums.residual)
    }

    fn descent(&mut self) -> f64 {
        self.system.sum(|sums| sums.descent)
    }

    fn turn(&mut self, growth: f64) {
        self.solve.next_direction(self.system, self.flow, growth);
    }

    fn curvature(&mut self) -> f64 {
        self.solve.product(self.system, self.flow, self.images);
        self.system.sum(|sums| sums.curvature)
    }

    fn advance(&mut self, step: f64) {
        self.solve.descend(self.system, step);
    }
}

/// Accelerations of a group of eight particles to and from vectors.
pub fn lane<const D: usize>(group: &[[f64; crate::lanes::LANES]; D], lane: usize) -> Vector<D> {
    Vector::from_fn(|i, _| group[i][lane])
}
