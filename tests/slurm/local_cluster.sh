#!/usr/bin/env bash
# A real Slurm on this one machine, for tests: Debian, as root, systemd not needed.
#
# Run:     local_cluster.sh COMMAND [ARGUMENT...]    sbatch, squeue and scancel work inside COMMAND
# Source:  trap cluster_stop EXIT; cluster_install; cluster_start
#
# A Slurm or munge that the machine already runs is left alone: all files lie in one temporary folder.

set -euo pipefail

# The daemons are in sbin, which a plain user's PATH kept by sudo or su may lack.
PATH=$PATH:/usr/sbin:/sbin

# Logs, state and configuration of the running cluster; empty while there is none.
cluster_folder=
# Folder of further logs that help when something goes wrong.
cluster_logs=

cluster_install() {
    local program missing=no
    for program in sbatch slurmctld slurmd munged; do
        type -P "$program" >/dev/null || missing=yes
    done
    [[ $missing == yes ]] || return 0

    # Without a policy the packages would try to start services: that fails here, or leaves a munged behind.
    local policy=/usr/sbin/policy-rc.d own_policy=no status=0
    if [[ ! -e $policy ]]; then
        printf '#!/bin/sh\nexit 101\n' >"$policy"
        chmod 755 "$policy"
        own_policy=yes
    fi
    export DEBIAN_FRONTEND=noninteractive
    { apt-get update -qq && apt-get install -y -qq --no-install-recommends slurm-wlm munge; } >&2 || status=$?
    [[ $own_policy == no ]] || rm -f "$policy"
    return "$status"
}

cluster_start() {
    [[ $(id -u) == 0 ]] || { echo 'local cluster: only root can start it' >&2; return 1; }
    [[ -z $cluster_folder ]] || { echo 'local cluster: already started' >&2; return 1; }

    # Inside a job of another cluster its variables would steer sbatch and squeue.
    unset "${!SLURM_@}"

    # In /tmp whatever TMPDIR says: a socket's path may have 107 bytes, and munged wants trusted parents.
    cluster_folder=$(mktemp -d /tmp/bagnold-slurm.XXXXXX)
    mkdir "$cluster_folder"/{state,spool,secret}
    # munged refuses a socket that others cannot reach, and a key that others can.
    chmod 711 "$cluster_folder"
    chmod 700 "$cluster_folder/secret"
    export SLURM_CONF=$cluster_folder/slurm.conf
    cluster_configure >"$SLURM_CONF"

    (umask 077; head -c 128 /dev/urandom >"$cluster_folder/secret/key")
    cluster_daemon munged --socket="$cluster_folder/munge.socket" --key-file="$cluster_folder/secret/key" \
        --seed-file="$cluster_folder/secret/seed" --pid-file="$cluster_folder/munged.pid" \
        --log-file="$cluster_folder/munged.log" || return
    cluster_daemon slurmctld -c -f "$SLURM_CONF" || return
    # A slurmd that finds no controller waits long before it asks again.
    cluster_wait "an answer of slurmctld" 60 cluster_answers || return
    cluster_daemon slurmd -c -f "$SLURM_CONF" || return
    cluster_wait "an idle node" 60 cluster_is_idle || return
}

# Meant for a trap: never fails, may be called twice.
cluster_stop() {
    local tries
    [[ -n $cluster_folder ]] || return 0

    # Jobs first, through Slurm, while it runs: they get their SIGTERM, and the time to act on it.
    if timeout 10 scontrol ping >/dev/null 2>&1; then
        timeout 10 scancel --user=root >/dev/null 2>&1 || true
        for ((tries = 0; tries < 100; tries++)); do
            [[ -n $(timeout 10 squeue --noheader 2>/dev/null) ]] || break
            sleep 0.1
        done
    fi
    cluster_kill TERM
    for ((tries = 0; tries < 50; tries++)); do
        [[ -n $(cluster_processes) ]] || break
        sleep 0.1
    done
    cluster_kill KILL
    rm -rf "$cluster_folder" || true
    cluster_folder=
    unset SLURM_CONF
}

# cluster_wait WHAT SECONDS COMMAND...
cluster_wait() {
    local what=$1 end=$((SECONDS + $2))
    shift 2
    until "$@"; do
        ((SECONDS < end)) || { cluster_complain "not in time: $what"; return 1; }
        sleep 0.1
    done
}

