//! The registry of all cases. A new case is one folder in the package `cases` and one line in `registry!`.

use crate::case::Registry;
use crate::store::provenance::{Build, declare};
use bagnold_cases::channel::{bed_load, clear_water, still_water, water_film};
use bagnold_cases::collapse::{columns::column_planar, columns::column_round, incline as incline_collapse};
use bagnold_cases::layer::{bagnold, film, flow_thickness, hydrostatic};
use bagnold_cases::{bed_load_1d, nonlocal_shear, settling, water_column};
use bagnold_scenes::study::canonical;
use bagnold_scenes::{scene, scene_space};
use std::sync::LazyLock;

/// The canonical studies, by file.
mod studies {
    include!(concat!(env!("OUT_DIR"), "/studies.rs"));
    pub(super) static ALL: &[(&str, &str)] = &FILES;
}

/// Build of this program, as its build script found it.
const BUILD: Build = Build {
    source_hash: env!("BAGNOLD_SOURCE_HASH"),
    solver_hash: env!("BAGNOLD_SOLVER_HASH"),
    simulation_hashes: include!(concat!(env!("OUT_DIR"), "/rooms.rs")),
    commit: env!("BAGNOLD_COMMIT"),
    profile: env!("BAGNOLD_PROFILE"),
    solver_opt_level: env!("BAGNOLD_SOLVER_OPT_LEVEL"),
    target_features: env!("BAGNOLD_TARGET_FEATURES"),
};

/// Declares what this program is built from.
pub(crate) fn declare_build() {
    declare(BUILD);
}

