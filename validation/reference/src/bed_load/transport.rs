//! Published formulas of bed-load transport, which `reference-data/bed-load/formulas.csv` lists: fits to experiments,
//! q* = c (τ* − τ*_c)^n with q* = q_s/√((s − 1) g d³), 0 below the critical Shields number τ*_c.

use crate::evidence::{MeasuredData, ReferenceKind, read_shipped};
use crate::input::FieldError;
use crate::metric::Confidence;
use crate::points::{MeasuredBand, MeasuredPoints};
use std::sync::LazyLock;

/// A formula.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TransportFormula {
    /// Meyer-Peter & Müller 1948.
    MeyerPeterMuller,
    /// Wong & Parker 2006 with the exponent 1.6: what their data ask for.
    WongParker,
    /// Wong & Parker 2006 with the exponent 1.5 kept.
    WongParkerThreeHalves,
    /// Ribberink 1998.
    Ribberink,
    /// Fernandez Luque & van Beek 1976.
    FernandezLuque,
}

/// Shields number from which runs count for [`MEASURED_BAND`] `[-]`: below it they are near the threshold of motion, where a formula with
/// any critical number is off by any factor.
const WELL_ABOVE_THRESHOLD: f64 = 0.1;

/// Shields number and transport q* of every measured run of `reference-data/bed-load/measured-transport.csv` `[-]`.
pub static MEASURED_TRANSPORT: LazyLock<MeasuredPoints> =
    LazyLock::new(|| MeasuredPoints::read("bed-load/measured-transport.csv", "Shields number", "transport"));

/// Factors on Wong & Parker's 1.6 form between which nine tenths of the measured runs well above the threshold of motion lie: the
/// width that a comparison with a formula can claim.
pub static MEASURED_BAND: LazyLock<(f64, f64)> = LazyLock::new(|| {
    let ratios = measured_ratios(|shields| shields >= WELL_ABOVE_THRESHOLD);
    MeasuredBand::of(ratios, 1).map_or((f64::NAN, f64::NAN), |band| band.bounds)
});

/// Factor in the Shields number within which runs count as of the same `[-]`.
const SAME_SHIELDS: f64 = 1.3;
/// Fewest runs that say something together.
const FEWEST_RUNS: usize = 10;

/// Band of the measured rates of the runs within a factor of 1.3 of a Shields number `[-]`, each over Wong & Parker's 1.6 form `[-]`;
/// none of too few.
pub fn measured_rates_about(shields_number: f64) -> Option<MeasuredBand> {
    let range = shields_number / SAME_SHIELDS..=shields_number * SAME_SHIELDS;
    MeasuredBand::of(measured_ratios(|shields| range.contains(&shields)), FEWEST_RUNS)
}

/// Rates of the measured runs within a factor of 1.3 of a Shields number `[-]`, or with too few of them of all well above the threshold,
/// each over Wong & Parker's 1.6 form `[-]`.
pub fn measured_scatter(shields_number: f64) -> Vec<f64> {
    let range = shields_number / SAME_SHIELDS..=shields_number * SAME_SHIELDS;
    let about: Vec<f64> = measured_ratios(|shields| range.contains(&shields)).collect();
    if about.len() < FEWEST_RUNS { measured_ratios(|shields| shields >= WELL_ABOVE_THRESHOLD).collect() } else { about }
}

/// Least and largest grain diameter `[m]` and slope `[-]` of the measured runs.
pub fn measured_grains() -> [(f64, f64); 2] {
    let range = |values: &[f64], unit: f64| {
        let least = values.iter().copied().fold(f64::INFINITY, f64::min);
        (least * unit, values.iter().copied().fold(0.0, f64::max) * unit)
    };
    read_shipped("bed-load/measured-transport.csv", |table| {
        Ok([range(table.numbers("grain diameter")?, 1e-3), range(table.numbers("slope")?, 1.0)])
    })
}

/// Rates of the measured runs at some Shields numbers, each over Wong & Parker's 1.6 form where that is not zero `[-]`.
fn measured_ratios(is_wanted: impl Fn(f64) -> bool) -> impl Iterator<Item = f64> {
    let ratios = MEASURED_TRANSPORT.points.iter().filter(move |(shields, _)| is_wanted(*shields));
    let own = |shields: f64| TransportFormula::WongParker.transport(shields);
    ratios.filter(move |(shields, _)| own(*shields) > 0.0).map(move |(shields, transport)| transport / own(*shields))
}

/// Row of a formula in the table.
#[derive(Debug, Clone, PartialEq)]
struct FormulaCoefficients {
    source: String,
    confidence: Confidence,
    origin: ReferenceKind,
    coefficient: f64,
    critical: f64,
    exponent: f64,
}

/// Coefficients in the order of [`TransportFormula::ALL`].
static ROWS: LazyLock<Vec<FormulaCoefficients>> = LazyLock::new(|| read_shipped("bed-load/formulas.csv", rows));

