#!/bin/bash
# A square column of water by DualSPHysics on the CPU, released at once: run.sh FOLDER
set -euo pipefail
program=$(command -v "${DUALSPHYSICS:-DualSPHysics5.4CPU_linux64}") || {
    echo "DualSPHysics is missing: name its program for the CPU by DUALSPHYSICS=PATH" >&2
    exit 3
}
program=$(realpath "$program")
if ! python3 -c "import numpy" 2> /dev/null; then
    echo "numpy is missing: install PyPI's package numpy" >&2
    exit 3
fi
export PYTHONDONTWRITEBYTECODE=1 # the deck stays as it is
deck=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$1/results"
cd "$1"
rm -rf out
python3 "$deck/column.py" "$deck/start.csv"
"$program" case out -cpu -ompthreads:1 -stable -sv:csv > log 2>&1 || { tail -n 8 log >&2; exit 1; }
python3 "$deck/column.py" "$deck/start.csv" tables > results/front.csv
grep -m 1 '^DualSPHysics5 v' log > version.txt
