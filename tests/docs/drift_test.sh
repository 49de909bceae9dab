#!/usr/bin/env bash
# drift_test.sh WORK: documentation_test.sh accepts a page that is right and finds each fault of one
# that is not. A stand-in is the program: it prints its arguments one a line, `fail` exits with 2,
# `package` asks for a package.
# shellcheck disable=SC2016  # the backquotes are those of pages
set -euo pipefail
check=$(dirname "$(readlink -f "$0")")/documentation_test.sh
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

expect 1 nonsense 'an unknown mode' 'text'
exit $((failures > 0))
