#!/usr/bin/env bash
# How large the project is: lines by folder, type names that several files declare. bash tests/counts.sh [COMMIT]
# Circles of files have a test of their own (tests/structure/circles.rs), repeated passages none.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
commit=${1:-HEAD}

# Lines of Rust, of pages' templates and of tiers below a path.
lines() {
    git ls-tree -r --name-only "$commit" -- "$1" | { grep -E '\.(rs|html)$' || true; } |
        while read -r file; do git show "$commit:$file"; done | wc -l
}

printf '%s\n\n| folder | lines |\n|---|---|\n' "$(git log -1 --format='%h %s' "$commit")"
for folder in solver/src validation/src/case validation/src/cases validation/src/setup validation/src/study validation/src/mutation \
    validation/src validation/layer validation/inference validation/figure validation/number tests python .; do
    printf '| %s | %s |\n' "$folder" "$(lines "$folder")"
done

printf '\n| case | lines |\n|---|---|\n'
git ls-tree -d --name-only "$commit" -- validation/src/cases/ | while read -r folder; do
    printf '| %s | %s |\n' "${folder##*/}" "$(lines "$folder")"
done | sort -t'|' -k3 -n

# Type names of a commit, and those that several declarations share. An associated type inside of an `impl` or a trait declares no
# name of its own: aliases count at the top level of a file only.
type_names() {
    local names
    names=$(git grep -hE '^\s*(pub(\([a-z: ]+\))? )?(struct|enum|trait) [A-Z]\w*|^(pub(\([a-z: ]+\))? )?type [A-Z]\w*' "$1" -- \
        'solver/src/*.rs' 'validation/**/*.rs' | sed -E 's/.*(struct|enum|trait|type) ([A-Z][A-Za-z0-9]*).*/\2/' | sort)
    printf 'type names at %s: %s, of which several declarations share %s\n' \
        "$(git rev-parse --short "$1")" "$(uniq <<<"$names" | wc -l)" "$(uniq -d <<<"$names" | wc -l)"
}

printf '\n'
for each in $(printf '%s\n' HEAD "$commit" | uniq); do type_names "$each"; done
