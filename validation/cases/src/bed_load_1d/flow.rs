//! The flow: water over a bed of grains in one dimension.

use crate::case::ParameterError;
use crate::metric::{Value, Variant};
use crate::reference::bed_load::{MeasuredBedLoad, critical_shields_number};
use crate::reference::one_dimension::LayerError;
use crate::reference::one_dimension::bed_load::{
    BedLoadLayer, Closures, GrainMotion, STEADY, SolidFractionProfile, Stream,
};
use crate::setup::rules;
use bagnold_solver::parameter::{between, positive, up_to};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Turbulent Schmidt number of a suspension `[-]`, chosen before the runs (`reference-data/bed-load-1d/README.md`).
const SCHMIDT_NUMBER: f64 = 0.7;

/// Diameter of the sphere with the drag of a grain of crushed plastic, over d `[-]`.
const PLASTIC_DRAG: f64 = 0.5;

/// Shields number, and height of the largest velocity over d, of the sheet flow of Sumer et al. in a duct `[-]`: its stream's surface is there.
const DUCT: (f64, f64) = (1.4, 22.0);

/// Half the height over which the given fraction falls from φ_max to 0 in studies of the order, in grain diameters.
const TRANSITION: f64 = 1.2;

/// A stream on a slope, over cells of one height.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SlopedStream {
    /// Slope tanθ `[-]`.
    #[schemars(transform = positive("give tanθ, such as 0.03"))]
    #[schemars(transform = between(0.0, 0.2, "reduce it: on steeper slopes the bed itself slides"))]
    pub slope: f64,
    /// Depth h of the water above the bed `[m]`.
    #[schemars(transform = positive("give it in metres, such as 0.046"))]
    pub depth: f64,
    /// Depth of the bed `[m]`.
    #[schemars(transform = positive("give it in metres, such as 0.04"))]
    pub bed_depth: f64,
    /// Depth of the lowest part of the bed, whose grains are held while water seeps through `[m]`.
    pub held_depth: f64,
    /// Height of a cell `[m]`.
    #[schemars(transform = positive("give it in metres, such as 2.5e-4"))]
    pub cell_height: f64,
}

/// Depths and cells in grain diameters.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct GrainUnits {
    /// Depth of the water in grain diameters.
    #[schemars(transform = between(2.0, 1000.0, "give 20 for a depth of many grains"))]
    pub relative_depth: f64,
    /// Depth of the bed in grain diameters.
    #[schemars(transform = between(1.0, 1000.0, "give 6, or more where grains move deeper"))]
    pub relative_bed_depth: f64,
    /// Cells over a grain diameter; both depths are whole multiples of one.
    #[schemars(transform = between(2.0, 1000.0, "give 12 for a quick run, 20 for an accurate one"))]
    pub cells_per_diameter: f64,
}

/// A stream of a Shields number, whose lengths are counted in grains.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SimilarStream {
    /// Shields number τ* `[-]`.
    #[schemars(transform = positive("give 0.03 to 0.7 for bed load"), transform = up_to(10.0, "give 0.03 to 0.7 for bed load"))]
    pub shields_number: f64,
    /// Lengths of the stream in grain diameters.
    #[serde(flatten)]
    pub lengths: GrainUnits,
}

/// Quantity that defines the stream.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "given", rename_all = "kebab-case")]
pub enum LayerStream {
    /// A slope and depths.
    Slope(SlopedStream),
    /// A Shields number.
    ShieldsNumber(SimilarStream),
    /// Shields numbers about the onset of motion, which is sought.
    Onset(GrainUnits),
}

/// Motion of the grains.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum BedMotion {
    /// They move and dilate.
    Dilating,
    /// They move at a given solid fraction, which falls smoothly across the bed's level.
    Frozen,
    /// They rest.
    AtRest,
}

/// Velocities from which the steady state is sought.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum LayerStart {
    /// Nothing moves.
    Rest,
    /// Water and upper grains move.
    Moving {
        /// Their speed `[m/s]`.
        #[schemars(transform = positive("give it in m/s, such as 2"), transform = up_to(100.0, "give it in m/s, such as 2"))]
        speed: f64,
    },
    /// From rest, and once more from 15 u_*: a second state is reported.
    Both,
}

