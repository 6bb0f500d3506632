//! `--profile`: what a command took of the machine, stage by stage and run by run.

use crate::case::{CaseResult, RunSummary};
use rustix::time::{ClockId, clock_gettime};
use std::time::Instant;

/// Runs that are listed one by one.
const LISTED: usize = 20;

/// Timer of a command's stages.
pub(super) struct StageTimer {
    begun: Instant,
    last: Instant,
    processor: f64,
    /// Name, wall and processor time `[s]` of each stage that is over.
    stages: Vec<(&'static str, f64, f64)>,
}

impl StageTimer {
    pub(super) fn begin() -> Self {
        let now = Instant::now();
        Self { begun: now, last: now, processor: processor_seconds(ClockId::ProcessCPUTime), stages: Vec::new() }
    }

    /// Notes that a stage is over.
    pub(super) fn over(&mut self, stage: &'static str) {
        let (now, processor) = (Instant::now(), processor_seconds(ClockId::ProcessCPUTime));
        self.stages.push((stage, (now - self.last).as_secs_f64(), processor - self.processor));
        (self.last, self.processor) = (now, processor);
    }

    /// The stages, and the runs that took longest.
    pub(super) fn in_words(&self, results: &[CaseResult], threads: usize) -> String {
        let wall = self.begun.elapsed().as_secs_f64();
        let memory = peak_memory().map(|most| format!(", at most {most:.0} MiB of memory")).unwrap_or_default();
        let mut text = format!("profile: {wall:.1} s of wall time, {threads} threads{memory}\n");
        for (stage, wall, processor) in &self.stages {
            let share = if *wall > 0.0 { processor / wall } else { 0.0 };
            text += &format!(
                "  {stage:<24}  {wall:8.2} s of wall time  {processor:8.2} s of processor  {share:5.2} cores busy\n"
            );
        }
        text + &runs(results)
    }
}

/// A line for each of the runs that took longest; what came from the store took no time.
fn runs(results: &[CaseResult]) -> String {
    let all = results.iter().flat_map(|result| result.runs.iter().map(move |run| (&result.name, run)));
    let (stored, mut rows): (Vec<_>, Vec<_>) = all.partition(|(_, run)| run.from_store);
    rows.sort_by(|(_, a), (_, b)| b.wall_seconds.total_cmp(&a.wall_seconds));
    let line = |(case, run): &(&String, &RunSummary)| {
        let RunSummary { variant, wall_seconds, particles, steps, .. } = run;
        let cost = run.microseconds_per_particle_step.map_or_else(|| "–".to_owned(), |cost| format!("{cost:.3}"));
        let line = format!(
            "  {wall_seconds:8.2} s  {particles:>8} particles  {steps:>9} steps  {cost:>7} µs per particle and step  {case} {variant}"
        );
        line.trim_end().to_owned() + "\n"
    };
    let mut text: String = rows.iter().take(LISTED).map(line).collect();
    let others: f64 = rows.iter().skip(LISTED).map(|(_, run)| run.wall_seconds).sum();
    if rows.len() > LISTED {
        text += &format!("  {others:8.2} s  in {} other runs\n", rows.len() - LISTED);
    }
    if !stored.is_empty() {
        text += &format!("  {} runs were read from the store\n", stored.len());
    }
    text
}

/// Time that the processors have worked `[s]`: for this program or this thread, by the clock.
pub(super) fn processor_seconds(clock: ClockId) -> f64 {
    let time = clock_gettime(clock);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}

/// The most memory that the program has held at a time `[MiB]`, where the system says it.
fn peak_memory() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().strip_suffix("kB")?.trim().parse::<f64>().ok().map(|kibibytes| kibibytes / 1024.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stages_and_memory_are_told() {
        let mut profile = StageTimer::begin();
        let mut sum = 0.0_f64;
        while processor_seconds(ClockId::ProcessCPUTime) - profile.processor < 0.02 {
            sum += (0..1000).map(f64::from).map(f64::sin).sum::<f64>();
        }
        assert!(sum.is_finite());
        profile.over("simulating");
        let (_, wall, processor) = profile.stages[0];
        assert!(processor >= 0.02 && wall > 0.0, "{wall} {processor}");
        let text = profile.in_words(&[], 2);
        assert!(text.starts_with("profile: ") && text.contains("simulating"), "{text}");
        if cfg!(target_os = "linux") {
            assert!(peak_memory().is_some_and(|megabytes| megabytes > 1.0));
        }
    }
}
