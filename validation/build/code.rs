//! The sources that results depend on, and the part of each that they do.

/// Folders of code that results depend on.
pub(crate) const CODE: [&str; 9] = [
    "solver/src",
    "validation/number/src",
    "validation/figure/src",
    "validation/inference/src",
    "validation/harness/src",
    "validation/reference/src",
    "validation/cases/src",
    "validation/scenes/src",
    "validation/tools/src",
];

/// The code of a file without its comments and its unit tests: no result depends on them.
pub(crate) fn code(text: &str) -> String {
    let (before, tests) = text.split_once("#[cfg(test)]\nmod tests {").unwrap_or((text, ""));
    // what follows the module's brace is code again
    let after = tests.split_once("\n}").map_or(tests, |(_, after)| after);
    let mut open = None;
    let is_code = |line: &&str| {
        // within a literal of several lines, two slashes begin no comment
        let is_comment = open.is_none() && line.trim_start().starts_with("//");
        open = left_open(line, open.take());
        !is_comment
    };
    before.lines().chain(after.lines()).filter(is_code).collect::<Vec<_>>().join("\n")
}

/// End of the literal that a line leaves open, by that of the literal which it begins in: `"`, or `"##` of a raw one.
pub(crate) fn left_open(line: &str, mut open: Option<String>) -> Option<String> {
    let line = line.replace("\\\\", "").replace("\\\"", "").replace("'\"'", "");
    let mut rest = line.as_str();
    loop {
        if let Some(close) = &open {
            let Some((_, after)) = rest.split_once(close.as_str()) else { return open };
            rest = after;
        }
        // none within a comment
        let (code, after) = rest.split_once('"').filter(|(code, _)| !code.contains("//"))?;
        let before = code.trim_end_matches('#');
        let hashes = if before.ends_with('r') { &code[before.len()..] } else { "" };
        (open, rest) = (Some(format!("\"{hashes}")), after);
    }
}

/// Whether a file is compiled for tests alone, by its path in the workspace: the workspace itself may lie in any folder.
pub(crate) fn is_of_tests(path: &str) -> bool {
    let mut parts = path.trim_end_matches(".rs").split('/');
    parts.any(|part| part == "tests" || part.ends_with("_tests"))
}
