#!/usr/bin/env bash
# Does the local cluster do what the tests of the program need? Arrays, throttling, a killed task, a second try.

set -euo pipefail

# shellcheck source=local_cluster.sh
source "$(dirname "${BASH_SOURCE[0]}")/local_cluster.sh"

shared=
trap 'cluster_leave "$shared"' EXIT

running() {
    squeue --noheader --array --job="$1" --states=RUNNING | wc -l
}

throttled() {
    [[ $(squeue --noheader --array --job="$1" --states=PENDING --format=%r) == JobArrayTaskLimit ]]
}

ended() {
    local queue
    queue=$(squeue --noheader --job="$1") && [[ -z $queue ]]
}

# state JOB_INDEX: also of what has ended, for as long as MinJobAge says.
state() {
    squeue --noheader --array --states=all --job="$1" --format=%T
}

files() {
    (cd "$shared" && echo done.*)
}

gone() {
    # A zombie counts as gone: who reaps it is the machine's matter.
    ! grep -qsE '^State:[[:space:]]*[^ZX[:space:]]' "/proc/$1/status"
}

cluster_install
begin=$SECONDS
cluster_start
echo "cluster is up after $((SECONDS - begin)) s: $(sbatch --version), $(sinfo --noheader --format='%P %C')"

shared=$(mktemp -d)
cat >"$shared/task" <<'TASK'
#!/bin/bash
echo "$$" >"pid.$SLURM_ARRAY_TASK_ID"
sleep "${1:-2}"
echo "$SLURM_ARRAY_TASK_ID" >"done.$SLURM_ARRAY_TASK_ID"
TASK
submit=(sbatch --parsable --chdir="$shared" --output=log.%a)

job=$("${submit[@]}" --array=1-6%2 "$shared/task")
most=0
killed=no
until ended "$job"; do
    now=$(running "$job")
    ((now <= most)) || most=$now
    if [[ $killed == no && -s $shared/pid.3 ]]; then
        kill -9 "$(<"$shared/pid.3")"
        killed=yes
    fi
    ((SECONDS < begin + 120)) || cluster_fail 'the array did not end'
    sleep 0.1
done
expected=$(($(nproc) < 2 ? 1 : 2))
((most == expected)) || cluster_fail "$most tasks ran at once instead of $expected"
[[ $(files) == 'done.1 done.2 done.4 done.5 done.6' ]] || cluster_fail "after the kill there are: $(files)"
[[ $(state "${job}_3") == FAILED ]] || cluster_fail "the killed task is $(state "${job}_3")"
[[ $(state "${job}_4") == COMPLETED ]] || cluster_fail "another task is $(state "${job}_4")"

again=$("${submit[@]}" --array=3 "$shared/task")
cluster_wait 'the second try' 60 ended "$again"
[[ $(files) == 'done.1 done.2 done.3 done.4 done.5 done.6' ]] || cluster_fail "after the second try there are: $(files)"

rm "$shared"/pid.*
doomed=$("${submit[@]}" --array=7-8%1 "$shared/task" 60)
cluster_wait 'the start of a task to cancel' 60 test -s "$shared/pid.7"
# A machine of two cores would run no more than two anyway: only this shows that it is the throttle that holds.
cluster_wait 'the throttle as the reason to wait' 30 throttled "$doomed"
scancel "$doomed"
cluster_wait 'the end of a cancelled array' 60 ended "$doomed"
cluster_wait 'the end of its process' 10 gone "$(<"$shared/pid.7")"
[[ $(state "${doomed}_7") == CANCELLED && $(state "${doomed}_8") == CANCELLED ]] || cluster_fail 'scancel left another state'
[[ ! -e $shared/pid.8 ]] || cluster_fail 'a task started after scancel'

# Stopped with a job running: that too must leave nothing.
rm "$shared"/pid.*
"${submit[@]}" --array=9 "$shared/task" 60 >/dev/null
cluster_wait 'the start of the last task' 60 test -s "$shared/pid.9"
folder=$cluster_folder
processes=$(cluster_processes)
[[ $(wc -w <<<"$processes") -ge 5 ]] || cluster_fail "the cluster's processes were not found: $processes"
cluster_stop
[[ ! -e $folder ]] || cluster_fail "$folder was left"
for process in $processes; do
    gone "$process" || cluster_fail "process $process was left: $(tr '\0' ' ' <"/proc/$process/cmdline")"
done

echo "try.sh: all well after $((SECONDS - begin)) s"
