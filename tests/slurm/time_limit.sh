#!/usr/bin/env bash
# A task that hits its time limit resumes when it is submitted again: `tests/slurm/time_limit.sh [PROGRAM [ROWS]]`. The run of
# so many rows must take longer than the half minute after which Slurm looks at limits; its task sleeps before it.

set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
program=$(realpath "${1:-$root/target/debug/bagnold}")
rows=${2:-120}
work=$(mktemp -d)
# shellcheck source=local_cluster.sh
source "$root/tests/slurm/local_cluster.sh"
trap 'cluster_stop "$work"' EXIT
cd "$work"
cat >sweep.toml <<PLAN
design = "grid"

[[cases]]
case = "film"
with = { resolution = $rows, relaxation_times = 1.5 }

[[vary]]
path = "material.viscosity"
values = [1.0]
PLAN

cluster_start
"$program" sweep template | sed "s|^exec|[ ! -e '$work/late' ] \|\| sleep 55\nexec|" >late.sh
touch late
"$program" sweep sweep.toml --out slurm-sweep --store slurm-store --engine slurm --time 00:01:00 --memory 500M --template late.sh
cluster_wait 'the time limit' 600 cluster_is_empty
status=0
"$program" --quiet sweep collect slurm-sweep || status=$?
((status == 1)) || cluster_fail "exit code $status of a sweep whose task hit its limit, expected 1"
checkpoints=(slurm-store/*/unfinished/*/*.checkpoint)
[[ -e ${checkpoints[0]} ]] || cluster_fail 'the limit left no checkpoint'
grep -rq 'interrupted by SIGTERM' slurm-sweep/slurm/logs || cluster_fail 'the task did not say that it was interrupted'

rm late
"$program" sweep collect slurm-sweep --resubmit --time 00:30:00 --memory 500M || true
cluster_wait 'end of the second job' 1800 cluster_is_empty
"$program" --quiet sweep collect slurm-sweep
"$program" --quiet sweep sweep.toml --out local-sweep --store local-store
cmp local-sweep/results.csv slurm-sweep/results.csv || cluster_fail 'the run that was continued gives another table'
echo "a task that hit its time limit went on and gave the same $(wc -l <slurm-sweep/results.csv) lines"
