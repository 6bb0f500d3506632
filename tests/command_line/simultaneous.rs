//! Several commands that write one folder at the same time.

use crate::command_line::program::{CHEAP, Place, path};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

/// So many at the same time.
const MANY: usize = 12;

fn start(place: &Place, arguments: &[&str]) -> Child {
    let mut command = Command::new(path());
    command
        .current_dir(place.path(""))
        .env("BAGNOLD_STORE", place.path("store"))
        .args(arguments)
        .args(["--threads", "1"]);
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("started")
}

/// Exit code and messages of each command.
fn ended(children: Vec<Child>) -> Vec<(Option<i32>, String)> {
    let end = |child: Child| {
        let Output { status, stderr, .. } = child.wait_with_output().expect("ended");
        (status.code(), String::from_utf8_lossy(&stderr).into_owned())
    };
    children.into_iter().map(end).collect()
}

/// The folder is in use by another command, with its number where that was written already.
fn is_refusal(said: &str, out: &str) -> bool {
    let begin = format!("error: output folder {out}: in use by another bagnold command that is running");
    let end = ", so nothing was changed; wait until it has ended, or name another folder with --out\n";
    said.starts_with(&begin) && said.ends_with(end)
}

/// A film of its own for each seed, which takes some seconds, so that all are running at the same time.
fn film(place: &Place, out: &str, seed: usize) -> Child {
    let seed = format!("seed={seed}");
    start(
        place,
        &[&["-q", "run", "--out", out, "--fresh", "--set", &seed, "--set", "relaxation_times=20"], CHEAP].concat(),
    )
}

#[test]
fn one_of_many_runs_into_a_new_folder_wins_and_the_others_are_refused() {
    let place = Place::new();
    for out in ["out", "new/out"] {
        let all = ended((0..MANY).map(|seed| film(&place, out, seed)).collect());
        let winners: Vec<usize> = (0..MANY).filter(|&k| all[k].0 == Some(0)).collect();
        let [winner] = winners[..] else { panic!("{} won: {all:?}", winners.len()) };
        for (code, said) in all.iter().enumerate().filter(|(k, _)| *k != winner).map(|(_, one)| one) {
            assert!(*code == Some(2) && is_refusal(said, out), "{code:?}: {said}");
        }
        let case = std::fs::read_to_string(place.path(out).join("case.toml")).expect("the winner's");
        assert!(case.contains(&format!("seed = {winner} ")), "{winner}: {case}");
        assert!(!place.path(out).join(".bagnold-output-lock").exists());
    }
}

#[test]
fn runs_into_folders_of_their_own_do_not_meet() {
    let place = Place::new();
    let all = ended((0..3).map(|k| film(&place, &format!("out-{k}"), k)).collect());
    assert!(all.iter().all(|(code, said)| *code == Some(0) && said.is_empty()), "{all:?}");
}

/// Waits until a file is there.
fn wait_for(place: &Place, name: &str) {
    let begun = Instant::now();
    while !place.path(name).exists() {
        assert!(begun.elapsed() < Duration::from_secs(60), "{name} does not come");
        std::thread::sleep(Duration::from_millis(2));
    }
}

#[test]
fn the_one_that_runs_is_named_and_one_that_was_killed_blocks_nobody() {
    let place = Place::new();
    let mut first = film(&place, "out", 1);
    wait_for(&place, "out/.bagnold-output");
    let refused = ended(vec![film(&place, "out", 2)]);
    let by = format!("that is running (process {}), so", first.id());
    assert!(refused[0].0 == Some(2) && is_refusal(&refused[0].1, "out") && refused[0].1.contains(&by), "{refused:?}");
    first.kill().expect("killed");
    first.wait().expect("ended");
    let next = ended(vec![film(&place, "out", 3)]);
    assert_eq!((next[0].0, next[0].1.as_str()), (Some(0), ""));
}

const SWEEP: &str = r#"
design = "grid"
[[cases]]
case = "film"
with = { resolution = 10 }
[[vary]]
path = "material.viscosity"
values = [0.5, 1.0]
"#;

/// Several machines may work in a sweep's folder, and do so from its very beginning.
#[test]
fn a_sweep_may_be_begun_by_several_and_all_see_the_whole() {
    let place = Place::new();
    let plan = place.file("plan.toml", SWEEP);
    let other = place.file("other.toml", &SWEEP.replace("[0.5, 1.0]", "[0.6, 1.1]"));
    let sweep = |plan: &str| start(&place, &["-q", "sweep", plan, "--out", "sweep"]);
    let all = ended((0..MANY).map(|k| sweep(if k % 2 == 0 { &plan } else { &other })).collect());
    // one plan has the folder, whichever came first
    let (has, has_not): (Vec<usize>, Vec<usize>) = (0..MANY).partition(|&k| all[k].0 == Some(0));
    assert_eq!((has.len(), has_not.len()), (MANY / 2, MANY / 2), "{all:?}");
    assert!(has.iter().all(|k| k % 2 == has[0] % 2), "{all:?}");
    for k in has_not {
        let refusal = "error: sweep: contains a sweep of another plan; name another folder with --out\n";
        assert_eq!((all[k].0, all[k].1.as_str()), (Some(2), refusal));
    }
}
