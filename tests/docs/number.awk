# Compares one number of a page with a table: prints what differs, or nothing.
#   awk -f number.awk TABLE, with HOLDFAST_TEXT, _RELATION, _VALUE and _WITHIN in the environment
# numbers_test.sh describes all four. To be run with LC_ALL=C: it reads bytes.

# The number in $text that the braces mark, else the first; sets the numbers `printed` and `half`, half a
# unit of its last digit. 0 if there is none.
function read_number(text,    at, rest, before, length_of_it, parts, digit) {
  if (match(text, /\{[^}]*\}/)) text = substr(text, RSTART + 1, RLENGTH - 2)
  gsub(/−/, "-", text)
  gsub(/\302\240|\342\200\257|\342\200\211/, " ", text)
  gsub(/⁻/, "^-", text)
  for (digit = 0; digit <= 9; ++digit) gsub(superscript[digit], "^" digit, text)
  while (match(text, /(^|[^0-9])10(\^-)?(\^[0-9])+/)) {
    rest = substr(text, RSTART, RLENGTH)
    at = index(rest, "10^")
    before = substr(text, 1, RSTART - 1) substr(rest, 1, at - 1)
    rest = substr(rest, at + 2)
    gsub(/\^/, "", rest)
    if (!sub(/·$/, "", before)) before = before "1"
    text = before "e" rest substr(text, RSTART + RLENGTH)
  }
  gsub(/\^-?[0-9]?/, "", text)
  for (at = 1; at <= length(text); ++at) {
    if (substr(text, at, 1) !~ /[0-9]/ || (at > 1 && substr(text, at - 1, 1) ~ /[A-Za-z_0-9.]/)) continue
    rest = substr(text, at)
    match(rest, /^[0-9][0-9]?[0-9]?( [0-9][0-9][0-9])+/)
    if (RLENGTH > 0 && substr(rest, RLENGTH + 1, 1) !~ /[0-9]/) {
      length_of_it = RLENGTH
      match(substr(rest, length_of_it + 1), /^\.[0-9]+/)
      if (RLENGTH > 0) length_of_it += RLENGTH
    } else {
      match(rest, /^[0-9]+(\.[0-9]+)?(e-?[0-9]+)?/)
      length_of_it = RLENGTH
    }
    rest = substr(rest, 1, length_of_it)
    gsub(/ /, "", rest)
    printed = rest + 0
    if (substr(text, 1, at - 1) ~ /(^|[^A-Za-z_0-9)])-$/) printed = -printed
    split(rest, parts, "e")
    half = 0.5 * 10 ^ (parts[2] - (index(parts[1], ".") ? length(parts[1]) - index(parts[1], ".") : 0))
    return 1
  }
  half = 0
  gsub(/[^A-Za-z]+/, " ", text)
  length_of_it = split(text, parts, " ")
  for (at = 1; at <= length_of_it; ++at) if (parts[at] in words) {
    printed = words[parts[at]]
    return 1
  }
  return 0
}

