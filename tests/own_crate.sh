#!/usr/bin/env bash
# A law of one's own from an empty folder: `bash tests/own_crate.sh [FOLDER]` has the program write a crate, builds it with
# libraries of its own, tests it, edits its law, says what that costs, and puts a law that remembers in its place, which runs a
# scene. Some minutes; a crate is slow only once.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
checkout=$PWD
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

# a law with a field of its own in the same crate, and a scene of it whose balances hold
cp "$checkout/validation/examples/own_field_law.rs" src/main.rs
cat >block.toml <<'SCENE'
case = "scene"
name = "block"
spacing = 0.01
duration = 0.5
interval = 0.05
pictures = 1
measured = []
sides = { left = { mirror = 0.0 }, right = { open = 0.6 }, bottom = "none", top = "none" }
bulk = { bulk_density = 1500.0 }
material = { law = "softening", peak_friction = 0.7, residual_friction = 0.4, softening_strain = 0.1 }
bodies = [{ shape = "box", lower = [0.0, 0.0], upper = [0.1, 0.12] }]
walls = [{ name = "bed", points = [[0.0, 0.0], [0.6, 0.0]] }]
gauges = [{ kind = "front", name = "front", from = [0.0, 0.0], to = [0.6, 0.0], thickness = 0.01 }]
SCENE
cargo run -- --quiet run block.toml --out block >"$work/log" 2>&1 || { cat "$work/log"; echo "the scene of a law with a field fails" >&2; exit 1; }
cargo run -- --quiet run block.toml --set material.residual_friction=0.7 --out strong >>"$work/log" 2>&1
front() { awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i ~ /front: front/) column = i } END { print $column }' "$1"/tables/gauges-*.csv; }
printf 'softened, the front is at %s m, else at %s m\n' "$(front block)" "$(front strong)"
awk -v soft="$(front block)" -v strong="$(front strong)" 'BEGIN { exit !(soft > strong + 0.01) }' || { echo "the field does nothing" >&2; exit 1; }
