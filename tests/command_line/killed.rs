//! A command that is killed with -9 again and again, and resumed.

use crate::command_line::program::{self, Place};
use std::collections::BTreeMap;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, SystemTime};

/// Finished pieces of work by name, with the time at which each was written.
pub(crate) type Finished = BTreeMap<String, SystemTime>;

/// Names and times of files.
pub(crate) fn written<'a>(files: impl Iterator<Item = (String, &'a Path)>) -> Finished {
    files
        .filter_map(|(name, file)| Some((name, file.metadata().and_then(|metadata| metadata.modified()).ok()?)))
        .collect()
}

/// Runs `bagnold COMMAND PLAN --out killed` with a store of its own, kills it three times, each time when at least one
/// more piece of work has been finished, then lets it end. Nothing finished may be written anew, and the last kill must
/// come before all is done. Returns the exit code.
pub(crate) fn kill_and_resume(place: &Place, command: &str, plan: &str, finished: impl Fn(&Path) -> Finished) -> i32 {
    let folder = place.path("killed");
    let mut seen = Finished::new();
    for kill in 1..=3 {
        let mut child = start(place, command, plan);
        let wanted = seen.len() + 1;
        while finished(&folder).len() < wanted && child.try_wait().expect("a child").is_none() {
            std::thread::sleep(Duration::from_millis(5));
        }
        child.kill().expect("kill -9");
        child.wait().expect("ended");
        let now = finished(&folder);
        assert!(now.len() >= wanted, "kill {kill}: {} pieces of work", now.len());
        assert_kept(&seen, &now);
        seen = now;
    }
    let code = start(place, command, plan).wait().expect("ended").code().expect("ended by itself");
    let all = finished(&folder);
    assert_kept(&seen, &all);
    assert!(seen.len() < all.len(), "all was done before the last kill");
    code
}

fn start(place: &Place, command: &str, plan: &str) -> Child {
    let mut process = Command::new(program::path());
    process.current_dir(place.path("")).stdout(Stdio::null()).stderr(Stdio::null());
    process.args(["-q", command, plan, "--out", "killed", "--threads", "1", "--store", "other"]);
    process.spawn().expect("started")
}

fn assert_kept(before: &Finished, after: &Finished) {
    for (name, time) in before {
        assert_eq!(after.get(name), Some(time), "{name} was written again");
    }
}

/// Every file is the same, byte for byte, as in the folder of a command that was never killed.
pub(crate) fn assert_same_files(place: &Place, whole: &str, names: &[&str]) {
    for name in names {
        let read = |folder: &str| std::fs::read(place.path(folder).join(name)).expect("written");
        assert_eq!(read(whole), read("killed"), "{name}");
    }
}
