#!/usr/bin/env bash
# instructions_test.sh OBJDUMP NM PROGRAM BASELINE... -- KERNELS...
# Looks at the finished program: code of AVX2 and AVX-512 may stand in the kernels made for them, and
# in what those alone have; never in a function that a unit compiled for the baseline has or asks
# for, nor in one that runs before main(). BASELINE are those units' libraries and objects, KERNELS
# the libraries of the wider sets.
set -euo pipefail
export LC_ALL=C

objdump=$1 nm=$2 program=$3
shift 3
baseline=()
while [[ $1 != -- ]]; do
  [[ $1 == *.gch ]] || baseline+=("$1")  # a precompiled header holds no code
  shift
done
shift

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# The functions with an instruction that no x86-64 of the first generation has: VEX and EVEX forms
# begin with v, those of masks with k, and some of BMI are named. A part that the compiler has split
# off counts as its whole.
functions_beyond_baseline() {
  "$objdump" --disassemble --no-show-raw-insn "$1" | awk '
    /^[0-9a-f]+ <.*>:$/ { name = substr($2, 2, length($2) - 3); sub(/\.(cold|part|constprop|isra).*/, "", name); next }
    $2 ~ /^(v[a-z]|k[a-z]+[bwdq]$|shlx|shrx|sarx|rorx|mulx|andn$|bextr|bls|bzhi|pdep|pext)/ &&
      $2 !~ /^ver[rw]$/ { print name }' | sort -u
}

names_of() { "$nm" --format=posix "$@" 2>/dev/null | awk 'NF >= 2 { print $1 }' | sort -u; }

functions_beyond_baseline "$program" > "$work/wide"
names_of "${baseline[@]}" > "$work/baseline"

failed=0
for set in avx2 avx512; do
  # Where the check sees no kernel it sees nothing else either.
  if [[ $* == *kernels_$set* ]] && ! grep -q "$set" "$work/wide"; then
    echo "no function of $program has instructions of $set: is this check blind?"
    failed=1
  fi
done
if comm -12 "$work/wide" "$work/baseline" | grep -v -E '^$' > "$work/shared"; then
  echo 'functions for every processor were taken from a unit for some of them:'
  c++filt < "$work/shared" | sort | uniq -c
  failed=1
fi
if grep -E '^_GLOBAL__|^_sub_I_|module_ctor' "$work/wide"; then
  echo 'these run on every processor before main()'
  failed=1
fi
(( failed )) || echo "$(wc -l < "$work/wide") functions beyond the baseline, none of them shared"
exit $failed
