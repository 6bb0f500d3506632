//! Arguments of `bagnold predict`.

use clap::{Args, Subcommand};

const EXAMPLES: &str = "Example:
  bagnold predict bed-load --grain-diameter 0.002 --slope 0.015 --depth 0.1 --width 0.3

A steady layer over the depth, with closures of the literature, gives the transport. The interval consists of draws of the closures
from their ranges and of the scatter of measured runs at about the same Shields number.";

/// `bagnold predict`
#[derive(Debug, Args)]
pub struct PredictArguments {
    /// What is predicted.
    #[command(subcommand)]
    pub action: PredictAction,
}

/// Predictions.
#[derive(Debug, Subcommand)]
pub enum PredictAction {
    /// Predict the bed load of a steady stream in a flume.
    BedLoad(BedLoadArguments),
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
    /// Slope of the energy line [-].
    #[arg(long, value_name = "TAN", value_parser = slope)]
    pub slope: f64,
    /// Depth of the water [m].
    #[arg(long, value_name = "M", value_parser = length)]
    pub depth: f64,
    /// Width between smooth side walls [m]; none without this option.
    #[arg(long, value_name = "M", value_parser = length)]
    pub width: Option<f64>,
    /// Number of draws of the closures.
    #[arg(long, value_name = "N", default_value = "64", value_parser = clap::value_parser!(u16).range(8..=4096))]
    pub draws: u16,
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
