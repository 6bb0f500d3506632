#!/usr/bin/env bash
# Damaged files of other programs: tables and files of VTK (in every encoding of tests/foreign/vtk) with bytes, counts and
# ends changed are read or refused, never with a panic, without an end, or with more memory than 2 GiB:
# `bash tests/foreign/damaged.sh [COUNT]`, 100 000 of each kind unless said otherwise, about a minute beyond the build.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
# The test program of a package of the validation.
tests_of() {
    cargo test --package "bagnold-$1" --lib --no-run --message-format=json |
        sed -n "/\"name\":\"bagnold_$1\"/s/.*\"executable\":\"\([^\"]*\)\".*/\1/p" | tail -n 1
}
harness=$(tests_of harness)
tools=$(tests_of tools)
(
    ulimit -v $((2 * 1024 * 1024))
    export PROPTEST_CASES=${1:-100000}
    (cd validation/harness && timeout 1800 "$harness" input::text_table metric::variant mesh::)
    (cd validation/tools && timeout 1800 "$tools" judge::vtk)
)
