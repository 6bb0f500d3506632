//! Inlets of a scene: their rules, and what they will have fed.

use super::SceneFlow;
use super::flow::Dimension;
use super::setting::{SceneInlet, SceneWall, shown};
use super::sides::SceneSides;
use super::surfaces::{Surfaces, is_taken};
use crate::case::ParameterError;
use crate::setup::wall_rows;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::enclosure::inlet::{Inlet, LARGEST_MACH_NUMBER, NARROWEST, Supply};
use bagnold_solver::weakly_compressible::enclosure::{BoundarySet, FeedRate};

/// Largest stiffness of a scene `[-]`.
const STIFFEST: f64 = 1e6;

/// Times at which it is added up how many particles are there: for estimates.
const TIMES: usize = 64;

impl<S: Dimension<D>, const D: usize> SceneFlow<S, D> {
    /// The inlets for the solver; those that [`SceneFlow::check_inlets`] refuses are left out.
    pub(super) fn feeds(&self) -> Vec<Inlet<D>> {
        self.inlets.iter().filter_map(|inlet| self.feed(inlet, inlet.rate().checked(self.duration).ok()?)).collect()
    }

    /// Walls, open sides and inlets for the solver.
    pub(super) fn enclosure(&self) -> BoundarySet<D> {
        let wall = |wall: &S::Wall| {
            let mut facet_wall = wall.facet_wall();
            facet_wall.motion.load = self.load_of(wall);
            facet_wall
        };
        let walls = self.walls.iter().map(wall).collect();
        BoundarySet { walls, exits: self.sides.exits(), inlets: self.feeds(), frame: self.frame() }
    }

    /// Depth of the dummy particles behind walls and of the rows of inlets `[m]`.
    pub(super) fn depth_of_walls(&self) -> f64 {
        wall_rows(self.numerics.smoothing_ratio) as f64 * self.spacing
    }

    fn feed(&self, inlet: &S::Inlet, rate: FeedRate) -> Option<Inlet<D>> {
        let density = self.bulk.density(&self.material);
        inlet.feed(Supply { spacing: self.spacing, density, rate })
    }

    /// Refuses rates that are not numbers, and openings that they cannot pass.
    pub(super) fn check_inlets(&self) -> Result<(), ParameterError> {
        for (k, inlet) in self.inlets.iter().enumerate() {
            self.check_inlet(inlet).map_err(|error| error.within(&format!("inlets[{k}]")))?;
        }
        Ok(())
    }

    fn check_inlet(&self, inlet: &S::Inlet) -> Result<(), ParameterError> {
        let given = inlet.rate();
        let rate = given.checked(self.duration)?;
        let least = NARROWEST * self.spacing;
        let narrow = |edge: f64| {
            let defect = format!("opening of {edge:.4} m, narrower than {NARROWEST} spacings, {least:.4} m");
            let remedy = "make the opening wider or the spacing smaller";
            ParameterError::field(S::Inlet::GIVEN_BY, defect, "", remedy)
        };
        inlet.check()?;
        if let Some(edge) = inlet.edges().into_iter().find(|edge| !(*edge >= least * (1.0 - 1e-9) && edge.is_finite()))
        {
            return Err(narrow(edge));
        }
        let Some(feed) = self.feed(inlet, rate) else { return Err(narrow(0.0)) };
        let sound_speed = self.equation_of_state().sound_speed();
        if let Some(problem) = feed.problem(self.spacing, sound_speed) {
            let most = LARGEST_MACH_NUMBER * sound_speed;
            let speed = feed.largest_speed();
            let largest = feed.rate.largest() * most / speed;
            let rate = format!("{} {}", problem.value, S::FLUX_UNIT);
            let defect =
                format!("{rate} gives inflow at {speed:.4} m/s, above {LARGEST_MACH_NUMBER} of the sound speed");
            let stiffness = (self.stiffness() * (speed / most).powi(2)).ceil();
            let stiffer =
                if stiffness <= STIFFEST { format!(", or raise `stiffness` to {stiffness}") } else { String::new() };
            let remedy = format!("give at most {largest:.4}, widen the opening{stiffer}");
            return Err(ParameterError::field(given.field(), defect, "", &remedy));
        }
        let first = feed.direction() * (0.5 * self.spacing);
        if let Some(cell) = feed.cells.iter().find(|cell| !self.sides.hold(&(*cell + first))) {
            let remedy = "move the opening or the side";
            let defect = format!("part of the opening, at {}, is beyond a side of the domain", place(cell));
            return Err(ParameterError::field(S::Inlet::GIVEN_BY, defect, "", remedy));
        }
        let rows = wall_rows(self.numerics.smoothing_ratio);
        let last = feed.direction() * (-self.spacing * rows as f64);
        if let Some(cell) = feed.cells.iter().find(|cell| !self.sides.continue_to(&(*cell + last))) {
            let defect = format!(
                "part of the opening, at {}, has less than {rows} spacings behind it to a periodic side or plane of symmetry",
                place(cell)
            );
            return Err(ParameterError::field(S::Inlet::GIVEN_BY, defect, "", "move the opening away from the side"));
        }
        Ok(())
    }

    /// Refuses openings that a wall closes, or the rows of another inlet. The surfaces are those of the walls, then of the inlets.
    pub(super) fn check_openings(&self, feeds: &[Inlet<D>], surfaces: &Surfaces<D>) -> Result<(), ParameterError> {
        let names: Vec<&str> = self.barriers().map(|(name, _)| name).collect();
        for (k, feed) in feeds.iter().enumerate() {
            let ahead = feed.direction() * (0.5 * self.spacing);
            let closing = feed.cells.iter().find_map(|cell| {
                let nearest = surfaces.nearest(&(cell + ahead))?;
                is_taken(&nearest, self.spacing).then_some((cell, nearest))
            });
            if let Some((cell, nearest)) = closing {
                let side = if nearest.distance < 0.0 { "behind" } else { "too near to" };
                let defect = format!("part of the opening, at {}, is {side} `{}`", place(cell), names[nearest.wall]);
                let remedy = format!("{}, or end the opening at the wall", S::Inlet::TURN);
                return Err(ParameterError::field(&format!("inlets[{k}]"), defect, "", &remedy));
            }
        }
        Ok(())
    }

    /// Particles that inlets will have fed at a time `[s]`.
    pub(super) fn fed_particles(&self, time: f64) -> f64 {
        self.feeds().iter().map(|feed| feed.rate.mass(time) / feed.particle_mass()).sum()
    }

    /// Mean number of fed particles over the run.
    pub(super) fn mean_fed_particles(&self) -> f64 {
        let feeds = self.feeds();
        let at = |time: f64| feeds.iter().map(|feed| feed.rate.mass(time) / feed.particle_mass()).sum::<f64>();
        (0..TIMES).map(|k| at(self.duration * (k as f64 + 0.5) / TIMES as f64)).sum::<f64>() / TIMES as f64
    }

    /// Names of what holds the flow back, walls and the rows of inlets, and whether material may stand behind it.
    pub(super) fn barriers(&self) -> impl Iterator<Item = (&str, bool)> {
        let walls = self.walls.iter().map(|wall| (wall.name(), wall.may_have_two_sides()));
        walls.chain(self.inlets.iter().map(|inlet| (inlet.name(), true)))
    }
}

fn place<const D: usize>(cell: &Vector<D>) -> String {
    format!("{} m", shown(cell.map(|part| format!("{part:.4}").parse().unwrap_or(part)).iter()))
}
