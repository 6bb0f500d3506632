//! Arguments of `bagnold predict`.

use super::{ExecutionOptions, ResourceLimits};
use clap::{Args, Subcommand};
use std::path::PathBuf;

const EXAMPLES: &str = "Example:
  bagnold predict bed-load --grain-diameter 0.002 --slope 0.015 --depth 0.1 --width 0.3

The transport is that of a steady one-dimensional layer with closures from the literature.
The interval combines draws of the closures from their ranges with the scatter of measured runs at about the same Shields number.";

const COLLAPSE_EXAMPLES: &str = "Example:
  bagnold predict column-planar --law law/law.toml --set half_width=0.08 --set solid_fraction=0.76 --out column

The law holds [material] and [[draws]]. Before anything runs, DIR/plan.json receives a digest of law, flow and program.
The folder rejects another plan. u_input is the standard deviation over the draws.
u_numerical is the difference between the two resolutions, or the front's uncertainty due to the spacing where that is larger.
The heading of the measurements is `run_out [-],run_out uncertainty [-]`, or of repeats `run_out #1 [-],run_out #2 [-]`.";

/// `bagnold predict`
#[derive(Debug, Args)]
pub struct PredictArguments {
    /// Quantity to predict.
    #[command(subcommand)]
    pub action: PredictAction,
}

/// Quantities that can be predicted.
#[derive(Debug, Subcommand)]
pub enum PredictAction {
    /// Predict the bed load of a steady stream in a flume.
    BedLoad(BedLoadArguments),
    /// Predict the collapse of a planar column from a fitted law.
    ColumnPlanar(Box<CollapseArguments>),
    /// Predict the collapse on a slope from a fitted law.
    InclineCollapse(Box<CollapseArguments>),
}

/// `bagnold predict column-planar`
#[derive(Debug, Args)]
#[command(after_help = COLLAPSE_EXAMPLES)]
pub struct CollapseArguments {
    /// File of the law, as `bagnold calibrate` writes it.
    #[arg(long, value_name = "FILE.toml")]
    pub law: PathBuf,
    /// Change one parameter of the flow; may be repeated.
    #[arg(long = "set", value_name = "path=value")]
    pub settings: Vec<String>,
    /// Particles over the half width (on a slope: over the height) in runs of draws; the predicted value uses twice as many.
    #[arg(long, value_name = "N", default_value = "20", value_parser = clap::value_parser!(u16).range(4..=400))]
    pub resolution: u16,
    /// Number of draws of the law.
    #[arg(long, value_name = "N", default_value = "24", value_parser = clap::value_parser!(u16).range(2..=1000))]
    pub draws: u16,
    /// CSV table of the measured collapse, with one row.
    #[arg(long, value_name = "FILE.csv")]
    pub measured: Option<PathBuf>,
    /// Output folder [default: reports/predictions/CASE].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Resource limits of each run.
    #[command(flatten)]
    pub allowance: ResourceLimits,
    /// Execution options.
    #[command(flatten)]
    pub work: ExecutionOptions,
}

/// `bagnold predict bed-load`
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub struct BedLoadArguments {
    /// Grain diameter [m].
    #[arg(long, value_name = "M", value_parser = grain)]
    pub grain_diameter: f64,
    /// Grain density [kg/m³].
    #[arg(long, value_name = "KG/M³", default_value = "2650", value_parser = density)]
    pub grain_density: f64,
    /// Slope of the energy line as a tangent [-], 0.015 for 1.5 %.
    #[arg(long, value_name = "TAN", value_parser = slope)]
    pub slope: f64,
    /// Depth of the water [m].
    #[arg(long, value_name = "M", value_parser = length)]
    pub depth: f64,
    /// Width between smooth side walls [m]; without this option the flume has no side walls.
    #[arg(long, value_name = "M", value_parser = length)]
    pub width: Option<f64>,
    /// Number of random draws of the closures.
    #[arg(long, value_name = "N", default_value = "64", value_parser = clap::value_parser!(u16).range(8..=4096))]
    pub draws: u16,
    /// Measured transport to compare with [kg/(m s)].
    #[arg(long, value_name = "KG/(M S)", value_parser = rate)]
    pub measured: Option<f64>,
}

fn rate(text: &str) -> Result<f64, String> {
    number(text, (1e-9, 1e4), "give it in kg/(m s): kg/s over the width of the flume")
}

fn number(text: &str, (least, most): (f64, f64), remedy: &str) -> Result<f64, String> {
    let value: Option<f64> = text.parse().ok().filter(|value| (least..=most).contains(value));
    value.ok_or_else(|| format!("must be a number from {least} to {most}; {remedy}"))
}

fn grain(text: &str) -> Result<f64, String> {
    number(text, (1e-4, 0.5), "give it in metres: 0.002 for 2 mm")
}

fn length(text: &str) -> Result<f64, String> {
    number(text, (1e-4, 100.0), "give it in metres: 0.1 for 10 cm")
}

fn density(text: &str) -> Result<f64, String> {
    number(text, (1010.0, 20_000.0), "give it in kg/m³: 2650 for quartz")
}

fn slope(text: &str) -> Result<f64, String> {
    number(text, (1e-5, 0.2), "give the tangent: 0.015 for 1.5 %")
}
