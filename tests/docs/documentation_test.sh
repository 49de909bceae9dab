#!/usr/bin/env bash
# Checks that the documentation still says what the program does.
#
#   documentation_test.sh commands SOURCE WORK PAGE PROGRAM [--without-packages]
#       Runs every command line of the page's sh blocks in the folder WORK, where data/ is a copy of
#       SOURCE/data. Each must exit with 0. A text block marked <!-- output --> must be what the sh
#       block before it printed; a line `...` in it stands for any number of lines. A block marked
#       <!-- file NAME --> is written to WORK/NAME before the commands behind it run; the lines
#       `key = value` of a block marked <!-- change NAME --> replace those of the same keys there.
#       --without-packages: a job that asks for a package which the build lacks is passed over.
#   documentation_test.sh code SOURCE PAGE…
#       Every cpp block carries a marker such as <!-- examples/first_program.cpp --> and is that file
#       or a contiguous part of it; so is any other block that carries one.
#   documentation_test.sh links SOURCE PAGE…
#       Relative links and images lead to files and headings that exist.
#
# PAGE is relative to SOURCE. Numbers of an output agree if they differ by less than 1e-6 of their
# size, so that another compiler's last digits are no drift; all else is compared to the letter.
set -euo pipefail
export LC_ALL=C.UTF-8

# Command lines that are not run, each with the reason. All others but `holdfast …` are faults.
not_run=(
  './run*|builds the whole project'
  './test*|would run this test within itself'
  'cmake *|builds or installs the whole project'
  'apt *|installs packages'
  'sudo apt*|installs packages'
  'holdfast explore *|its page is built apart: tests/explorer'
)
# Case files that the pages name as the reader's own, and what stands in for them.
placeholders=(
  'my-cable.toml|data/kollar2022.toml'
)
# shellcheck source=tests/docs/pages.sh
source "$(dirname "$(readlink -f "$0")")/pages.sh"

