//! Wording of documents, doc comments and messages: lengths of sentences and lines, banned words, first words.

use crate::structure::source::workspace;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Words that open a question `[-]`.
const QUESTIONS: [&str; 7] = ["What", "How", "Where", "When", "Which", "Who", "Why"];
/// House words that have a standard word.
const BANNED: [&str; 6] = ["nobody", "somebody", "likewise", "of one's own", "told apart", " is no "];
/// Words that nothing prints, each for a standard one.
const NEVER_PRINTED: [&str; 12] = [
    "known defect",
    "drifted",
    "accepted anew",
    "deliberate error",
    "way of a front",
    "further ratio",
    "is right",
    "cannot tell",
    "at the level",
    "nobody",
    "one's own",
    "told apart",
];
/// Words of a sentence at most.
const LONGEST_SENTENCE: usize = 35;
/// Characters of a line of prose at most.
const LONGEST_LINE: usize = 100;
/// Words of a message at most.
const LONGEST_MESSAGE: usize = 30;
/// Words of a reason of a gate at most, and in the mean of all reasons.
pub(crate) const LONGEST_REASON: usize = 20;
const MEAN_REASON: f64 = 14.0;
/// Words of a caption at most.
pub(crate) const LONGEST_CAPTION: usize = 40;
/// Begins the reason of a gate in the code of a case.
const REASONS: [&str; 5] = [".gated(", ".gated_by(", "reason = ", "reason) = ", "REASON: &str ="];
/// Documents and their largest number of words; a folder stands for all its documents but generated ones.
const LENGTHS: [(&str, usize); 4] =
    [("README.md", 1_000), ("ARCHITECTURE.md", 2_200), ("CHANGELOG.md", 700), ("docs/src", 18_000)];
/// Doc comments that may begin with a question word, mostly because they are printed by `--help` and `show`; only fewer are allowed.
const QUESTIONS_LEFT: usize = 300;

