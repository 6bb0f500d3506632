#!/usr/bin/env bash
# Damaged files of other programs: tables and files of VTK (in every encoding of tests/foreign/vtk) with bytes, counts and
# ends changed are read or refused, never with a panic, without an end, or with more memory than 2 GiB:
# `bash tests/foreign/damaged.sh [COUNT]`, 100 000 of each kind unless said otherwise, about a minute beyond the build.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
cargo test --package bagnold-validation --lib --no-run
program=$(cargo test --package bagnold-validation --lib --no-run --message-format=json |
    sed -n '/"name":"bagnold_validation"/s/.*"executable":"\([^"]*\)".*/\1/p' | tail -n 1)
cd validation
(
    ulimit -v $((2 * 1024 * 1024))
    PROPTEST_CASES=${1:-100000} timeout 1800 "$program" judge::vtk judge::text_table metric::variant mesh::
)
