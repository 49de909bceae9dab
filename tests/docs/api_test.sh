#!/usr/bin/env bash
# docs/api.md lists every public name of the library: api_test.sh SOURCE_FOLDER
#
# Every function of the page says in its header what it refuses (InvalidParameter), or in the page that
# it is unchecked.
# Every type at the beginning of a line of a header, outside namespace detail, stands in the page with
# that header; and every name of the page stands in its header.
set -euo pipefail
cd "$1"
page=docs/api.md
failures=0
complain() {
  printf '%s\n' "$*"
  failures=$((failures + 1))
}

# "NAME HEADER" of each row of the page, without namespaces and parentheses.
listed() {
  sed -nE 's/^\| `([^`]+)` \|.*\| `([^`]+)` \|$/\1 \2/p' "$page" | sed -E 's/\(\)//; s/^([a-z0-9_]+::)+//'
}

# "NAME HEADER" of each type that the headers declare for all to use.
declared() {
  local header
  for header in $(cd include/holdfast && find . -name '*.hpp' | sed 's|^\./||' | sort); do
    awk -v header="$header" '
      /^namespace .*detail.*\{/ { hidden = 1 }
      /^}  \/\/ namespace .*detail/ { hidden = 0 }
      !hidden && /^(class|struct|enum class) [A-Za-z_]+( :| \{|$| final)/ {
        name = $2 == "class" ? $3 : $2
        if ($0 !~ /;$/) print name, header
      }' "include/holdfast/$header"
  done
}

while read -r name header; do
  if [ ! -f "include/holdfast/$header" ]; then
    complain "$page: there is no header $header"
  elif ! grep -qw -- "$name" "include/holdfast/$header"; then
    complain "$page: $header has no $name"
  fi
done < <(listed)

while read -r name header; do
  complain "$header: $name is missing in $page"
done < <(comm -23 <(declared | sort -u) <(listed | sort -u))

# "NAME HEADER" of each function that a comment before its declaration lets throw InvalidParameter.
refusing() {
  local header
  for header in $(sed -nE 's/^\| `[^`]+\(\)` \|.*\| `([^`]+)` \|$/\1/p' "$page" | sort -u); do
    awk -v header="$header" '
      /^ *\/\/\// { if (!comment) throws = 0; comment = 1; if (/InvalidParameter/) throws = 1; next }
      { comment = 0 }
      throws {
        for (rest = $0; match(rest, /[a-z_0-9]+\(/); rest = substr(rest, RSTART + RLENGTH))
          print substr(rest, RSTART, RLENGTH - 1), header
      }
      /[{;]$/ { throws = 0 }' "include/holdfast/$header"
  done
}

# "NAME HEADER" of each function of the page that does not say (unchecked).
checked() {
  grep -E '^\| `[^`]+\(\)` \|' "$page" | grep -v '(unchecked) |' |
    sed -nE 's/^\| `([a-z0-9_]+::)?([^`]+)\(\)` \|.*\| `([^`]+)` \|$/\2 \3/p' |
    grep -vE '^(require_[a-z_]+|converted|linear_plant) '
}

while read -r name header; do
  complain "$header: $name() refuses nothing by its comment, and $page does not call it unchecked"
done < <(comm -23 <(checked | sort -u) <(refusing | sort -u))

names=$(listed | wc -l)
printf '%s names, %s failures\n' "$names" "$failures"
[ "$names" -gt 500 ] && [ "$failures" -eq 0 ]
