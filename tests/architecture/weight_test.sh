#!/usr/bin/env bash
# What the house weighs: weight_test.sh SOURCE_FOLDER [BUDGETS]
#
# weight.txt has the most lines of C++ that each room may have, and what the whole may. The whole only falls: a room may
# take what others have given up in the same change, and where one is 5 % below its own its budget comes down.
set -euo pipefail
source=$1 budgets=${2:-$(dirname "$0")/weight.txt}
failures=0
complain() {
  printf '%s\n' "$*"
  failures=$((failures + 1))
}

# Lines of C++ under some folders; those neither blank nor a comment with "code".
lines() {
  local kind=$1
  shift
  (cd "$source" && find "$@" \( -name '*.hpp' -o -name '*.cpp' \) -print0 | xargs -0 cat) |
    if [ "$kind" = code ]; then grep -cvE '^[[:space:]]*($|//)'; else wc -l; fi
}

total=0
while read -r kind budget folders; do
  read -ra all <<<"$folders"
  for folder in "${all[@]}"; do [ -d "$source/$folder" ] || complain "weight.txt: there is no $folder"; done
  count=$(lines "$kind" "${all[@]}")
  total=$((total + 1))
  [ "$count" -le "$budget" ] || complain "$folders: $count lines ($kind); the budget is $budget"
  [ $((count * 100)) -ge $((budget * 95)) ] ||
    complain "$folders: $count lines ($kind) are well below the budget of $budget: it comes down to $count"
done < <(grep -vE '^(#|$)' "$budgets")

# No room without one.
for folder in "$source"/include/holdfast/*/ "$source"/src/*/; do
  room=${folder#"$source"/}
  grep -qE " ${room%/}( |$)" "$budgets" || complain "weight.txt has no budget for ${room%/}"
done

printf '%d budgets, %d failures\n' "$total" "$failures"
[ "$total" -gt 30 ] && [ "$failures" -eq 0 ]
