//! Commands that a signal asks to end, whose checkpoints are damaged, or whose disk is full.

use crate::command_line::program;
use crate::command_line::restart::{RUN_IN_PLANE, Work, checkpoints, has_gone_on, output_of_the_program, place};
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

fn send(child: &Child, signal: &str) {
    let sent = Command::new("kill").args([&format!("-{signal}"), &child.id().to_string()]).status().expect("kill");
    assert!(sent.success());
}

/// The signal of a terminal that ends, and its exit code. Where the tests themselves were started so that they ignore it, as by
/// `nohup`, the program has to ignore it too, and is asked otherwise.
pub(crate) fn hangup() -> (&'static str, i32) {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:")?.trim().chars().last()?.to_digit(16));
    // the lowest bit is the signal of number 1
    if ignored.is_some_and(|digit| digit % 2 == 1) { ("TERM", 143) } else { ("HUP", 129) }
}

#[test]
fn a_signal_keeps_what_there_is_and_says_how_to_go_on() {
    interrupted(&[(&RUN_IN_PLANE, ("TERM", 143))]);
}

pub(crate) fn interrupted(works: &[(&Work, (&str, i32))]) {
    for &(work, (signal, code)) in works {
        let place = place();
        let (expected, _) = work.undisturbed(&place);
        let mut child = work.start(&place, "asked", "2");
        assert!(has_gone_on(&mut child, &place, "asked-store"), "{}: over before it could be asked", work.name);
        send(&child, signal);
        let (status, said) = output_of_the_program(child);
        assert_eq!(status.code(), Some(code), "{}: {said}", work.name);
        let first = format!("interrupted by SIG{signal}: what is finished is kept, and a checkpoint of ");
        assert!(said.contains(&first), "{said}");
        assert!(said.contains("the same command resumes from there"), "{said}");
        assert!(!checkpoints(&place, "asked-store").is_empty());
        let left = std::fs::read_dir(place.path("asked")).into_iter().flatten().flatten();
        let staging = |name: &str| name.contains("staging");
        assert!(!left.map(|entry| entry.file_name().to_string_lossy().into_owned()).any(|name| staging(&name)));
        work.start(&place, "asked", "1").wait().expect("ended");
        assert_eq!(work.states(&place, "asked"), expected, "{}", work.name);
    }
}

#[test]
fn nohup_ignores_the_end_of_the_terminal() {
    let place = place();
    let mut process = Command::new("nohup");
    process.arg(program::path()).current_dir(place.path("")).args(RUN_IN_PLANE.arguments);
    process.args(["--out", "out", "--store", "out-store", "--checkpoint-interval", "0.05"]);
    process.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
    let mut child = process.spawn().expect("started");
    assert!(has_gone_on(&mut child, &place, "out-store"));
    send(&child, "HUP");
    let (status, said) = output_of_the_program(child);
    assert!(status.code().is_some_and(|code| code <= 1), "{status}: {said}");
}

/// The load on each particle of so many rows is felt for hours before the first step.
#[test]
fn a_signal_ends_the_filling_of_a_body() {
    let place = place();
    let tower = "case = \"scene\"\nname = \"tower\"\nspacing = 0.005\nduration = 100.0\n\
        [[bodies]]\nshape = \"box\"\nlower = [0.0, 0.0]\nupper = [0.02, 300.0]\n";
    place.file("tower.toml", tower);
    let mut process = Command::new(program::path());
    process.current_dir(place.path("")).args(["run", "tower.toml", "--store", "store"]).stdout(Stdio::null());
    let mut child = process.stderr(Stdio::piped()).spawn().expect("started");
    let mut lines = BufReader::new(child.stderr.take().expect("piped")).lines().map_while(Result::ok);
    assert!(lines.any(|line| line.contains("1 run, about")));
    std::thread::sleep(Duration::from_millis(500));
    send(&child, "TERM");
    assert!(lines.any(|line| line.contains("interrupted by SIGTERM")));
    assert_eq!(child.wait().expect("ended").code(), Some(143));
}

#[test]
fn a_second_signal_ends_at_once() {
    let place = place();
    let mut child = RUN_IN_PLANE.start(&place, "out", "1");
    assert!(has_gone_on(&mut child, &place, "out-store"));
    // the second arrives while the first is being answered, or finds the program gone
    send(&child, "TERM");
    let _ = Command::new("kill").args(["-TERM", &child.id().to_string()]).stderr(Stdio::null()).status();
    let (status, _) = output_of_the_program(child);
    assert_eq!(status.code(), Some(143));
}