/// A layer of water and grains. On a slope, those from rest are judged; those from both starts are compared with them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BedLoad1dFlow {
    /// Stream, given by its slope, by a Shields number, or at the onset of motion.
    pub stream: LayerStream,
    /// Gravity `[m/s²]`.
    #[schemars(transform = rules::gravity())]
    pub gravity: f64,
    /// Density ρ_f of the water `[kg/m³]`.
    #[schemars(transform = positive("give it in kg/m³, such as 1000"))]
    pub fluid_density: f64,
    /// Kinematic viscosity ν of the water `[m²/s]`.
    #[schemars(transform = positive("give it in m²/s, 1e-6 for water"))]
    pub kinematic_viscosity: f64,
    /// Density ρ_s of the grains `[kg/m³]`.
    #[schemars(transform = positive("give it in kg/m³, such as 2600"))]
    pub grain_density: f64,
    /// Diameter d of the grains `[m]`.
    #[schemars(transform = positive("give it in metres; 0.005 for 5 mm"))]
    pub grain_diameter: f64,
    /// Diameter of the sphere with the drag of a grain, over d `[-]`.
    #[schemars(transform = between(0.01, 2.0, "give it in grain diameters: 1 for spheres, 0.5 for crushed plastic"))]
    pub drag_diameter: f64,
    /// Motion of the grains.
    pub motion: BedMotion,
    /// Initial velocity of the layer.
    pub start: LayerStart,
    /// Closures of drag, friction, dilation and turbulence.
    pub closures: Closures,
    /// Number of draws of the closures from the ranges of the literature, each a layer and the same bed at rest; 0 for none.
    #[schemars(transform = between(0.0, 4096.0, "give 64 for a standard deviation within 10 %, or 0 for none"))]
    pub closure_draws: usize,
    /// Change of a step, of velocities over u_* and of fractions, below which a layer counts as steady `[-]`.
    #[schemars(transform = positive("give 1e-11, slightly above rounding; with 1e-3 the run stops too early"))]
    pub steady_change: f64,
}

impl Default for BedLoad1dFlow {
    fn default() -> Self {
        Self {
            stream: LayerStream::Slope(SlopedStream {
                slope: 0.03,
                depth: 0.046,
                bed_depth: 0.04,
                held_depth: 0.0,
                cell_height: 2.5e-4,
            }),
            gravity: 9.81,
            fluid_density: 1000.0,
            kinematic_viscosity: 1e-6,
            grain_density: 2600.0,
            grain_diameter: 5e-3,
            drag_diameter: 1.0,
            motion: BedMotion::Dilating,
            start: LayerStart::Rest,
            closures: Closures::default(),
            closure_draws: 0,
            steady_change: STEADY,
        }
    }
}

impl SlopedStream {
    fn check(&self) -> Result<(), ParameterError> {
        let Self { depth, bed_depth, held_depth, cell_height, .. } = *self;
        let remedy = "fix less than the whole bed, or give 0 for none";
        rules::between("stream.held_depth", held_depth, 0.0, 0.9 * bed_depth, remedy)?;
        let fits = |depth: f64| (depth / cell_height - (depth / cell_height).round()).abs() < 1e-6;
        let is_fine = depth / cell_height >= 10.0 && (depth + bed_depth) / cell_height <= 1e5;
        if is_fine && [depth, bed_depth, held_depth].into_iter().all(fits) {
            return Ok(());
        }
        let rule = "a length that divides the depths of water, bed and held grains into at most 1e5 whole cells";
        let remedy = "give 2.5e-4 for depths in multiples of a quarter of a millimetre";
        Err(ParameterError::field("stream.cell_height", cell_height, rule, remedy))
    }
}

impl GrainUnits {
    fn check(&self) -> Result<(), ParameterError> {
        let depths = [("relative_depth", self.relative_depth), ("relative_bed_depth", self.relative_bed_depth)];
        for (name, depth) in depths {
            let cells = depth * self.cells_per_diameter;
            if (cells - cells.round()).abs() > 1e-6 {
                let (rule, remedy) = ("a whole multiple of a cell", "give whole numbers of cells and diameters");
                return Err(ParameterError::field(&format!("stream.{name}"), depth, rule, remedy));
            }
        }
        Ok(())
    }
}

impl BedLoad1dFlow {
    /// The rules between fields.
    pub(super) fn checked(&self) -> Result<(), ParameterError> {
        if self.grain_density <= self.fluid_density {
            let (rule, remedy) =
                ("greater than the water density", "give it in kg/m³; floating grains form no bed load");
            return Err(ParameterError::field("grain_density", self.grain_density, rule, remedy));
        }
        rules::refuse("closures", self.closures.problem())?;
        match self.stream {
            LayerStream::Slope(own) => {
                own.check()?;
                self.check_sliding("stream.slope", own.slope)
            }
            LayerStream::ShieldsNumber(own) => {
                own.lengths.check()?;
                self.check_sliding("stream.shields_number", own.shields_number)
            }
            LayerStream::Onset(lengths) => lengths.check(),
        }
    }

