#!/usr/bin/env bash
# Plants the small faults of faults.txt in the headers, one at a time, and shows which of them the
# tests catch; see --help.
set -euo pipefail
export LC_ALL=C

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
list=${MUTATION_LIST:-$here/faults.txt}
compiler=${CXX:-g++}
time_limit=300
jobs=1
keep=no
mode=faults
threshold=
numbers=()

usage() {
  cat <<HELP
Usage: tests/mutation/mutation_check.sh [OPTION]... [FAULT]...

Plants each fault of tests/mutation/faults.txt in a copy of the headers and compiles and runs the
tests that the list names for it, until one fails. Without numbers of faults: all of them.

  -j, --jobs N       faults tried at the same time, each with one compiler (default 1)
  -k, --keep         keep the folder with the headers, programs and outputs, and say where it is
  -l, --limit S      seconds that one test may run (default $time_limit); longer counts as caught
  -t, --at-least N   faults that must be caught (default 116, or all where fewer are tried)
      --check-list   only see that every fault can still be planted: its text occurs exactly once
      --check-tests  only see that the tests of the faults pass without any fault; a catch means
                     nothing where they do not
  -h, --help         this text

Exit code: 0 enough faults are caught (the list holds, the tests pass), 1 not, 2 a fault that cannot
be planted or does not compile, or a wrong option.

Needs g++ (or CXX), GoogleTest and Eigen (EIGEN_FOLDER, where pkg-config does not know it); and for
the faults in simd/, sundials/ and ceres/ what these need, and Arb. Changes nothing in the repository.
HELP
}

say() { printf '%s\n' "$*" >&2; }
fail() { say "$*" && exit 2; }

# --- the list ---------------------------------------------------------------------------------

fault_numbers() { awk '$1 == "fault:" { print $2 }' "$list"; }

field() { # FAULT KEY
  awk -v first="fault: $1" -v key="$2: " '
    $0 == first { inside = 1 }
    /^$/ { inside = 0 }
    inside && index($0, key) == 1 { print substr($0, length(key) + 1) }' "$list"
}

tests_of() { # FAULT...
  local fault
  for fault; do field "$fault" tests; done | tr ' ' '\n' | awk 'NF && !seen[$0]++'
}

# How often the text of TEXT occurs in a file.
occurrences() {
  awk '{
    for (rest = $0; (at = index(rest, ENVIRON["TEXT"])) > 0; ++count)
      rest = substr(rest, at + length(ENVIRON["TEXT"]))
  } END { print count + 0 }' "$1"
}

# What is wrong with one entry of the list; nothing where it can be planted.
flaw_of() { # FAULT
  local header text becomes source count
  header=$root/include/holdfast/$(field "$1" header)
  text=$(field "$1" text)
  becomes=$(field "$1" becomes)
  [[ -n $(field "$1" kind) ]] || echo "it has no kind"
  [[ -n $text && -n $becomes && $text != "$becomes" ]] || echo "nothing would change"
  [[ -n $(field "$1" tests) ]] || echo "it has no tests"
  [[ -f $header ]] || { echo "no header $header" && return; }
  count=$(TEXT=$text occurrences "$header")
  [[ $count == 1 ]] || echo "its text occurs $count times in $(field "$1" header)"
  for source in $(field "$1" tests); do
    [[ -f $root/tests/$source ]] || echo "no test tests/$source"
  done
}

check_list() {
  local fault flaw bad=0
  [[ $(fault_numbers | sort | uniq -d | wc -l) == 0 ]] || fail "a number is given to two faults"
  for fault in "${numbers[@]}"; do
    flaw=$(flaw_of "$fault")
    [[ -z $flaw ]] && continue
    bad=1
    say "fault $fault: $flaw"
  done
  return $bad
}

# --- compiling and running one test -------------------------------------------------------------

eigen_flags() {
  if [[ -n ${EIGEN_FOLDER-} ]]; then
    echo "-isystem $EIGEN_FOLDER"
  else
    pkg-config --cflags-only-I eigen3 2>/dev/null | sed 's/-I/-isystem /g' ||
      echo "-isystem /usr/include/eigen3"
  fi
}

