#!/bin/bash
# Planar columns of aspect ratio 1 and 3 by Gerris: run.sh FOLDER
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

# boxes WIDE HIGH: walls, openings and links of the boxes
boxes() {
    local wide=$1 high=$2 row column sides box
    for ((row = 0; row < high; row++)); do
        for ((column = 0; column < wide; column++)); do
            sides=""
            [ $column -gt 0 ] || sides+=" left = Boundary { BcDirichlet U 0 }"
            [ $column -lt $((wide - 1)) ] || sides+=" right = BoundaryOutflow"
            [ $row -gt 0 ] || sides+=" bottom = Boundary { BcDirichlet U 0 BcDirichlet V 0 }"
            [ $row -lt $((high - 1)) ] || sides+=" top = BoundaryOutflow"
            echo "GfsBox {$sides }"
        done
    done
    for ((box = 1; box <= wide * high; box++)); do
        [ $((box % wide)) -eq 0 ] || echo "$box $((box + 1)) right"
        [ $((box + wide)) -gt $((wide * high)) ] || echo "$box $((box + wide)) top"
    done
}

# profile FILE CELL: thickness over the bed in metres, r_0 = 0.1 m, from the cells' shares of grains
profile() {
    grep -v '^#' "$1" | sort -g | awk -v cell="$2" '
        NR > 1 && $1 > x + cell / 2 { printf "%.6g,%.6g\n", 0.1 * x, 0.1 * h; h = 0 }
        { x = $1; h += cell * $4 }
        END { printf "%.6g,%.6g\n", 0.1 * x, 0.1 * h }'
}

# edge FILE THICKNESS: the first place where the profile is thinner
edge() {
    awk -F , -v least="$2" '
        NR > 1 && $2 < least && !found { print x + ($1 - x) * (h - least) / (h - $2); found = 1 }
        { x = $1; h = $2 }' "$1"
}

# column ASPECT LEVEL WIDE HIGH [NAME]: 2^LEVEL cells over a box of 1.25 r_0, for about 5 sqrt(h_0/g)
column() {
    local aspect=$1 wide=$3 high=$4 name=${5:-} cell end step file time times
    rm -rf "$aspect"
    mkdir "$aspect"
    cell=$(awk "BEGIN { print 1.25 / 2^$2 }")
    end=$(awk "BEGIN { print 5 * sqrt($aspect) }")
    step=$(awk "BEGIN { print sqrt($aspect) / 4 }")
    sed "s/^BOXES LINKS/$((wide * high)) $(((wide - 1) * high + wide * (high - 1)))/; s/LEVEL/$2/
        s/ASPECT/$aspect/; s/VISCOSITY/3./; s/END/$end/; s/STEP/$step/" "$deck/column.gfs" > "$aspect/column.gfs"
    boxes "$wide" "$high" >> "$aspect/column.gfs"
    (cd "$aspect" && gerris2D column.gfs > log 2>&1) || { tail -n 5 "$aspect/log" >&2; exit 1; }
    echo "t,front,front_of_rows,height" > "results/series$name.csv"
    for file in $(ls "$aspect"/sim-*.txt | sort -V); do
        time=$(basename "${file#*sim-}" .txt)
        profile "$file" "$cell" > "$aspect/thickness-$time.csv"
        awk -v time="$time" -v front="$(edge "$aspect/thickness-$time.csv" 0.002)" \
            -v rows="$(edge "$aspect/thickness-$time.csv" 0.005)" -F , 'NR == 1 {
            printf "%.6g,%.6g,%.6g,%.6g\n", time * sqrt(0.1 / 9.81), front, rows, $2 }' \
            "$aspect/thickness-$time.csv"
    done | sort -g >> "results/series$name.csv"
    # at 0, 1, 2 and 3 sqrt(h_0/g) and the last, of pictures every quarter of it
    mapfile -t times < <(ls "$aspect" | sed -n 's/^thickness-\(.*\)\.csv$/\1/p' | sort -g)
    {
        echo "x,start,after_1,after_2,after_3,end"
        paste -d , "$aspect/thickness-${times[0]}.csv" "$aspect/thickness-${times[4]}.csv" \
            "$aspect/thickness-${times[8]}.csv" "$aspect/thickness-${times[12]}.csv" \
            "$aspect/thickness-${times[-1]}.csv" | cut -d , -f 1,2,4,6,8,10
    } > "results/thickness$name.csv"
}

column 1 5 4 1
column 3 4 8 3 -3
gerris2D -V 2>&1 | sed -n 1p > version.txt
