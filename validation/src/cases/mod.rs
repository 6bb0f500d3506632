//! The canonical cases. A new case is one file or folder here and one line in `registry!`.

mod arrangement;
pub mod bagnold;
pub mod bed_load;
pub mod bed_load_1d;
mod bulk;
pub mod channel;
pub mod clear_water;
pub mod collapse;
pub mod column_planar;
pub mod column_round;
pub mod film;
pub mod flow_thickness;
pub mod hydrostatic;
pub mod incline_collapse;
pub mod layer;
pub mod recording;
mod rules;
pub mod settling;
pub mod still_water;
mod transport_panel;
pub mod water_film;

pub use arrangement::Arrangement;
pub use bulk::Bulk;

use crate::case::Registry;

/// Makes the registry, and the macro by which tests have one module a case.
macro_rules! registry {
    ($mark:tt $($module:ident :: $case:ident),+ $(,)?) => {
        /// All cases, in the order of `bagnold list` and of the report.
        pub static REGISTRY: Registry = Registry::new(&[$(&$module::$case),+]);

        /// Calls a macro with the modules of all cases, whose names are those of the cases with `_` for `-`.
        #[macro_export]
        macro_rules! for_every_case {
            ($mark callback:ident) => {
                $mark callback!($($module),+);
            };
        }
    };
}

registry!($
    hydrostatic::Hydrostatic,
    film::Film,
    bagnold::Bagnold,
    column_planar::ColumnPlanar,
    column_round::ColumnRound,
    incline_collapse::InclineCollapse,
    flow_thickness::FlowThickness,
    still_water::StillWater,
    water_film::WaterFilm,
    clear_water::ClearWater,
    settling::Settling,
    bed_load_1d::BedLoad1d,
    bed_load::BedLoad,
);

#[cfg(test)]
mod tests {
    use super::REGISTRY;
    use crate::case::{Changes, Tier};
    use crate::metric::Variant;
    use std::collections::BTreeSet;

    #[test]
    fn the_runs_of_a_case_have_their_own_variants_texts_and_file_names() {
        for case in REGISTRY.iter() {
            for tier in [Tier::Quick, Tier::Paper, Tier::Fine] {
                let prepared = case.prepare(tier, &Changes::default()).expect("the tiers are valid");
                let variants: Vec<Variant> = (0..prepared.run_count()).map(|run| prepared.variant(run)).collect();
                let files: BTreeSet<String> = variants.iter().map(Variant::file_name).collect();
                assert_eq!(files.len(), variants.len(), "{}, {tier}", case.name());
                for variant in variants {
                    assert_eq!(variant.to_string().parse(), Ok(variant));
                }
            }
        }
    }
}
