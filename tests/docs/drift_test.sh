#!/usr/bin/env bash
# drift_test.sh WORK: documentation_test.sh, numbers_test.sh and api_test.sh accept a page and a header that
# are right and find each fault of those that are not. A stand-in is the program: it prints its arguments one a line, `fail` exits
# with 2, `package` asks for a package.
# shellcheck disable=SC2016  # the backquotes are those of pages
set -euo pipefail
check=$(dirname "$(readlink -f "$0")")/documentation_test.sh
numbers_check=$(dirname "$(readlink -f "$0")")/numbers_test.sh
work=$1
rm -rf "$work"
mkdir -p "$work/source/examples" "$work/source/docs"
cat >"$work/holdfast" <<'STAND_IN'
#!/usr/bin/env bash
case $1 in
  fail) exit 2 ;;
  package) echo "install the package libmissing-dev" >&2; exit 1 ;;
  show) cat "$2" ;;
  crlf) printf 'x\r\n' ;;
  *) printf '%s\n' "$@" ;;
esac
STAND_IN
chmod +x "$work/holdfast"
printf 'int main() {\n  return 0;\n}\n' >"$work/source/examples/nothing.cpp"
printf '# Other\n\n## A heading, `code` and ρ\n\n## 2. Second\n' >"$work/source/docs/other.md"

failures=0
# expect CODE MODE WHAT PAGE [OPTION]: checking the text PAGE in this MODE ends with CODE.
expect() {
  local wanted=$1 mode=$2 what=$3 code=0
  printf '%s\n' "$4" >"$work/source/page.md"
  if [[ $mode == commands ]]; then
    "$check" commands "$work/source" "$work/scratch" page.md "$work/holdfast" ${5+"$5"} \
      >"$work/log" 2>&1 || code=$?
  elif [[ $mode == numbers ]]; then
    "$numbers_check" "$work/source" "$work/scratch" "$work/holdfast" ${5+"$5"} page.md \
      >"$work/log" 2>&1 || code=$?
  else
    "$check" "$mode" "$work/source" page.md >"$work/log" 2>&1 || code=$?
  fi
  if [[ $code != "$wanted" ]]; then
    printf 'FAILED: %s: exit code %s, not %s\n' "$what" "$code" "$wanted"
    cat "$work/log"
    failures=$((failures + 1))
  fi
}
block() { printf '```%s\n%s\n```\n' "$1" "$2"; }
output() { printf '\n<!-- output -->\n%s' "$(block text "$1")"; }

run=$(block sh 'holdfast a,1.5 b \
  c,2   # two lines')
expect 0 commands 'a command' "$run"
expect 0 commands 'its output' "$run$(output $'a,1.5\nb\nc,2')"
expect 0 commands 'its output, another last digit' "$run$(output $'a,1.50000001\nb\nc,2')"
expect 0 commands 'its output, shortened' "$run$(output $'...\nc,2')"
expect 0 commands 'its output, shortened twice' "$run$(output $'...\nb\n...')"
expect 0 commands 'an output of CRLF lines' "$(block sh 'holdfast crlf')$(output x)"
expect 1 commands 'another number' "$run$(output $'a,1.501\nb\nc,2')"
expect 1 commands 'another word' "$run$(output $'a,1.5\nB\nc,2')"
expect 1 commands 'a line too few' "$run$(output $'a,1.5\nb')"
expect 1 commands 'a line too many' "$run$(output $'a,1.5\nb\nc,2\nd')"
expect 1 commands 'a line too many behind what is left out' "$run$(output $'a,1.5\n...\nc,2\nd')"
expect 1 commands 'an order that is another' "$run$(output $'b\n...\na,1.5\n...')"
expect 1 commands 'an output without a command' "$(output a)"
expect 1 commands 'a command that fails' "$(block sh 'holdfast fail')"
expect 1 commands 'a command that fails within a pipe' "$(block sh 'holdfast fail | cat')"
expect 1 commands 'an unknown kind of command' "$(block sh 'make everything')"
expect 0 commands 'commands that are not run' "$(block sh $'# all\n./run\ncmake --preset x\nholdfast fail …')"
expect 1 commands 'a missing package' "$(block sh 'holdfast package')"
expect 0 commands 'a missing package, of a build without it' "$(block sh 'holdfast package')$(output x)" \
  --without-packages
