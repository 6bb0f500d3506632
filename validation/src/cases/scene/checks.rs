//! Rules between the fields of a scene.

use super::body::vector;
use super::gauge::Gauge;
use super::parameters::SceneParameters;
use super::wall::WallLine;
use crate::case::ParameterError;
use crate::cases::rules;
use bagnold_solver::weakly_compressible::boundary::Surface;
use bagnold_solver::weakly_compressible::boundary::enclosure::Enclosure;
use bagnold_solver::weakly_compressible::numerics::Contact;
use std::collections::BTreeSet;

/// Most rows of a series.
const MOST_SAMPLES: f64 = 1e5;

impl SceneParameters {
    /// Everything that is refused beyond the ranges of single fields.
    pub(super) fn checked(&self) -> Result<(), ParameterError> {
        self.check_names()?;
        rules::material("material", &self.material)?;
        self.bulk.check(&self.material).map_err(|error| error.within("bulk"))?;
        self.sides.check()?;
        for (k, body) in self.bodies.iter().enumerate() {
            body.check().map_err(|error| error.within(&format!("bodies[{k}]")))?;
        }
        for (k, wall) in self.walls.iter().enumerate() {
            wall.check(self.spacing).map_err(|error| error.within(&format!("walls[{k}]")))?;
        }
        self.check_gauges()?;
        self.check_scales()?;
        rules::viscous_step("numerics", &self.numerics, &self.material)?;
        if self.walls.iter().any(|wall| wall.surface == Surface::Smooth) {
            rules::gate("numerics", &self.numerics)?;
        }
        let enclosure = Enclosure { shells: self.walls.iter().map(WallLine::shell).collect(), exits: self.exits() };
        rules::refuse("numerics", enclosure.numerics_problem(&self.numerics))?;
        if self.numerics.contact == Contact::None && !self.walls.is_empty() {
            let remedy = "contact keeps particles in front of walls of segments; leave it as it is";
            return Err(ParameterError::field("numerics.contact", "none", "\"half-spacing\" with walls", remedy));
        }
        Ok(())
    }

    /// Names that are unlike each other and may stand in files.
    fn check_names(&self) -> Result<(), ParameterError> {
        let fit =
            |name: &str| !name.is_empty() && name.chars().all(|letter| letter.is_ascii_alphanumeric() || letter == '-');
        let mut seen = BTreeSet::new();
        let walls = self.walls.iter().enumerate().map(|(k, wall)| (format!("walls[{k}].name"), wall.name.as_str()));
        let gauges = self.gauges.iter().enumerate().map(|(k, gauge)| (format!("gauges[{k}].name"), gauge.name()));
        let own = [("name".to_owned(), self.name.as_str())].into_iter();
        for (field, name) in own.chain(walls).chain(gauges) {
            let kind = field.split('[').next().unwrap_or_default().to_owned();
            if !fit(name) {
                let remedy = "files are named after it";
                return Err(ParameterError::field(
                    &field,
                    format!("\"{name}\""),
                    "letters, digits and hyphens",
                    remedy,
                ));
            }
            if !seen.insert((kind, name)) {
                return Err(ParameterError::field(
                    &field,
                    format!("\"{name}\""),
                    "unlike the others",
                    "name each once",
                ));
            }
        }
        Ok(())
    }

    fn check_gauges(&self) -> Result<(), ParameterError> {
        for (k, gauge) in self.gauges.iter().enumerate() {
            if let Gauge::Force { wall, .. } = gauge
                && !self.walls.iter().any(|other| other.name == *wall)
            {
                let names: Vec<&str> = self.walls.iter().map(|wall| wall.name.as_str()).collect();
                let rule = format!(
                    "the name of a wall: {}",
                    if names.is_empty() { "there is none".to_owned() } else { names.join(", ") }
                );
                return Err(ParameterError::field(
                    &format!("gauges[{k}].wall"),
                    format!("\"{wall}\""),
                    &rule,
                    "correct the name",
                ));
            }
            if let Some((from, to)) = gauge.line()
                && (vector(&to) - vector(&from)).norm() <= self.spacing
            {
                let value = format!("({}, {})", to.0, to.1);
                let rule = "farther from `from` than the spacing";
                return Err(ParameterError::field(&format!("gauges[{k}].to"), value, rule, "make the line longer"));
            }
        }
        for (k, measured) in self.measured.iter().enumerate() {
            let field = |name: &str| format!("measured[{k}].{name}");
            if !self.gauges.iter().any(|gauge| gauge.name() == measured.gauge) {
                let value = format!("\"{}\"", measured.gauge);
                return Err(ParameterError::field(&field("gauge"), value, "the name of a gauge", "correct the name"));
            }
            if let Some(row) = measured.points.iter().position(|&(time, value)| !(time >= 0.0 && value > 0.0)) {
                let (time, value) = measured.points[row];
                let name = field(&format!("points[{row}]"));
                let rule = "a time that is not negative and a positive value";
                return Err(ParameterError::field(&name, format!("({time}, {value})"), rule, "correct the row"));
            }
        }
        Ok(())
    }

    /// Times and lengths that fit to each other.
    fn check_scales(&self) -> Result<(), ParameterError> {
        if self.interval > self.duration {
            let rule = format!("at most the duration, {}", self.duration);
            return Err(ParameterError::field(
                "interval",
                self.interval,
                &rule,
                "a hundredth of the duration is usual",
            ));
        }
        if self.interval * MOST_SAMPLES < self.duration {
            let rule = format!("at least {}, a {MOST_SAMPLES}th of the duration", self.duration / MOST_SAMPLES);
            return Err(ParameterError::field(
                "interval",
                self.interval,
                &rule,
                "a hundredth of the duration is usual",
            ));
        }
        rules::count("pictures", self.pictures, 1, 100, "four are usual")?;
        if vector(&self.gravity).norm() == 0.0 {
            let (rule, remedy) =
                ("unlike (0, 0)", "the stiffness is measured by it; give it in m/s², such as [0, -9.81]");
            return Err(ParameterError::field("gravity", "(0, 0)", rule, remedy));
        }
        let (lower, upper) = self.extent();
        let size = (upper - lower).max();
        let most = size / 4.0;
        if self.spacing > most {
            let rule = format!("at most a quarter of the scene's size, {most}");
            return Err(ParameterError::field("spacing", self.spacing, &rule, "make the particles smaller"));
        }
        Ok(())
    }
}
