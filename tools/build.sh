# Functions that `run`, `test` and `.ci/run` share. Sourced by bash, not run.
# shellcheck shell=bash

project_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
package_list=$project_root/tools/packages.txt

say() { printf '%s\n' "$*" >&2; }

# The lines of the list that a command needs: listed_packages run|explorer|test|ci
listed_packages() {
  local purposes
  case $1 in
    run) purposes='run' ;;
    explorer) purposes='run|explorer' ;;
    test) purposes='run|test' ;;
    ci) purposes='run|explorer|test|ci' ;;
  esac
  grep -E "^($purposes) " "$package_list"
}

missing_packages() {
  local wanted installed
  wanted=$(listed_packages "$1" | awk '{ print $2 }' | sort -u)
  # dpkg-query fails for names that it has never heard of; those are missing all the same.
  # shellcheck disable=SC2086
  installed=$(dpkg-query -W -f='${Package} ${db:Status-Status}\n' $wanted 2>/dev/null |
    awk '$2 == "installed" { print $1 }' | sort -u)
  comm -23 <(printf '%s\n' "$wanted") <(printf '%s\n' "$installed")
}

# Installs what is missing: install_packages run|explorer|test|ci. Touches no network when nothing is.
# Returns 2 where it cannot.
install_packages() {
  if ! command -v apt-get >/dev/null; then
    say "This system has no apt-get, so the following must be installed by hand:"
    listed_packages "$1" | sed -E 's/^[a-z]+ +[^ ]+ +/  /' >&2
    say "Then: cmake --preset release && cmake --build --preset release (tests: preset dev, ctest --preset dev)"
    return 2
  fi
  local missing
  missing=$(missing_packages "$1" | tr '\n' ' ')
  missing=${missing% }
  [ -n "$missing" ] || return 0

  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      say "Missing packages: $missing. Installing them needs root or sudo: apt-get install $missing"
      return 2
    fi
    as_root=(sudo)
  fi
  say "Installing with apt-get: $missing"
  # A stale or partly unreachable package list may still do; the installation decides.
  "${as_root[@]}" apt-get update >&2 || true
  # shellcheck disable=SC2086
  if ! "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install --yes --no-install-recommends $missing >&2; then
    say "apt-get could not install: $missing"
    return 2
  fi
}

# A time in words: duration SECONDS
duration() {
  if [ "$1" -lt 60 ]; then printf '%d s' "$1"; else printf '%d min %d s' $(($1 / 60)) $(($1 % 60)); fi
}

# Shows Ninja's lines as one, which a terminal sees move and a file gets every half minute; all other
# output passes. NAME is what is built: COMMAND 2>&1 | show_progress NAME
show_progress() {
  local name=$1 begin=$SECONDS shown=0 code line text='' built=0 steps=0 now left step clear=''
  [ ! -t 2 ] || clear=$'\r\e[K'
  while true; do
    code=0
    IFS= read -r -t 1 line || code=$?
    text+=$line
    if [ "$code" -eq 0 ]; then
      if [[ $text =~ ^\ *\[([0-9]+)/([0-9]+)\] ]]; then
        built=${BASH_REMATCH[1]} steps=${BASH_REMATCH[2]}
      elif [ "$text" != 'ninja: no work to do.' ]; then
        printf '%s%s\n' "$clear" "$text" >&2
      fi
      text=''
    elif [ "$code" -le 128 ]; then
      break
    fi
    now=$((SECONDS - begin))
    if [ -z "$clear" ] && [ $((now - shown)) -lt 30 ]; then continue; fi
    shown=$now left='' step=''
    [ "$built" -eq 0 ] || step="step $built of $steps, "
    # The steps differ by much, hence "about", and nothing before there is something to go by.
    if [ "$built" -gt 1 ] && [ $((10 * built)) -ge "$steps" ]; then
      left=", about $(duration $((now * (steps - built) / built))) left"
    fi
    printf '%s%s: %s%s%s' "$clear" "$name" "$step" "$(duration "$now")" "$left" >&2
    [ -n "$clear" ] || printf '\n' >&2
  done
  printf '%s%s' "$clear" "$text" >&2
  [ "$built" -lt 2 ] || say "$name: $built of $steps steps in $(duration $((SECONDS - begin)))"
}

# Configures build/PRESET when there is nothing there yet or the presets are newer, then builds all of it
# or the targets that are named: build_preset PRESET [TARGET ...]. Changes in the CMake files Ninja
# notices by itself.
build_preset() {
  local preset=$1 folder=$project_root/build/$1
  shift
  if [ ! -f "$folder/build.ninja" ] ||
    [ "$project_root/CMakePresets.json" -nt "$folder/build.ninja" ]; then
    (cd "$project_root" && cmake --preset "$preset" -D HOLDFAST_REQUIRE_PACKAGES=ON --log-level=NOTICE) || return
  fi
  cmake --build "$folder" --parallel "$(nproc)" ${1:+--target "$@"} 2>&1 | show_progress "build/$preset"
}

# The Python that PYTHON names, else the newest that has the module venv.
newest_python() {
  local python
  for python in ${PYTHON-} python3.14 python3.13 python3.12 python3; do
    if "$python" -m venv --help >/dev/null 2>&1; then echo "$python" && return; fi
  done
  say 'Python 3.9 or newer with the module venv is missing (tools/packages.txt)'
  return 2
}
