#!/usr/bin/env bash
# Optimisation changes no bit: an unoptimised build with all its checks and a release build end short runs of every case in
# the committed states. `bash tests/builds.sh`, about a quarter of an hour on 2 cores.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
target=${CARGO_TARGET_DIR:-target}
for profile in unoptimised release; do
    cargo build --profile "$profile" --bin bagnold-dev
    printf '%s:\n' "$profile"
    "$target/$profile/bagnold-dev" verify
done
echo "unoptimised and release builds give the same bits"
