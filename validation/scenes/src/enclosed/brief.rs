//! Summary of a scene before it runs: its speeds and sizes in the numbers that decide whether the model applies.

use super::SceneFlow;
use super::flow::Dimension;
use super::setting::{SceneInlet, SceneWall};

use crate::output::caution;
use bagnold_number::four_digits;
use bagnold_solver::material::rheology::Rheology;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::enclosure::facet_wall::Motion;
use bagnold_solver::weakly_compressible::terms::stress_diffusion::STEEPEST;

/// Largest Mach number `[-]` of a weakly compressible flow: density then varies by some per cent.
const LARGEST_MACH_NUMBER: f64 = 0.2;
/// Fewest particles across a gap.
const NARROWEST_GAP: f64 = 3.0;
/// Largest component of the normal of a wall along the lattice.
const ALIGNED: f64 = 1.0 - 1e-6;
/// Share of a spacing within which ends of walls touch.
const TOUCHING: f64 = 0.5;
/// Most triangles of a wall per square of the spacing: finer ones only take time and memory.
const FINEST: f64 = 16.0;
/// Most ends of walls between which gaps are searched.
const MOST_ENDS: usize = 2000;

impl<S: Dimension<D>, const D: usize> SceneFlow<S, D> {
    /// One line on the terminal: particles, speeds and the size of the grains. Narrow gaps are warned of.
    pub(super) fn summary(&self) -> String {
        if let Some((gap, one, other)) = self.narrowest_gap() {
            let across = gap / self.spacing;
            caution(&format!(
                "scene `{}`: the gap between the ends of walls `{one}` and `{other}` is {across:.1} particle spacings wide, \
                 but flow through it needs at least {NARROWEST_GAP}; reduce `spacing` to {} m or less",
                self.name,
                four_digits(gap / NARROWEST_GAP)
            ));
        }
        let sound_speed = self.equation_of_state().sound_speed();
        let speed = self.expected_speed();
        let mach = speed / sound_speed;
        // a fall over the height of the scene reaches the limit itself at the default stiffness
        if mach > 1.01 * LARGEST_MACH_NUMBER {
            caution(&too_fast(&self.name, speed, mach, (self.stiffness(), self.from.is_some())));
        }
        // waves of such a law are not damped by the diffusion of the stress
        let friction = self.material.contact_friction();
        if self.material.strength_is_friction() && friction > STEEPEST {
            caution(&format!(
                "scene `{}`: a static friction of {friction} is above {STEEPEST}: such a law is ill-posed at small inertial numbers, and \
                 layers flow at least 5 % too fast (friction 0.8, 40 rows); lower it, or compare runs of two spacings",
                self.name
            ));
        }
        for wall in self.walls.iter().filter(|_| D == 3) {
            let finer = wall.facet_wall().facets.len() as f64 * self.spacing.powi(2) / wall.measure();
            if finer > FINEST {
                caution(&format!(
                    "wall `{}` has {finer:.0} triangles per square of the spacing (limit {FINEST:.0}): such fine triangles only \
                     cost time and memory at the start; simplify the mesh",
                    wall.name()
                ));
            }
        }
        let opening = |wall: &S::Wall| Some(format!("; wall `{}` has {}", wall.name(), wall.openings()?));
        let openings = self.walls.iter().filter_map(opening);
        let stop = |wall: &S::Wall| {
            let Motion { times, displacements, .. } = wall.motion();
            let ([.., before, last], end) = (&displacements[..], *times.last()?) else { return None };
            // a gate is meant to stop
            let ends = end < self.duration && before != last && wall.load().is_some();
            ends.then(|| format!("; the motion of wall `{}` ends at {} s", wall.name(), four_digits(end)))
        };
        let openings = openings.chain(self.walls.iter().filter_map(stop));
        let beyond = self.inlets.iter().map(|own| own.rate().beyond(own.name(), self.duration, S::FLUX_UNIT));
        let grains = self.material.grain_diameter().map(|diameter| diameter / self.spacing);
        let grains = grains.map(|ratio| format!(", grain diameter {ratio:.2} particle spacings")).unwrap_or_default();
        format!(
            "scene `{}`, spacing {} m: sound speed {sound_speed:.3} m/s ({}), largest expected speed {speed:.3} m/s (Mach {mach:.2}){grains}{}",
            self.name,
            four_digits(self.spacing),
            self.sound_cause(),
            openings.chain(beyond).chain(self.circulation()).collect::<String>()
        )
    }

    /// Speed below which a liquid beside inclined walls does not rest: its rows end at different distances from them.
    fn circulation(&self) -> Option<String> {
        let is_inclined = |wall: &S::Wall| {
            let facets = wall.facet_wall().facets;
            facets.iter().any(|facet| facet.normal.iter().all(|part| part.abs() < ALIGNED))
        };
        (matches!(self.material, Rheology::Newtonian(_)) && self.walls.iter().any(is_inclined))
            .then(|| "; beside inclined walls the liquid keeps moving at up to 0.3 % of √(g H)".to_owned())
    }

    /// The narrowest gap `[m]` between ends of different walls that is too narrow for a flow, and their names.
    fn narrowest_gap(&self) -> Option<(f64, &str, &str)> {
        let ends: Vec<_> = self.walls.iter().map(|wall| (wall.hull(), wall.name())).collect();
        // the triangles of a mesh are ends by the thousand
        if ends.iter().map(|(places, _)| places.len()).sum::<usize>() > MOST_ENDS {
            return None;
        }
        let between = |one: &[Vector<D>], other: &[Vector<D>]| {
            let distances = one.iter().flat_map(|place| other.iter().map(move |far| (place - far).norm()));
            distances.fold(f64::INFINITY, f64::min)
        };
        let mut narrowest = None;
        for (place, one) in ends.iter().enumerate() {
            for other in &ends[place + 1..] {
                let gap = between(&one.0, &other.0);
                let is_gap = gap > TOUCHING * self.spacing && gap < (NARROWEST_GAP - 0.01) * self.spacing;
                if is_gap && narrowest.is_none_or(|(least, _, _)| gap < least) {
                    narrowest = Some((gap, one.1, other.1));
                }
            }
        }
        narrowest
    }
}

/// Warning of a flow too fast for its sound speed, with the stiffness that suffices.
fn too_fast(name: &str, speed: f64, mach: f64, (stiffness, goes_on): (f64, bool)) -> String {
    let enough = (stiffness * (mach / LARGEST_MACH_NUMBER).powi(2)).ceil();
    let remedy = if goes_on {
        format!("start from a state of a scene with `stiffness = {enough}`")
    } else {
        format!("set `stiffness = {enough}`, or leave it out")
    };
    format!(
        "scene `{name}`: a speed of {speed:.3} m/s is Mach {mach:.2}, above {LARGEST_MACH_NUMBER}: impacts and forces are not \
         validated there; {remedy}"
    )
}
