#!/bin/bash
# Films on a slope of 10 degrees by OpenFOAM, 20 and 40 cells: run.sh FOLDER. ITERATIONS may be set.
set -euo pipefail
export WM_PROJECT_DIR="${WM_PROJECT_DIR:-/usr/share/openfoam}" # Debian sets no environment
if ! command -v simpleFoam > /dev/null || [ ! -d "$WM_PROJECT_DIR" ]; then
    echo "simpleFoam is missing: install Debian's package openfoam" >&2
    exit 3
fi
deck=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$1/results"
cd "$1"

# film CELLS FLUID SOLVER TIME_SCHEME END STEP VELOCITY_AT_START STEPS_BETWEEN_MEANS NAME
film() {
    local folder=$2-$1
    rm -rf "$folder"
    mkdir "$folder"
    cp -r "$deck/0" "$deck/constant" "$deck/system" "$folder"
    cp "$folder/constant/transportProperties.$2" "$folder/constant/transportProperties"
    sed -i "s/@CELLS@/$1/; s/@SOLVER@/$3/; s/@DDT@/$4/; s/@END@/$5/; s/@DT@/$6/" "$folder"/system/*
    sed -i "s/@U0@/$7/; s/@EVERY@/$8/" "$folder/0/U" "$folder/system/controlDict"
    (cd "$folder" && blockMesh > log.blockMesh 2>&1 && "$3" > log.solver 2>&1) \
        || { tail -n 5 "$folder"/log.* >&2; exit 1; }
    awk 'BEGIN { print "y,u" } { printf "%.6g,%.6g\n", $1, $2 }' \
        "$folder"/postProcessing/depth/*/line_U.xy > "results/$2-profile$9.csv"
}

# films CELLS NAME
films() {
    film "$1" newtonian pimpleFoam backward 0.5 5e-5 0 100 "$2"
    for fluid in bingham herschel_bulkley; do
        film "$1" $fluid simpleFoam steadyState "${ITERATIONS:-20000}" 1 0.05 20000 "$2"
    done
}

films 20 -coarse
films 40 ""
awk 'BEGIN { print "t,u"; print "0,0" } !/^#/ { gsub(/[()]/, ""); printf "%.6g,%.6g\n", $1, $2 }' \
    newtonian-40/postProcessing/mean/0/volFieldValue.dat > results/newtonian-mean.csv
grep -m 1 '^Build' newtonian-40/log.solver | sed 's/ *: */ /; s/^Build/OpenFOAM/; s/"//g' > version.txt
