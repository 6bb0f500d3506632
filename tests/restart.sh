#!/usr/bin/env bash
# Kills `run`, `report`, `sweep` and `calibrate` with -9 in the middle of their runs, of both models, in the plane and in
# space, and compares the final states with those of commands that were left alone: `bash tests/restart.sh [KILLS]`, ten
# kills each of six commands by default.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
export BAGNOLD_KILLS="${1:-10}"
cargo build --bin bagnold
cargo test --test suite command_line::restart:: -- --include-ignored --nocapture --test-threads=1
