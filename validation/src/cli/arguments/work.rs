//! Options of everything that simulates: how much it may ask for, and how to compute.

use crate::figure::FigureFormat;
use clap::Args;
use std::path::PathBuf;
use std::time::Duration;

/// Resource limits of runs; more is rejected before anything is allocated.
#[derive(Debug, Clone, Copy, Default, Args)]
pub struct ResourceLimits {
    /// Reject runs that need more memory than this [default: $BAGNOLD_MOST_MEMORY, else the memory of the machine].
    #[arg(long, value_name = "GIB", value_parser = positive, allow_negative_numbers = true)]
    pub most_memory: Option<f64>,
    /// Reject runs above this number of estimated core hours per case [default: $BAGNOLD_MOST_HOURS, else 10000].
    #[arg(long, value_name = "HOURS", value_parser = positive, allow_negative_numbers = true)]
    pub most_hours: Option<f64>,
}

pub(super) fn positive(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|number| *number > 0.0);
    number.ok_or_else(|| "must be a positive number, such as 30 or 0.5".to_owned())
}

/// Execution options of every command that simulates.
#[derive(Debug, Args)]
pub struct ExecutionOptions {
    /// Threads to use [default: all cores].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Simulate all runs again, without stored results and checkpoints.
    #[arg(long)]
    pub fresh: bool,
    /// Seconds between two checkpoints of a run [default: 60; up to 120 if a checkpoint costs over 1 %].
    #[arg(long, value_name = "SECONDS", value_parser = seconds, allow_negative_numbers = true)]
    pub checkpoint_interval: Option<Duration>,
    /// Folder of stored results [default: $BAGNOLD_STORE, else reports/store of the checkout, else the
    /// cache folder of the user].
    #[arg(long, value_name = "DIR")]
    pub store: Option<PathBuf>,
}

/// A time of an argument.
fn seconds(text: &str) -> Result<Duration, String> {
    let rule = "must be a number of seconds from 0 to 1e6, such as 60";
    let seconds: f64 = text.parse().map_err(|_| rule.to_owned())?;
    if (0.0..=1e6).contains(&seconds) { Ok(Duration::from_secs_f64(seconds)) } else { Err(rule.to_owned()) }
}

/// Size of figures.
#[derive(Debug, Clone, Copy, Default, Args)]
pub struct FigureOptions {
    /// Figures for a paper: width, font size of the axis labels, resolution of the PNG, such as
    /// 85mm,9pt,300dpi [default: for the screen, 1600 px wide].
    #[arg(long, value_name = "MM,PT,DPI")]
    pub figure: Option<FigureFormat>,
}

impl FigureOptions {
    /// The format that was asked for, or that of the screen.
    pub fn format(self) -> FigureFormat {
        self.figure.unwrap_or_default()
    }
}
