#!/bin/bash
# Run decks again and compare their tables with the stored ones: again.sh [CODE/CASE...].
# Without a cell all decks run whose code is installed. Grains, particles and material points may
# differ by 3 % of the largest value of a column, meshes by 0.1 %.
set -uo pipefail
league=$(cd "$(dirname "$0")" && pwd)
cells=("$@")
if [ $# -eq 0 ]; then
    for deck in "$league"/*/*/deck/run.sh; do
        cell=${deck#"$league"/}
        cells+=("${cell%/deck/run.sh}")
    done
fi
differ=0
for cell in "${cells[@]}"; do
    if [ ! -f "$league/$cell/deck/run.sh" ]; then
        echo "$cell: no deck here; name a cell as CODE/CASE, such as openfoam/film"
        differ=1
        continue
    fi
    folder=$(mktemp -d)
    bash "$league/$cell/deck/run.sh" "$folder" > "$folder/output" 2>&1
    code=$?
    case $code in
        0) ;;
        3) echo "$cell: not installed: $(tail -n 1 "$folder/output")"; continue ;;
        *) echo "$cell: ended with $code: $(tail -n 1 "$folder/output")"; differ=1; continue ;;
    esac
    case $cell in
        lammps/* | yade/* | mpm/* | newton/* | dualsphysics/*) tolerance=0.03 ;;
        *) tolerance=0.001 ;;
    esac
    python3 - "$league/$cell/results" "$folder/results" "$tolerance" "$cell" << 'END' || differ=1
import csv, os, sys

stored, again, tolerance, cell = sys.argv[1], sys.argv[2], float(sys.argv[3]), sys.argv[4]
worst, columns = (0.0, ""), 0
for name in sorted(os.listdir(stored)):
    rows = [list(csv.reader(open(os.path.join(folder, name)))) for folder in (stored, again)]
    # a deposit of grains may end a few bins earlier or later
    lengths = [len(table) for table in rows]
    if max(lengths) - min(lengths) > 2 * tolerance * max(lengths):
        sys.exit(f"{cell}: differs: {name} has {lengths[1]} rows, stored are {lengths[0]}")
    for column, head in enumerate(rows[0][0]):
        try:
            values = [[float(row[column]) for row in table[1:]] for table in rows]
        except ValueError:
            continue
        size = max(map(abs, values[0])) or 1.0
        # a value that is not a number differs
        off = max(abs(a - b) / size if abs(a - b) >= 0.0 else float("inf") for a, b in zip(*values))
        worst, columns = max(worst, (off, f" ({name} {head})")), columns + 1
if columns == 0:
    sys.exit(f"{cell}: no stored column to compare with")
verdict = "as stored" if worst[0] <= tolerance else "differs"
print(f"{cell}: {verdict}: largest difference of {columns} columns {100 * worst[0]:.3g} %"
      f"{worst[1] if worst[0] > 0.0 else ''}, allowed {100 * tolerance:.3g} %")
sys.exit(worst[0] > tolerance)
END
done
exit $differ
