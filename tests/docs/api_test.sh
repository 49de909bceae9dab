#!/usr/bin/env bash
# The headers describe what they declare, and docs/cpp.md names what they have:
# api_test.sh SOURCE_FOLDER [LEAST]
#
# Each type, function, alias and constant of include/holdfast, outside namespace detail, has a comment
# `///` before it. A function or class whose body throws InvalidParameter, or calls validate() or a
# require_…(), names InvalidParameter in its comment. Each `name()` and `Type` of a table of docs/cpp.md
# is declared in the header at the end of its row.
# LEAST: fewer declarations than that are a fault too, lest nothing was read (default 900).
# shellcheck disable=SC2016  # backquotes of the page, $ of awk
set -euo pipefail
cd "$1"
page=docs/cpp.md least=${2:-900} failures=0 count=0 names=0
complain() {
  printf '%s\n' "$*"
  failures=$((failures + 1))
}

# A line for each declaration of the headers, which begins in the first column: "ok", or what is wrong.
declarations() {
  find include/holdfast -name '*.hpp' -print0 | sort -z | xargs -0 awk '
    function judge(    name, place) {
      name = head
      sub(/\(.*/, "", name)
      if (hidden || name ~ /::~?[A-Za-z_]+$/) return  # a member outside its class, which declares it
      place = FILENAME ":" at ": "
      if (!documented) print place "no comment /// before: " head
      else if (refuses && !catches && comment !~ /InvalidParameter/)
        print place "the comment does not name InvalidParameter: " head
      else print "ok"
    }
    FNR == 1 { hidden = open = commented = 0 }
    /^namespace .*detail.*\{/ { hidden = 1 }
    /^}  \/\/ namespace .*detail/ { hidden = 0 }
    /^\/\/\// { comment = (commented ? comment : "") $0; commented = 1; next }
    !open && /^[a-zA-Z\[]/ && !/^(namespace|extern template|static_assert)/ {
      open = 1; at = FNR; head = ""; documented = commented
      body = refuses = catches = 0
      if (!commented) comment = ""
    }
    { commented = 0 }
    open {
      code = $0
      if (sub(/\/\/.*/, "", code)) comment = comment $0
      if (!body) head = head code " "
      if ((body || sub(/[^{]*\{/, "{", code)) &&
          code ~ /throw InvalidParameter|[^a-z_](require_[a-z_]+|validate)\(/) refuses = 1
      if (code ~ /catch \(const InvalidParameter/) catches = 1
      if (/^}/ || (!body && code ~ /[;}] *$/)) { judge(); open = 0 }
      body = body || code ~ /\{ *$/
    }'
}

while read -r line; do
  count=$((count + 1))
  [ "$line" = ok ] || complain "$line"
done < <(declarations)

# "HEADER NAME…" of each row whose last cell is a header.
rows() {
  sed -nE 's/^\|.*\| *([^|]*`[^|]*) *\| *`([a-z_0-9/]+\.hpp)` *\|$/\2 \1/p' "$page" | tr -d '`,'
}

while read -r header row; do
  file=include/holdfast/$header
  [ -f "$file" ] || { complain "$page: there is no header $header" && continue; }
  for name in $row; do
    names=$((names + 1))
    declared="(class|struct|using) $name\\b"
    [[ $name != *'()' ]] || declared="\\b${name%()}\\("
    grep -qE -- "$declared" < <(grep -vE '^ *//' "$file") || complain "$page: $header has no $name"
  done
done < <(rows)

printf '%d declarations, %d names of %s, %d failures\n' "$count" "$names" "$page" "$failures"
[ "$count" -ge "$least" ] && [ "$names" -gt 0 ] && [ "$failures" -eq 0 ]
