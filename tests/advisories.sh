#!/usr/bin/env bash
# Known vulnerabilities of dependencies: `bash tests/advisories.sh PATH_OF_CARGO_DENY`, for every lock file of the repository.
# The database of advisories is not part of the repository, and this fetches none: where a machine has none, it says so in a
# line and ends with 0. `cargo deny fetch db`, once and with a network, puts one into advisory-dbs in Cargo's home.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
deny=${1:?usage: bash tests/advisories.sh PATH_OF_CARGO_DENY}
databases=${CARGO_HOME:-$HOME/.cargo}/advisory-dbs
unchecked() {
    printf 'advisories: not checked, because %s\n' "$1"
    exit 0
}
command -v "$deny" > /dev/null || unchecked "there is no cargo-deny at $deny"
[ -n "$(ls -A "$databases" 2> /dev/null)" ] || unchecked "there is no database in $databases (cargo deny fetch db)"
for manifest in Cargo.toml python/Cargo.toml tests/browser/Cargo.toml; do
    "$deny" --offline --config deny.toml --manifest-path "$manifest" check advisories
done
echo "advisories: checked"