version() { sed -n 's/.*version_string = "\([0-9.]*\)".*/\1/p' "$root/include/holdfast/core/version.hpp"; }

libraries_of() { # SOURCE
  case $1 in
    simd/*) echo "-ltbb" ;;
    sundials/*)
      echo "-lsundials_cvode -lsundials_nvecserial -lsundials_sunmatrixband" \
        "-lsundials_sunlinsolband -lsundials_sunnonlinsolfixedpoint"
      ;;
    ceres/*) echo "-lceres -lglog" ;;
    arb/*) echo "-lflint-arb -lflint" ;;
  esac
}

compile() { # ARGUMENT...
  local flags
  read -ra flags <<<"$(eigen_flags)"
  "$compiler" -std=c++17 -O1 -w -D_GLIBCXX_ASSERTIONS "${flags[@]}" \
    "-DHOLDFAST_SOURCE_DIR=\"$root\"" "-DHOLDFAST_VERSION=\"$(version)\"" "$@"
}

# What every test includes and no fault is in.
precompile() {
  mkdir -p "$work/common"
  printf '#include "support/testing.hpp"\n' >"$work/common/common.hpp"
  compile -I "$root/tests" -x c++-header "$work/common/common.hpp" -o "$work/common/common.hpp.gch" ||
    fail "GoogleTest and Eigen are needed"
  compile -I "$root/tests" -c "$root/tests/support/dense_routes.cpp" -o "$work/common/dense_routes.o"
}

build() { # SOURCE INCLUDE PROGRAM
  local libraries
  read -ra libraries <<<"$(libraries_of "$1")"
  compile -include "$work/common/common.hpp" -I "$2" -I "$root/tests" "$root/tests/$1" -o "$3" \
    "$work/common/dense_routes.o" -lgtest_main -lgtest "${libraries[@]}" -lpthread 2>"$3.errors"
}

# The test that failed, or in which the program ended.
culprit() { # OUTPUT
  awk '/^\[  FAILED  \] / && !failed { failed = $4 }
       /^\[ RUN      \] / { last = $4 }
       END { print failed ? failed : last ? last " (ended there)" : "before the first test" }' "$1"
}

run_program() { # PROGRAM: 0 passes, 124 too slow, else fails; the output goes to PROGRAM.output
  (cd "$(dirname "$1")" && timeout -k 5 "$time_limit" "$1" --gtest_fail_fast) >"$1.output" 2>&1
}

program_for() { echo "$2/$(tr '/' '-' <<<"${1%_test.cpp}")"; } # SOURCE FOLDER

# --- one fault ----------------------------------------------------------------------------------

plant() { # FAULT INCLUDE
  local header
  header=$2/holdfast/$(field "$1" header)
  mkdir -p "$2"
  cp -R "$root/include/holdfast" "$2/"
  TEXT=$(field "$1" text) BECOMES=$(field "$1" becomes) awk '
    (at = index($0, ENVIRON["TEXT"])) > 0 {
      $0 = substr($0, 1, at - 1) ENVIRON["BECOMES"] substr($0, at + length(ENVIRON["TEXT"]))
    }
    { print }' "$root/include/holdfast/$(field "$1" header)" >"$header"
}

# Tries the tests in their order: the verdict and what tells more of it.
judge() { # FAULT FOLDER
  local source program code
  plant "$1" "$2/include"
  for source in $(field "$1" tests); do
    program=$(program_for "$source" "$2")
    build "$source" "$2/include" "$program" ||
      { echo "ERROR $source does not compile" && return; }
    code=0
    run_program "$program" || code=$?
    [[ $keep == yes ]] || rm -f "$program"
    case $code in
      0) ;;
      124 | 137) echo "caught by the time limit in $source" && return ;;
      *) echo "caught $(culprit "$program.output") in $source" && return ;;
    esac
  done
  echo "SURVIVED"
}

try_fault() { # FAULT
  local folder=$work/fault-$1 began=$SECONDS verdict
  mkdir -p "$folder"
  verdict=$(judge "$1" "$folder")
  printf '%2d  %-34s %-24s %-8s %s  (%d s)\n' "$1" "$(field "$1" header)" "$(field "$1" kind)" \
    "${verdict%% *}" "${verdict#"${verdict%% *}"}" $((SECONDS - began)) | tee "$folder/verdict"
  [[ $keep == yes ]] || rm -rf "$folder/include"
}

# --- one test without a fault -------------------------------------------------------------------

check_test() { # SOURCE
  local program began=$SECONDS verdict=passes
  program=$(program_for "$1" "$work")
  if ! build "$1" "$root/include" "$program"; then
    verdict="DOES NOT COMPILE"
  elif ! run_program "$program"; then
    verdict="FAILS: $(culprit "$program.output")"
  fi
  printf '%-46s %s  (%d s)\n' "$1" "$verdict" $((SECONDS - began)) | tee "$program.verdict"
  [[ $keep == yes ]] || rm -f "$program"
}

# --- all of them --------------------------------------------------------------------------------

# Calls this script again for each argument, as many at a time as there are jobs.
each() { # try|check ARGUMENT...
  local what=$1
  shift
  printf '%s\n' "$@" | xargs -P "$jobs" -I '{}' \
    env MUTATION_LIST="$list" "${BASH_SOURCE[0]}" --worker "$what" "$work" "$keep" "$time_limit" '{}'
}

check_tests() {
  local sources
  mapfile -t sources < <(tests_of "${numbers[@]}")
  each check "${sources[@]}"
  local passed
  passed=$(cat "$work"/*.verdict | grep -c ' passes  (' || true)
  echo "${#sources[@]} tests without a fault, $passed pass"
  [[ $passed == "${#sources[@]}" ]]
}

how_many() { cat "$work"/fault-*/verdict | awk -v verdict="$1" '$0 ~ " " verdict " " { ++count } END { print count + 0 }'; }

