//! The columns that the case asks for, in report order.

use super::parameters::{ColumnPlanarParameters, PlanarColumns, SHOWN};
use crate::collapse::interior::PROFILE_TIME;
use crate::collapse::{Alteration, ColumnPurpose, ColumnRun, ExperimentGrains, Geometry, Material, Release};
use crate::reference::grains::LAGREE_GRAINS;
use bagnold_solver::material::rheology::{MuI, Rheology};
use bagnold_solver::weakly_compressible::numerics::{Numerics, ViscousStep};

/// Seeds at the finest resolution of a study.
const FINEST_SEEDS: usize = 3;
/// Particles over the half width from which one seed serves: below, the scatter is of the size of the limits of half a per cent.
const SINGLE_SEED_RESOLUTION: usize = 80;
/// Longest time of a regularised column over √(h_0/g) `[-]`: it never rests.
const REGULARISED_DURATION: f64 = 5.0;
/// Time of a further seed of a profile over √(h_0/g) `[-]`: just beyond that of the profile.
const PROFILE_SEED_DURATION: f64 = PROFILE_TIME + 0.1;

pub(super) fn all(parameters: &ColumnPlanarParameters) -> Vec<ColumnRun> {
    let published = parameters.materials().into_iter().flat_map(|(grains, columns)| {
        let material = Material::published(grains);
        columns.aspect_ratios.iter().map(move |&ratio| parameters.column(material, columns, ratio))
    });
    published
        .chain(parameters.altered())
        .chain(parameters.ensembles())
        .chain(parameters.hourglasses())
        .chain(parameters.other_numerics())
        .chain(parameters.regularised())
        .chain(parameters.profile_seeds())
        .collect()
}

impl ColumnPlanarParameters {
    /// A column that is there for the laws.
    fn column(&self, material: Material, columns: &PlanarColumns, aspect_ratio: f64) -> ColumnRun {
        let shown = SHOWN.iter().find(|shown| shown.0 == aspect_ratio).map_or(&[][..], |shown| shown.1);
        let is_shown = matches!(material, Material::SAND | Material::GLASS);
        ColumnRun {
            purpose: ColumnPurpose::Law,
            geometry: Geometry::Planar,
            material,
            aspect_ratio,
            resolution: self.resolution_of(material.grains, aspect_ratio),
            half_width: columns.half_width_of(aspect_ratio),
            law: columns.law,
            bulk_density: columns.bulk.density(&columns.law),
            regularisation_rate: None,
            shown_times: if is_shown { shown.to_vec() } else { Vec::new() },
            release: self.release,
        }
    }

    /// Columns of grains that differ from others in one number.
    fn altered(&self) -> Vec<ColumnRun> {
        let of = |columns: &PlanarColumns, law: MuI, material: Material, aspect_ratios: &[f64]| {
            let columns = PlanarColumns { law: Rheology::MuI(law), ..columns.clone() };
            aspect_ratios.iter().map(|&ratio| self.column(material, &columns, ratio)).collect::<Vec<_>>()
        };
        let mut runs = Vec::new();
        if let Rheology::MuI(law) = self.sand.law {
            for &reference_inertia in &self.sand_inertias.values {
                let material =
                    Material::altered(ExperimentGrains::Sand, Alteration::ReferenceInertia(reference_inertia));
                let ratios = &self.sand_inertias.aspect_ratios;
                runs.extend(of(&self.sand, MuI { reference_inertia, ..law }, material, ratios));
            }
        }
        if let Rheology::MuI(law) = self.lagree.law {
            for &grain_diameter in &self.lagree_diameters.values {
                let material = Material::altered(ExperimentGrains::Lagree, Alteration::GrainDiameter(grain_diameter));
                let ratios = &self.lagree_diameters.aspect_ratios;
                runs.extend(of(&self.lagree, MuI { grain_diameter, ..law }, material, ratios));
            }
        }
        if let Rheology::MuI(law) = self.bars.law {
            for &friction in &self.bars_frictions.values {
                let material = Material::altered(ExperimentGrains::Bars, Alteration::Friction(friction));
                let law = MuI { static_friction: friction, limiting_friction: friction, ..law };
                runs.extend(of(&self.bars, law, material, &self.bars_frictions.aspect_ratios));
            }
            for &limiting_friction in &self.bars_limiting_frictions.values {
                let material =
                    Material::altered(ExperimentGrains::Bars, Alteration::LimitingFriction(limiting_friction));
                let MuI { reference_inertia, grain_diameter, .. } = LAGREE_GRAINS.law;
                let law = MuI { limiting_friction, reference_inertia, grain_diameter, ..law };
                runs.extend(of(&self.bars, law, material, &self.bars_limiting_frictions.aspect_ratios));
            }
        }
        runs
    }

