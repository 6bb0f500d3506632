#!/bin/bash
# A laminar film by OpenFOAM on meshes of 10, 20 and 40 cells: run.sh FOLDER
set -euo pipefail
export WM_PROJECT_DIR="${WM_PROJECT_DIR:-/usr/share/openfoam}" # Debian sets no environment
if ! command -v pimpleFoam > /dev/null || [ ! -d "$WM_PROJECT_DIR" ]; then
    echo "pimpleFoam is missing: install Debian's package openfoam" >&2
    exit 3
fi
deck=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$1/results"
cd "$1"

# film CELLS TIME_STEP
film() {
    rm -rf "$1"
    mkdir "$1"
    cp -r "$deck/0" "$deck/constant" "$deck/system" "$1"
    sed -i "s/@CELLS@/$1/; s/@DT@/$2/" "$1"/system/*
    (cd "$1" && blockMesh > log.blockMesh 2>&1 && pimpleFoam > log.solver 2>&1) \
        || { tail -n 5 "$1"/log.* >&2; exit 1; }
    awk 'BEGIN { print "y,u" } { printf "%.6g,%.6g\n", $1, $2 }' \
        "$1"/postProcessing/depth/*/line_U.xy > "results/profile-$1.csv"
}

film 10 0.02
film 20 0.005
film 40 0.00125
# the mean over the depth, from 1/3 m/s at every height
awk 'BEGIN { print "t,u"; print "0,0.333333" }
    !/^#/ { gsub(/[()]/, ""); printf "%.6g,%.6g\n", $1, $2 }' \
    40/postProcessing/mean/0/volFieldValue.dat > results/mean.csv
grep -m 1 '^Build' 40/log.solver | sed 's/ *: */ /; s/^Build/OpenFOAM/; s/"//g' > version.txt