    /// The stream; at the onset of motion, that of Shields' curve.
    pub fn stream(&self) -> Stream {
        match self.stream {
            LayerStream::Slope(own) => Stream {
                slope: own.slope,
                flow_depth: own.depth,
                bed_depth: own.bed_depth,
                held_depth: own.held_depth,
                gravity: self.gravity,
                fluid_density: self.fluid_density,
                kinematic_viscosity: self.kinematic_viscosity,
                grain_density: self.grain_density,
                grain_diameter: self.grain_diameter,
                drag_diameter: self.drag_diameter,
            },
            LayerStream::ShieldsNumber(own) => self.similar(&own.lengths, own.shields_number),
            LayerStream::Onset(lengths) => {
                let grains = self.similar(&lengths, 1.0);
                self.similar(&lengths, critical_shields_number(grains.dimensionless_diameter()))
            }
        }
    }

    /// A stream of a Shields number, with lengths counted in grains.
    fn similar(&self, lengths: &GrainUnits, shields_number: f64) -> Stream {
        let excess = self.grain_density / self.fluid_density - 1.0;
        let sloped = SlopedStream {
            slope: shields_number * excess / lengths.relative_depth,
            depth: lengths.relative_depth * self.grain_diameter,
            bed_depth: lengths.relative_bed_depth * self.grain_diameter,
            held_depth: 0.0,
            cell_height: self.grain_diameter / lengths.cells_per_diameter,
        };
        Self { stream: LayerStream::Slope(sloped), ..self.clone() }.stream()
    }

    /// Height of a cell `[m]`.
    pub fn cell_height(&self) -> f64 {
        match self.stream {
            LayerStream::Slope(own) => own.cell_height,
            LayerStream::ShieldsNumber(SimilarStream { lengths, .. }) | LayerStream::Onset(lengths) => {
                self.grain_diameter / lengths.cells_per_diameter
            }
        }
    }

    /// The layer.
    pub(super) fn layer(&self) -> Result<BedLoadLayer, LayerError> {
        let Self { closures, steady_change, motion, .. } = *self;
        let stream = self.stream();
        let grains = match motion {
            BedMotion::Frozen => GrainMotion::Frozen(smooth_bed(&stream, closures.largest_fraction)?),
            BedMotion::AtRest => GrainMotion::Resting(SolidFractionProfile::flat_bed(closures.largest_fraction)?),
            BedMotion::Dilating => GrainMotion::Dilating,
        };
        Ok(BedLoadLayer { stream, closures, grains, cell_height: self.cell_height(), steady_change })
    }

    /// Refuses a bed that slides on its base.
    fn check_sliding(&self, field: &str, value: f64) -> Result<(), ParameterError> {
        match self.layer().and_then(|layer| layer.check()) {
            Err(LayerError::BedSlides { slope, limit, remedy }) => {
                let defect = format!("{value} gives the slope {slope:.4}, but the bed slides above {limit:.4}");
                Err(ParameterError::field(field, defect, "", &remedy))
            }
            _ => Ok(()),
        }
    }

    /// Whether the onset of motion is sought.
    pub(super) fn seeks_onset(&self) -> bool {
        matches!(self.stream, LayerStream::Onset(_))
    }

    /// Whether eddies carry grains.
    pub(super) fn is_suspended(&self) -> bool {
        self.closures.turbulent_schmidt > 0.0
    }

    /// The layer with its stream, whatever the drag of its grains, that others have simulated or measured.
    pub(super) fn measured(&self) -> Option<MeasuredBedLoad> {
        let stream = self.stream();
        let is_own = |of: &MeasuredBedLoad| of.stream() == Stream { drag_diameter: 1.0, ..stream };
        MeasuredBedLoad::ALL.into_iter().find(is_own)
    }

