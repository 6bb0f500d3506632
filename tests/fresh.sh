#!/usr/bin/env bash
# README's two commands as a newcomer gives them: `bash tests/fresh.sh [FOLDER]` clones the last commit into a folder of its own,
# with an empty target and a home of Cargo that holds nothing but the caller's config.toml (which may name a mirror), runs both
# and says what each took and fetched. Nothing may have been fetched or installed before but Rust and the linker that it needs.
# The clone stays in FOLDER, where one is given.
set -euo pipefail
checkout=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
work=${1:-}
if [ -z "$work" ]; then
    work=$(mktemp -d)
    trap 'rm -rf "$work"' EXIT
fi
rm -rf "$work/home" "$work/tree"
mkdir -p "$work/home"
for name in config.toml config; do
    [ ! -f "${CARGO_HOME:-$HOME/.cargo}/$name" ] || cp "${CARGO_HOME:-$HOME/.cargo}/$name" "$work/home/"
done
git clone --quiet "$checkout" "$work/tree"
if [ -n "$(git -C "$checkout" status --porcelain)" ]; then
    echo "note: changes that are not committed are not in the clone" >&2
fi
cd "$work/tree"
# rustup finds its toolchain by its own home, whatever Cargo's is
export RUSTUP_HOME=${RUSTUP_HOME:-$HOME/.rustup} CARGO_HOME="$work/home"
unset CARGO_TARGET_DIR CARGO_BUILD_TARGET_DIR BAGNOLD_STORE RUSTFLAGS CARGO_ENCODED_RUSTFLAGS

# Runs a command; says its wall and processor time, and what lies in Cargo's home since.
timed() {
    local TIMEFORMAT='%R %U %S' code=0 seconds
    exec 3>&1 4>&2
    seconds=$({ time "$@" 1>&3 2>&4; } 2>&1) || code=$?
    exec 3>&- 4>&-
    local crates bytes
    crates=$(find "$CARGO_HOME/registry/cache" -name '*.crate' 2>/dev/null | wc -l)
    bytes=$(du -sm "$CARGO_HOME/registry" 2>/dev/null | cut -f1)
    local fetched
    fetched=$(find "$CARGO_HOME/registry/cache" -name '*.crate' -printf '%s\n' 2>/dev/null | awk '{ sum += $1 } END { printf "%.0f", sum / 1e6 }')
    awk -v name="$*" -v seconds="$seconds" -v crates="$crates" -v fetched="$fetched" -v bytes="$bytes" 'BEGIN {
        split(seconds, part, " ")
        printf "fresh: `%s`: %.0f s of wall time, %.0f s of processor; %d crates fetched so far, %s MB (%s MB unpacked)\n",
            name, part[1], part[2] + part[3], crates, fetched, bytes
    }'
    return "$code"
}

failed=0
timed cargo run -- report --deny moved || failed=1
test -s reports/index.html || { echo "fresh: there is no reports/index.html" >&2; failed=1; }
ls -l target/debug/bagnold | awk '{ printf "fresh: the program has %.0f MB\n", $5 / 1e6 }'
# one target that fails must not hide the others
timed cargo test --no-fail-fast || failed=1
exit "$failed"
