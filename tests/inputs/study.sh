#!/usr/bin/env bash
# The study of generated inputs at length: `bash tests/inputs/study.sh [COUNT]`, 3000 inputs unless said otherwise.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
BAGNOLD_INPUTS=${1:-3000} cargo test -p bagnold-tests --test suite inputs:: -- --nocapture --test-threads=1
