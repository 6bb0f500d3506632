//! Formulas of the constitutive laws, for a code that has to write them itself.

use std::fmt::Write as _;

/// Definition of |γ̇| and τ.
const INVARIANTS: &str = "s is the deviatoric stress, ε′ the deviatoric strain rate, |γ̇| = √(2 ε′:ε′), τ = √(½ s:s): in simple shear |γ̇| = |du/dy| and \
    τ = |s_xy|. A law given as τ acts along the strain rate, s = (2 τ/|γ̇|) ε′; one given as η is s = 2 η ε′. Where p ≤ 0 friction carries nothing.";

/// Laws by their names in files, with their formulas.
const FORMULAS: [(&str, &str); 10] = [
    ("newtonian", "η constant: `viscosity`"),
    (
        "bingham",
        "η = μ + τ_y (1 − exp(−|γ̇|/γ_r))/|γ̇|: `plastic_viscosity` μ, `yield_stress` τ_y, `regularisation_rate` γ_r (Papanastasiou 1987)",
    ),
    (
        "coulomb-bingham",
        "η = μ + min[(τ_y + μ_c p)(1 − exp(−|γ̇|/γ_r))/|γ̇|, η_max]: `plastic_viscosity` μ, `yield_stress` τ_y, `friction` μ_c, `regularisation_rate` γ_r, \
         `largest_viscosity` η_max",
    ),
    (
        "herschel-bulkley",
        "η = τ_y (1 − exp(−|γ̇|/γ_r))/|γ̇| + η_K, η_K = K (|γ̇|² + γ_r²)^((n−1)/2) for n ≤ 1 and K min(|γ̇|, 1000/s)^(n−1) above: `yield_stress` τ_y, \
         `consistency` K, `flow_index` n, `regularisation_rate` γ_r",
    ),
    (
        "regularised-mu-i",
        "η = μ_s p (1 − exp(−|γ̇|/α_r))/|γ̇| + (μ_2 − μ_s) p/(ξ √p + |γ̇| + α_r), ξ = I_0/(D √ρ_s), with the numbers of `mu-i` and `regularisation_rate` α_r",
    ),
    ("root-mu-i", "η = μ(I) p/√(|γ̇|² + γ_r²), μ(I) as of `mu-i`, `regularisation_rate` γ_r"),
    (
        "mu-i",
        "τ = μ(I) p where it flows, μ(I) = μ_s + (μ_2 − μ_s)/(1 + I_0/I), I = |γ̇| D/√(p/ρ_s); rigid below μ_s p (here elastic, solved implicitly, without a \
         regularisation): `static_friction` μ_s, `limiting_friction` μ_2, `reference_inertia` I_0, `grain_diameter` D, `grain_density` ρ_s of a grain",
    ),
    (
        "nonlocal-mu-i",
        "|γ̇| = g μ, μ = τ/p, t_0 ∂g/∂t = A² D² ∇²g + R g − c μ g², R = Δμ (μ − μ_s)/(μ_2 − μ), c = (Δμ/I_0) D √(ρ_s/p), Δμ = μ_2 − μ_s (Kamrin & Henann 2015)",
    ),
    (
        "softening-drucker-prager",
        "rigid (here elastic) up to τ = μ(κ) p + k(κ), both along a line from peak to residual over the plastic shear strain κ, at any rate alike",
    ),
    (
        "viscous-number",
        "τ = (μ_c + K1 I + tanψ) p′, p′ = p − p_f, I = η |γ̇|/p′, tanψ = K3 (φ − φ_c + K2 I), dφ/dt = −φ |γ̇| tanψ, ∇·v = ∇·(k/η ∇p_f), \
         k = α D² (1 − φ)³/φ² (Pailha & Pouliquen 2009): `critical_friction` μ_c, `friction_slope` K1, `fraction_slope` K2, `dilatancy` K3, \
         `critical_fraction` φ_c, `solid_fraction` φ at the start, `grain_diameter` D, `permeability_coefficient` α, `liquid_viscosity` η, \
         `grain_density` and `liquid_density` for the buoyant weight",
    ),
];

/// The laws that parameters name, with their formulas; empty where they name none.
pub(super) fn section(parameters: &str) -> String {
    let is_named = |name: &str| {
        // grains without a choice of laws, and laws that are written by μ(I)
        (name == "mu-i" && parameters.contains("reference_inertia"))
            || parameters.contains(&format!("law = \"{name}\""))
            || parameters.contains(&format!("[{}]", name.replace('-', "_")))
    };
    let named = FORMULAS.iter().filter(|(name, _)| is_named(name));
    let mut text = String::new();
    for (name, formula) in named {
        let _ = writeln!(text, "- `{name}`: {formula}");
    }
    if text.is_empty() { text } else { format!("\n## Laws\n\n{INVARIANTS}\n\n{text}") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bagnold_solver::material::rheology::Rheology;
    use bagnold_solver::parameter::schema_of;

    #[test]
    fn every_law_of_files_has_its_formula() {
        let schema = schema_of::<Rheology>().to_string();
        for (name, _) in FORMULAS {
            assert!(schema.contains(&format!("\"{name}\"")), "{name} is no law: {schema}");
        }
        assert_eq!(schema.matches("\"law\":{").count(), FORMULAS.len(), "a law lacks its formula");
        assert!(section("[herschel_bulkley]\nyield_stress = 1").contains("K min("));
        assert!(section("[grains]\nreference_inertia = 0.3").contains("`mu-i`: τ = μ(I) p"));
        assert_eq!(section("gravity = 9.81"), "");
    }
}
