#!/bin/bash
# A planar column by Gerris: run.sh FOLDER. ASPECT and LEVEL may be set.
set -euo pipefail
for program in gerris2D gcc m4; do
    if ! command -v $program > /dev/null || [ ! -e /usr/include/gfs.h ]; then
        echo "$program or the headers of gerris are missing: install Debian's packages gerris," \
            "libgfs-dev, gcc and m4" >&2
        exit 3
    fi
done
deck=$(cd "$(dirname "$0")" && pwd)
aspect=${ASPECT:-1}
level=${LEVEL:-5}
case $aspect in # boxes of 1.25 r_0 along the bed and upwards
    1) wide=4 high=1 end=5 ;;
    3) wide=8 high=3 end=9 ;;
    *) echo "ASPECT is $aspect, but must be 1 or 3" >&2; exit 2 ;;
esac
mkdir -p "$1/results"
cd "$1"
rm -f sim-*.txt

boxes() {
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
sed "s/^BOXES LINKS/$((wide * high)) $(((wide - 1) * high + wide * (high - 1)))/; s/LEVEL/$level/
    s/ASPECT/$aspect/; s/VISCOSITY/3./; s/END/$end/" "$deck/column.gfs" > column.gfs
boxes >> column.gfs
gerris2D column.gfs > log 2>&1 || { tail -n 5 log >&2; exit 1; }
gerris2D -V 2>&1 | sed -n 1p > version.txt

cell=$(awk "BEGIN { print 1.25 / 2^$level }")
# Thickness over the bed in metres, r_0 = 0.1 m: sums of the cells' shares of grains.
for file in $(ls sim-*.txt | sort -t - -k 2 -g); do
    time=${file#sim-}
    grep -v '^#' "$file" | sort -g | awk -v cell="$cell" '
        NR > 1 && $1 > x + cell / 2 { printf "%.6g,%.6g\n", 0.1 * x, 0.1 * h; h = 0 }
        { x = $1; h += cell * $4 }
        END { printf "%.6g,%.6g\n", 0.1 * x, 0.1 * h }' > "thickness-${time%.txt}.csv"
done

# the first place where the thickness falls below $2
edge() {
    awk -F , -v least="$2" 'NR > 1 && $2 < least { print x + ($1 - x) * (h - least) / (h - $2); exit }
        { x = $1; h = $2 }' "$1"
}
{
    echo "t,front,front_of_rows,height"
    for file in $(ls thickness-*.csv | sort -t - -k 2 -g); do
        time=${file#thickness-}
        height=$(head -n 1 "$file" | cut -d , -f 2)
        echo "${time%.csv} $(edge "$file" 0.002) $(edge "$file" 0.005) $height"
    done | awk '{ printf "%.6g,%.6g,%.6g,%.6g\n", $1 * sqrt(0.1 / 9.81), $2, $3, $4 }'
} > results/series.csv
{
    echo "x,start,after_1,after_2,after_3,end"
    # times over sqrt(r_0/g)
    paste -d , thickness-0.csv thickness-1.csv thickness-2.csv thickness-3.csv "thickness-$end.csv" \
        | cut -d , -f 1,2,4,6,8,10
} > results/thickness.csv