    /// Ensembles of seeds at several resolutions.
    fn ensembles(&self) -> Vec<ColumnRun> {
        let (study, lagree) = (&self.sensitivity, &self.lagree);
        let finest = study.resolutions.iter().copied().max().unwrap_or(0);
        let mut runs = Vec::new();
        for &ratio in &study.aspect_ratios {
            for &resolution in &study.resolutions {
                let is_finest = resolution == finest && study.resolutions.len() > 1;
                let own = self.column(Material::LAGREE, lagree, ratio);
                for &seed in study.seeds.iter().take(if is_finest { FINEST_SEEDS } else { usize::MAX }) {
                    // the column that is there for the laws is one of its ensemble
                    let is_own = resolution == own.resolution && seed == self.release.seed;
                    if !(is_own && lagree.aspect_ratios.contains(&ratio)) {
                        let release = Release { seed, ..self.release };
                        runs.push(ColumnRun {
                            purpose: ColumnPurpose::Convergence,
                            resolution,
                            release,
                            ..own.clone()
                        });
                    }
                }
            }
        }
        runs
    }

    /// Columns of the sand with an eddy viscosity, and without the coupling of density and pressure.
    fn other_numerics(&self) -> Vec<ColumnRun> {
        let other = &self.other_numerics;
        let run = |purpose, ratio: f64, numerics| ColumnRun {
            purpose,
            shown_times: Vec::new(),
            release: Release { numerics, ..self.release },
            ..self.column(Material::SAND, &self.sand, ratio)
        };
        let numerics = self.release.numerics;
        let eddies = Numerics { smagorinsky_constant: other.smagorinsky_constant, ..numerics };
        let uncoupled = Numerics { density_coupling: 0.0, ..numerics };
        // beside what stands for itself, or there is nothing to compare with
        let own = |ratio: &&f64| self.sand.aspect_ratios.contains(ratio);
        let with_eddies =
            other.eddy_aspect_ratios.iter().filter(own).map(|&ratio| run(ColumnPurpose::Eddies, ratio, eddies));
        let without = other
            .uncoupled_aspect_ratios
            .iter()
            .filter(own)
            .map(|&ratio| run(ColumnPurpose::Uncoupled, ratio, uncoupled));
        with_eddies.chain(without).collect()
    }

    /// Columns of both grains with other hourglass coefficients.
    fn hourglasses(&self) -> Vec<ColumnRun> {
        let study = &self.sensitivity;
        let grains = [(Material::LAGREE, &self.lagree), (Material::SAND, &self.sand)];
        let mut runs = Vec::new();
        let columns = grains.iter().flat_map(|grains| study.aspect_ratios.iter().map(move |ratio| (grains, *ratio)));
        for (&(material, columns), ratio) in columns {
            let own = ColumnRun { shown_times: Vec::new(), ..self.column(material, columns, ratio) };
            for &resolution in &study.hourglass_resolutions {
                let seeds = if resolution < SINGLE_SEED_RESOLUTION { usize::MAX } else { 1 };
                for &hourglass in &study.hourglass {
                    runs.extend(study.hourglass_seeds.iter().take(seeds).map(|&seed| {
                        let numerics = Numerics { hourglass, ..self.release.numerics };
                        let release = Release { numerics, seed, ..self.release };
                        ColumnRun { purpose: ColumnPurpose::Hourglass, resolution, release, ..own.clone() }
                    }));
                }
            }
        }
        runs
    }

    /// Further seeds of columns that stand for themselves, for the mean of their velocity profile.
    fn profile_seeds(&self) -> Vec<ColumnRun> {
        let study = &self.sensitivity;
        let mut runs = Vec::new();
        for (material, columns) in [(Material::SAND, &self.sand), (Material::LAGREE, &self.lagree)] {
            for &ratio in study.profile_aspect_ratios.iter().filter(|ratio| columns.aspect_ratios.contains(ratio)) {
                let own = ColumnRun { shown_times: Vec::new(), ..self.column(material, columns, ratio) };
                // an ensemble of the same column has them already
                let is_ensemble = material == Material::LAGREE
                    && study.aspect_ratios.contains(&ratio)
                    && study.resolutions.contains(&own.resolution);
                if is_ensemble {
                    continue;
                }
                runs.extend(study.profile_seeds.iter().filter(|&&seed| seed != self.release.seed).map(|&seed| {
                    let release =
                        Release { seed, duration: PROFILE_SEED_DURATION.min(self.release.duration), ..self.release };
                    ColumnRun { purpose: ColumnPurpose::ProfileSeed, release, ..own.clone() }
                }));
            }
        }
        runs
    }

    /// Columns of sand with the paper's stress update.
    fn regularised(&self) -> Vec<ColumnRun> {
        let Rheology::MuI(law) = self.sand.law else { return Vec::new() };
        let rate = self.regularised.rate;
        let release = Release {
            duration: REGULARISED_DURATION.min(self.release.duration),
            numerics: Numerics { viscous_step: ViscousStep::Implicit, ..self.release.numerics },
            ..self.release
        };
        let run = |&ratio: &f64| ColumnRun {
            purpose: ColumnPurpose::Regularised,
            law: Rheology::RegularisedMuI(law.regularised(rate)),
            regularisation_rate: Some(rate),
            shown_times: Vec::new(),
            release,
            ..self.column(Material::SAND, &self.sand, ratio)
        };
        self.regularised.aspect_ratios.iter().map(run).collect()
    }
}
