#!/usr/bin/env bash
# The same sweep by both engines: `tests/slurm/sweep.sh [PROGRAM]`. One task is killed on the way; the tables must be equal.

set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
program=$(realpath "${1:-$root/target/debug/bagnold}")
work=$(mktemp -d)
# shellcheck source=local_cluster.sh
source "$root/tests/slurm/local_cluster.sh"
trap 'cluster_stop "$work"' EXIT
cd "$work"
cat >sweep.toml <<'PLAN'
design = "grid"

[[cases]]
case = "film"
with = { resolution = 10 }

[[vary]]
path = "material.viscosity"
lower = 0.5
upper = 2.0
levels = 6
scale = "log"

[[vary]]
path = "slope_angle"
values = [15.0, 20.0, 25.0, 30.0]
PLAN

# Stores of their own: nothing may come from the other engine's runs.
"$program" --quiet sweep sweep.toml --out local-sweep --store local-store
records=(local-sweep/runs/*/record.postcard)
((${#records[@]} == 24)) || cluster_fail "${#records[@]} of 24 runs have a record"

cluster_start
slurm=(--engine slurm --store slurm-store --memory 500M --throttle 2)
status=0
"$program" --quiet sweep sweep.toml --out refused "${slurm[@]}" --time 00:10:00:90:1 2>refusal || status=$?
[[ $status == 2 && ! -e refused ]] && grep -q 'Invalid --time' refusal || cluster_fail "exit code $status of a wrong time, and: $(<refusal)"

# The third task waits for a file before it starts bagnold, so that it is surely alive when it is killed.
"$program" sweep template |
    sed "s|^exec|echo \$\$ >'$work/task.'\$SLURM_ARRAY_TASK_ID; while [ \$SLURM_ARRAY_TASK_ID = 3 ] \&\& [ -e '$work/hold' ]; do sleep 0.1; done\nexec|" >held.sh
touch hold
"$program" sweep sweep.toml --out slurm-sweep "${slurm[@]}" --time 00:10:00 --template held.sh

cluster_wait 'start of task 3' 60 test -s task.3
# A machine of two cores would run no more than two anyway: this shows that it is the throttle that holds.
cluster_wait 'the throttle as the reason to wait' 60 eval 'squeue --noheader --states=PENDING --format=%r | grep JobArrayTaskLimit'
kill -9 "$(<task.3)"
rm hold
cluster_wait 'end of the first jobs' 300 cluster_is_empty

status=0
"$program" --quiet sweep collect slurm-sweep || status=$?
((status == 1)) || cluster_fail "exit code $status with a task that was killed, expected 1"
[[ ! -e slurm-sweep/runs/0003-film/record.postcard ]] || cluster_fail 'the killed task left a record'
cmp -s local-sweep/results.csv slurm-sweep/results.csv && cluster_fail 'the tables are equal although a run is missing'

"$program" sweep collect slurm-sweep --resubmit >said || true
grep -q '^submitted 1 runs as Slurm job' said || cluster_fail "the second submission says: $(<said)"
cluster_wait 'end of the second job' 120 cluster_is_empty
"$program" --quiet sweep collect slurm-sweep
cmp local-sweep/results.csv slurm-sweep/results.csv || cluster_fail 'the engines give different tables'
echo "both engines give the same $(wc -l <slurm-sweep/results.csv) lines; task 3 was killed and recovered"