fn rows(table: &MeasuredData) -> Result<Vec<FormulaCoefficients>, FieldError> {
    let (sources, confidences) = (table.labels("source")?, table.confidences()?);
    let row = |formula: TransportFormula| {
        let row = table.row("formula", formula.key())?;
        Ok(FormulaCoefficients {
            source: sources[row].clone(),
            confidence: confidences[row],
            origin: table.metadata.origin,
            coefficient: table.numbers("coefficient")?[row],
            critical: table.numbers("critical Shields number")?[row],
            exponent: table.numbers("exponent")?[row],
        })
    };
    TransportFormula::ALL.into_iter().map(row).collect()
}

impl TransportFormula {
    /// All formulas.
    pub const ALL: [Self; 5] =
        [Self::MeyerPeterMuller, Self::WongParker, Self::WongParkerThreeHalves, Self::Ribberink, Self::FernandezLuque];

    /// Coefficient c `[-]`, critical Shields number τ*_c `[-]` and exponent n `[-]`.
    pub fn parameters(self) -> (f64, f64, f64) {
        let row = self.row();
        (row.coefficient, row.critical, row.exponent)
    }

    /// Name in the table.
    fn key(self) -> &'static str {
        match self {
            Self::MeyerPeterMuller => "meyer-peter-mueller",
            Self::WongParker => "wong-parker-1.6",
            Self::WongParkerThreeHalves => "wong-parker-1.5",
            Self::Ribberink => "ribberink",
            Self::FernandezLuque => "fernandez-luque",
        }
    }

    fn row(self) -> &'static FormulaCoefficients {
        &ROWS[self as usize]
    }

    /// Transport rate q* `[-]` at a Shields number τ* `[-]`.
    pub fn transport(self, shields_number: f64) -> f64 {
        let (coefficient, critical, exponent) = self.parameters();
        let excess = shields_number - critical;
        if excess > 0.0 { coefficient * libm::pow(excess, exponent) } else { 0.0 }
    }

    /// Authors, year and formula.
    pub fn name(self) -> &'static str {
        &self.row().source
    }

    /// Kind of reference.
    pub fn origin(self) -> ReferenceKind {
        self.row().origin
    }

    /// Confidence in the formula: read in two or more documents, or in one besides the coefficients.
    pub fn confidence(self) -> Confidence {
        self.row().confidence
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evidence::shipped_table;

    #[test]
    fn formulas_give_the_printed_table() {
        let table = shipped_table("bed-load/transport.csv").expect("readable");
        let names = table.labels("formula").expect("labels");
        let column = |name| table.numbers(name).expect("numbers");
        let (shields, transport) = (column("Shields number"), column("transport"));
        let of = |name: &str| TransportFormula::ALL.into_iter().find(|formula| formula.key() == name).expect(name);
        assert_eq!(names.len(), 15);
        for ((name, shields), printed) in names.iter().zip(shields).zip(transport) {
            // three digits after the point
            let computed = of(name).transport(*shields);
            assert!((computed - printed).abs() < 5.5e-4, "{name} at {shields}: {computed} for {printed}");
        }
    }

    #[test]
    fn nothing_moves_below_the_critical_shields_number() {
        for formula in TransportFormula::ALL {
            let (_, critical, _) = formula.parameters();
            assert_eq!(formula.transport(critical), 0.0);
            assert_eq!(formula.transport(0.0), 0.0);
            assert!(formula.transport(critical + 1e-6) > 0.0);
            assert_eq!(formula.origin(), ReferenceKind::Fit);
            assert!(formula.confidence() != Confidence::Unverified, "{}", formula.name());
        }
    }

    #[test]
    fn the_formula_runs_through_the_runs_of_each_shields_number() {
        for shields in [0.115, 0.173] {
            let rates = measured_rates_about(shields).expect("runs");
            assert!((0.4..1.2).contains(&rates.median), "{shields}: {rates:?}");
            assert!(
                rates.bounds.0 < rates.median && rates.median < rates.bounds.1 && rates.deviation > 0.0,
                "{rates:?}"
            );
        }
        assert_eq!(measured_rates_about(5.0), None);
    }

    #[test]
    fn the_band_holds_nine_tenths_of_the_runs_well_above_the_threshold() {
        assert_eq!(MEASURED_TRANSPORT.points.len(), 105);
        let own = TransportFormula::WongParker;
        let ratio = |&(shields, transport): &(f64, f64)| transport / own.transport(shields);
        let well_above: Vec<f64> = MEASURED_TRANSPORT.points.iter().filter(|run| run.0 >= 0.1).map(ratio).collect();
        let inside = well_above.iter().filter(|ratio| (MEASURED_BAND.0..=MEASURED_BAND.1).contains(*ratio)).count();
        println!("{MEASURED_BAND:?}: {inside} of {}", well_above.len());
        assert_eq!((well_above.len(), inside), (32, 28));
        // and it is no wider than the factor of two by which the formula is said to scatter
        assert!(MEASURED_BAND.0 > 0.45 && MEASURED_BAND.1 < 2.0);
    }
}
