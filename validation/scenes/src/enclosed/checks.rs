//! Rules between the fields of a scene.

use super::flow::Dimension;
use super::geostatic::rankine_ratios;
use super::periods::Periods;
use super::setting::{SceneBody, SceneGauge, SceneInlet, SceneWall, shown, vector};
use super::{BodyPreparation, Measurand, SceneFlow, names, shapes, sides::SceneSides};
use crate::case::ParameterError;
use crate::setup::rules;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::enclosure::facet::Facet;
use bagnold_solver::weakly_compressible::enclosure::facet_wall::Motion;
use bagnold_solver::weakly_compressible::numerics::Contact;
use bagnold_solver::weakly_compressible::scene::pore_problem;
use bagnold_solver::weakly_compressible::walls::Surface;

impl<S: Dimension<D>, const D: usize> SceneFlow<S, D> {
    /// Everything that is refused beyond the ranges of single fields.
    pub(super) fn checked(&self) -> Result<(), ParameterError> {
        let walls = self.walls.iter().map(SceneWall::name).collect();
        let inlets = self.inlets.iter().map(SceneInlet::name).collect();
        let gauges = self.gauges.iter().map(SceneGauge::name).collect();
        names::check(&self.name, [("walls", walls), ("inlets", inlets), ("gauges", gauges)])?;
        if self.bodies.is_empty() && self.inlets.is_empty() {
            return Err(ParameterError::field("bodies", "no body", "", S::ADD_A_BODY));
        }
        rules::material("material", &self.material)?;
        self.bulk.check(&self.material).map_err(|error| error.within("bulk"))?;
        self.sides.check()?;
        for (k, body) in self.bodies.iter().enumerate() {
            body.check().map_err(|error| error.within(&format!("bodies[{k}]")))?;
        }
        let (lower, upper) = shapes::around(self.bodies.iter().flat_map(|body| <[Vector<D>; 2]>::from(body.extent())));
        for (k, wall) in self.walls.iter().enumerate() {
            let sound = wall
                .check(self.spacing, (upper - lower).max())
                .and_then(|()| check_motion(&wall.motion(), S::Wall::GIVEN_BY))
                .and_then(|()| self.check_turn(wall))
                .and_then(|()| self.check_load(wall));
            sound.map_err(|error| error.within(&format!("walls[{k}]")))?;
        }
        self.check_pore_liquid()?;
        self.check_scales()?;
        self.check_preparation()?;
        self.check_lateral_pressure()?;
        self.check_inlets()?;
        self.check_gauges()?;
        self.check_numerics()?;
        self.stored_state().map(|_| ())
    }

    /// Pore liquid that the solver serves, and a start that only a material with one has.
    fn check_pore_liquid(&self) -> Result<(), ParameterError> {
        let parts = (!self.inlets.is_empty(), self.side_walls.is_some());
        let problem = |pore| {
            let scale = (self.spacing, self.equation_of_state().bulk_modulus);
            pore_problem(&pore, &self.numerics, scale, parts)
        };
        if let Some(problem) = self.material.pore_liquid().and_then(problem) {
            return Err(problem.into());
        }
        if self.pore_pressure_ratio != 0.0 && self.material.pore_liquid().is_none() {
            let rule = format!("0 for the law \"{}\"", self.material.name());
            let remedy = "leave it out, or give the law \"viscous-number\"";
            return Err(ParameterError::field("pore_pressure_ratio", self.pore_pressure_ratio, &rule, remedy));
        }
        Ok(())
    }

    /// Numerics that the material and the walls need.
    fn check_numerics(&self) -> Result<(), ParameterError> {
        rules::viscous_step("numerics", &self.numerics, &self.material)?;
        let enclosure = self.enclosure();
        if enclosure.walls.iter().any(|wall| wall.roughness == Surface::Smooth) {
            rules::gate("numerics", &self.numerics)?;
        }
        rules::refuse("numerics", enclosure.numerics_problem(&self.numerics))?;
        if let Some(problem) = self.side_walls.and_then(|walls| walls.problem(D)) {
            return Err(problem.into());
        }
        if self.numerics.contact == Contact::None && !(self.walls.is_empty() && self.inlets.is_empty()) {
            let remedy = format!("remove it: the default keeps particles in front of walls of {}", S::Wall::FACETS);
            return Err(ParameterError::field("numerics.contact", "none", "\"half-spacing\" with walls", &remedy));
        }
        Ok(())
    }

