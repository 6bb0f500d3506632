#!/usr/bin/env bash
# A real Slurm on this machine, for the tests beside this file, which source it: Debian, as root, systemd not needed. Slurm is
# installed if it is missing. All files lie in one temporary folder: a Slurm or munge that the machine already runs is left alone.

set -euo pipefail

# The daemons are in sbin, which the PATH of a plain user may lack.
PATH=$PATH:/usr/sbin:/sbin

# In /tmp whatever TMPDIR says: a socket's path may have 107 bytes, and munged wants trusted parents.
cluster=$(mktemp -d /tmp/bagnold-slurm.XXXXXX)
daemons=()

cluster_start() {
    [[ $(id -u) == 0 ]] || cluster_fail 'only root can start a Slurm'
    type -P sbatch slurmctld slurmd munged >/dev/null || cluster_install

    # Inside a job of another cluster its variables would steer sbatch and squeue.
    unset "${!SLURM_@}"
    export SLURM_CONF=$cluster/slurm.conf
    cluster_configuration >"$SLURM_CONF"
    # munged refuses a socket that others cannot reach, and a key that others can.
    chmod 711 "$cluster"
    mkdir "$cluster"/{state,spool}
    (umask 077; mkdir "$cluster/secret"; head -c 128 /dev/urandom >"$cluster/secret/key")
    cluster_daemon munged --foreground --socket="$cluster/munge.socket" --key-file="$cluster/secret/key" \
        --seed-file="$cluster/secret/seed" --pid-file="$cluster/secret/pid"
    cluster_daemon slurmctld -D -c
    # A slurmd that finds no controller waits long before it asks again.
    cluster_wait 'an answer of slurmctld' 60 scontrol ping
    cluster_daemon slurmd -D -c
    cluster_wait 'an idle node' 60 eval '[[ $(sinfo --noheader --format=%T) == idle ]]'
}

cluster_install() {
    # Without a policy the packages would start services.
    local policy=/usr/sbin/policy-rc.d
    [[ -e $policy ]] || { printf '#!/bin/sh\nexit 101\n' >"$policy"; chmod 755 "$policy"; trap "rm -f $policy" RETURN; }
    apt-get update -qq >&2
    DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends slurm-wlm munge >&2
}

# For a trap on EXIT: ends the jobs, which get their SIGTERM, and the daemons, and keeps the exit code.
cluster_stop() {
    local status=$?
    if ((${#daemons[@]} > 0)); then
        timeout 10 scancel --user=root || true
        cluster_wait 'the end of the jobs' 20 cluster_is_empty || true
        kill "${daemons[@]}" || true
        wait
    fi
    rm -rf "$cluster" "$@"
    exit "$status"
}

cluster_is_empty() {
    local queue
    queue=$(squeue --noheader --me) && [[ -z $queue ]]
}

# cluster_wait WHAT SECONDS COMMAND...
cluster_wait() {
    local end=$((SECONDS + $2))
    until "${@:3}" >/dev/null 2>&1; do
        ((SECONDS < end)) || cluster_fail "not in time: $1"
        sleep 0.1
    done
}

# Says what went wrong, and what Slurm and the logs say.
cluster_fail() {
    echo "${0##*/}: $1" >&2
    timeout 10 sinfo --long --Node >&2 || true
    tail -n 20 "$cluster"/*.log slurm-sweep/slurm/logs/* >&2 2>/dev/null || true
    exit 1
}

# ---- Only used above

cluster_daemon() {
    "$@" </dev/null >"$cluster/$1.log" 2>&1 &
    daemons+=($!)
}

cluster_configuration() {
    local name cores memory port
    # `hostname -s` fails where the machine's name does not resolve.
    name=$(uname -n)
    name=${name%%.*}
    cores=$(nproc)
    # Slurm drains a node that turns out to have less memory than it was said to have.
    memory=$(awk '/^MemTotal:/ { print int($2 / 1024 * 0.9) }' /proc/meminfo)
    # Below 32768: there the kernel takes ports for others' outgoing connections.
    port=$((20000 + RANDOM % 10000))
    cat <<CONF
ClusterName=bagnold
SlurmctldHost=$name(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
SlurmUser=root
AuthInfo=socket=$cluster/munge.socket
StateSaveLocation=$cluster/state
SlurmdSpoolDir=$cluster/spool
SlurmctldPidFile=$cluster/slurmctld.pid
SlurmdPidFile=$cluster/slurmd.pid
MailProg=/bin/true

# What works without cgroups and in a container: what is said here counts, not what slurmd finds.
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SlurmdParameters=config_overrides

# A job that names no memory would take all of it.
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
DefMemPerCPU=$((memory / cores))

# Quick to schedule, patient with a busy machine.
SchedulerParameters=batch_sched_delay=0,sched_interval=1,bf_interval=1
KillWait=2
ReturnToService=2
MessageTimeout=30

NodeName=$name NodeAddr=127.0.0.1 CPUs=$cores RealMemory=$memory State=UNKNOWN
PartitionName=debug Nodes=$name Default=YES State=UP
CONF
}
