#!/bin/bash
# The column of column-planar, three times as high as half of it is wide: run.sh FOLDER. The tables are
# those of a similar column of 48 mm, as wide as that of the other discs: lengths times 0.48, times by
# its root, since no length but the diameter enters.
set -euo pipefail
export ASPECT="${ASPECT:-3}" WIDTH="${WIDTH:-24}"
bash "$(dirname "$0")/../../column-planar/deck/run.sh" "$1"
for table in "$1"/results/*.csv; do
    awk -F, -v OFS=, 'NR == 1 { for (k = 1; k <= NF; k++) f[k] = $k == "t" ? sqrt(0.48) : 0.48 }
        NR > 1 { for (k = 1; k <= NF; k++) $k = sprintf("%.6g", f[k] * $k) } { print }' \
        "$table" > "$table.similar"
    mv "$table.similar" "$table"
done
