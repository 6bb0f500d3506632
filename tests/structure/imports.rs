//! The paths by which a file reaches into other modules of its crate.

use crate::structure::source::{Source, is_word};

/// A path from the crate's root, such as `["material", "drag", "DragLaw"]`, and the line that names it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Import {
    pub(crate) path: Vec<String>,
    pub(crate) line: usize,
}

/// Every path of a file that begins with `crate` or `super`, alone or in a list in braces.
pub(crate) fn imports(source: &Source) -> Vec<Import> {
    let bytes = source.code.as_bytes();
    let mut found = Vec::new();
    for word in ["crate", "super"] {
        for (start, _) in source.code.match_indices(word) {
            let end = start + word.len();
            let begins = start == 0 || !(is_word(bytes[start - 1]) || bytes[start - 1] == b':');
            let is_visibility = source.code[..start].trim_end().ends_with("(in");
            if !begins || is_visibility || !source.code[end..].starts_with("::") {
                continue;
            }
            let mut base = if word == "crate" { Vec::new() } else { source.module.clone() };
            if word == "super" {
                base.pop();
            }
            let mut reader = Reader { source, at: end + 2, found: &mut found };
            reader.tree(base);
        }
    }
    found
}

/// Every path of a `use` that begins with neither `crate` nor `super`, below the file's own module: of these, those that begin
/// with a child are what a folder passes on.
pub(crate) fn passed_on(source: &Source) -> Vec<Import> {
    let mut found = Vec::new();
    for (start, word) in source.code.match_indices("use ") {
        let rest = source.code[start + word.len()..].trim_start();
        let begins = source.code[..start].ends_with(['\n', ' ']) || start == 0;
        if begins && !["crate", "super", "self", "::"].iter().any(|other| rest.starts_with(other)) {
            Reader { source, at: start + word.len(), found: &mut found }.tree(source.module.clone());
        }
    }
    found
}

struct Reader<'a> {
    source: &'a Source,
    at: usize,
    found: &'a mut Vec<Import>,
}

impl Reader<'_> {
    /// A path or a list of paths from here on; leaves the position behind it.
    fn tree(&mut self, mut path: Vec<String>) {
        loop {
            self.skip_blanks();
            if self.takes("{") {
                loop {
                    self.skip_blanks();
                    if self.takes("}") {
                        return;
                    }
                    let before = self.at;
                    self.tree(path.clone());
                    self.skip_renaming();
                    if !self.takes(",") && self.at == before {
                        return;
                    }
                }
            }
            let line = self.source.line(self.at);
            let word = self.word();
            match word.as_str() {
                "super" => {
                    path.pop();
                }
                "self" | "" => {}
                _ => path.push(word),
            }
            if !self.takes("::") {
                self.found.push(Import { path, line });
                return;
            }
        }
    }

    fn skip_blanks(&mut self) {
        let rest = &self.source.code[self.at..];
        self.at += rest.len() - rest.trim_start().len();
    }

    /// ` as name`.
    fn skip_renaming(&mut self) {
        self.skip_blanks();
        if self.source.code[self.at..].starts_with("as ") {
            self.at += 3;
            self.skip_blanks();
            self.word();
            self.skip_blanks();
        }
    }

    fn takes(&mut self, text: &str) -> bool {
        let is_there = self.source.code[self.at..].starts_with(text);
        self.at += if is_there { text.len() } else { 0 };
        is_there
    }

    fn word(&mut self) -> String {
        let rest = &self.source.code.as_bytes()[self.at..];
        let length = rest.iter().take_while(|byte| is_word(**byte)).count();
        self.at += length;
        self.source.code[self.at - length..self.at].to_owned()
    }
}

#[test]
fn every_form_of_a_path_is_read() {
    let code = "use crate::a::{b::{C, D as E}, f};\nuse super::g;\nuse super::super::h::*;\npub(in crate::x) fn i() { crate::j::k(); }\n";
    let source = Source { path: String::new(), module: vec!["m".to_owned(), "n".to_owned()], code: code.to_owned() };
    let read: Vec<(String, usize)> =
        imports(&source).into_iter().map(|import| (import.path.join("::"), import.line)).collect();
    let expected = [("a::b::C", 1), ("a::b::D", 1), ("a::f", 1), ("j::k", 4), ("m::g", 2), ("h", 3)];
    assert_eq!(read, expected.map(|(path, line)| (path.to_owned(), line)));
}
