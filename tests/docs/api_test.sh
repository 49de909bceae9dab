#!/usr/bin/env bash
# docs/api.md lists every public name of the library: api_test.sh SOURCE_FOLDER
#
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

names=$(listed | wc -l)
printf '%s names, %s failures\n' "$names" "$failures"
[ "$names" -gt 500 ] && [ "$failures" -eq 0 ]