expect 1 commands 'an unknown kind of block' "$(block bash 'holdfast a')"
expect 1 commands 'a block without an end' '```sh'
expect 1 commands 'a comment without its block' $'<!-- output -->\ntext'
file="<!-- file my.toml -->
$(block toml $'x = 1 # one\ny = 2')
"
show=$(block sh 'holdfast show my.toml')
expect 0 commands 'a file' "$file$show$(output $'x = 1 # one\ny = 2')"
change="<!-- change my.toml -->
"
expect 0 commands 'a change of it' "$file$change$(block toml 'x = 3')
$show$(output $'x = 3\ny = 2')"
expect 1 commands 'a change of nothing' "$file$change$(block toml 'z = 3')"
expect 1 commands 'a file elsewhere' "<!-- file ../my.toml -->
$(block toml 'x = 1')"

marked='<!-- examples/nothing.cpp -->
'
expect 0 code 'an example' "$marked$(block cpp $'int main() {\n  return 0;\n}')"
expect 0 code 'a part of an example' "$marked$(block cpp '  return 0;')"
expect 1 code 'code without an example' "$(block cpp '  return 0;')"
expect 1 code 'code that differs' "$marked$(block cpp '  return 1;')"
expect 1 code 'code with lines left out' "$marked$(block cpp $'int main() {\n}')"
expect 1 code 'half a line of code' "$marked$(block cpp 'return 0;')"
expect 1 code 'an example that is not there' "<!-- examples/missing.cpp -->
$(block cpp '  return 0;')"

