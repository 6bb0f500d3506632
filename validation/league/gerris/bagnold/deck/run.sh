#!/bin/bash
# Layers of grains on an incline by Gerris: run.sh FOLDER. ANGLES and LEVEL may be set; SQUARE=1
# takes as many cells along the slope as over the depth instead of one.
set -euo pipefail
for program in gerris2D gcc m4; do
    if ! command -v $program > /dev/null || [ ! -e /usr/include/gfs.h ]; then
        echo "$program or the headers of gerris are missing: install Debian's packages gerris," \
            "libgfs-dev, gcc and m4" >&2
        exit 3
    fi
done
deck=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$1/results"
cd "$1"
level=${LEVEL:-5}
cells=$((2 ** level))
if [ -n "${SQUARE:-}" ]; then boxes=1; else boxes=$cells level=0; fi
bed="bottom = Boundary { BcDirichlet U 0 BcDirichlet V 0 }"
for angle in ${ANGLES:-22 23 24 25}; do
    mkdir -p "$angle"
    {
        awk -v angle="$angle" -v boxes=$boxes -v level=$level 'BEGIN { radians = angle * atan2(0, -1) / 180 }
            { sub("BOXES", boxes " " 2 * boxes - 1); sub("LEVEL", level); sub("SIZE", 1 / boxes)
              sub("COSINE", cos(radians)); sub("SINE", sin(radians)); print }' "$deck/layer.gfs"
        for ((box = 1; box <= boxes; box++)); do
            [ $box -gt 1 ] && sides="" || sides="$bed"
            [ $box -lt $boxes ] || sides+=" top = BoundaryOutflow"
            echo "GfsBox { $sides }"
        done
        for ((box = 1; box <= boxes; box++)); do
            echo "$box $box right"
            [ $box -eq $boxes ] || echo "$box $((box + 1)) top"
        done
    } > "$angle/layer.gfs"
    (cd "$angle" && gerris2D layer.gfs > log 2>&1) || { tail -n 5 "$angle/log" >&2; exit 1; }
    # the cells at the left end, in SI units: depth 10 mm, bulk density 1500 kg/m3
    grep -v '^#' "$angle/end.txt" | sort -g | awk 'BEGIN { print "y,u,p" } NR == 1 { x = $1 }
        $1 == x { printf "%.6g,%.6g,%.6g\n", 0.01 * $2, sqrt(0.0981) * $4, 147.15 * $5 }' \
        > "results/profile-$angle.csv"
done
gerris2D -V 2>&1 | sed -n 1p > version.txt