# Fills kinds, markers, texts and places with the fenced blocks of the page.
read_blocks() {
  local line marker='' number=0 inside=no
  kinds=() markers=() texts=() places=()
  while IFS= read -r line || [[ -n $line ]]; do
    number=$((number + 1))
    if [[ $inside == yes ]]; then
      if [[ $line == '```' ]]; then
        inside=no
      else
        texts[-1]+=$line$'\n'
      fi
    elif [[ $line =~ ^\`\`\`(.*)$ ]]; then
      inside=yes
      kinds+=("${BASH_REMATCH[1]}") markers+=("$marker") texts+=('') places+=("$page:$number")
      marker=''
      case ${kinds[-1]} in
        sh | text | cpp | toml | cmake | python) ;;
        *) failed "${places[-1]}: a block must be sh, text, cpp, python, toml or cmake, not '${kinds[-1]}'" ;;
      esac
    elif [[ $line =~ ^[[:space:]]+\`\`\` ]]; then
      failed "$page:$number: a block must begin in the first column"
    elif [[ $line =~ ^'<!-- '(output|file .*|change .*|examples/.*)' -->'$ ]]; then
      marker=${BASH_REMATCH[1]}
    elif [[ -n $line ]]; then
      if [[ -n $marker ]]; then
        failed "$page:$number: no block follows the comment <!-- $marker -->"
      fi
      marker=''
    fi
  done <"$source_folder/$page"
  if [[ $inside == yes ]]; then
    failed "$page: a block has no end"
  fi
}

# The commands of an sh block, one a line: without comments, continued lines joined.
command_lines() {
  sed -E -e ':join' -e '/\\$/{N;s/[[:space:]]*\\\n[[:space:]]*/ /;b join' -e '}' \
    -e 's/(^|[[:space:]])#.*$//' -e 's/[[:space:]]+$//' <<<"$1" | grep -v '^$' || true
}

# Says why a command line is not run; status 1 if it is to be run or is unknown.
reason_not_to_run() {
  local entry
  if [[ $1 == *…* || $1 == *...* ]]; then
    printf 'left open by an ellipsis'
    return 0
  fi
  for entry in "${not_run[@]}"; do
    # shellcheck disable=SC2053  # the entry is a pattern
    if [[ $1 == ${entry%%|*} ]]; then
      printf '%s' "${entry#*|}"
      return 0
    fi
  done
  return 1
}

# Whether the file $2 is the text $1, in which a line `...` stands for any number of lines.
is_output() {
  awk -v tolerance=1e-6 '
    function is_number(word) { return word ~ /^[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?$/ }
    function size(value) { return value < 0 ? -value : value }
    function same_word(a, b) {
      if (a == b) return 1
      if (!is_number(a) || !is_number(b)) return 0
      return size(a - b) <= tolerance * (size(a + 0) > size(b + 0) ? size(a + 0) : size(b + 0))
    }
    function same_line(a, b,    count, i, left, right) {
      if (a == b) return 1
      count = split(a, left, /[ ,]/)
      if (split(b, right, /[ ,]/) != count) return 0
      for (i = 1; i <= count; ++i) if (!same_word(left[i], right[i])) return 0
      return 1
    }
    NR == FNR { wanted[++rows] = $0; next }
    { found[++lines] = $0 }
    END {
      row = 1; open_row = 0
      for (line = 1; line <= lines;) {
        if (row <= rows && wanted[row] == "...") { open_row = row++; open_line = line }
        else if (row <= rows && same_line(wanted[row], found[line])) { ++row; ++line }
        else if (open_row) { row = open_row + 1; line = ++open_line }
        else exit 1
      }
      while (row <= rows && wanted[row] == "...") ++row
      exit row <= rows
    }' <(printf '%s' "$1") "$2"
}

# Runs one command line; its standard output is added to $work.output.
run_command() {
  local place=$1 line=$2 code start=$SECONDS reason
  if reason=$(reason_not_to_run "$line"); then
    printf 'not run (%s): %s\n' "$reason" "$line"
    passed_over=$((passed_over + 1)) output_known=no
    return
  fi
  if [[ $line != 'holdfast '* ]]; then
    failed "$place: unknown kind of command: $line"
    output_known=no
    return
  fi
  run_in_work "$line" "$work.output"
  if [[ $without_packages == yes ]] && asks_for_package; then
    printf 'not run (the build lacks a package): %s\n' "$line"
    passed_over=$((passed_over + 1)) output_known=no
    return
  fi
  ran=$((ran + 1))
  printf '%3d s: %s\n' $((SECONDS - start)) "$line"
  if [[ $code != 0 ]]; then
    failed "$place: exit code $code: $line"
    cat "$work.errors" >&2
  fi
}

run_block() {
  local line
  : >"$work.output"
  output_known=yes
  while IFS= read -r line; do
    run_command "${places[$1]}" "$line"
  done < <(command_lines "${texts[$1]}")
}

compare_output() {
  case $output_known in
    yes)
      compared=$((compared + 1))
      if ! is_output "${texts[$1]}" "$work.output"; then
        failed "${places[$1]}: the commands before it print something else (-: page, +: program)"
        diff -u <(printf '%s' "${texts[$1]}") "$work.output" >&2 || true
      fi
      ;;
    no) printf 'not compared, since a command was not run: %s\n' "${places[$1]}" ;;
    none) failed "${places[$1]}: an output without a command before it" ;;
  esac
}

check_commands() {
  local entry index
  begin_work "$source_folder"
  for entry in "${placeholders[@]}"; do
    if [[ -f $work/${entry#*|} ]]; then
      cp "$work/${entry#*|}" "$work/${entry%%|*}"
    fi
  done
  ran=0 passed_over=0 compared=0 output_known=none
  read_blocks
  for index in "${!kinds[@]}"; do
    if [[ ${markers[$index]} == 'file '* ]]; then
      write_marked_file "${markers[$index]#file }" "${texts[$index]}" "${places[$index]}"
    elif [[ ${markers[$index]} == 'change '* ]]; then
      change_marked_file "${markers[$index]#change }" "${texts[$index]}" "${places[$index]}"
    elif [[ ${kinds[$index]} == sh ]]; then
      run_block "$index"
    elif [[ ${markers[$index]} == output ]]; then
      compare_output "$index"
    fi
  done
  printf '%s: %d commands run, %d not run, %d outputs compared\n' \
    "$page" "$ran" "$passed_over" "$compared"
}

check_code() {
  local index file content checked=0
  read_blocks
  for index in "${!kinds[@]}"; do
    file=${markers[$index]}
    if [[ $file != examples/* ]]; then
      if [[ ${kinds[$index]} == cpp ]]; then
        failed "${places[$index]}: a cpp block needs a comment that names its file of examples/"
      fi
      continue
    fi
    checked=$((checked + 1))
    if [[ ! -f $source_folder/$file ]]; then
      failed "${places[$index]}: there is no $file"
      continue
    fi
    content=$'\n'$(<"$source_folder/$file")$'\n'
    if [[ -z ${texts[$index]} || $content != *$'\n'"${texts[$index]}"* ]]; then
      failed "${places[$index]}: the block is no part of $file"
      diff -u "$source_folder/$file" <(printf '%s' "${texts[$index]}") >&2 || true
    fi
  done
  printf '%s: %d blocks compared with examples/\n' "$page" "$checked"
}

# The page without its code.
# shellcheck disable=SC2016  # the backquotes are those of the page
prose() {
  awk '/^```/ { code = !code; next } !code' "$1" | sed -E 's/`[^`]*`//g'
}

# The anchors of a page's headings, as GitHub makes them.
anchors() {
  local line slug
  local -A seen=()
  while IFS= read -r line; do
    slug=${line,,}
    slug=${slug//[^[:alnum:] _-]/}
    slug=${slug// /-}
    if [[ -n ${seen[$slug]-} ]]; then
      printf '%s-%d\n' "$slug" "${seen[$slug]}"
    else
      printf '%s\n' "$slug"
    fi
    seen[$slug]=$((${seen[$slug]-0} + 1))
  done < <(awk '/^```/ { code = !code; next } !code && /^#+ /' "$1" | sed -E 's/^#+ +//; s/ +#*$//')
}

link_targets() {
  prose "$1" | grep -oE '\]\([^)]*\)' | sed -E 's/^\]\(<?//; s/>?( "[^"]*")?\)$//' || true
  prose "$1" | sed -nE 's/^\[[^]]+\]: *<?([^ >]+).*/\1/p; s/.*<(img|a) [^>]*(src|href)="([^"]*)".*/\3/p'
}

check_links() {
  local target file anchor number checked=0
  while IFS= read -r target; do
    if [[ $target =~ ^[a-z]+: ]]; then
      continue
    fi
    checked=$((checked + 1))
    file=${target%%#*}
    if [[ -n $file ]]; then
      file=$(dirname "$source_folder/$page")/$file
    else
      file=$source_folder/$page
    fi
    if [[ ! -e $file ]]; then
      failed "$page: the link '$target' leads nowhere"
    elif [[ $target == *#* ]]; then
      anchor=${target#*#}
      if ! grep -qxF -- "$anchor" < <(anchors "$file"); then
        failed "$page: the link '$target' names no heading"
      fi
    fi
  done < <(link_targets "$source_folder/$page")
  # Sections by number: [docs/theory-motion.md](docs/theory-motion.md), section 2
  while IFS=' ' read -r target number; do
    checked=$((checked + 1))
    if ! grep -qE "^#+ $number\\. " "$(dirname "$source_folder/$page")/$target"; then
      failed "$page: $target has no section $number"
    fi
  done < <(prose "$source_folder/$page" | tr '\n' ' ' |
    grep -oE '\]\([^) ]*\.md\),? sections? [0-9]+' | sed -E 's/^\]\(([^)]*)\),? sections? /\1 /')
  printf '%s: %d links checked\n' "$page" "$checked"
}

mode=$1
source_folder=$2
shift 2
case $mode in
  commands)
    work=$1 page=$2 program=$3 without_packages=no
    if [[ ${4-} == --without-packages ]]; then
      without_packages=yes
    fi
    check_commands
    ;;
  code)
    for page in "$@"; do
      check_code
    done
    ;;
  links)
    for page in "$@"; do
      check_links
    done
    ;;
  *)
    failed "unknown mode '$mode'"
    ;;
esac
exit $((failures > 0))
