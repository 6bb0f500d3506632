#!/bin/bash
# The column of column-planar, three times as high as half of it is wide: run.sh FOLDER.
set -euo pipefail
export ASPECT="${ASPECT:-3}" WIDTH="${WIDTH:-24}"
exec bash "$(dirname "$0")/../../column-planar/deck/run.sh" "$1"