    fn check_gauges(&self) -> Result<(), ParameterError> {
        let down = self.down();
        for (k, gauge) in self.gauges.iter().enumerate() {
            let within = |error: ParameterError| error.within(&format!("gauges[{k}]"));
            match gauge.measure(&down) {
                Measurand::Force(wall) | Measurand::Position(wall) => {
                    names::check_wall("wall", wall, self.barriers().map(|(name, _)| name)).map_err(within)?;
                }
                Measurand::Turn(wall) if !self.turns(wall) => {
                    let remedy = "give the wall a `turn` (rate 0 holds it), or correct the name";
                    let (value, rule) = (format!("\"{wall}\""), "a wall with a `turn`");
                    return Err(within(ParameterError::field("wall", value, rule, remedy)));
                }
                _ => {}
            }
            gauge.check(self.spacing, &down).and_then(|()| self.check_direction(gauge)).map_err(within)?;
            self.check_place(k, gauge)?;
        }
        names::check_measured(&self.measured, |name| self.gauges.iter().any(|gauge| gauge.name() == name))
    }

    /// Refuses a gauge that lies as a whole beyond a side, where nothing is ever measured.
    fn check_place(&self, k: usize, gauge: &S::Gauge) -> Result<(), ParameterError> {
        let measure = gauge.measure(&self.direction_of(gauge));
        for (axis, ((lower, upper), (low, high))) in self.sides.pairs().into_iter().zip(S::Sides::NAMES).enumerate() {
            let margin = match &measure {
                Measurand::Front(_) => 0.0,
                // what repeats itself is met in every period
                _ if lower.is_periodic() => continue,
                Measurand::Flux(_) => 0.0,
                Measurand::Depth(depth) if depth.direction[axis].abs() < 1e-9 => 0.5 * depth.width,
                Measurand::Probe(probe) => probe.reach * self.spacing,
                Measurand::Depth(_) => continue,
                Measurand::Force(_) | Measurand::Position(_) | Measurand::Turn(_) => continue,
            };
            let places = gauge.places();
            let all = |way: f64, plane: f64| places.iter().all(|place| way * (place[axis] - plane) > margin);
            let below = lower.coordinate().filter(|plane| all(-1.0, *plane)).map(|plane| (low, plane));
            let above = upper.coordinate().filter(|plane| all(1.0, *plane)).map(|plane| (high, plane));
            if let Some((side, plane)) = below.or(above) {
                let defect =
                    format!("`{}` lies beyond the side `{side}` at {plane} m, outside the domain", gauge.name());
                let remedy = "move it between the sides of the domain";
                return Err(ParameterError::field(&format!("gauges[{k}]"), defect, "", remedy));
            }
        }
        Ok(())
    }

    /// Check of the direction of a thickness: one direction only, which leaves the material somewhere.
    fn check_direction(&self, gauge: &S::Gauge) -> Result<(), ParameterError> {
        let refused = |direction: &Vector<D>, rule, remedy| {
            Err(ParameterError::field("direction", shown(direction.iter()), rule, remedy))
        };
        let (given, wall) = gauge.along();
        if let Some(wall) = wall {
            names::check_wall("normal_to", wall, self.walls.iter().map(SceneWall::name))?;
        }
        if let Some(given) = given {
            if wall.is_some() {
                let defect = "given together with `normal_to`";
                return Err(ParameterError::field("direction", defect, "", "leave one of the two out"));
            }
            if !(given.norm() > 0.0 && given.norm().is_finite()) {
                return refused(&given, "a vector longer than 0", "leave it out to measure along gravity");
            }
        }
        let direction = self.direction_of(gauge);
        let is_depth = matches!(gauge.measure(&direction), Measurand::Depth(_));
        if is_depth && !Periods::of(&self.sides.axes()).are_crossed_by(&direction) {
            let remedy = "give a direction that is not along periodic sides, or `normal_to` a wall";
            return refused(&direction, "across the layer", remedy);
        }
        Ok(())
    }

