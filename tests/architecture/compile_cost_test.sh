#!/usr/bin/env bash
# What a user's compiler pays: compile_cost_test.sh COMPILER NM SOURCE_FOLDER OBJECT ...
#
# The umbrella of each room may read as many headers of the library and of Eigen as compile_cost.txt
# says, and no object of the program may hold a decomposition of Eigen in double: these cost up to 15 s
# each to instantiate and stand in lib/. A limit is raised on purpose, in the change that needs it.
set -euo pipefail
compiler=$1 nm=$2 source=$3
shift 3
failures=0
complain() {
  printf '%s\n' "$*"
  failures=$((failures + 1))
}

# Paths of all headers that a header reads.
headers_of() {
  "$compiler" -std=c++17 -I "$source/include" -isystem /usr/include/eigen3 -M -x c++ \
    "$source/include/holdfast/$1.hpp" | tr ' \\' '\n\n'
}

rooms=0
while read -r room most_own most_eigen; do
  rooms=$((rooms + 1))
  read=$(headers_of "$room")
  own=$(grep -c '/holdfast/' <<<"$read" || true)
  eigen=$(grep -c '/eigen3/' <<<"$read" || true)
  [ "$own" -le "$most_own" ] || complain "$room.hpp reads $own headers of the library; $most_own are allowed"
  [ "$eigen" -le "$most_eigen" ] || complain "$room.hpp reads $eigen headers of Eigen; $most_eigen are allowed"
done < <(grep -v '^#' "$(dirname "$0")/compile_cost.txt")

for room in "$source"/include/holdfast/*.hpp; do
  grep -q "^$(basename "$room" .hpp) " "$(dirname "$0")/compile_cost.txt" ||
    complain "compile_cost.txt has no line for $(basename "$room")"
done

heavy='Eigen::(RealSchur|ComplexSchur|HessenbergDecomposition|EigenSolver|RealQZ|JacobiSVD|BDCSVD|FullPivLU|CompleteOrthogonalDecomposition)<'
for object in "$@"; do
  found=$("$nm" --defined-only -C "$object" | grep -oE "$heavy[^>]*>" | grep -v 'long double' | sort -u | head -3 | tr '\n' ' ' || true)
  [ -z "$found" ] || complain "$(basename "$object") instantiates $found"
done

# Who includes everything and uses nothing instantiates none of them: what asks for them in a header
# is a template.
unused=$(mktemp --suffix=.o)
trap 'rm -f "$unused"' EXIT
"$compiler" -std=c++17 -O0 -fkeep-inline-functions -I "$source/include" -isystem /usr/include/eigen3 \
  -x c++ -c - -o "$unused" <<<'#include "holdfast/holdfast.hpp"'
found=$("$nm" --defined-only -C "$unused" | grep -oE "$heavy[^>]*>" | sort -u | head -3 | tr '\n' ' ' || true)
[ -z "$found" ] || complain "the umbrella header alone instantiates $found"

printf '%d rooms, %d objects, %d failures\n' "$rooms" "$#" "$failures"
[ "$rooms" -gt 10 ] && [ "$failures" -eq 0 ]
