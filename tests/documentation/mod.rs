//! The book in `docs/`: its tutorials do what they say, and its links lead somewhere.

mod league;
mod reference;

use crate::command_line::program::usual_store;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A fenced block: what stands behind the fence, and its text.
struct Block {
    info: String,
    text: String,
}

fn book() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/src")
}

fn pages() -> Vec<PathBuf> {
    let entries = std::fs::read_dir(book()).expect("docs/src");
    let entries = entries.flatten().map(|entry| entry.path());
    let mut pages: Vec<PathBuf> = entries.filter(|path| path.extension().is_some_and(|own| own == "md")).collect();
    pages.sort();
    assert!(pages.len() > 5, "{pages:?}");
    pages
}

fn blocks(text: &str) -> Vec<Block> {
    let mut blocks = Vec::new();
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        // blocks in lists are indented
        let indent = line.len() - line.trim_start().len();
        if let Some(info) = line.trim_start().strip_prefix("```") {
            let own = lines.by_ref().take_while(|line| !line.trim_start().starts_with("```"));
            let text: Vec<&str> = own.map(|line| line.get(indent..).unwrap_or_default()).collect();
            blocks.push(Block { info: info.to_owned(), text: text.join("\n") + "\n" });
        }
    }
    blocks
}

/// The program that `cargo test` of the whole workspace builds.
fn program() -> PathBuf {
    let test = std::env::current_exe().expect("the test knows its own path");
    let folder = test.parent().and_then(Path::parent).expect("a test stands in target/PROFILE/deps");
    folder.join(format!("bagnold{}", std::env::consts::EXE_SUFFIX))
}

/// Writes the files of a page and does its commands, in order, in a folder of its own.
fn follow(page: &Path, store: &Path) -> usize {
    let text = std::fs::read_to_string(page).expect("readable");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut commands = 0;
    for block in blocks(&text) {
        match block.info.split_once(' ') {
            Some(("toml" | "text", name)) => {
                std::fs::write(folder.path().join(name), &block.text).expect("writable");
            }
            None if block.info == "sh" => {
                for line in block.text.replace("\\\n", "").lines() {
                    let arguments =
                        line.strip_prefix("bagnold ").unwrap_or_else(|| panic!("{}: {line}", page.display()));
                    // a shell parts the words as the reader's does
                    let script = format!("\"$BAGNOLD\" --quiet {arguments}");
                    let done = Command::new("sh")
                        .args(["-c", &script])
                        .current_dir(folder.path())
                        .env("BAGNOLD", program())
                        .env("BAGNOLD_STORE", store)
                        .output()
                        .expect("a shell");
                    // a verdict may be red in a tutorial; bad input and divergence may not
                    let code = done.status.code();
                    let errors = String::from_utf8_lossy(&done.stderr);
                    assert!(matches!(code, Some(0 | 1)), "{}: {line}: {code:?}: {errors}", page.display());
                    commands += 1;
                }
            }
            _ => {}
        }
    }
    for figure in figures(&text) {
        let shown = std::fs::read(book().join(figure)).unwrap_or_else(|error| panic!("{figure}: {error}"));
        let made = folder.path().join(figure.trim_start_matches("figures/").replacen("--", "/figures/", 1));
        let is_current = std::fs::read(&made).is_ok_and(|made| made == shown);
        if !is_current {
            let kept = book().join("../../target/reference").join(figure.trim_start_matches("figures/"));
            let _ = kept.parent().map(std::fs::create_dir_all);
            let copied = std::fs::copy(&made, &kept);
            panic!("{}: {figure} is not what the commands make; copied to {kept:?}: {copied:?}", page.display());
        }
    }
    commands
}

/// Pictures of a page: `figures/OUT--NAME.png` is what its commands leave as `OUT/figures/NAME.png`.
fn figures(page: &str) -> impl Iterator<Item = &str> {
    let targets = ["](", "]: "].into_iter().flat_map(|begin| page.split(begin).skip(1));
    targets.filter_map(|rest| rest.split([')', '\n']).next()).filter(|own| own.starts_with("figures/"))
}

#[test]
fn tutorials_and_the_chapters_on_equations_and_limits_have_a_figure() {
    for page in ["introduction", "own-sand", "own-geometry", "overlay", "equations", "limits"] {
        let text = std::fs::read_to_string(book().join(format!("{page}.md"))).expect("readable");
        assert!(figures(&text).next().is_some(), "{page}.md");
    }
}

#[test]
fn the_commands_of_every_tutorial_work() {
    let store = usual_store();
    let done: usize = pages().iter().map(|page| follow(page, &store)).sum();
    assert!(done >= 12, "{done} commands");
}

/// The anchor that a renderer gives to a heading.
fn anchor(heading: &str) -> String {
    let kept = |sign: &char| sign.is_alphanumeric() || matches!(sign, ' ' | '-' | '_');
    let sign = |sign: char| if sign == ' ' { '-' } else { sign };
    heading.trim_start_matches('#').trim().to_lowercase().chars().filter(kept).map(sign).collect()
}

#[test]
fn every_page_is_in_the_summary_and_every_link_leads_to_a_page_and_a_heading() {
    let read = |page: &Path| std::fs::read_to_string(page).expect("readable");
    let (mut linked, mut anchors) = (BTreeSet::new(), 0);
    for page in pages() {
        let text = read(&page);
        let targets = text.split("](").skip(1).filter_map(|rest| rest.split_once(')')).map(|(target, _)| target);
        let defined = text.lines().filter(|line| line.starts_with('[')).filter_map(|line| line.split_once("]: "));
        for target in targets.chain(defined.map(|(_, target)| target)).filter(|target| !target.contains("://")) {
            let (file, heading) = target.split_once('#').unwrap_or((target, ""));
            let file = if file.is_empty() { page.clone() } else { book().join(file) };
            assert!(file.is_file(), "{}: {target} leads nowhere", page.display());
            let is_there = || read(&file).lines().any(|line| line.starts_with('#') && anchor(line) == heading);
            assert!(heading.is_empty() || is_there(), "{}: {target} names no heading", page.display());
            anchors += usize::from(!heading.is_empty());
            if page.ends_with("SUMMARY.md") {
                linked.insert(file);
            }
        }
    }
    assert!(anchors > 0, "no link names a heading");
    let all: BTreeSet<PathBuf> = pages().into_iter().filter(|page| !page.ends_with("SUMMARY.md")).collect();
    assert_eq!(all, linked, "the summary lists every page");
}
