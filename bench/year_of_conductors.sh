#!/usr/bin/env bash
# The gains that each conductor of the library may have all year, proved; see --help.
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: year_of_conductors.sh PROGRAM [MODES]

Strings each conductor that the program at the path PROGRAM knows with 20 % of its rated strength at
15 °C over 350 m, and proves an interval of D for -30 to 80 °C and P = 0. The absorber has the mass of
3 m of the conductor, is tuned to its 20th mode and hangs 4 m from the support; the computer samples
every millisecond. MODES is the number of modes (default 40). Prints a row of CSV for each conductor.
TEXT
}

case ${1-} in
  -h | --help) usage && exit 0 ;;
  '') usage >&2 && exit 2 ;;
esac

# proved_interval PROGRAM MODES NAME MASS_PER_LENGTH STRENGTH
proved_interval() {
  local values interval
  values=$(awk -v mu="$4" -v strength="$5" 'BEGIN {
    tension = 0.2 * strength; mass = 3 * mu; omega = 6.283185307 * 20 / 700 * sqrt(tension / mu)
    printf "%.6g %.6g %.6g %.6g", tension, mass, mass * omega ^ 2, 0.2 * mass * omega
  }')
  read -r tension mass stiffness damping <<<"$values"
  interval=$("$1" boundary --stable-interval --family --prove --draws 12 --p 0 --threads 1 --quiet \
    --set conductor.name="$3" --set conductor.span=350 --set conductor.damping_ratio=1e-3 \
    --set stringing.temperature=15 --set stringing.tension="$tension" --set plant.model=string \
    --set plant.modes="$2" --set absorber.mass="$mass" --set absorber.position=4 \
    --set plant.absorber_stiffness="$stiffness" --set plant.absorber_damping="$damping" \
    --set control.sampling_period=0.001 --set 'uncertain.weather.temperature=[-30, 80]' |
    sed -n '2{s/^[^,]*,[^,]*,//;s/,[^,]*$//;p}')
  printf '"%s",%s,%s\n' "$3" "$tension" "$interval"
}
export -f proved_interval

echo 'conductor,tension_N,lower_N_s_per_m,upper_N_s_per_m'
"$1" conductors --quiet | awk -F, 'NR > 1 { printf "%s\n%s\n%s\n", $1, $3, $6 }' |
  xargs -d '\n' -n 3 -P "$(nproc)" bash -c 'proved_interval "$0" "$@"' "$1" "${2-40}"