#[test]
fn a_checkpoint_that_is_damaged_is_refused_and_the_one_before_continued() {
    let place = place();
    let (expected, _) = RUN_IN_PLANE.undisturbed(&place);
    let mut child = RUN_IN_PLANE.start(&place, "damaged", "1");
    while checkpoints(&place, "damaged-store").len() < 2 && child.try_wait().expect("a child").is_none() {
        std::thread::sleep(Duration::from_millis(3));
    }
    send(&child, "TERM");
    child.wait().expect("ended");
    let mut files = checkpoints(&place, "damaged-store");
    let number = |file: &Path| file.file_stem().and_then(|stem| stem.to_str()?.parse::<u64>().ok());
    files.sort_by_key(|file| number(file));
    assert_eq!(files.len(), 2, "the last two are kept");
    let mut bytes = std::fs::read(&files[1]).expect("a checkpoint");
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    std::fs::write(&files[1], bytes).expect("writable");
    let (_, said) = output_of_the_program(RUN_IN_PLANE.start(&place, "damaged", "1"));
    let refusal = "not continued: it is damaged; the one before it is used, or the run begins anew";
    assert!(said.contains(refusal), "{said}");
    assert!(said.contains("resumes from its checkpoint at t = "), "{said}");
    assert_eq!(RUN_IN_PLANE.states(&place, "damaged"), expected);
}

#[test]
fn fresh_begins_anew() {
    let place = place();
    let mut child = RUN_IN_PLANE.start(&place, "out", "1");
    assert!(has_gone_on(&mut child, &place, "out-store"));
    send(&child, "TERM");
    child.wait().expect("ended");
    let mut process = Command::new(program::path());
    process.current_dir(place.path("")).args(RUN_IN_PLANE.arguments);
    process.args(["--out", "out", "--store", "out-store", "--fresh", "-v"]);
    let done = process.output().expect("ended");
    let said = String::from_utf8_lossy(&done.stderr);
    assert!(!said.contains("resumes from its checkpoint at t ="), "{said}");
    assert!(done.status.code().is_some_and(|code| code <= 1), "{said}");
}

/// A small disk of its own; taken down at the end.
struct Disk(PathBuf);

impl Disk {
    /// None where that is not allowed, as for everybody but root.
    fn new(folder: PathBuf) -> Option<Self> {
        std::fs::create_dir_all(&folder).expect("writable");
        let mut mount = Command::new("mount");
        mount.args(["-t", "tmpfs", "-o", "size=16m", "tmpfs"]).arg(&folder).stderr(Stdio::null());
        mount.status().is_ok_and(|status| status.success()).then_some(Self(folder))
    }

    /// Fills what is left.
    fn fill(&self) -> PathBuf {
        let file = self.0.join("filler");
        let mut filler = std::fs::File::create(&file).expect("writable");
        while filler.write_all(&[0; 4096]).is_ok() {}
        file
    }
}

impl Drop for Disk {
    fn drop(&mut self) {
        let _ = Command::new("umount").arg("-l").arg(&self.0).status();
    }
}

#[test]
fn a_full_disk_is_said_and_leaves_the_checkpoint_before() {
    let place = place();
    let Some(disk) = Disk::new(place.path("full-store")) else {
        println!("skipped: only root can mount a disk");
        return;
    };
    let (expected, _) = RUN_IN_PLANE.undisturbed(&place);
    let mut child = RUN_IN_PLANE.start(&place, "full", "1");
    assert!(has_gone_on(&mut child, &place, "full-store"));
    send(&child, "TERM");
    child.wait().expect("ended");
    let before = checkpoints(&place, "full-store");
    let filler = disk.fill();
    let (status, said) = output_of_the_program(RUN_IN_PLANE.start(&place, "full", "1"));
    assert!(status.code().is_some_and(|code| code <= 1), "{said}");
    assert!(said.contains("not kept (No space left on device"), "{said}");
    assert!(said.contains("those before it stay, and the run continues"), "{said}");
    assert_eq!(RUN_IN_PLANE.states(&place, "full"), expected);
    assert_eq!(checkpoints(&place, "full-store"), before, "what was there is there, and nothing half written");
    std::fs::remove_file(filler).expect("removable");
    let (_, said) = output_of_the_program(RUN_IN_PLANE.start(&place, "full", "1"));
    assert!(!said.contains("WARN"), "{said}");
    assert_eq!(RUN_IN_PLANE.states(&place, "full"), expected);
    assert!(checkpoints(&place, "full-store").is_empty());
}
