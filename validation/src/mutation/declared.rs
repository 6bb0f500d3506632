//! Which cases ought to see an error: declared before they were run.

use super::Scope;
use bagnold_solver::planted::Planted;

const BAGNOLD: &str = "bagnold";
const BED_LOAD: &str = "bed-load";
const BED_LOAD_1D: &str = "bed-load-1d";
const CLEAR_WATER: &str = "clear-water";
const COLUMN_PLANAR: &str = "column-planar";
const COLUMN_ROUND: &str = "column-round";
const FILM: &str = "film";
const FLOW_THICKNESS: &str = "flow-thickness";
const HYDROSTATIC: &str = "hydrostatic";
const INCLINE: &str = "incline-collapse";
const SETTLING: &str = "settling";
const STILL_WATER: &str = "still-water";
const WATER_COLUMN: &str = "water-column";
const WATER_FILM: &str = "water-film";

/// What a case is cut to, so that its runs are those that say something new: settings of `--set`.
#[must_use]
pub fn settings_of(case: &str) -> &'static [&'static str] {
    match case {
        BAGNOLD => &["slope_angles=[24.0]"],
        // one slope, and no study of its order
        BED_LOAD_1D => &["slopes=[0.03]", "dilating_cell_heights=[]", "frozen_cell_heights=[]", "measured=[]"],
        // other operators are observed and never judged
        FILM => &["comparison_resolution=0"],
        STILL_WATER => &["jitters=[0.4]", "unstabilised_jitters=[]"],
        _ => &[],
    }
}

/// The cases that ought to see an error, the likeliest first.
fn cases(error: Planted) -> &'static [&'static str] {
    match error {
        Planted::KernelNormalisation | Planted::KernelGradient => &[HYDROSTATIC, STILL_WATER, WATER_FILM],
        Planted::NeighbourRadius => &[FILM, WATER_FILM, COLUMN_PLANAR],
        Planted::PeriodicShift => &[FILM, BAGNOLD],
        Planted::PeriodicWrap => &[WATER_FILM, SETTLING],
        Planted::MirrorTensorSign => &[FILM, COLUMN_PLANAR],
        Planted::MirrorVectorSign => &[COLUMN_PLANAR, WATER_COLUMN],
        Planted::GravityValue => &[INCLINE, HYDROSTATIC, SETTLING],
        Planted::GravityAlongBed => &[BAGNOLD, FILM, WATER_FILM],
        Planted::PressureHalved | Planted::SoundSpeed => &[HYDROSTATIC, FILM, WATER_COLUMN],
        Planted::FrictionSwapped => &[BAGNOLD, FLOW_THICKNESS],
        Planted::InertialDensity | Planted::InertialRoot | Planted::ReferenceInertia => &[BAGNOLD],
        Planted::ViscousReferenceRate | Planted::RootFriction => &[BED_LOAD_1D, BED_LOAD],
        Planted::YieldNorm | Planted::ShearRateNorm | Planted::FlowIndex => &[FILM],
        Planted::TrialModulus | Planted::SpinSign => &[HYDROSTATIC, BAGNOLD, COLUMN_PLANAR],
        Planted::VonKarman | Planted::RoughnessLength => &[CLEAR_WATER, BED_LOAD],
        Planted::Smagorinsky => &[FILM, CLEAR_WATER, WATER_COLUMN],
        Planted::MixingLengthRoot => &[CLEAR_WATER, BED_LOAD_1D],
        Planted::RoomAmongGrains | Planted::IntrinsicViscosity | Planted::Dilation => &[BED_LOAD_1D, BED_LOAD],
        Planted::SchillerNaumannExponent
        | Planted::WenYuExponent
        | Planted::DiFeliceExponent
        | Planted::MorsiAlexanderExponent
        | Planted::ErgunInertia => &[SETTLING, BED_LOAD_1D],
        Planted::ArtificialViscositySign => &[HYDROSTATIC, WATER_COLUMN],
        Planted::HourglassSign | Planted::HourglassDirection => &[BAGNOLD, HYDROSTATIC, WATER_COLUMN],
        Planted::DensityCouplingSign => &[HYDROSTATIC, FILM],
        Planted::StressDiffusionSign => &[FLOW_THICKNESS, BAGNOLD],
        Planted::WallPressure | Planted::WallStress | Planted::WallVelocity => &[HYDROSTATIC, BAGNOLD, FILM],
        Planted::WallContinuity => &[HYDROSTATIC, WATER_COLUMN],
        Planted::ForceCorrection | Planted::GradientCorrection => &[BAGNOLD, FILM],
        Planted::ElasticDamping => &[HYDROSTATIC, BAGNOLD, FLOW_THICKNESS],
        Planted::OldVelocityMoves => &[HYDROSTATIC, FILM],
        Planted::ViscousResponse => &[COLUMN_PLANAR, FILM],
        Planted::ContactFriction => &[COLUMN_PLANAR, COLUMN_ROUND, INCLINE],
        Planted::PoissonSource
        | Planted::Stabilisation
        | Planted::DensityCorrection
        | Planted::PressureMoments
        | Planted::SurfacePressure => &[STILL_WATER, WATER_FILM],
        Planted::ShiftingSign => &[STILL_WATER, CLEAR_WATER],
        Planted::BedMirror => &[WATER_FILM],
        Planted::DragReaction => &[SETTLING, BED_LOAD_1D],
        Planted::Overburden | Planted::PairRate | Planted::GrainFilling => &[BED_LOAD_1D, BED_LOAD],
        Planted::WaterShare => &[BED_LOAD_1D, BED_LOAD, SETTLING],
    }
}

/// The cases that ought to see an error, cut to what matters.
#[must_use]
pub fn scopes(error: Planted) -> Vec<Scope> {
    let scope = |case: &&str| Scope {
        case: (*case).to_owned(),
        settings: settings_of(case).iter().map(|setting| (*setting).to_owned()).collect(),
    };
    cases(error).iter().map(scope).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::{Changes, Tier};
    use crate::cases::REGISTRY;

    #[test]
    fn every_error_has_cases_that_take_their_settings() {
        for &error in Planted::ALL {
            let scopes = scopes(error);
            assert!(!scopes.is_empty(), "{} is seen by no case", error.name());
            for scope in scopes {
                let case = REGISTRY.find(&scope.case).expect("a case");
                let changes = Changes { file: None, settings: &scope.settings, ..Changes::default() };
                assert!(case.prepare(Tier::Quick, &changes).is_ok(), "{scope:?}");
            }
        }
    }

    #[test]
    fn names_are_distinct() {
        let mut names: Vec<&str> = Planted::ALL.iter().map(|error| error.name()).collect();
        names.sort_unstable();
        assert!(names.windows(2).all(|pair| pair[0] != pair[1]));
    }
}
