#!/bin/bash
# A square column of water by OpenFOAM, released at once: run.sh FOLDER
set -euo pipefail
export WM_PROJECT_DIR="${WM_PROJECT_DIR:-/usr/share/openfoam}" # Debian sets no environment
if ! command -v interFoam > /dev/null || [ ! -d "$WM_PROJECT_DIR" ]; then
    echo "interFoam is missing: install Debian's package openfoam" >&2
    exit 3
fi
deck=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$1/results"
cd "$1"
rm -rf column
mkdir column
cp -r "$deck/0" "$deck/constant" "$deck/system" column
(cd column && blockMesh > log.blockMesh 2>&1 && setFields > log.setFields 2>&1 \
    && interFoam > log.interFoam 2>&1) || { tail -n 5 column/log.* >&2; exit 1; }

# where the water's share, followed from the wall, first falls below one half
edge() {
    awk '$2 < 0.5 { if (NR == 1) print 0; else print x + ($1 - x) * (s - 0.5) / (s - $2); exit }
        { x = $1; s = $2 }' "$1"
}
{
    echo "t,front,height"
    echo "0,0.6,0.6"
    for time in $(ls column/postProcessing/lines | sort -g); do
        of="column/postProcessing/lines/$time"
        [ "$time" = 0 ] || printf "%s,%.6g,%.6g\n" "$time" "$(edge "$of/bed_alpha.water.xy")" \
            "$(edge "$of/back_alpha.water.xy")"
    done
} > results/front.csv
grep -m 1 '^Build' column/log.interFoam | sed 's/ *: */ /; s/^Build/OpenFOAM/; s/"//g' > version.txt
