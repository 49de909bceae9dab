#!/usr/bin/env bash
# CPU seconds of each job of a conductor by its modes at 50 to 800 of them; see --help.
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: mode_scaling.sh PROGRAM [CASE [RUNS]]

Times the jobs of the program at the path PROGRAM on a conductor by 50, 100, 200, 400 and 800 of its
modes, and says with which power of their number the time grows between the last two of them.

  CASE  a case file with conductor and absorber (default: the line of data/acsr-drake-300m.toml)
  RUNS  runs of each, the median of which counts (default 3)
TEXT
}

case ${1-} in
  -h | --help) usage && exit 0 ;;
  '') usage >&2 && exit 2 ;;
esac
program=$1 case=${2-"$(dirname "${BASH_SOURCE[0]}")/../data/acsr-drake-300m.toml"} runs=${3-3}
counts=(50 100 200 400 800)
loop=(--case "$case" --quiet --set plant.model=string --set plant.absorber_stiffness=12580
  --set plant.absorber_damping=30 --set control.proportional_gain=-2000
  --set control.differential_gain=-30 --set control.sampling_period=0.002)
jobs=('case' 'boundary --stable-interval' 'stability --p -4000:0:40 --d -60:0:40' 'margins' 'design'
  'design --both-gains' 'max-delay --frequency 21:21:1' 'response --p -2000:-2000:1 --d -60:0:41' 'simulate --duration 20'
  'modal-damping' 'verdict' 'answers')

# cpu_seconds COMMAND…: of the user and the system together, the median of all runs
cpu_seconds() {
  local TIMEFORMAT='%U %S' run
  for ((run = 0; run < runs; ++run)); do
    { time "$@" >/dev/null 2>&1; } 2>&1
  done | awk '{ print $1 + $2 }' | sort -g | awk '{ all[NR] = $1 } END { print all[int((NR + 1) / 2)] }'
}

printf '%-40s' 'job, CPU seconds of modes:'
printf '%9s' "${counts[@]}" exponent
printf '\n'
for job in "${jobs[@]}"; do
  printf '%-40s' "$job"
  times=()
  for count in "${counts[@]}"; do
    # shellcheck disable=SC2086
    times+=("$(cpu_seconds "$program" $job "${loop[@]}" --set plant.modes="$count")")
    printf '%9.3f' "${times[-1]}"
  done
  awk -v before="${times[-2]}" -v last="${times[-1]}" 'BEGIN { printf "%9.2f\n", log(last / before) / log(2) }'
done
