#!/usr/bin/env bash
# The same sweep by both engines: `tests/slurm/sweep.sh [PROGRAM]`. One task is killed on the way; the tables must be equal.

set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
# shellcheck source=local_cluster.sh
source "$root/tests/slurm/local_cluster.sh"

program=$(realpath "${1:-$root/target/debug/bagnold}")
[[ -x $program ]] || { echo "sweep.sh: $program does not exist; cargo build --bin bagnold" >&2; exit 1; }

work=
trap 'cluster_leave "$work"' EXIT

work=$(mktemp -d)
cd "$work"
cluster_logs=$work/slurm-sweep/slurm/logs
cat >sweep.toml <<'PLAN'
design = "grid"

[[cases]]
case = "film"
with = { resolution = 10 }

[[parameters]]
path = "material.viscosity"
lower = 0.5
upper = 2.0
levels = 6
scale = "log"

[[parameters]]
path = "slope_angle"
values = [15.0, 20.0, 25.0, 30.0]
PLAN

# Stores of their own: nothing may come from the other engine's runs.
"$program" --quiet sweep sweep.toml --out local-sweep --store local-store
records=(local-sweep/runs/*/record.postcard)
((${#records[@]} == 24)) || cluster_fail "${#records[@]} of 24 runs have a record"

cluster_install
cluster_start
# The first task waits for a file before it starts bagnold, so that it is surely alive when it is killed.
"$program" sweep template |
    sed "s|^exec|echo \$\$ >'$work/task.'\$SLURM_ARRAY_TASK_ID; while [ \$SLURM_ARRAY_TASK_ID = 3 ] \&\& [ -e '$work/hold' ]; do sleep 0.1; done\nexec|" >held.sh
touch hold
"$program" sweep sweep.toml --out slurm-sweep --store slurm-store --engine slurm --throttle 2 --time 00:10:00 \
    --memory 500M --template held.sh

cluster_wait 'start of task 3' 60 test -s task.3
kill -9 "$(cat task.3)"
rm hold
ended() {
    [[ -z $(squeue --noheader --me) ]]
}
cluster_wait 'end of the first jobs' 300 ended

status=0
"$program" --quiet sweep collect slurm-sweep || status=$?
((status == 1)) || cluster_fail "exit code $status with a task that was killed, expected 1"
[[ ! -e slurm-sweep/runs/0003-film/record.postcard ]] || cluster_fail 'the killed task left a record'
cmp -s local-sweep/results.csv slurm-sweep/results.csv && cluster_fail 'the tables are equal although a run is missing'

"$program" sweep collect slurm-sweep --resubmit --time 00:10:00 --memory 500M || true
cluster_wait 'end of the second job' 120 ended
"$program" --quiet sweep collect slurm-sweep
cmp local-sweep/results.csv slurm-sweep/results.csv || cluster_fail 'the engines give different tables'
echo "both engines give the same $(wc -l <slurm-sweep/results.csv) lines; task 3 was killed and recovered"
