//! Likely causes of a divergence, each with a remedy. The message of the solver names particle, place, time and
//! quantity; the causes name the parameter to change.

use crate::observation::{Outcome, Recorded};

/// A quantity as the solver's message names it, and what usually drives it out of its range.
const CAUSES: [(&str, &str); 9] = [
    (
        "speed",
        "a wall, body or flow above Mach 0.2 (raise `stiffness` in a scene; elsewhere a gentler slope or a deeper layer), particles \
         that start too close (lower `jitter`, or prepare a settled layer), or too long a step (lower `numerics.acoustic_courant`)",
    ),
    (
        "density",
        "a wall, body or flow above Mach 0.2 (raise `stiffness` in a scene), particles that meet (lower `jitter`, keep \
         `numerics.hourglass` above 0.2), or too few rows for the flow (raise `resolution`, in a scene lower `spacing`)",
    ),
    (
        "number of neighbours",
        "particles that have fallen together: raise `numerics.hourglass`, or take the kernel \"wendland-c2\"",
    ),
    (
        "viscous step",
        "viscosities that differ too much for the solve: raise `regularisation_rate`, or lower `largest_viscosity`",
    ),
    (
        "implicit velocity",
        "viscosities that differ too much for the solve: lower `largest_viscosity`, or shorten `numerics.time_step`",
    ),
    (
        "pressure Poisson equation",
        "too long a step, or particles that have come together: shorten `numerics.time_step`, keep `numerics.stabilisation` \
         and `numerics.shifting` above 0",
    ),
    ("way in one step", "too long a step: shorten `numerics.time_step`, or lower `numerics.courant`"),
    ("friction of the grains", "too long a step for the grains: shorten `numerics.time_step`"),
    ("Reynolds number", "a grain faster than its drag law knows: choose another `drag`, or a smaller grain"),
];

/// The record with the likely causes behind the message of a divergence that is no expected result.
pub(in crate::case) fn explained<O>(mut record: Recorded<O>) -> Recorded<O> {
    if let Outcome::Diverged { message, expected: false } = &mut record.outcome
        && let Some(causes) = causes(message)
    {
        message.push_str("; likely causes: ");
        message.push_str(causes);
    }
    record
}

/// Usual causes of the divergence that a message of the solver describes; none for an unknown quantity.
fn causes(message: &str) -> Option<&'static str> {
    let known = |(name, _): &&(&str, &str)| message.contains(&format!(": the {name} of particle "));
    CAUSES.iter().find(known).map(|(_, causes)| *causes)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(text: &str, expected: bool) -> String {
        let record = Recorded {
            outcome: Outcome::Diverged { message: text.to_owned(), expected },
            state_hash: String::new(),
            particles: 1,
            steps: 1,
            simulated_time: 1.0,
            wall_seconds: 1.0,
            threads: 1,
            frames: Vec::new(),
            first_bad: None,
            data: (),
        };
        match explained(record).outcome {
            Outcome::Diverged { message, .. } => message,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_divergence_says_what_it_likely_comes_from() {
        let text = "diverged at t = 0.1 s (step 7): the density of particle 3 at (0, 1) m is 1 kg/m³, outside";
        assert!(
            message(text, false)
                .starts_with(&format!("{text}; likely causes: a wall, body or flow above Mach 0.2 (raise `stiffness`"))
        );
        assert_eq!(message(text, true), text, "an expected divergence is a result");
        assert_eq!(message("something else", false), "something else");
    }
}
