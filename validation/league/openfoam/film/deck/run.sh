#!/bin/bash
# Films on a slope of 10 degrees by OpenFOAM: run.sh FOLDER. CELLS and ITERATIONS may be set.
set -euo pipefail
export WM_PROJECT_DIR="${WM_PROJECT_DIR:-/usr/share/openfoam}" # Debian sets no environment
if ! command -v simpleFoam > /dev/null || [ ! -d "$WM_PROJECT_DIR" ]; then
    echo "simpleFoam is missing: install Debian's package openfoam" >&2
    exit 3
fi
deck=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$1/results"
cd "$1"

# film FLUID SOLVER TIME_SCHEME END STEP VELOCITY_AT_START STEPS_BETWEEN_MEANS
film() {
    rm -rf "$1"
    mkdir "$1"
    cp -r "$deck/0" "$deck/constant" "$deck/system" "$1"
    sed -i "s/@CELLS@/${CELLS:-40}/; s/@SOLVER@/$2/; s/@DDT@/$3/; s/@END@/$4/; s/@DT@/$5/" "$1"/system/*
    sed -i "s/@U0@/$6/; s/@EVERY@/$7/" "$1/0/U" "$1/system/controlDict"
    cp "$1/constant/transportProperties.$1" "$1/constant/transportProperties"
    (cd "$1" && blockMesh > log.blockMesh 2>&1 && "$2" > log.solver 2>&1) \
        || { tail -n 5 "$1"/log.* >&2; exit 1; }
    awk 'BEGIN { print "y,u" } { printf "%.6g,%.6g\n", $1, $2 }' \
        "$1"/postProcessing/depth/*/line_U.xy > "results/$1-profile.csv"
}

film newtonian pimpleFoam backward 0.5 5e-5 0 100
film bingham simpleFoam steadyState "${ITERATIONS:-20000}" 1 0.05 20000
film herschel_bulkley simpleFoam steadyState "${ITERATIONS:-20000}" 1 0.05 20000
awk 'BEGIN { print "t,u"; print "0,0" } !/^#/ { gsub(/[()]/, ""); printf "%.6g,%.6g\n", $1, $2 }' \
    newtonian/postProcessing/mean/0/volFieldValue.dat > results/newtonian-mean.csv
grep -m 1 '^Build' newtonian/log.solver | sed 's/ *: */ /; s/^Build/OpenFOAM/; s/"//g' > version.txt
