#!/usr/bin/env bash
# Checks that the numbers in the documentation's sentences and in its hand-written tables are those
# of the program.
#
#   numbers_test.sh SOURCE WORK PROGRAM [--without-packages] PAGE…
#
# A hidden block follows the paragraph or the table that it guards:
#
#   <!-- numbers
#   holdfast orbit --set control.sampling_period=0.011 --set backlash.width=0.002
#   "23.1 s" = period_s
#   "{2100} samples" = period_samples
#   holdfast margins
#   "12.72 ms" = 1000 * position[quantity=sampling_period,side=above]
#   "about 70 %" = 100 * distance[quantity=sampling_period] / value[quantity=sampling_period] within 2
#   -->
#
# A line that begins with `holdfast` is a command; it runs in the folder WORK, where data/ is a copy of
# SOURCE/data and where the blocks <!-- file … --> and <!-- change … --> of the page have been written
# (documentation_test.sh), and prints a table, CSV with a header. A quoted line says of the last table
#   - that its text stands, line breaks aside, between the last heading and the block, outside of code;
#   - that the first number in it, or the one in braces, is the value: a column in the first row, or in
#     the rows [column=value,…], in sums of products and quotients (+ - * /, blanks around them) with
#     numbers and other columns. Where several rows are named, it must be that of each of them.
# Numbers agree if they differ by at most half a unit of the last digit printed, or by what follows
# `within`. `>` and `<` in the place of `=` say that the number is above or below the value: the
# text is a bound. Read are −, 1.8·10⁻¹¹, 14 700, and where there are no digits words: one … twelve,
# twenty, thirty, half, third, quarter, sixth, tenth, twentieth, which are exact but for `within`.
#
# PAGE is relative to SOURCE. --without-packages: what a job tells that asks for a package which the
# build lacks is passed over.
set -euo pipefail
export LC_ALL=C.UTF-8
here=$(dirname "$(readlink -f "$0")")

source_folder=$1 work=$2 program=$3 without_packages=no
shift 3
if [[ ${1-} == --without-packages ]]; then
  without_packages=yes
  shift
fi
# shellcheck source=tests/docs/pages.sh
source "$here/pages.sh"

# Runs the command line, unless it has run since a file of $work changed; its table is $table, or
# nothing where there is none to compare with.
run_command() {
  local start=$SECONDS code
  if [[ -n ${tables[$1]-} ]]; then
    table=${tables[$1]}
    return
  fi
  runs=$((runs + 1)) table=$work.tables/$runs
  run_in_work "$1" "$table"
  printf '%3d s: %s\n' $((SECONDS - start)) "$1"
  if [[ $without_packages == yes ]] && asks_for_package; then
    printf 'passed over (the build lacks a package): %s\n' "$1"
    table=none
  elif [[ $code != 0 ]]; then
    failed "$page:$number: exit code $code: $1: $(tr '\n' ' ' <"$work.errors")"
    table=none
  fi
  tables[$1]=$table
}

# Checks a line "TEXT" = VALUE within NUMBER.
check_number() {
  local text relation value within='' problem
  if [[ ! $1 =~ ^\"(.*)\"\ ([=\<\>])\ (.+)$ ]]; then
    failed "$page:$number: not understood: $1"
    return
  fi
  text=${BASH_REMATCH[1]} relation=${BASH_REMATCH[2]} value=${BASH_REMATCH[3]}
  if [[ $value =~ ^(.*)\ within\ ([0-9.]+(e-?[0-9]+)?)$ ]]; then
    value=${BASH_REMATCH[1]} within=${BASH_REMATCH[2]}
  fi
  checked=$((checked + 1))
  if [[ $region != *"${text//[\{\}]/}"* ]]; then
    failed "$page:$number: '${text//[\{\}]/}' does not stand above"
  elif [[ -z $table ]]; then
    failed "$page:$number: no command is before '$text'"
  elif [[ $table == none ]]; then
    checked=$((checked - 1))
  else
    problem=$(HOLDFAST_TEXT=$text HOLDFAST_RELATION=$relation HOLDFAST_VALUE=$value \
      HOLDFAST_WITHIN=$within LC_ALL=C awk -f "$here/number.awk" "$table")
    if [[ -n $problem ]]; then
      failed "$page:$number: '$text': $problem"
    fi
  fi
}

check_page() {
  local line number=0 inside=text marker='' block='' region=' ' table='' checked=0
  while IFS= read -r line || [[ -n $line ]]; do
    number=$((number + 1))
    case $inside in
      code)
        if [[ $line != '```' ]]; then
          block+=$line$'\n'
          continue
        fi
        inside=text
        if [[ $marker == 'file '* ]]; then
          write_marked_file "${marker#file }" "$block" "$page:$number"
          tables=()
        elif [[ $marker == 'change '* ]]; then
          change_marked_file "${marker#change }" "$block" "$page:$number"
          tables=()
        fi
        marker=''
        ;;
      numbers)
        if [[ $line == '-->' ]]; then
          inside=text
        elif [[ $line == 'holdfast '* ]]; then
          run_command "$line"
        else
          check_number "$line"
        fi
        ;;
      text)
        if [[ $line == '```'* ]]; then
          inside=code block=''
        elif [[ $line == '<!-- numbers' ]]; then
          inside=numbers table=''
        elif [[ $line =~ ^'<!-- '(.*)' -->'$ ]]; then
          marker=${BASH_REMATCH[1]}
        elif [[ $line =~ ^#+\  ]]; then
          region=' '
        else
          read -ra line_words <<<"$line"
          region+="${line_words[*]} "
        fi
        ;;
    esac
  done <"$source_folder/$page"
  if [[ $inside != text ]]; then
    failed "$page: a block has no end"
  fi
  counts+=("$page: $checked numbers checked")
}

runs=0 counts=()
declare -A tables=()
rm -rf "$work.tables"
mkdir -p "$work.tables"
for page in "$@"; do
  begin_work "$source_folder"
  tables=()
  check_page
done
printf '%s\n' "${counts[@]}"
exit $((failures > 0))
