//! Loads on walls for the solver, and their rules.

use super::flow::{Dimension, SceneFlow};
use super::given_load::GivenLoad;
use super::setting::{SceneBody, SceneWall, shown};
use super::shapes;
use super::sides::SceneSides;
use crate::case::ParameterError;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::enclosure::wall_load::WallLoad;

/// Rate of the damper in times that sound needs across the material below `[-]`: a critical one has 2.8.
const USUAL_DAMPING: f64 = 2.0;
/// Part of a table's way along the load, over the way, that is rounding `[-]`.
const ROUNDING: f64 = 1e-9;

impl<S: Dimension<D>, const D: usize> SceneFlow<S, D> {
    /// The load of a wall for the solver.
    pub(super) fn load_of(&self, wall: &S::Wall) -> Option<WallLoad<D>> {
        let given = wall.load()?;
        let (direction, area) = (given.direction.normalize(), self.area_across(wall, &given));
        let spans = self.bodies.iter().map(|body| body.span(&direction));
        let (low, high) =
            spans.fold((f64::INFINITY, f64::NEG_INFINITY), |all, own| (all.0.min(own.0), all.1.max(own.1)));
        let (height, state) = (high - low, self.equation_of_state());
        Some(WallLoad {
            direction,
            force: given.force.unwrap_or_else(|| given.pressure.unwrap_or_default() * area),
            mass: given.mass.unwrap_or(0.5 * state.reference_density * area * height),
            damping: given.damping.unwrap_or(USUAL_DAMPING * state.sound_speed() / height),
            travel: 0.0,
        })
    }

    /// The largest pressure of any load `[Pa]`.
    pub(super) fn load_pressure(&self) -> f64 {
        let of_wall = |wall: &S::Wall| {
            let given = wall.load()?;
            given.pressure.or(given.force.map(|force| force / self.area_across(wall, &given)))
        };
        self.walls.iter().filter_map(of_wall).fold(0.0, f64::max)
    }

    /// Area of a wall across its load: of its box between the sides of the domain, but not more than that of the wall `[m^(D-1)]`.
    fn area_across(&self, wall: &S::Wall, load: &GivenLoad<Vector<D>>) -> f64 {
        let (lower, upper) = self.sides.clip(shapes::around(wall.hull()));
        let (edges, direction) = (upper - lower, load.direction.normalize());
        let face = |axis: usize| (0..D).filter(|other| *other != axis).map(|other| edges[other]).product::<f64>();
        (0..D).map(|axis| direction[axis].abs() * face(axis)).sum::<f64>().min(wall.measure())
    }

    /// Refuses a load without a size or a direction, on no wall, or against a table.
    pub(super) fn check_load(&self, wall: &S::Wall) -> Result<(), ParameterError> {
        let Some(given) = wall.load() else { return Ok(()) };
        let refused = |field: &str, value: String, rule: &str, remedy: &str| {
            Err(ParameterError::field(&format!("load.{field}"), value, rule, remedy))
        };
        let direction = given.direction;
        if !(direction.norm() > 0.0 && direction.norm().is_finite()) {
            return refused("direction", shown(&direction), "a vector longer than 0", "point it into the material");
        }
        match (given.pressure, given.force) {
            (Some(_), Some(_)) => {
                return refused("force", "given together with `pressure`".to_owned(), "", "leave one of the two out");
            }
            (None, None) => {
                return refused("pressure", "missing, as is `force`".to_owned(), "", "give one of the two");
            }
            _ => {}
        }
        if self.area_across(wall, &given) <= 0.0 {
            let value = format!("{}, along the wall `{}`", shown(&direction), wall.name());
            return refused("direction", value, "across the wall", "point it into the material");
        }
        if self.bodies.is_empty() && (given.mass.is_none() || given.damping.is_none()) {
            let remedy = "give both in a scene without bodies, where no material sets their defaults";
            return refused("mass", "this or `damping` is missing".to_owned(), "", remedy);
        }
        let along = |way: &&Vector<D>| way.dot(&direction).abs() > ROUNDING * way.norm() * direction.norm();
        if let Some(way) = wall.motion().displacements.iter().find(along) {
            let defect = format!("{} is not perpendicular to the displacement {}", shown(&direction), shown(way));
            let remedy = "leave displacements along the load out of `motion`, because the load moves the wall there";
            return refused("direction", defect, "", remedy);
        }
        Ok(())
    }
}
