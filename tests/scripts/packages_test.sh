#!/usr/bin/env bash
# packages_test.sh SOURCE WORK: install_packages against stand-ins, so that nothing is installed.
set -euo pipefail
source_folder=$1
work=$2
rm -rf "$work"
mkdir -p "$work"

# A world is a folder of commands that is the whole PATH: world NAME; stand_in COMMAND BODY
world() {
  bin=$work/$1
  log=$work/$1.log
  mkdir -p "$bin"
  : >"$log"
  local tool
  for tool in bash env awk grep sed sort comm tr cat dirname; do
    ln -s "$(command -v "$tool")" "$bin/$tool"
  done
}
stand_in() {
  printf '#!/usr/bin/env bash\n%s\n' "$2" >"$bin/$1"
  chmod +x "$bin/$1"
}
apt_get_that_logs() { stand_in apt-get "echo \"apt-get \$* [\${DEBIAN_FRONTEND-}]\" >>'$log'"; }
user_number() { stand_in id "echo $1"; }

# dpkg-query that knows everything asked for, except one package.
all_installed_but() {
  stand_in dpkg-query "shift 2; for package; do
    [ \"\$package\" = '$1' ] && continue; echo \"\$package installed\"; done"
}

# Runs install_packages PURPOSE in the world and keeps exit code and messages.
install_for() {
  code=0
  messages=$(PATH=$bin bash -c "set -euo pipefail; source '$source_folder/tools/build.sh'
    install_packages $1" 2>&1) || code=$?
}

failures=0
expect() {
  if ! eval "$2"; then
    printf 'FAILED: %s\n  exit code %s, messages: %s\n  log: %s\n' \
      "$1" "$code" "$messages" "$(cat "$log")"
    failures=$((failures + 1))
  fi
}
logged() { grep -q -- "$1" "$log"; }

world nothing_missing
apt_get_that_logs && user_number 0 && all_installed_but none
install_for ci
expect 'nothing missing: silent success' '[ $code = 0 ] && [ -z "$messages" ]'
expect 'nothing missing: apt-get is not called' '[ ! -s "$log" ]'

world root
apt_get_that_logs && user_number 0 && all_installed_but libgtest-dev
install_for test
expect 'root: one line says what is installed' \
  '[ $code = 0 ] && [ "$messages" = "Installing with apt-get: libgtest-dev" ]'
expect 'root: lists are updated' 'logged "apt-get update"'
expect 'root: only the missing package, nothing recommended, no questions' \
  'logged "apt-get install --yes --no-install-recommends libgtest-dev \[noninteractive\]"'

install_for_run_log_size=$(wc -c <"$log")
install_for run
expect 'run does not want what only the tests need' \
  '[ $code = 0 ] && [ "$(wc -c <"$log")" = "$install_for_run_log_size" ]'

world known_but_removed
apt_get_that_logs && user_number 0
stand_in dpkg-query 'shift 2; for package; do echo "$package config-files"; done'
install_for run
expect 'a removed package whose settings remain is missing' 'logged "install .*libeigen3-dev"'

world sudo
apt_get_that_logs && user_number 1000 && all_installed_but cmake
stand_in sudo "echo sudo >>'$log'; exec \"\$@\""
install_for run
expect 'not root: through sudo' '[ $code = 0 ] && logged sudo && logged "install .*cmake"'

world neither_root_nor_sudo
apt_get_that_logs && user_number 1000 && all_installed_but cmake
install_for run
expect 'neither root nor sudo: says so, exit code 2' \
  '[ $code = 2 ] && [[ $messages == *cmake*sudo* ]] && [ ! -s "$log" ]'

world installation_fails
user_number 0 && all_installed_but cmake
stand_in apt-get 'exit 100'
install_for run
expect 'failed installation: says so, exit code 2' \
  '[ $code = 2 ] && [[ $messages == *"could not install: cmake"* ]]'

world no_apt_get
install_for test
expect 'no apt-get: list of what is needed, exit code 2' \
  '[ $code = 2 ] && [[ $messages == *GoogleTest* && $messages == *"Eigen 3.4"* ]]'
expect 'no apt-get: the list leaves out what only ci needs' '[[ $messages != *clang-tidy* ]]'

[ "$failures" = 0 ] && echo 'package check: all as expected'
