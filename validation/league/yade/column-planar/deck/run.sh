#!/bin/bash
# A planar column of discs by YADE: run.sh FOLDER. ASPECT, WIDTH, SEED and STEPS may be set.
set -euo pipefail
deck=$(cd "$(dirname "$0")" && pwd)
if ! command -v yade > /dev/null; then
    echo "yade is missing: install Debian's package yade" >&2
    exit 3
fi
export ASPECT="${ASPECT:-1}" WIDTH="${WIDTH:-40}" SEED="${SEED:-1}" STEPS="${STEPS:-15}"
mkdir -p "$1/results"
cd "$1"
rm -f grains.*.txt
cp "$deck/column.py" "$deck/tables.py" .
yade -n -x -j 1 column.py > log 2>&1 || { tail -n 5 log >&2; exit 1; }
yade --version 2>&1 | sed -n 's/^Yade version: */YADE /p' | sed 's/ *$//' > version.txt
python3 tables.py 0.1 "$(awk "BEGIN { print 0.1 * $ASPECT }")"
