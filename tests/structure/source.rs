//! Rust files as a reader of structure sees them: without comments, texts and tests.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// A file's code; what is left out is blank, so that lines keep their numbers.
pub(crate) struct Source {
    /// Path below the workspace, with `/`.
    pub(crate) path: String,
    /// Modules from the crate's root on, such as `["kernel", "wendland"]`.
    pub(crate) module: Vec<String>,
    /// The code.
    pub(crate) code: String,
}

impl Source {
    /// The line of a position, from 1.
    pub(crate) fn line(&self, position: usize) -> usize {
        self.code[..position].matches('\n').count() + 1
    }
}

/// The workspace.
pub(crate) fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// All files of a crate's `src` that are no tests, by their paths.
pub(crate) fn sources(crate_src: &str) -> Vec<Source> {
    let mut files = Vec::new();
    collect(&workspace().join(crate_src), &mut Vec::new(), &mut files);
    files.sort();
    let read = |(module, file): (Vec<String>, PathBuf)| {
        let text = std::fs::read_to_string(&file).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
        let below = file.strip_prefix(workspace()).unwrap_or(&file).to_string_lossy().replace('\\', "/");
        Source { path: below, module, code: without_tests(&blanked(&text)) }
    };
    files.into_iter().map(read).collect()
}

fn collect(folder: &Path, module: &mut Vec<String>, files: &mut Vec<(Vec<String>, PathBuf)>) {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let paths: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    let tests = test_modules(&paths);
    for path in paths {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        if name == "tests" || name.ends_with("_tests") || tests.contains(&name) {
            continue;
        }
        if path.is_dir() {
            module.push(name);
            collect(&path, module, files);
            module.pop();
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let own = (!matches!(name.as_str(), "mod" | "lib" | "main")).then_some(name);
            files.push((module.iter().cloned().chain(own).collect(), path));
        }
    }
}

/// Modules of a folder that are declared behind `#[cfg(test)]`.
fn test_modules(paths: &[PathBuf]) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for path in paths.iter().filter(|path| path.extension().is_some_and(|extension| extension == "rs")) {
        let text = std::fs::read_to_string(path).unwrap_or_default();
        for (position, mark) in text.match_indices(TEST) {
            let rest = text[position + mark.len()..].trim_start();
            let declared = rest.split(['{', ';']).next().unwrap_or_default();
            if let Some((_, name)) = declared.rsplit_once("mod ").filter(|_| rest[declared.len()..].starts_with(';')) {
                found.insert(name.trim().to_owned());
            }
        }
    }
    found
}

const TEST: &str = "#[cfg(test)]";

/// The text with comments and the insides of texts and characters blanked.
pub(crate) fn blanked(text: &str) -> String {
    let bytes = text.as_bytes();
    let mut out = bytes.to_vec();
    let mut at = 0;
    while at < bytes.len() {
        let end = skipped(bytes, at);
        if end > at {
            out[at..end].iter_mut().filter(|byte| **byte != b'\n').for_each(|byte| *byte = b' ');
        }
        at = end.max(at + 1);
    }
    // every byte of a character beyond ASCII stands in a comment, in a text or in a name
    String::from_utf8_lossy(&out).into_owned()
}

/// End of the comment, text or character that begins here; `at` if none does.
fn skipped(bytes: &[u8], at: usize) -> usize {
    let rest = &bytes[at..];
    let find = |needle: &[u8], from: usize| {
        rest[from..].windows(needle.len()).position(|window| window == needle).map_or(bytes.len(), |k| at + from + k)
    };
    match rest {
        [b'/', b'/', ..] => find(b"\n", 2),
        [b'/', b'*', ..] => (find(b"*/", 2) + 2).min(bytes.len()),
        [b'r', b'"' | b'#', ..] if at == 0 || !is_word(bytes[at - 1]) => {
            let hashes = rest[1..].iter().take_while(|byte| **byte == b'#').count();
            if rest.get(1 + hashes) != Some(&b'"') {
                return at;
            }
            let close: Vec<u8> = std::iter::once(b'"').chain(std::iter::repeat_n(b'#', hashes)).collect();
            (find(&close, 2 + hashes) + close.len()).min(bytes.len())
        }
        [b'"', ..] => {
            let mut end = at + 1;
            while end < bytes.len() && bytes[end] != b'"' {
                end += if bytes[end] == b'\\' { 2 } else { 1 };
            }
            (end + 1).min(bytes.len())
        }
        // a character, not a lifetime
        [b'\'', b'\\', ..] => find(b"'", 3) + 1,
        [b'\'', _, b'\'', ..] => at + 3,
        [b'\'', first, ..] if *first >= 0x80 => find(b"'", 1) + 1,
        _ => at,
    }
}

pub(crate) fn is_word(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_'
}

/// The code with every item behind `#[cfg(test)]` blanked.
fn without_tests(code: &str) -> String {
    let mut out = code.to_owned();
    while let Some(start) = out.find(TEST) {
        let end = start + TEST.len() + item_length(&out[start + TEST.len()..]);
        let blank: String = out[start..end].chars().map(|c| if c == '\n' { '\n' } else { ' ' }).collect();
        out.replace_range(start..end, &blank);
    }
    out
}

/// Length of the item that begins here: up to its `;`, or the brace that closes its first.
fn item_length(code: &str) -> usize {
    let mut depth = 0usize;
    for (position, byte) in code.bytes().enumerate() {
        match byte {
            b';' if depth == 0 => return position + 1,
            b'{' => depth += 1,
            b'}' => {
                depth = depth.saturating_sub(1);
                if depth == 0 {
                    return position + 1;
                }
            }
            _ => {}
        }
    }
    code.len()
}

#[test]
fn comments_texts_and_tests_are_left_out() {
    let text = "use a::b; // use crate::c\nlet s = \"crate::d\"; let c = '\"';\n#[cfg(test)]\nmod tests { use crate::e; }\nfn f<'a>() {}\n";
    let code = without_tests(&blanked(text));
    for gone in ["crate", "tests"] {
        assert!(!code.contains(gone), "{code}");
    }
    assert!(code.contains("use a::b;") && code.contains("fn f<'a>() {}"));
    assert_eq!(code.lines().count(), text.lines().count());
}
