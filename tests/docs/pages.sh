# What the checks of the documentation share. It is sourced, after $work (a folder) and $program are set.
# shellcheck shell=bash
seconds_allowed=120

failures=0
failed() {
  printf 'FAILED: %s\n' "$1" >&2
  failures=$((failures + 1))
}

# Makes $work a fresh folder with data/, a copy of $1/data, and `holdfast` the program.
begin_work() {
  rm -rf "$work" "$work.bin"
  mkdir -p "$work" "$work.bin"
  ln -s "$program" "$work.bin/holdfast"
  if [[ -d $1/data ]]; then
    cp -r "$1/data" "$work/data"
  fi
}

# Runs the command line $1 in $work; its standard output, without the CR of CSV's line ends, is
# added to the file $2, its standard error is $work.errors, its exit code $code.
run_in_work() {
  code=0
  (cd "$work" && PATH=$work.bin:$PATH timeout "$seconds_allowed" bash -o pipefail -c "$1") \
    >"$work.raw" 2>"$work.errors" </dev/null || code=$?
  tr -d '\r' <"$work.raw" >>"$2"
}

# Whether the command just run failed since the build lacks a package.
asks_for_package() {
  [[ $code == 1 ]] && grep -q 'install the package lib' "$work.errors"
}

# The block <!-- file $1 --> with the text $2 at the place $3.
write_marked_file() {
  if [[ $1 == */* || $1 == .* ]]; then
    failed "$3: '$1' is not the name of a file in the folder"
  else
    printf '%s' "$2" >"$work/$1"
  fi
}

# The block <!-- change $1 --> with the text $2 at the place $3.
change_marked_file() {
  local line key
  while IFS= read -r line; do
    key=${line%% = *}
    if [[ ! $key =~ ^[a-z_0-9]+$ || $(grep -c "^$key = " "$work/$1") != 1 ]]; then
      failed "$3: '$line' is not the change of one line of $1"
      continue
    fi
    awk -v key="$key = " -v line="$line" 'index($0, key) == 1 { $0 = line } { print }' \
      "$work/$1" >"$work/$1.new"
    mv "$work/$1.new" "$work/$1"
  done < <(printf '%s' "$2")
}