    /// Name of the published layer with its stream.
    pub(super) fn published(&self) -> Option<&'static str> {
        let stream = self.stream();
        let is_near = |value: f64, other: f64| (value / other - 1.0).abs() < 1e-9;
        let is_duct =
            is_near(stream.shields_number(), DUCT.0) && is_near(stream.flow_depth / stream.grain_diameter, DUCT.1);
        self.measured().map(MeasuredBedLoad::name).or_else(|| is_duct.then_some("duct"))
    }

    /// Whether it is one of the case's own slopes with a motion of its grains.
    pub(super) fn is_on_slope(&self, motion: BedMotion) -> bool {
        matches!(self.stream, LayerStream::Slope(_)) && self.published().is_none() && self.motion == motion
    }

    /// Whether it is one of the layers that are judged: on a slope, from rest.
    pub(super) fn is_from_rest(&self) -> bool {
        self.is_on_slope(BedMotion::Dilating) && self.start == LayerStart::Rest && self.closure_draws == 0
    }

    /// A variant with what differs from the usual inputs, and the height of a cell where nothing else does or it differs as well.
    pub(super) fn with_changes(&self, variant: Variant) -> Variant {
        let mut usual = Self::default();
        if self.published().is_some() {
            (usual.grain_density, usual.grain_diameter) = (self.grain_density, self.grain_diameter);
            usual.closures.turbulent_schmidt = SCHMIDT_NUMBER;
        }
        if self.measured() == Some(MeasuredBedLoad::SheetFlow) {
            usual.drag_diameter = PLASTIC_DRAG;
        }
        let inputs = self.inputs().into_iter().zip(usual.inputs());
        let changed = inputs.filter(|(own, usual)| own != usual).map(|(own, _)| own);
        let named = changed.fold(variant.clone(), |named, (name, value)| named.and(name, value));
        let has_usual_cells = self.published().is_some() || self.cell_height() == usual.cell_height();
        if named != variant && has_usual_cells { named } else { named.and("cell_height", self.cell_height()) }
    }

    /// Inputs by their names in variants.
    pub(super) fn inputs(&self) -> [(&'static str, Value); 13] {
        let Closures { karman, turbulent_schmidt, .. } = self.closures;
        [
            ("bed_roughness_fade_length", self.closures.grain_roughness.bed_roughness_fade_length.into()),
            ("limiting_friction", self.closures.limiting_friction.into()),
            ("static_friction", self.closures.static_friction.into()),
            ("reference_inertia", self.closures.reference_inertia.into()),
            ("largest_fraction", self.closures.largest_fraction.into()),
            ("dilation", self.closures.dilation.into()),
            ("drag", self.closures.drag.name().into()),
            ("mixing_length", self.closures.mixing_length.name().into()),
            ("turbulent_schmidt", turbulent_schmidt.into()),
            ("drag_diameter", self.drag_diameter.into()),
            ("karman", karman.into()),
            ("grain_density", self.grain_density.into()),
            ("grain_diameter", self.grain_diameter.into()),
        ]
    }
}

/// A bed whose fraction falls smoothly (with two continuous derivatives) across z = 0.
fn smooth_bed(stream: &Stream, largest_fraction: f64) -> Result<SolidFractionProfile, LayerError> {
    let half = TRANSITION * stream.grain_diameter;
    SolidFractionProfile::sampled(-half, half, 4096, |z| {
        let x = (0.5 * (z / half + 1.0)).clamp(0.0, 1.0);
        largest_fraction * (1.0 - x * x * x * (10.0 - x * (15.0 - 6.0 * x)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::{RunList, Tier};

    #[test]
    fn a_layer_counted_in_grains_has_its_shields_number() {
        let lengths = GrainUnits { relative_depth: 20.0, relative_bed_depth: 6.0, cells_per_diameter: 12.0 };
        let stream = LayerStream::ShieldsNumber(SimilarStream { shields_number: 0.1, lengths });
        let flow = BedLoad1dFlow { stream, grain_diameter: 2e-3, ..BedLoad1dFlow::default() };
        let stream = flow.stream();
        assert!((stream.shields_number() / 0.1 - 1.0).abs() < 1e-12);
        assert!((stream.flow_depth / flow.cell_height() - 240.0).abs() < 1e-9);
    }

    #[test]
    fn the_streams_of_the_paper_have_its_shields_numbers() {
        // three digits are printed
        for (slope, printed) in [(0.03, 0.173), (0.05, 0.288)] {
            let found = Stream { slope, ..BedLoad1dFlow::default().stream() }.shields_number();
            assert!((found - printed).abs() <= 5.01e-4, "{found} at {slope}");
        }
    }

    #[test]
    fn the_list_has_the_streams_of_the_published_layers() {
        let flows = RunList::<BedLoad1dFlow>::of_tier(Tier::Paper).flows().to_vec();
        for name in ["grain-simulation", "sheet-flow", "duct"] {
            let of = flows.iter().filter(|flow| flow.published() == Some(name));
            assert!(of.clone().any(|flow| flow.start == LayerStart::Both), "{name}");
            assert!(name == "grain-simulation" || of.count() > 5, "{name}");
        }
    }
}
