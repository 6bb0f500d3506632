#!/bin/bash
# Run a deck, keep its results and write made.toml: record.sh CODE/CASE [FOLDER], from any folder.
set -euo pipefail
cell=$(cd "$(dirname "$0")" && pwd)/$1
folder=${2:-$(mktemp -d)}
digest() { (cd "$1" && find -L . -type f | LC_ALL=C sort | xargs cat | sha256sum | cut -d ' ' -f 1); }

bash "$cell/deck/run.sh" "$folder"
times > "$folder/times.txt" # the second line is that of the children: user and system time
cpu=$(awk 'NR == 2 { split($1 $2, t, /[ms]/); print 60 * (t[1] + t[3]) + t[2] + t[4] }' \
    "$folder/times.txt")
rm -rf "$cell/results"
cp -r "$folder/results" "$cell/results"
cat > "$cell/made.toml" << EOF
code = "${1%%/*}"
version = "$(cat "$folder/version.txt")"
date = "$(date +%F)"
processor = "$(sed -n '/^model name/ { s/.*: //p; q }' /proc/cpuinfo)"
cpu_seconds = $cpu
command = "bash deck/run.sh FOLDER"
deck_sha256 = "$(digest "$cell/deck")"
results_sha256 = "$(digest "$cell/results")"
EOF
