#!/usr/bin/env bash
# A law of one's own from an empty folder: `bash tests/own_crate.sh [FOLDER]` has the program write a crate, builds it with
# libraries of its own, tests it, edits its law, and says what that costs. Some minutes; a crate is slow only once.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
program=${BAGNOLD:-target/debug/bagnold}
[ -x "$program" ] || { echo "$program does not exist: run \`cargo build --bin bagnold\` first" >&2; exit 2; }
work=${1:-$(mktemp -d)}
mkdir -p "$work"
"$program" new law own-law --out "$work/own-law"
unset CARGO_TARGET_DIR BAGNOLD_STORE
cd "$work/own-law"
export BAGNOLD_STORE="$work/store"

# Seconds of processor that a command takes, its output in a log.
seconds_of() {
    local TIMEFORMAT='%U %S'
    { time "$@" >"$work/log" 2>&1; } 2>&1 | awk '{ printf "%.0f", $1 + $2 }'
}

# Velocity at the surface of the film.
surface() {
    tail -n 1 film/tables/profile-*.csv | cut -d, -f2
}

first=$(seconds_of cargo build)
if grep '^warning' "$work/log" | grep -v 'will be rejected by a future version'; then
    echo "the build warns" >&2
    exit 1
fi
seconds_of cargo run -- --quiet run film.toml --out film >/dev/null
before=$(surface)
sed -i 's/self\.friction_growth \*/2.0 * self.friction_growth */' src/main.rs
again=$(seconds_of cargo build)
seconds_of cargo run -- --quiet run film.toml --out film >/dev/null
after=$(surface)
printf 'first build %d s of processor, after an edit %d s; at the surface %s m/s, then %s m/s\n' "$first" "$again" "$before" "$after"
awk -v before="$before" -v after="$after" 'BEGIN { exit !(after < 0.6 * before) }' || { echo "a stale number" >&2; exit 1; }
((first <= 300)) || { echo "the first build takes more than 300 s" >&2; exit 1; }
((again <= 20)) || { echo "a build after an edit takes more than 20 s" >&2; exit 1; }