fn text(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Files of a folder and below with an ending.
pub(crate) fn files(folder: &str, ending: &str) -> Vec<PathBuf> {
    let (mut found, mut open) = (Vec::new(), vec![workspace().join(folder)]);
    while let Some(path) = open.pop() {
        if path.is_dir() {
            let entries = std::fs::read_dir(&path).expect("a folder").flatten().map(|entry| entry.path());
            open.extend(entries.filter(|path| !path.ends_with("target")));
        } else if path.extension().is_some_and(|own| own == ending) {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// Documents for users and for developers.
fn documents() -> Vec<PathBuf> {
    let single = ["README.md", "ARCHITECTURE.md", "CHANGELOG.md", "CONTRIBUTING.md", "docs/src", "docs/dev"];
    single.iter().flat_map(|path| files(path, "md")).collect()
}

/// (number, text) of the lines of a document that are prose: no code, no table.
fn prose(document: &str) -> Vec<(usize, &str)> {
    let mut is_code = false;
    let mut lines = Vec::new();
    for (index, line) in document.lines().enumerate() {
        if line.trim_start().starts_with("```") {
            is_code = !is_code;
        } else if !is_code && !line.trim_start().starts_with('|') {
            lines.push((index + 1, line));
        }
    }
    lines
}

/// (line, words) of the sentences of a document. A blank line, a heading and an item of a list begin a new one.
fn sentences(document: &str) -> Vec<(usize, String)> {
    let mut found: Vec<(usize, String)> = vec![(1, String::new())];
    for (number, line) in prose(document) {
        let trimmed = line.trim_start();
        let is_item = trimmed.starts_with(['-', '*', '#', '!'])
            || trimmed.split('.').next().is_some_and(|first| first.parse::<u32>().is_ok());
        if trimmed.is_empty() || is_item {
            found.push((number, String::new()));
        }
        for word in trimmed.split_whitespace() {
            if let Some(last) = found.last_mut() {
                last.1.push_str(word);
                last.1.push(' ');
            }
            let ends = word.trim_end_matches(['*', ')', '"', '`', '_']).ends_with(['.', '?', '!', ':']);
            if ends && !["al.", "e.g.", "i.e.", "vs.", "Fig.", "Eq."].contains(&word) {
                found.push((number, String::new()));
            }
        }
    }
    found.retain(|(_, sentence)| sentence.split_whitespace().nth(2).is_some());
    found
}

fn place(path: &Path, line: usize) -> String {
    format!("{}:{line}", path.strip_prefix(workspace()).unwrap_or(path).display())
}

#[track_caller]
fn assert_none(found: &[String]) {
    assert!(found.is_empty(), "{} places:\n{}", found.len(), found.join("\n"));
}

#[test]
fn sentences_of_documents_are_short() {
    let mut long = Vec::new();
    for path in documents() {
        for (line, sentence) in sentences(&text(&path)) {
            let words = words(&sentence);
            if words > LONGEST_SENTENCE {
                long.push(format!("{}: {words} words: {sentence}", place(&path, line)));
            }
        }
    }
    assert_none(&long);
}

#[test]
fn readme_and_limits_have_sentences_of_twenty_words() {
    for name in ["README.md", "docs/src/limits.md"] {
        let all = sentences(&text(&workspace().join(name)));
        let words: usize = all.iter().map(|(_, sentence)| sentence.split_whitespace().count()).sum();
        let mean = words as f64 / all.len() as f64;
        assert!(mean <= 20.0, "{name}: {mean:.1} words in the mean of {} sentences", all.len());
    }
}

#[test]
fn lines_of_documents_are_short() {
    let mut long = Vec::new();
    for path in documents() {
        let document = text(&path);
        let lines = prose(&document).into_iter().filter(|(_, line)| !line.contains("]("));
        long.extend(
            lines.filter(|(_, line)| line.chars().count() > LONGEST_LINE).map(|(number, _)| place(&path, number)),
        );
    }
    assert_none(&long);
}

#[test]
fn documents_use_standard_words() {
    let mut found = Vec::new();
    for path in documents().into_iter().filter(|path| !path.ends_with("writing.md")) {
        for (number, line) in text(&path).lines().enumerate() {
            let lower = line.to_lowercase();
            let banned = BANNED.iter().filter(|word| lower.contains(**word)).map(|word| word.trim().to_owned());
            found.extend(banned.chain(per(line)).map(|word| format!("{}: {word}", place(&path, number + 1))));
        }
    }
    assert_none(&found);
}

/// A unit with "a" in the sense of "per", such as "µs a particle".
fn per(line: &str) -> Option<String> {
    let words: Vec<&str> = line.split_whitespace().collect();
    let units = ["µs", "ns", "ms", "s", "B", "kB", "MB", "division", "pass"];
    let things = ["particle", "pair", "step", "row", "case", "run", "particle-step"];
    let is_per = |three: &&[&str]| {
        units.contains(&three[0]) && three[1] == "a" && things.iter().any(|thing| three[2].starts_with(thing))
    };
    words.windows(3).find(is_per).map(|three| three.join(" "))
}

#[test]
fn headings_are_no_questions() {
    let mut found = Vec::new();
    for path in documents() {
        let document = text(&path);
        let is_question = |line: &str| {
            let words = line.strip_prefix('#').map(|rest| rest.trim_start_matches('#').trim_start());
            words.is_some_and(|words| QUESTIONS.iter().any(|question| words.starts_with(&format!("{question} "))))
        };
        let lines = prose(&document).into_iter().filter(|(_, line)| is_question(line));
        found.extend(lines.map(|(number, line)| format!("{}: {line}", place(&path, number))));
    }
    assert_none(&found);
}

#[test]
fn doc_comments_begin_with_nouns() {
    let mut count = 0;
    for path in ["solver", "validation", "tests", "python"].iter().flat_map(|folder| files(folder, "rs")) {
        let source = text(&path);
        let comments = source.lines().filter_map(|line| {
            let line = line.trim_start();
            line.strip_prefix("/// ").or_else(|| line.strip_prefix("//! "))
        });
        count += comments
            .filter(|words| QUESTIONS.iter().any(|question| words.starts_with(&format!("{question} "))))
            .count();
    }
    assert!(count <= QUESTIONS_LEFT, "{count} doc comments begin with a question word, {QUESTIONS_LEFT} may");
}

#[test]
fn messages_are_short() {
    let mut long = Vec::new();
    for path in files("tests/bad", "message") {
        let message = text(&path);
        let words = message.split_whitespace().count();
        let is_odd =
            ["is with ", "such that", "of a size", " unlike ", "parted"].iter().any(|words| message.contains(words));
        if words > LONGEST_MESSAGE || is_odd {
            long.push(format!("{}: {words} words: {message}", place(&path, 1)));
        }
    }
    assert_none(&long);
}

/// Texts between quotes in the lines of code of a file, without its unit tests.
fn literals(code: &str) -> Vec<String> {
    let code = code.split("#[cfg(test)]").next().unwrap_or_default();
    let lines = code.lines().filter(|line| !line.trim_start().starts_with("//"));
    lines.flat_map(|line| line.split('"').skip(1).step_by(2).map(str::to_owned).collect::<Vec<_>>()).collect()
}

#[test]
fn what_is_printed_uses_standard_words() {
    let mut printed: Vec<(PathBuf, Vec<String>)> = Vec::new();
    for path in files("validation", "html") {
        let page = text(&path);
        // a number before a word of several things is wrong of one
        let parts = page.split("length }} ").skip(1).filter(|rest| rest.starts_with(char::is_alphabetic));
        let counted = parts.map(|rest| rest.chars().take_while(|letter| *letter != '<').collect::<String>());
        let one: Vec<String> = counted.filter(|rest| !rest.contains("{%")).collect();
        assert!(one.is_empty(), "{}: {one:?}", path.display());
        printed.push((path, vec![page]));
    }
    let sources = files("validation", "rs").into_iter().chain(files("solver/src", "rs"));
    let is_test = |part: &str| part == "tests" || part.ends_with("tests.rs");
    let sources = sources.filter(|path| !path.iter().any(|part| is_test(&part.to_string_lossy())));
    printed.extend(sources.map(|path| (path.clone(), literals(&text(&path)))));
    printed.extend(files("validation/studies", "toml").into_iter().map(|path| (path.clone(), vec![text(&path)])));
    let mut found = Vec::new();
    for (path, texts) in printed {
        let all = texts.iter().map(|text| text.to_lowercase()).collect::<Vec<_>>();
        let is_printed = |word: &&&str| all.iter().any(|text| text.contains(**word));
        found.extend(NEVER_PRINTED.iter().filter(is_printed).map(|word| format!("{}: {word}", path.display())));
    }
    assert_none(&found);
}

/// Number of words of a text, symbols left out.
pub(crate) fn words(text: &str) -> usize {
    text.split_whitespace().filter(|word| word.contains(char::is_alphanumeric)).count()
}

/// Texts of an argument list or a statement of which the code begins with the rest.
fn texts(code: &str) -> Vec<String> {
    let (mut depth, mut is_text, mut found) = (0, false, Vec::<String>::new());
    for letter in code.chars() {
        match letter {
            '"' if is_text => is_text = false,
            letter if is_text => found.last_mut().expect("its begin").push(letter),
            '"' => {
                is_text = true;
                found.push(String::new());
            }
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' if depth == 0 => break,
            ')' | ']' | '}' => depth -= 1,
            ';' if depth == 0 => break,
            _ => {}
        }
    }
    found
}

#[test]
fn reasons_of_gates_are_short() {
    let code = ["cases/src", "scenes/src"].iter().flat_map(|folder| files(&format!("validation/{folder}"), "rs"));
    let judging = code.filter(|path| path.iter().any(|part| part == "metrics" || part == "metrics.rs"));
    let mut reasons = BTreeSet::new();
    for path in judging {
        let code = text(&path);
        let begins = REASONS.iter().flat_map(|begin| code.match_indices(begin).map(|(at, _)| at + begin.len()));
        reasons.extend(begins.flat_map(|at| texts(&code[at..])).filter(|reason| words(reason) > 2));
    }
    for study in files("validation/studies", "toml") {
        let study = text(&study);
        let stated = study.lines().filter_map(|line| line.strip_prefix("reason = "));
        reasons.extend(stated.map(|reason| reason.trim_matches('"').to_owned()));
    }
    assert!(reasons.len() > 150, "{} reasons were found", reasons.len());
    let mean = reasons.iter().map(|reason| words(reason)).sum::<usize>() as f64 / reasons.len() as f64;
    assert!(mean <= MEAN_REASON, "{mean:.1} words in the mean of {} reasons", reasons.len());
    let long = reasons.into_iter().filter(|reason| words(reason) > LONGEST_REASON);
    assert_none(&long.collect::<Vec<_>>());
}

#[test]
fn documents_keep_their_lengths() {
    for (name, most) in LENGTHS {
        let written =
            files(name, "md").into_iter().map(|path| text(&path)).filter(|text| !text.starts_with("<!-- Generated"));
        let words: usize = written.map(|text| text.split_whitespace().count()).sum();
        assert!(words <= most, "{name} has {words} words, {most} at most");
    }
    let readme = text(&workspace().join("README.md"));
    let before = readme.split("cargo run").next().unwrap_or_default();
    assert!(before.split_whitespace().count() <= 250, "README's first command comes within 250 words");
}