try_all() {
  local caught errors all=${#numbers[@]}
  each try "${numbers[@]}"
  caught=$(how_many caught)
  errors=$(how_many ERROR)
  echo
  cat "$work"/fault-*/verdict | sort -n | grep -v ' caught ' || true
  echo "$all faults, $caught caught, $((all - caught - errors)) survived"
  [[ $errors == 0 ]] || fail "$errors that do not compile: $list is wrong, or a package is missing"
  ((caught >= ${threshold:-$((all < 116 ? all : 116))}))
}

worker() { # try|check WORK KEEP LIMIT ARGUMENT
  work=$2 keep=$3 time_limit=$4
  case $1 in
    try) try_fault "$5" ;;
    check) check_test "$5" ;;
  esac
}

read_arguments() {
  while (($# > 0)); do
    case $1 in
      -h | --help) usage && exit 0 ;;
      -k | --keep) keep=yes ;;
      --check-list) mode=list ;;
      --check-tests) mode=tests ;;
      -j | --jobs | -l | --limit | -t | --at-least)
        [[ ${2-} =~ ^[0-9]+$ ]] || fail "$1 needs a number"
        case $1 in
          -j | --jobs) jobs=$2 ;;
          -l | --limit) time_limit=$2 ;;
          *) threshold=$2 ;;
        esac
        shift
        ;;
      *)
        fault_numbers | grep -qx -- "$1" || fail "$1 is no option and no fault of the list; see --help"
        numbers+=("$1")
        ;;
    esac
    shift
  done
  ((${#numbers[@]} > 0)) || mapfile -t numbers < <(fault_numbers)
}

make_work_folder() {
  work=$(mktemp -d)
  if [[ $keep == yes ]]; then say "in $work"; else trap 'rm -rf "$work"' EXIT; fi
}

main() {
  if [[ ${1-} == --worker ]]; then
    shift
    worker "$@"
    return
  fi
  read_arguments "$@"
  check_list || exit 2
  [[ $mode != list ]] || { echo "${#numbers[@]} faults can be planted" && return; }
  make_work_folder
  precompile
  if [[ $mode == tests ]]; then check_tests; else try_all; fi
}

main "$@"
