#!/usr/bin/env bash
# Builds the wheel, installs it into a new virtual environment and runs its tests and its notebook there:
# bash tests/python/wheel.sh [PROGRAM]. With a program bagnold of the same sources the numbers are compared to the last digit.
# The wheel stays in target/wheels; a machine that installs it needs no Rust.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
program=${1:+$(realpath "$1")}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

python3 -m venv "$work/environment"
python="$work/environment/bin/python"
"$python" -m pip install --quiet --disable-pip-version-check "maturin>=1.9,<2"
(cd "$root/python" && "$python" -m maturin build --profile dev --locked --quiet --interpreter "$python" --out "$work/wheels")
wheel=$(ls "$work"/wheels/bagnold-*.whl)
"$python" -m pip install --quiet --disable-pip-version-check "$wheel[test]"

# outside the checkout, so that nothing but the installed package can be imported
cp -r "$root/python/tests" "$root/python/notebooks" "$work"
cp "$root/docs/src/python.md" "$work/tests"
cd "$work"
export HOME="$work/home" BAGNOLD_PROGRAM="${program:-}"
mkdir "$HOME"
"$python" -m pytest -q -rs tests
BAGNOLD_STORE="$work/store" "$python" -m pytest -q --nbmake notebooks
mkdir -p "$root/target/wheels"
cp "$wheel" "$root/target/wheels/"
echo "the wheel target/wheels/$(basename "$wheel") works"
