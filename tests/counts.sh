#!/usr/bin/env bash
# Lines of code by package, and type names that several files declare: bash tests/counts.sh [COMMIT]
#
# Counted: lines of Rust that are neither blank nor a comment; examples and build scripts are among them. Not counted: `#[cfg(test)]`
# items and the files that `#[cfg(test)] mod x;` declares, `*_tests.rs`, and the folders `tests` and `benches`.
# A package is a folder with a Cargo.toml; a file belongs to the innermost package around it. An indented row is part of the row above.
# Lines of TOML: those below folders `runs` and `studies` that are neither blank nor a comment.
# tests/structure/lines.rs counts by this rule too, and compares with tests/structure/lines.toml.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
commit=${1:-HEAD}
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
git archive "$commit" -- ':(glob)**/*.rs' ':(glob)**/*.toml' | tar -x -C "$tree"

printf '%s\n\n| package | lines of code | lines of TOML |\n|---|---|---|\n' "$(git log -1 --format='%h %s' "$commit")"
(
    cd "$tree"
    find . -name Cargo.toml -printf '%h\n' | sed 's|^\./||' >packages
    find . \( -name '*.rs' -o -regex '.*/\(runs\|studies\)/.*\.toml' \) -printf '%P\n' |
        { grep -vE '(^|/)(tests|benches)/|_tests\.rs$' || true; } | sort >sources
    mapfile -t sources <sources
    awk '
        # The modules of a file lie beside `mod.rs`, `lib.rs` and `main.rs`, and in the folder of its name for any other.
        function parent(file) { return substr(file, 1, match(file, /[^\/]*$/) - 1) }
        function folder(file) { return file ~ /(^|\/)(mod|lib|main)\.rs$/ ? parent(file) : substr(file, 1, length(file) - 3) "/" }
        function add(part) { if (is_toml) toml[part]++; else code[part]++; known[part] }
        function around(part) { do sub(/\/?[^\/]*$/, "", part); while (part != "" && !(part in package)); return part }
        function count(file,    place) {
            add("~")
            add(around(file))
            for (place in within) if (index(file, place "/") == 1) add(place)
        }
        function row(name, part) { return "| " name " | " code[part] + 0 " | " toml[part] + 0 " |" }
        BEGIN {
            while ((getline line <"packages") > 0) package[line]
            split("validation/src/cli validation/scenes/src/study solver/src/weakly_compressible", places, " ")
            for (each in places) within[places[each]]
        }
        FNR == 1 {
            state = "code"; comment = 0
            is_toml = FILENAME ~ /\.toml$/
            skipped = pass == 2 && FILENAME in tests
            for (each in hidden) if (pass == 2 && index(FILENAME, each) == 1) skipped = 1
        }
        skipped { next }
        { text = $0; sub(/^[ \t]+/, "", text); indent = length($0) - length(text) }
        is_toml { if (pass == 2 && text != "" && text !~ /^#/) count(FILENAME); next }
        comment { if (text ~ /\*\//) comment = 0; next }
        text == "" || text ~ /^\/\// { next }
        text ~ /^\/\*/ { if (text !~ /\*\//) comment = 1; next }
        state == "code" && text ~ /^#\[cfg\(test\)\]/ { state = "item"; margin = indent; path = ""; next }
        state == "item" && text ~ /^#\[path/ { split(text, quoted, "\""); path = quoted[2] }
        state == "item" && text ~ /^#\[/ { next }
        state == "item" {
            if (text ~ /(^|[ )])mod [a-z_0-9]+;/) {
                name = text; sub(/.*mod /, "", name); sub(/;.*/, "", name)
                if (path != "") tests[parent(FILENAME) path]
                else { tests[folder(FILENAME) name ".rs"]; hidden[folder(FILENAME) name "/"] }
            }
            state = text ~ /[;,}]$/ ? "code" : "body"; next
        }
        state == "body" { if (indent == margin && text ~ /^[})\]]|;$/) state = "code"; next }
        pass == 2 { count(FILENAME) }
        END {
            for (part in known) if (part != "~" && !(part in within)) {
                print part "\t0\t" row(part == "" ? "." : part, part)
                for (place in within) if (place in known && around(place) == part) print part "\t1\t" row("    " place, place)
            }
            print "~\t0\t" row("all", "~")
        }' pass=1 "${sources[@]}" pass=2 "${sources[@]}" | LC_ALL=C sort | cut -f3
)

# Type names of a commit, and those that several declarations share. An associated type inside of an `impl` or a trait declares no
# name of its own: aliases count at the top level of a file only.
names=$(git grep -hE '^\s*(pub(\([a-z: ]+\))? )?(struct|enum|trait) [A-Z]\w*|^(pub(\([a-z: ]+\))? )?type [A-Z]\w*' "$commit" -- \
    'solver/src/*.rs' 'validation/**/*.rs' | sed -E 's/.*(struct|enum|trait|type) ([A-Z][A-Za-z0-9]*).*/\2/' | sort)
printf '\ntype names: %s, of which several declarations share %s\n' "$(uniq <<<"$names" | wc -l)" "$(uniq -d <<<"$names" | wc -l)"
