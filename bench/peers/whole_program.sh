#!/usr/bin/env bash
# The whole program against an Octave script that makes the same chart; see --help.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

usage() {
  cat <<'TEXT'
Usage: whole_program.sh PROGRAM [ROWS [ROUNDS [RUNS]]]

Times a chart of 1000 x 1000 gains from the start of the process to the closed file, by the program
at the path PROGRAM and by Octave, and compares what they found.

  ROWS    rows (values of P) that Octave computes; its time is scaled to 1000 (default 1000: all)
  ROUNDS  how often each takes its turn (default 1)
  RUNS    runs of the program in its turn; the median of all counts (default 11)
TEXT
}

case ${1-} in
  -h | --help) usage && exit 0 ;;
  '') usage >&2 && exit 2 ;;
esac
program=$1 rows=${2-1000} rounds=${3-1} runs=${4-11}
columns=1000 all_rows=1000
for tool in octave-cli "$program"; do
  command -v "$tool" >/dev/null || { echo "whole_program.sh: cannot run $tool" >&2 && exit 2; }
done

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# seconds COMMAND…: how long it takes. No file is there to be replaced, since a file system may take
# longer for that than for the rest.
seconds() {
  rm -f "$folder"/*.csv
  local start=$EPOCHREALTIME
  "$@" >&2
  awk -v start="$start" -v end="$EPOCHREALTIME" 'BEGIN { printf "%.6f\n", end - start }'
}
median() {
  sort -g "$1" | awk '{ v[NR] = $1 } END { print (v[int((NR + 1) / 2)] + v[int(NR / 2) + 1]) / 2 }'
}
# Octave 7 is prone to grumble when it exits; its words count only where it failed.
octave() {
  octave-cli --quiet --norc "$@" 2>"$folder/octave.errors" || { cat "$folder/octave.errors" && false; }
}
by_octave() { octave "$here/stability_chart.m" "$1" "$2" "$columns"; }
by_program() {
  "$program" stability --quiet --p "-1000:200:$2" --d "-40:20:$columns" --output "$1"
}
stable_column() { tr -d '\r' <"$1" | awk -F, 'NR > 1 { print $3 }'; }

for _ in $(seq "$rounds"); do
  for _ in $(seq "$runs"); do
    seconds by_program "$folder/program.csv" "$all_rows" >>"$folder/program.times"
  done
  # The start of Octave is no part of what grows with the rows.
  seconds octave --eval '' >>"$folder/start.times"
  seconds by_octave "$folder/octave.csv" "$rows" >>"$folder/octave.times"
done
by_program "$folder/compared.csv" "$rows"
differing=$(paste <(stable_column "$folder/octave.csv") <(stable_column "$folder/compared.csv") |
  awk '$1 != $2 || NF != 2 { n++ } END { print n + 0 }')

awk -v octave="$(median "$folder/octave.times")" -v program="$(median "$folder/program.times")" \
  -v start="$(median "$folder/start.times")" -v rows="$rows" -v all="$all_rows" -v columns="$columns" '
  BEGIN {
    whole = start + (octave - start) * all / rows
    printf "octave   %9.3f s%s\n", whole,
      rows == all ? "" : sprintf("   scaled from %d rows in %.3f s", rows, octave)
    printf "program  %9.4f s   median\n", program
    printf "ratio    %9.0f\n", whole / program
  }'
echo "cells    $((rows * columns)) compared, $differing differ"
echo "machine  $(lscpu | sed -n 's/^Model name: *//p' | head -n 1), $(nproc) cores," \
  "$(octave-cli --version 2>/dev/null | head -n 1), load $(cut -d ' ' -f 1 /proc/loadavg)"
[ "$differing" -eq 0 ]
