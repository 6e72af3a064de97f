#!/usr/bin/env bash
# The choice among the methods for a photon of a shell against the best method in hindsight, by counted
# instructions: median and worst ratio, and the worst ten scenes.
#
#   benches/choice.sh [SCENES [SEED [MOST_DIGITS [TRIED]]]]     needs valgrind; about 4 scenes a second
#
# TRIED methods, the cheapest by their estimates, are tried in each scene: 3, or 11 for all.
set -euo pipefail
scenes=${1:-200} seed=${2:-1} digits=${3:-10000} tried=${4:-3}
command -v valgrind >/dev/null || { echo "valgrind is missing: apt-get install valgrind" >&2; exit 1; }
cd "$(dirname "$0")/.."
program=$(cargo bench --locked --bench choice --no-run 2>&1 | sed -n 's/.*(\(.*choice-[0-9a-f]*\)).*/\1/p')
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# In parts: every call leaves a file.
for ((done = 0; done < scenes; done += 100)); do
    part=$((scenes - done < 100 ? scenes - done : 100))
    valgrind --tool=callgrind --toggle-collect='*measured*' --dump-after=choice::measured \
        --callgrind-out-file="$folder/out" "$program" "$part" "$((seed + done))" "$digits" "$tried" \
        >"$folder/calls" 2>"$folder/log"
    i=0
    while read -r line; do
        i=$((i + 1))
        echo "$seed.$done.$line $(sed -n 's/^\(totals\|summary\): //p' "$folder/out.$i" | head -1)"
    done <"$folder/calls" >>"$folder/all"
    rm -f "$folder"/out.*
done
awk '
    $5 == "choice" { choice[$1] = $7; scene[$1] = $2 " digits, " $3 ", k = " $4; next }
    $6 == "true" && (!($1 in best) || $7 < best[$1]) { best[$1] = $7; name[$1] = $5 }
    END { for (s in best) printf "%.3f  %s: %d, best %s %d\n", choice[s] / best[s], scene[s], choice[s], name[s], best[s] }
' "$folder/all" | sort -n >"$folder/ratios"
count=$(wc -l <"$folder/ratios")
echo "$count scenes; choice over best in hindsight, instructions:"
echo "median $(sed -n "$(((count + 1) / 2))p" "$folder/ratios" | cut -d' ' -f1)   worst $(tail -1 "$folder/ratios" | cut -d' ' -f1)"
tail -10 "$folder/ratios"
