//! Estimated resources of runs before anything is allocated (particles, memory, steps and time), and their limits.

use crate::case::RunCost;

/// Memory of a particle in the snapshots of a run that is done `[bytes]`.
const BYTES_KEPT: f64 = 700.0;

/// Memory that may be taken where the system does not say how much there is `[bytes]`.
const USUAL_MEMORY: f64 = 16.0 * GIBIBYTE;

const GIBIBYTE: f64 = 1024.0 * 1024.0 * 1024.0;

/// Hours of one core that the runs of a case may take by default: two months of eight cores. The
/// longest fine tier takes some tens.
const USUAL_CORE_HOURS: f64 = 10_000.0;

/// Estimated resources of a set of runs.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Estimate {
    /// Number of runs.
    pub runs: usize,
    /// Memory of the run that needs most of it, while it runs `[bytes]`.
    pub running: f64,
    /// Memory of all runs, if they ran at once `[bytes]`.
    pub all_running: f64,
    /// Particles of all runs `[-]`.
    pub all_particles: f64,
    /// Particle-steps of all runs `[-]`.
    pub particle_steps: f64,
    /// Nominal time of all runs on one core `[s]`: from their parameters alone, so that what is refused does not depend on the
    /// machine or on what it has measured.
    pub core_seconds: f64,
}

impl Estimate {
    /// Estimate of one run.
    pub(in crate::case) fn of(cost: RunCost) -> Self {
        let running = cost.particles * cost.bytes_per_particle;
        Self {
            runs: 1,
            running,
            all_running: running,
            all_particles: cost.particles,
            particle_steps: cost.particle_steps,
            core_seconds: cost.particle_steps * cost.seconds_per_particle_step + cost.preparation_seconds,
        }
    }

    /// Sum of the estimates of two sets of runs.
    pub fn and(self, other: Self) -> Self {
        Self {
            runs: self.runs + other.runs,
            // whichever is larger; NaN, which is refused, stays
            running: if other.running <= self.running { self.running } else { other.running },
            all_running: self.all_running + other.all_running,
            all_particles: self.all_particles + other.all_particles,
            particle_steps: self.particle_steps + other.particle_steps,
            core_seconds: self.core_seconds + other.core_seconds,
        }
    }

    /// Peak memory `[bytes]` on a number of threads, each of which may hold a run.
    pub fn memory(&self, threads: usize) -> f64 {
        let at_once = threads.clamp(1, self.runs.max(1)) as f64;
        (self.running * at_once).min(self.all_running) + self.all_particles * BYTES_KEPT
    }

    /// Particles, memory and time on one core as text, for a number of simultaneous runs.
    pub fn in_words(&self, threads: usize) -> String {
        let [particles, hours] = [self.all_particles, self.core_seconds / 3600.0].map(rounded);
        format!("{particles} particles, {} of memory, {hours} core hours", size(self.memory(threads)))
    }

    /// Ratio of the estimate to the limits; above 1 if it exceeds them. One run at a time must fit into the memory.
    pub(in crate::case) fn excess(&self, limits: &Limits) -> f64 {
        let excess = (self.memory(1) / limits.memory).max(self.core_seconds / 3600.0 / limits.core_hours);
        // a run whose cost is not even a number is beyond any limit
        let is_known = excess.is_finite() && self.memory(1).is_finite() && self.core_seconds.is_finite();
        if is_known { excess } else { f64::INFINITY }
    }

    /// The limit that it breaks: the defect, as it follows the value in the message, and the remedy.
    pub(in crate::case) fn problem(&self, limits: &Limits) -> Option<(String, String)> {
        if self.excess(limits) <= 1.0 {
            return None;
        }
        let (needed, most, remedy) = if self.memory(1) > limits.memory || !self.memory(1).is_finite() {
            let needed = format!("{} of memory for {} particles", size(self.memory(1)), rounded(self.all_particles));
            (needed, size(limits.memory), "reduce the number of particles, or raise `--most-memory`")
        } else {
            let (steps, hours) = (rounded(self.particle_steps), rounded(self.core_seconds / 3600.0));
            let needed = format!("{hours} core hours for {steps} particle-steps");
            let most = format!("{} core hours", rounded(limits.core_hours));
            (needed, most, "reduce the number of particles or steps, or raise `--most-hours`")
        };
        Some((format!("needs {needed}, above the limit of {most}"), remedy.to_owned()))
    }
}