    /// A preparation that the material has a stress for.
    fn check_preparation(&self) -> Result<(), ParameterError> {
        let value = match self.preparation {
            BodyPreparation::None => return Ok(()),
            BodyPreparation::Settled => "settled",
            BodyPreparation::Stressed => "stressed",
        };
        let refused = |rule: &str, remedy: &str| Err(ParameterError::field("preparation", value, rule, remedy));
        if self.bodies.is_empty() && self.from.is_none() {
            return refused("\"none\" for a scene without bodies", "leave it out: inflow cannot be prepared");
        }
        if self.preparation == BodyPreparation::Settled {
            return Ok(());
        }
        if self.material.strength_at_rest(0.0).is_none() {
            let rule = format!("\"none\" or \"settled\" for the law \"{}\"", self.material.name());
            return refused(&rule, "leave it out, or give a law with a yield stress, such as \"mu-i\"");
        }
        let (across, along) = self.pulls();
        if across.norm() == 0.0 {
            let rule = "\"none\" where gravity acts along periodic sides only, because nothing compresses the material";
            return refused(rule, "leave it out");
        }
        let ratio = self.lateral_pressure_ratio;
        if ratio != 1.0 {
            let rule = "1 beside `preparation` \"stressed\"";
            let remedy = "leave one of the two out, or set `preparation` to \"settled\"";
            return Err(ParameterError::field("lateral_pressure_ratio", ratio, rule, remedy));
        }
        if along.norm() > 0.0
            && let Some(wall) = self.smooth_floor()
        {
            let rule = format!("\"none\" or \"settled\" on the smooth slope `{}`", wall.name());
            return refused(&rule, "leave it out, or make the wall rough: a smooth wall carries no shear stress");
        }
        Ok(())
    }

    /// A wall that bears weight but no shear stress.
    pub(super) fn smooth_floor(&self) -> Option<&S::Wall> {
        self.walls.iter().find(|wall| {
            let wall = wall.facet_wall();
            let is_floor = |facet: &Facet<D>| facet.normal.dot(&self.down()) < -0.5;
            wall.roughness == Surface::Smooth && wall.facets.iter().any(is_floor)
        })
    }

    /// A ratio of horizontal to vertical stress that the material bears at rest.
    fn check_lateral_pressure(&self) -> Result<(), ParameterError> {
        let (field, ratio) = ("lateral_pressure_ratio", self.lateral_pressure_ratio);
        if ratio == 1.0 {
            return Ok(());
        }
        let law = self.material.name();
        let Some(cohesion) = self.material.strength_at_rest(0.0) else {
            let rule = format!("1 for the law \"{law}\"");
            let remedy = "leave it out, or give a law with a yield stress, such as \"mu-i\"";
            return Err(ParameterError::field(field, ratio, &rule, remedy));
        };
        let weight = self.bulk.density(&self.material) * self.pull().norm() * self.height();
        if weight == 0.0 {
            return Err(ParameterError::field(field, ratio, "1 without gravity", "leave it out"));
        }
        let friction = (self.material.strength_at_rest(weight).unwrap_or(cohesion) - cohesion) / weight;
        let (active, passive) = rankine_ratios::<D>(friction, cohesion / weight);
        // rounded outwards, so that the bounds that a message shows are allowed
        let (active, passive) = ((1e4 * active).floor() / 1e4, (1e4 * passive).ceil() / 1e4);
        let remedy = format!("give a value such as 1 − sin φ; outside Rankine's limits \"{law}\" yields");
        rules::between(field, ratio, active, passive, &remedy)
    }

