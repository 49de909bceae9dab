#!/usr/bin/env bash
# Runs every job of the program once with a small question, most often under a tool that watches it:
#
#   every_job.sh [--threads | --without-packages | --short] [WRAPPER ...] PROGRAM
#
#   --threads           only the jobs that use threads
#   --without-packages  leaves out what SUNDIALS, Ceres Solver and netCDF are needed for
#   --short             leaves out the report
#
# Fails where a job does, and where the program has a job that is not asked anything here.
set -euo pipefail

only=all
case ${1-} in
  --threads) only=threads && shift ;;
  --without-packages) only=plain && shift ;;
  --short) only=short && shift ;;
esac
command=("$@")
program=$(realpath "${command[-1]}")
command[-1]=$program

# Kind, then the words: f follows one whose output it reads, t threads, p needs a package, l takes long,
# w needs the explorer's page, which is built apart, a any other.
questions='
t stability --p -600:0:7 --d -20:0:5 --radius
t stability --axis plant.absorber_mass=0.1:0.2:3 --axis control.differential_gain=-9:0:3
a stability --continuous --p -600:0:3 --d -20:0:3
a stability --prove --p -600:0:7 --d -20:0:5 --undecided 0.01
a stability --prove --p -600:0:7 --d -20:0:5 --undecided 0.01 --set plant.model=string --set plant.modes=10
a boundary --p -600:0
a boundary --regions
a boundary --stable-interval
a response --p -600:0:3 --d -20:0:3
t max-delay --frequency 5:8:3 --threads 3
a max-delay --frequency 10:12:2 --criterion stable --prove
a margins --prove
a design
t design --frequency 5:10:3 --threads 3
a design --band 9:11
a margins
t stability --set plant.model=string --set plant.modes=10 --p -600:0:7 --d -20:0:5 --radius
a boundary --stable-interval --set plant.model=string --set plant.modes=10
a modal-damping --set plant.model=string --set plant.modes=10
a simulate --duration 0.2 --set plant.model=string --set plant.modes=10
a simulate --duration 0.05 --switching exact --set plant.model=string --set plant.modes=4
a absorption --frequency 5:20:4 --set conductor.name=Drake --set conductor.span=300 --set conductor.tension=28020 --set site.weibull_scale=5 --set device.1.kind=dashpot --set device.1.position=1.5 --set device.1.damping=200
a aeolian --frequency 5:20:4 --set conductor.name=Drake --set conductor.span=300 --set conductor.tension=28020 --set site.weibull_scale=5 --set device.1.kind=dashpot --set device.1.position=1.5 --set device.1.damping=200
a fatigue --set conductor.name=Drake --set conductor.span=300 --set conductor.tension=28020 --set site.weibull_scale=5 --set device.1.kind=dashpot --set device.1.position=1.5 --set device.1.damping=200
a modal-damping --count 5 --set conductor.name=Drake --set conductor.span=300 --set conductor.tension=28020 --set site.weibull_scale=5 --set device.1.kind=dashpot --set device.1.position=1.5 --set device.1.damping=200
a sensitivity
a simulate --duration 0.5
a simulate --duration 0.2 --switching exact
a simulate --duration 0.2 --set backlash.law=play
a simulate --duration 0.2 --set backlash.law=dead_zone --set backlash.contact_stiffness=1000
a spectrum --duration 2
a deviation --duration 0.5 --offset 1e-5
a coverage --durations 1,2
a section --duration 1 --from 0.2
a diagram --axis backlash.width=0.0001:0.001:3
a lyapunov --duration 0.5
a lyapunov --duration 0.2 --switching exact
a orbit --certificate
a orbit --prove
a orbit --prove --switching exact
a orbit --switching exact
a orbit --map backlash.width=0.0004:0.0006 --map control.differential_gain=-14:-12
a basins --map backlash.width=0.001:0.002:3 --map control.sampling_period=0.01:0.011:2
a verdict
t basins --axis initial.z1=-0.005:0.005:5 --axis initial.z2=-0.005:0.005:5 --threads 3
t sweep --axis backlash.width=0:0.001:5 --axis control.sampling_period=0.001,0.002 --duration 0.5 --threads 3 --output sweep.csv
p sweep --axis backlash.width=0:0.001:5 --duration 0.5 --threads 2 --output sweep.nc
t sweep --axis backlash.width=0:0.001:5 --axis initial.z1=0:0.001:9 --duration 0.5 --threads 3 --chunk 4 --output sweep.zarr
t stability --p -600:0:70 --d -20:0:5 --radius --threads 3 --output chart.zarr
f convert sweep.zarr of-store.csv
a sag-tension --set conductor.name=Drake --set conductor.span=300 --set stringing.temperature=15 --set stringing.tension=28e3
a statics --force -1:1:3 --elements 8
a modes --count 2 --elements 8
p decay --duration 0.1 --elements 8
p peaks --force 1:1:1 --elements 8
p reduce
p fit --data decay.csv
a case
a case --check case.toml
a conductors --find drake
p place --for damping --frequency 5:10:3 --set device.1.kind=dashpot --set device.1.position=0.5 --set device.1.damping=1
a answers
l report --output report
l report --for span --case acsr-drake-300m-dampers.toml --output span-report
w explore --output explorer.html
a manual
a completion bash
a bill-of-materials
'

asked() { awk 'NF { print $2 }' <<<"$questions" | sort -u; }
known() { "$program" --help | awk '/:$/ { jobs = $0 !~ /^(Usage|Options|Examples)/ } jobs && /^  [a-z]/ { print $1 }' | sort -u; }

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
data=$(dirname "$0")/../../data
cp "$data/kollar2022-decay.csv" "$work/decay.csv"
cp "$data/kollar2022.toml" "$work/case.toml"
cp "$data/acsr-drake-300m-dampers.toml" "$work"

missing=$(comm -13 <(asked) <(known) | tr '\n' ' ')
if [ -n "$missing" ]; then
  echo "no question for: $missing" >&2
  exit 1
fi

# Asks one question, in the folder of all and with output files of its own: ask NUMBER WORDS ...
ask() {
  local number=$1
  shift
  if ! (cd "$work" && "${command[@]}" "$@" >"out.$number" 2>"err.$number" </dev/null); then
    { printf 'FAILED: %s\n' "$*" && head -40 "$work/err.$number"; } >"$work/failed.$number"
  fi
}

count=0
while read -r kind words; do
  case $only:$kind in
    *: | threads:[afplw] | plain:p | short:l) continue ;;
    *:w) [ -f "$(dirname "$program")/../../wasm/explorer.html" ] || continue ;;
  esac
  read -ra arguments <<<"$words"
  count=$((count + 1))
  if [ "$kind" = f ]; then wait; elif [ "$(jobs -r | wc -l)" -ge "$(nproc)" ]; then wait -n || true; fi
  ask "$count" "${arguments[@]}" &
done <<<"$questions"
wait
failures=$(find "$work" -maxdepth 1 -name 'failed.*' | wc -l)
find "$work" -maxdepth 1 -name 'failed.*' -exec cat {} +
printf '%d questions, %d failures\n' "$count" "$failures"
[ "$failures" -eq 0 ]
