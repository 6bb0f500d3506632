#!/bin/bash
# A planar pile of bars by Newton's implicit material points on the CPU: run.sh FOLDER.
# The first run of a user also compiles the kernels, which takes about half a minute.
set -euo pipefail
deck=$(cd "$(dirname "$0")" && pwd)
if ! python3 -c "import newton, numpy, warp" 2> /dev/null; then
    echo "Newton is missing: install PyPI's packages newton, warp-lang and numpy" >&2
    exit 3
fi
mkdir -p "$1/results"
cd "$1"
python3 "$deck/column.py" > log 2>&1 || { tail -n 5 log >&2; exit 1; }
python3 "$deck/tables.py"
python3 -c "
from importlib.metadata import version
print('Newton ' + version('newton') + ', Warp ' + version('warp-lang'))" > version.txt