/// Makes the registry, and the macro by which tests have one module a case.
macro_rules! registry {
    ($mark:tt $($module:ident :: $case:ident),+ $(,)?) => {
        /// All cases and canonical studies, in the order of `bagnold list` and of the report. Its first use declares what the program is built from, so
        /// that results of these cases are stored and found by the hash of their sources.
        pub static REGISTRY: LazyLock<Registry> = LazyLock::new(|| {
            declare_build();
            static CASES: Registry = Registry::new(&[$(&$module::$case),+]);
            let studies = canonical(studies::ALL, CASES);
            Registry::new(Vec::leak(CASES.iter().chain(studies).collect()))
        });

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
    column_planar::CASE,
    column_round::CASE,
    incline_collapse::InclineCollapse,
    flow_thickness::FlowThickness,
    nonlocal_shear::NonlocalShearFlows,
    water_column::WaterColumn,
    still_water::StillWater,
    water_film::WaterFilm,
    clear_water::ClearWater,
    settling::Settling,
    bed_load_1d::BedLoad1d,
    bed_load::BedLoad,
    scene::CASE,
    scene_space::CASE,
);

#[cfg(test)]
mod tests {
    use super::REGISTRY;
    use crate::case::{Changes, PreparedCase, Progress, Tier};
    use crate::metric::Variant;
    use crate::report::Baseline;
    use crate::store::{CodeOrigin, Store, StorePolicy};
    use bagnold_solver::material::rheology::ViscousLaw;
    use bagnold_solver::material::rheology::open::{OpenLaw, Parameters, register};
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

    /// The case without particles solves a layer over its depth, and has no scene to read.
    #[test]
    fn every_case_of_particles_has_boundaries_and_a_start() {
        for case in REGISTRY.iter().filter(|case| !case.is_study()) {
            let prepared = case.prepare(Tier::Quick, &Changes::default()).expect("the tier is valid");
            let Some(all) = prepared.conditions(0) else {
                assert_eq!(case.name(), "bed-load-1d");
                continue;
            };
            let (start, boundaries): (Vec<_>, Vec<_>) = all.rows.iter().partition(|row| row.is_of_start());
            assert!(!boundaries.is_empty(), "{}", case.name());
            assert!(start.iter().all(|row| row.value.is_finite()), "{}: {start:?}", case.name());
            assert!(start.iter().any(|row| row.quantity == "gravity x"), "{}", case.name());
        }
    }

    #[test]
    fn every_case_has_a_baseline() {
        for case in REGISTRY.iter() {
            let baseline =
                Baseline::shipped(case.name(), Tier::Quick).unwrap_or_else(|error| panic!("failed to {error}"));
            assert!(!baseline.is_empty(), "{}", case.name());
        }
    }

    #[test]
    fn every_case_is_known_by_the_hash_of_the_sources() {
        for case in REGISTRY.iter() {
            assert_eq!(case.origin(), CodeOrigin::PACKAGE, "{}: its `ORIGIN` is missing", case.name());
        }
        assert_eq!(crate::pendulum::REGISTRY.origin(), CodeOrigin::ELSEWHERE);
    }

    /// A liquid that no built-in law knows by this name.
    #[derive(Debug, serde::Deserialize)]
    struct Honey {
        viscosity: f64,
    }

    impl ViscousLaw for Honey {
        fn viscosity(&self, _: f64, _: f64) -> f64 {
            self.viscosity
        }

        fn largest_viscosity(&self, _: f64) -> f64 {
            self.viscosity
        }
    }

    fn prepared(case: &str, settings: &[&str]) -> Result<Box<dyn PreparedCase>, String> {
        let settings: Vec<String> = settings.iter().map(|&setting| setting.to_owned()).collect();
        let case = REGISTRY.iter().find(|other| other.name() == case).expect("a case");
        case.prepare(Tier::Quick, &Changes { file: None, settings: &settings, ..Changes::default() })
            .map_err(|error| error.to_string())
    }

    #[test]
    fn any_law_runs_by_its_name() {
        register("honey", |parameters: &Parameters| Ok(OpenLaw::viscous(parameters.read::<Honey>()?))).expect("new");
        let bingham = |table: &str| {
            ["law=bingham", "yield_stress=1", "plastic_viscosity=1", "regularisation_rate=1"]
                .map(|setting| format!("{table}.{setting}"))
        };
        let honey = ["material.law=honey".to_owned(), "material.viscosity=1".to_owned()];
        let layer = ["resolution=4", "preparation=none", "duration=2.2", "bulk_density=1000"];
        let column = ["resolution=4", "duration=0.1", "bulk_density=1500", "aspect_ratio=1", "variants=[]"];
        for (case, own, law) in [
            ("hydrostatic", layer.to_vec(), honey.to_vec()),
            ("hydrostatic", layer.to_vec(), bingham("material").to_vec()),
            ("column-planar", column.to_vec(), bingham("material").to_vec()),
        ] {
            let settings: Vec<&str> = own.into_iter().chain(law.iter().map(String::as_str)).collect();
            let prepared = prepared(case, &settings).expect("valid");
            let store = Store::at(std::path::Path::new("unused"), StorePolicy::Bypass);
            prepared.simulate(0, &store, &Progress::SILENT).expect("a scene");
            let result = prepared.finish().expect("a result");
            assert!(!result.metrics.is_empty(), "{case}: {settings:?}");
        }
    }

    #[test]
    fn a_case_made_for_one_law_says_so() {
        let refusal = |case: &str, path: &str| {
            let settings = [format!("{path}.law=newtonian"), format!("{path}.viscosity=1")];
            prepared(case, &settings.each_ref().map(String::as_str)).err().unwrap_or_default()
        };
        let bagnold =
            "`material.law` is \"newtonian\", but must be \"mu-i\"; choose it: the case's reference, Bagnold's profile";
        assert!(refusal("bagnold", "material").starts_with(bagnold));
        let thickness = refusal("flow-thickness", "material");
        let laws = "`material.law` is \"newtonian\", but must be \"mu-i\" or \"nonlocal-mu-i\"";
        assert!(thickness.starts_with(laws), "{thickness}");
    }
}