function fault(what) { if (problem == "") problem = what; return 0 }
function is_number(word) { return word ~ /^[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?$/ }
function size(value) { return value < 0 ? -value : value }
function same(a, b) {
  if (!is_number(a) || !is_number(b)) return a "" == b ""
  return size(a - b) <= 1e-9 * (size(a + 0) > size(b + 0) ? size(a + 0) : size(b + 0))
}

# The fields of a line of CSV, in field[1 … count].
function read_fields(line, field,    count, quoted, i, letter) {
  count = 1
  field[1] = ""
  for (i = 1; i <= length(line); ++i) {
    letter = substr(line, i, 1)
    if (letter == "\"") quoted = !quoted
    else if (letter == "," && !quoted) field[++count] = ""
    else field[count] = field[count] letter
  }
  return count
}

# The value of a column in the $which-th of the rows that have the named values; widens `rows`.
function of_column(name, choice, which,    pairs, count, i, at, row, chosen) {
  if (!(name in column)) return fault("there is no column '" name "'")
  count = choice == "" ? 0 : split(choice, pairs, ",")
  for (i = 1; i <= count; ++i) {
    at = index(pairs[i], "=")
    wanted_column[i] = substr(pairs[i], 1, at - 1)
    wanted[i] = substr(pairs[i], at + 1)
    if (!at || !(wanted_column[i] in column)) return fault("there is no column '" wanted_column[i] "'")
  }
  for (row = 1; row <= lines; ++row) {
    for (i = 1; i <= count; ++i) if (!same(cell[row, column[wanted_column[i]]], wanted[i])) break
    if (i > count) { found[++chosen] = row; if (!count) break }
  }
  if (!chosen) return fault(count ? "no row has " choice : "the table has no row")
  if (chosen > rows) rows = chosen
  at = cell[found[which <= chosen ? which : chosen], column[name]]
  if (!is_number(at)) return fault("'" at "' in the column '" name "' is no number")
  return at + 0
}

# Sums of products and quotients of numbers and columns, for the $which-th of the chosen rows.
function value_of(text, which,    sum, product, operation, sign, operand, name, choice, rest) {
  sum = 0
  sign = 1
  rest = text
  operation = ""
  while (1) {
    sub(/^ +/, "", rest)
    if (match(rest, /^-?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?/)) {
      operand = substr(rest, 1, RLENGTH) + 0
      rest = substr(rest, RLENGTH + 1)
    } else if (match(rest, /^[A-Za-z_][A-Za-z_0-9.]*/)) {
      name = substr(rest, 1, RLENGTH)
      rest = substr(rest, RLENGTH + 1)
      choice = ""
      if (match(rest, /^\[[^]]*\]/)) {
        choice = substr(rest, 2, RLENGTH - 2)
        rest = substr(rest, RLENGTH + 1)
      }
      operand = of_column(name, choice, which)
    } else return fault("'" text "' is not understood")
    if (problem != "") return 0
    if (operation == "/" && operand == 0) return fault("'" text "' divides by zero")
    product = operation == "*" ? product * operand : operation == "/" ? product / operand : operand
    sub(/^ +/, "", rest)
    if (rest == "") return sum + sign * product
    operation = substr(rest, 1, 1)
    rest = substr(rest, 2)
    if (operation == "+" || operation == "-") {
      sum += sign * product
      sign = operation == "+" ? 1 : -1
    } else if (operation != "*" && operation != "/") return fault("'" text "' is not understood")
  }
}

function compare(    relation, within, value, i, slack, right) {
  relation = ENVIRON["HOLDFAST_RELATION"]
  within = ENVIRON["HOLDFAST_WITHIN"]
  if (!read_number(ENVIRON["HOLDFAST_TEXT"])) return fault("there is no number in it")
  slack = within == "" ? half : within + 0
  rows = 1
  for (i = 1; i <= rows && problem == ""; ++i) {
    value = value_of(ENVIRON["HOLDFAST_VALUE"], i)
    if (problem != "") return
    right = relation == ">" ? printed > value : relation == "<" ? printed < value : \
      size(printed - value) <= slack + 1e-9 * size(value)
    if (!right) fault(sprintf("the program says %.12g", value))
  }
}

BEGIN {
  split("⁰ ¹ ² ³ ⁴ ⁵ ⁶ ⁷ ⁸ ⁹", list, " ")
  for (i = 1; i <= 10; ++i) superscript[i - 1] = list[i]
  count = split("one two three four five six seven eight nine ten eleven twelve", list, " ")
  for (i = 1; i <= count; ++i) words[list[i]] = i
  words["twenty"] = 20
  words["thirty"] = 30
  words["half"] = 1 / 2
  words["third"] = 1 / 3
  words["quarter"] = 1 / 4
  words["sixth"] = 1 / 6
  words["tenth"] = 1 / 10
  words["twentieth"] = 1 / 20
}
FNR == 1 { columns = read_fields($0, field); for (i = 1; i <= columns; ++i) column[field[i]] = i; next }
{
  ++lines
  count = read_fields($0, field)
  for (i = 1; i <= count; ++i) cell[lines, i] = field[i]
}
END { compare(); if (problem != "") print problem }
