# Functions that `run`, `test` and `.ci/run` share. Sourced by bash, not run.
# shellcheck shell=bash

project_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
package_list=$project_root/tools/packages.txt

say() { printf '%s\n' "$*" >&2; }

# The lines of the list that a command needs: listed_packages run|test|ci
listed_packages() {
  local purposes
  case $1 in
    run) purposes='run' ;;
    test) purposes='run|test' ;;
    ci) purposes='run|test|ci' ;;
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

# Installs what is missing: install_packages run|test|ci. Touches no network when nothing is.
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

# Configures build/PRESET when there is nothing there yet or the presets are newer, then builds:
# build_preset PRESET. Changes in the CMake files Ninja notices by itself.
build_preset() {
  local folder=$project_root/build/$1
  if [ ! -f "$folder/build.ninja" ] ||
    [ "$project_root/CMakePresets.json" -nt "$folder/build.ninja" ]; then
    (cd "$project_root" && cmake --preset "$1" -D HOLDFAST_REQUIRE_PACKAGES=ON) || return
  fi
  cmake --build "$folder" --parallel "$(nproc)"
}
