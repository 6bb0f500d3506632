//! The part of a source that results depend on.

/// The code of a file without its comments and its unit tests: no result depends on them.
pub(crate) fn code(text: &str) -> String {
    let (before, tests) = text.split_once("#[cfg(test)]\nmod tests {").unwrap_or((text, ""));
    // what follows the module's brace is code again
    let after = tests.split_once("\n}").map_or(tests, |(_, after)| after);
    let is_code = |line: &&str| !line.trim_start().starts_with("//");
    before.lines().chain(after.lines()).filter(is_code).collect::<Vec<_>>().join("\n")
}

/// Whether a file is compiled for tests alone, by its path in the workspace: the workspace itself may lie in any folder.
pub(crate) fn is_of_tests(path: &str) -> bool {
    let mut parts = path.trim_end_matches(".rs").split('/');
    parts.any(|part| part == "tests" || part.ends_with("_tests"))
}