    /// Times and lengths that fit to each other.
    fn check_scales(&self) -> Result<(), ParameterError> {
        names::check_times(self.interval, self.duration)?;
        rules::count("pictures", self.pictures, 1, 100, "give 3 or 4")?;
        if vector(&self.gravity).norm() == 0.0 && self.start_pressure() <= 0.0 {
            let none = shown(&[0.0; D]);
            let level = "0, ".repeat(D - 1);
            let remedy =
                format!("give it in m/s², such as [{level}-9.81], or an initial `pressure`, or a `load` on a wall");
            let defect = format!("{none} m/s² and no load: the stiffness has no scale");
            return Err(ParameterError::field("gravity", defect, "", &remedy));
        }
        let (lower, upper) = self.extent();
        let most = (upper - lower).max() / 4.0;
        if self.spacing > most {
            let rule = format!("at most a quarter of the scene's size, {most} m");
            return Err(ParameterError::field("spacing", format!("{} m", self.spacing), &rule, "reduce it"));
        }
        Ok(())
    }
}

fn check_motion<const D: usize>(motion: &Motion<D>, given_by: &str) -> Result<(), ParameterError> {
    check_table("motion", &motion.times, &motion.displacements, given_by)
}

/// Refuses tables that do not begin at rest, and times that do not rise. `given_by` names the places that a wall is given by.
pub(super) fn check_table<const N: usize>(
    field: &str,
    times: &[f64],
    values: &[Vector<N>],
    given_by: &str,
) -> Result<(), ParameterError> {
    let refused = |row: Option<usize>, value: String, rule: &str, remedy: &str| {
        let field = row.map_or_else(|| field.to_owned(), |row| format!("{field}[{row}]"));
        Err(ParameterError::field(&field, value, rule, remedy))
    };
    let start = times.first().zip(values.first());
    if let Some((&time, value)) = start.filter(|(time, value)| **time != 0.0 || **value != Vector::<N>::zeros()) {
        let row = |time: f64, value: &Vector<N>| shown(std::iter::once(&time).chain(value));
        let (value, rest) = (row(time, value), row(0.0, &Vector::zeros()));
        let rule = format!("{rest}, where the wall is at the start");
        let remedy = format!("begin with that row: `{given_by}` give the position at the start");
        return refused(Some(0), value, &rule, &remedy);
    }
    if times.len() == 1 {
        return refused(None, "one row".to_owned(), "two rows or more", "leave it out for a wall at rest");
    }
    if let Some(row) = times.windows(2).position(|pair| pair[1] <= pair[0]).map(|row| row + 1) {
        let before = times[row - 1];
        let (value, rule) = (format!("at {} s", times[row]), format!("later than the row above it, at {before} s"));
        let is_jump = times[row] == before;
        let remedy = if is_jump { "spread the jump over a short time" } else { "sort the rows by their times" };
        return refused(Some(row), value, &rule, remedy);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_begin_at_rest_and_go_on() {
        let motion = |rows: &[[f64; 4]]| Motion {
            times: rows.iter().map(|row| row[0]).collect(),
            displacements: rows.iter().map(|row| Vector::<3>::new(row[1], row[2], row[3])).collect(),
            ..Motion::default()
        };
        let checked = |rows: &[[f64; 4]]| check_motion(&motion(rows), "corners").map_err(|error| error.to_string());
        assert_eq!(checked(&[]), Ok(()));
        assert_eq!(checked(&[[0.0; 4], [1.0, 0.0, 0.0, 0.5]]), Ok(()));
        let early = "`motion[0]` is (0, 0, 0.5, 0), but must be (0, 0, 0, 0), where the wall is at the start; begin with that row: `corners` give the position at the start";
        assert_eq!(checked(&[[0.0, 0.0, 0.5, 0.0]]), Err(early.to_owned()));
        let late = checked(&[[0.5, 0.0, 0.0, 0.0]]).expect_err("starts late");
        assert!(late.starts_with("`motion[0]` is (0.5, 0, 0, 0)"), "{late}");
        let alone = checked(&[[0.0; 4]]).expect_err("one row");
        assert!(alone.starts_with("`motion` is one row, but must be two rows or more"), "{alone}");
        let last =
            |time: f64| checked(&[[0.0; 4], [1.0, 0.5, 0.0, 0.0], [time, 0.0, 0.0, 0.5]]).expect_err("no later row");
        assert!(
            last(1.0).starts_with("`motion[2]` is at 1 s, but must be later than")
                && last(1.0).ends_with("spread the jump over a short time")
        );
        assert!(last(0.5).ends_with("sort the rows by their times"), "{}", last(0.5));
    }
}
