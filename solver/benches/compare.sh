#!/usr/bin/env bash
# Compares what a step costs in two versions of the solver: `bash solver/benches/compare.sh COMMIT COMMIT [CASE…]`.
#
# Both are built in worktrees of their own under target/compare, with the bench `cost` of this tree, and run in turns, so that
# what else the machine does meets both alike: ROUNDS rounds (5), of which the median counts. A table is printed: for each case
# the CPU time of a step without a search, of a search, and of the mean step, searches included, per particle, and memory; the
# values of the second commit, then their ratios to the first. `.` stands for the tree as it is, with what is not committed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
[ $# -ge 2 ] || { sed -n '2,8s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2; exit 2; }
commits=("$1" "$2")
shift 2
cases=("$@")
((${#cases[@]})) || cases=(plain-50k mui20-50k mui28-50k mui28-5k space-100k)
folder="$PWD/target/compare"
mkdir -p "$folder"

build() {
    local commit=$1 tree
    if [ "$commit" = . ]; then
        tree=$PWD
    else
        commit=$(git rev-parse --short=12 "$commit^{commit}")
        tree="$folder/$commit"
        [ -d "$tree" ] || git worktree add --quiet --detach "$tree" "$commit" >&2
        # the same measure for both
        cp -r solver/benches "$tree/solver/"
        cp Cargo.lock "$tree/"
    fi
    (cd "$tree" && CARGO_TARGET_DIR="$folder/target-$commit" cargo bench --quiet -p bagnold-benches --bench cost --no-run \
        --message-format=json | sed -n '/"name":"cost"/s/.*"executable":"\([^"]*\)".*/\1/p' | tail -n 1)
}

first=$(build "${commits[0]}")
second=$(build "${commits[1]}")
rows="$folder/rows.csv"
: >"$rows"
for case in "${cases[@]}"; do
    for ((round = 0; round < ${ROUNDS:-5}; round++)); do
        # each in a process of its own, so that memory is that of the case
        echo "first,$("$first" "$case" | tail -n 1)" >>"$rows"
        echo "second,$("$second" "$case" | tail -n 1)" >>"$rows"
    done
done

echo "# $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1), load $(cut -d ' ' -f 1-3 /proc/loadavg)"
echo "# ${commits[1]} against ${commits[0]}, medians of ${ROUNDS:-5}"
echo "case,threads,particles,step_ns,search_ns,mean_ns,mean_wall_ns,memory_B,step_ratio,search_ratio,mean_ratio,memory_ratio"
awk -F, '
    function median(version, name, column,    n, i, j, value, sorted) {
        n = count[version, name]
        for (i = 1; i <= n; i++) {
            value = values[version, name, column, i]
            for (j = i; j > 1 && sorted[j - 1] > value; j--) sorted[j] = sorted[j - 1]
            sorted[j] = value
        }
        return sorted[int((n + 1) / 2)]
    }
    {
        if (!($2 in seen)) { seen[$2] = 1; names[++total] = $2 }
        i = ++count[$1, $2]
        for (column = 3; column <= NF; column++) values[$1, $2, column, i] = $column + 0
    }
    END {
        for (k = 1; k <= total; k++) {
            name = names[k]
            printf "%s,%d,%d", name, median("second", name, 3), median("second", name, 4)
            split("5 7 8 9 11", columns, " ")
            for (c = 1; c <= 5; c++) printf ",%.0f", median("second", name, columns[c])
            split("5 7 8 11", columns, " ")
            for (c = 1; c <= 4; c++) printf ",%.3f", median("second", name, columns[c]) / median("first", name, columns[c])
            print ""
        }
    }' "$rows"
