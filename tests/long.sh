#!/usr/bin/env bash
# Tests that `cargo test` leaves out because they take minutes: modules `long` of the targets. Paper tier and full studies
# have commands of their own.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
cargo test --tests --no-fail-fast -- --ignored long::