expect 0 links 'links' '[a](docs/other.md), [b](docs/other.md#a-heading-code-and-ρ), ![c](examples/nothing.cpp)
[d](https://example.org/x), `[e](no link)`, [f](docs/other.md), section 2'
expect 1 links 'a file that is not there' '[a](docs/missing.md)'
expect 1 links 'a picture that is not there' '![a](missing.svg)'
expect 1 links 'a heading that is not there' '[a](docs/other.md#another)'
expect 1 links 'a section that is not there' '[a](docs/other.md), section 3'
expect 1 links 'a reference that leads nowhere' '[a]: missing.md'

# numbers WHAT LINE: LINE is wrong of the paragraph and the table below; right_numbers: it is right.
paragraph="# A heading
About 72 % of it, −3.5 mm
or 1.8·10⁻¹¹, after 14 700 samples and four periods, half of it; P = k2 − 5 N, of 10⁻³ m².
$(block text 'but 99 in code')"
table="holdfast name,x,y one,72.4,-0.00346 '\"two, or so\",1.84e-11,14700' three,4,none four,4,0.001"
numbers() { expect 1 numbers "$1" "$(guarded "$paragraph" "$table" "$2")"; }
right_numbers() { expect 0 numbers "$1" "$(guarded "$paragraph" "$table" "$2")"; }
guarded() { printf '%s\n\n<!-- numbers\n%s\n%s-->\n' "$1" "$2" "${3:+$3$'\n'}"; }
expect 0 numbers 'a page without numbers' "$paragraph"
right_numbers 'a number' '"About 72 %" = x'
numbers 'a number that differs by more than half a unit' '"About 72 %" = 1.01 * x'
right_numbers 'a number within what is allowed' '"About 72 %" = 1.01 * x within 2'
numbers 'a number outside of what is allowed' '"About 72 %" = 1.05 * x within 2'
right_numbers 'a bound' '"72 %" < x'
numbers 'a bound that is passed' '"72 %" > x'
numbers 'a text that does not stand there' '"about 73 %" = x'
numbers 'a text that stands in code alone' '"99 in code" = 99'
right_numbers 'a minus sign, a text over two lines, a factor' '"−3.5 mm or" = 1000 * y[name=one]'
numbers 'another sign' '"−3.5 mm" = 1000 * -1 * y[name=one]'
right_numbers 'a power of ten, a quoted field' $'"1.8·10⁻¹¹" = x[y=14700]\n"{10⁻³} m²" = y[name=four]'
numbers 'another exponent' '"1.8·10⁻¹¹" = 10 * x[y=14700]'
right_numbers 'a number in braces, a thousands blank, a word' \
  $'"1.8·10⁻¹¹, after {14 700}" = y[x=1.84e-11]\n"and four periods" = x[name=four]'
numbers 'the number in braces is another' '"{1.8·10⁻¹¹}, after 14 700" = y[x=1.84e-11]'
right_numbers 'no number is the 2 of k2' '"P = k2 − 5 N" = 9 - x[name=four]'
right_numbers 'sums, products, quotients' '"72 %" = 2 * x[name=three] * 10 - 40 / x[name=four] + 2'
right_numbers 'two columns that choose, two rows that are chosen' \
  $'"four" = x[x=4,name=three]\n"four" = x[x=4]\n"{5} N" > x[x=4]'
numbers 'one of two rows is another' '"four" = x[name=three] * 1000 * y[x=4]'
numbers 'a column that is missing' '"About 72 %" = z'
numbers 'a column that chooses and is missing' '"About 72 %" = x[z=1]'
numbers 'a row that is missing' '"About 72 %" = x[name=five]'
numbers 'a value that is no number' '"four" = y[name=three]'
right_numbers 'a word for a fraction, within what is allowed' '"{half}" = 0.1 * x[name=three] + 0.13 within 0.05'
numbers 'a word for a fraction is exact' '"{half}" = 0.1 * x[name=three] + 0.13'
numbers 'a text without a number' '"of it" = x'
numbers 'a value that is not understood' '"About 72 %" = x ^ 2'
numbers 'a division by zero' '"About 72 %" = x / 0'
numbers 'a line that is not understood' 'About 72 % = x'
expect 1 numbers 'a text above the last heading' "$(guarded "$paragraph
## Another" "$table" '"About 72 %" = x')"
expect 1 numbers 'a table without a row' "$(guarded "$paragraph" 'holdfast name,x' '"About 72 %" = x')"
expect 1 numbers 'a number without a command' "$(guarded "$paragraph" '"About 72 %" = 72' '')"
expect 1 numbers 'a command for numbers that fails' "$(guarded "$paragraph" 'holdfast fail' '"About 72 %" = x')"
expect 1 numbers 'a command that asks for a package' \
  "$(guarded "$paragraph" 'holdfast package' '"About 72 %" = x')"
expect 0 numbers 'the same, of a build without it' \
  "$(guarded "$paragraph" 'holdfast package' '"About 72 %" = x')" --without-packages
expect 1 numbers 'numbers without an end' $'text\n<!-- numbers\nholdfast a'
expect 0 numbers 'a file, a change of it' "$(printf '%s\n' "<!-- file my.csv -->" "$(block toml $'x\nx = 1')")
$(guarded "# A" 'holdfast show my.csv | sed "s/x = //"' '')
Now 1.
$(guarded '' 'holdfast show my.csv | sed "s/x = //"' '"Now 1" = x')
$(printf '%s\n' "<!-- change my.csv -->" "$(block toml 'x = 3')")
$(guarded 'Then 3.' 'holdfast show my.csv | sed "s/x = //"' '"Then 3" = x')"

# api CODE WHAT SED: api_test.sh ends with CODE after the header and the page below were changed by SED.
mkdir -p "$work/source/include/holdfast/core"
api() {
  local code=0
  cat >"$work/source/include/holdfast/core/size.hpp" <<'HEADER'
namespace holdfast {

/// A length.
struct Size {
  double metres;  ///< > 0
};

/// Refuses a length. @throws InvalidParameter unless it is > 0
inline void validate(const Size& size) { require_positive("size", size.metres, "m"); }

/// Twice a length. @throws InvalidParameter as `validate`
template <class Number>
Number twice(const Size& size) {
  validate(size);
  return Number(2) * size.metres;
}

namespace detail {

double hidden(const Size& size) { throw InvalidParameter("size", size.metres, "m", "another"); }

}  // namespace detail
}  // namespace holdfast
HEADER
  printf '| a length | `Size`, `twice()` | `core/size.hpp` |\n' >"$work/source/docs/cpp.md"
  sed -i "$3" "$work/source/include/holdfast/core/size.hpp" "$work/source/docs/cpp.md"
  "$(dirname "$check")/api_test.sh" "$work/source" "${4-3}" >"$work/log" 2>&1 || code=$?
  [[ $code == "$1" ]] || {
    printf 'FAILED: %s: exit code %s, not %s\n' "$2" "$code" "$1"
    cat "$work/log"
    failures=$((failures + 1))
  }
}
api 0 'a header' ''
api 1 'fewer declarations than expected' '' 4
api 1 'a type without a comment' '/A length/d'
api 1 'a function without a comment' '/Twice/d'
api 1 'a function that calls validate() and does not say so' 's/ @throws InvalidParameter as.*//'
api 1 'a function of one line that refuses and does not say so' 's/ @throws InvalidParameter unless.*//'
api 1 'a header of the page that is not there' 's|core/size.hpp|core/sizes.hpp|'
api 1 'a function of the page that is not there' 's/`twice()`/`thrice()`/'
api 1 'a function of the page that is a type' 's/`Size`/`Size()`/'
api 1 'a page without a table' 's/^|.*//'

expect 1 nonsense 'an unknown mode' 'text'
exit $((failures > 0))