/// Two digits are more than an estimate knows.
fn rounded(value: f64) -> String {
    let text = format!("{value:.1e}");
    let is_extreme = (f64::MIN_POSITIVE..1e-3).contains(&value) || value >= 1e4;
    if is_extreme { text } else { text.parse().unwrap_or(value).to_string() }
}

/// Memory `[bytes]` in the unit that suits its size.
fn size(bytes: f64) -> String {
    let step = (bytes.max(1.0).log2() / 10.0).min(3.0) as usize;
    format!("{} {}", rounded(bytes / 1024_f64.powi(step as i32)), ["B", "KiB", "MiB", "GiB"][step])
}

/// Resource limits of the runs of a case.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Memory `[bytes]`.
    pub memory: f64,
    /// Hours of one core `[h]`.
    pub core_hours: f64,
}

impl Default for Limits {
    fn default() -> Self {
        let memory = of_environment("BAGNOLD_MOST_MEMORY").map(|gibibytes| gibibytes * GIBIBYTE);
        Self {
            memory: memory.or_else(installed_memory).unwrap_or(USUAL_MEMORY),
            core_hours: of_environment("BAGNOLD_MOST_HOURS").unwrap_or(USUAL_CORE_HOURS),
        }
    }
}

/// A positive number in a variable of the environment.
fn of_environment(name: &str) -> Option<f64> {
    let text = std::env::var(name).ok().filter(|text| !text.is_empty())?;
    let number = text.trim().parse::<f64>().ok().filter(|number| *number > 0.0);
    if number.is_none() {
        tracing::warn!("`{name}` is {text}, but must be a positive number; it is ignored");
    }
    number
}

impl Limits {
    /// No limits.
    pub const NONE: Self = Self { memory: f64::INFINITY, core_hours: f64::INFINITY };

    /// Limits on memory `[GiB]` and core hours `[h]`: those given, else of the environment, else the defaults.
    pub fn of(memory: Option<f64>, core_hours: Option<f64>) -> Self {
        let usual = Self::default();
        Self {
            memory: memory.map_or(usual.memory, |memory| memory * GIBIBYTE),
            core_hours: core_hours.unwrap_or(usual.core_hours),
        }
    }
}

/// The machine's memory `[bytes]`, where the system says it.
fn installed_memory() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("MemTotal:"))?;
    let kibibytes: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kibibytes * 1024.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMITS: Limits = Limits { memory: 16.0 * GIBIBYTE, core_hours: 100.0 };

    fn of(particles: f64, core_seconds: f64) -> Estimate {
        let running = particles * crate::case::cost::BYTES_WHILE_RUNNING;
        Estimate {
            runs: 1,
            running,
            all_running: running,
            all_particles: particles,
            particle_steps: 1e6 * core_seconds,
            core_seconds,
        }
    }

    #[test]
    fn excessive_size_is_refused_with_its_number() {
        assert_eq!(of(1e5, 3600.0).problem(&LIMITS), None);
        let (defect, remedy) = of(1e8, 1.0).problem(&LIMITS).expect("too large");
        assert_eq!(defect, "needs 340 GiB of memory for 1.0e8 particles, above the limit of 16 GiB");
        assert!(remedy.ends_with("raise `--most-memory`"), "{remedy}");
        let (defect, remedy) = of(1.0, 1e9).problem(&LIMITS).expect("too long");
        assert_eq!(defect, "needs 2.8e5 core hours for 1.0e15 particle-steps, above the limit of 100 core hours");
        assert!(remedy.ends_with("raise `--most-hours`"), "{remedy}");
        for cost in [f64::NAN, f64::INFINITY] {
            assert!(of(cost, 1.0).problem(&LIMITS).is_some() && of(1.0, cost).problem(&LIMITS).is_some());
            assert!(of(1.0, 1.0).and(of(cost, cost)).problem(&LIMITS).is_some());
            assert!(of(cost, cost).and(of(1.0, 1.0)).problem(&LIMITS).is_some());
        }
    }
}