# Says what went wrong, and what Slurm and the logs say.
cluster_complain() {
    echo "${0##*/}: $1" >&2
    [[ -n $cluster_folder ]] || return 0
    timeout 10 sinfo --long --Node >&2 || true
    tail -n 20 "$cluster_folder"/*.out "$cluster_folder"/*.log "$cluster_logs"/* >&2 2>/dev/null || true
}

cluster_fail() {
    cluster_complain "$*"
    exit 1
}

# For a script's trap on EXIT: stops the cluster, removes the script's folder and ends with its exit code.
cluster_leave() {
    local status=$?
    cluster_stop
    [[ -z $1 ]] || rm -rf "$1"
    exit "$status"
}

# ---- Only used above

cluster_configure() {
    # `hostname -s` fails where the machine's name does not resolve.
    local name controller_port node_port cores memory
    name=$(uname -n)
    name=${name%%.*}
    cores=$(nproc)
    # Slurm drains a node that turns out to have less memory than it was said to have.
    memory=$(awk '/^MemTotal:/ { print int($2 / 1024 * 0.9) }' /proc/meminfo)
    controller_port=$(cluster_free_port 20000)
    node_port=$(cluster_free_port 25000)

    cat <<CONF
ClusterName=bagnold
SlurmctldHost=$name(127.0.0.1)
SlurmctldPort=$controller_port
SlurmdPort=$node_port
SlurmUser=root
SlurmdUser=root

AuthType=auth/munge
AuthInfo=socket=$cluster_folder/munge.socket
CredType=cred/munge

StateSaveLocation=$cluster_folder/state
SlurmdSpoolDir=$cluster_folder/spool
SlurmctldPidFile=$cluster_folder/slurmctld.pid
SlurmdPidFile=$cluster_folder/slurmd.pid
SlurmctldLogFile=$cluster_folder/slurmctld.log
SlurmdLogFile=$cluster_folder/slurmd.log

# What works without cgroups.
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
MailProg=/bin/true

AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/none

SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
# Else a job that names no memory takes all of it, and jobs run one at a time.
DefMemPerCPU=$((memory / cores))

SchedulerType=sched/backfill
SchedulerParameters=batch_sched_delay=0,sched_interval=1,bf_interval=1
InactiveLimit=0
KillWait=2
JobRequeue=1
ReturnToService=2
# Patient with a busy machine.
MessageTimeout=30
TCPTimeout=10

# config_overrides: what is said here counts, not what slurmd finds in a container.
SlurmdParameters=config_overrides
NodeName=$name NodeAddr=127.0.0.1 CPUs=$cores Boards=1 SocketsPerBoard=1 CoresPerSocket=$cores ThreadsPerCore=1 \\
    RealMemory=$memory State=UNKNOWN
PartitionName=debug Nodes=$name Default=YES MaxTime=INFINITE State=UP
CONF
}

# Below 32768: there the kernel takes ports for others' outgoing connections.
cluster_free_port() {
    local port
    while true; do
        port=$(($1 + RANDOM % 5000))
        (: <"/dev/tcp/127.0.0.1/$port") 2>/dev/null || { echo "$port"; return; }
    done
}

# No descriptor of the caller's may stay with a daemon: a pipe behind the caller would never end.
cluster_daemon() {
    "$@" </dev/null >>"$cluster_folder/$1.out" 2>&1 || { cluster_complain "$1 did not start"; return 1; }
}

cluster_is_idle() {
    [[ $(timeout 10 sinfo --noheader --partition=debug --format=%T 2>/dev/null) == idle ]]
}

cluster_answers() {
    timeout 10 scontrol ping >/dev/null 2>&1
}

# The daemons, the jobs' watchers (slurmstepd) and the jobs' own processes; another Slurm's are not ours to end.
cluster_processes() {
    local comm pid
    grep -lxsE 'munged|slurmctld|slurmscriptd|slurmd|slurmstepd' /proc/[0-9]*/comm | while read -r comm; do
        pid=${comm//[!0-9]/}
        [[ -z $(find "/proc/$pid/fd" -lname "$cluster_folder/*" -print -quit 2>/dev/null) ]] || cluster_family "$pid"
    done | sort -u || true
}

cluster_family() {
    local child
    echo "$1"
    grep -lxsE "PPid:[[:space:]]*$1" /proc/[0-9]*/status | while read -r child; do
        cluster_family "${child//[!0-9]/}"
    done || true
}

cluster_kill() {
    local pid
    for pid in $(cluster_processes); do
        kill -"$1" "$pid" 2>/dev/null || true
    done
}

if [[ ${BASH_SOURCE[0]} == "$0" ]]; then
    [[ $# -gt 0 ]] || { echo "usage: $0 COMMAND [ARGUMENT...]" >&2; exit 2; }
    trap cluster_stop EXIT
    cluster_install
    cluster_start
    "$@"
fi
