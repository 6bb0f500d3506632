//! Kills aimed at the moment when a folder's new contents take the place of the old ones: what is there is of one run.

use crate::command_line::program::{CHEAP, Place, path};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Kills that are tried, unless `BAGNOLD_KILLS` says otherwise.
const USUAL: u32 = 20;

/// A run whose records are stored already: most of its time goes into figures and publishing.
fn run(place: &Place, out: &str, seed: u32) -> Command {
    let mut command = Command::new(path());
    command.current_dir(place.path("")).env("BAGNOLD_STORE", place.path("store"));
    command.args(["-q", "run", "--out", out, "--threads", "1"]).args(CHEAP).args(["--set", &format!("seed={seed}")]);
    command.stdout(Stdio::null()).stderr(Stdio::null());
    command
}

/// The seed in the case's file and the state hash among the metrics; none without metrics, which is no result.
fn contents(place: &Place, out: &str) -> Option<(String, String)> {
    let metrics = std::fs::read_to_string(place.path(out).join("metrics.json")).ok()?;
    let case = std::fs::read_to_string(place.path(out).join("case.toml")).expect("a result is whole");
    let line = |text: &str, key: &str| {
        let line = text.lines().find(|line| line.trim_start().starts_with(key));
        line.unwrap_or_else(|| panic!("{key}")).trim().to_owned()
    };
    Some((line(&case, "seed = "), line(&metrics, "\"state_hash\": ")))
}

#[test]
fn a_kill_while_a_folder_is_published_leaves_no_mixture() {
    let kills = std::env::var("BAGNOLD_KILLS").ok().and_then(|text| text.parse().ok()).unwrap_or(USUAL);
    let place = Place::new();
    let mut whole = Vec::new();
    let mut usual = Duration::ZERO;
    for seed in [1, 2, 1] {
        let begun = Instant::now();
        assert!(run(&place, "out", seed).status().expect("started").success());
        usual = begun.elapsed();
        whole.push(contents(&place, "out").expect("a result"));
    }
    assert_ne!(whole[0], whole[1]);
    std::fs::create_dir(place.path("out/mine")).expect("writable");
    place.file("out/mine/notes.txt", "mine");
    let (mut interrupted, mut halfway) = (0, 0);
    for kill in 0..kills {
        let seed = 1 + (kill + 1) % 2;
        let mut child = run(&place, "out", seed).spawn().expect("started");
        // the last tenth of the time, and a little beyond
        let share = 0.9 + 0.12 * f64::from(kill) / f64::from(kills);
        std::thread::sleep(usual.mul_f64(share));
        interrupted += u32::from(child.try_wait().expect("a child").is_none());
        child.kill().expect("killed");
        child.wait().expect("ended");
        match contents(&place, "out") {
            Some(found) => assert!(whole.contains(&found), "kill {kill}: {found:?}"),
            None => halfway += 1,
        }
        // what a kill interrupts the next command ends
        assert!(run(&place, "out", seed).status().expect("started").success());
        assert_eq!(contents(&place, "out").as_ref(), Some(&whole[seed as usize - 1]), "kill {kill}");
    }
    println!("{interrupted} of {kills} kills came before the end, {halfway} of them between two results");
    assert_eq!(std::fs::read_to_string(place.path("out/mine/notes.txt")).expect("still there"), "mine");
    let left: Vec<String> = place.names().into_iter().filter(|name| name.starts_with('.')).collect();
    assert_eq!(left, [""; 0], "nothing is left beside");
}
