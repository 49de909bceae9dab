#!/usr/bin/env bash
# Code and options that must not compile, and what the compiler says of them:
# refused_code_test.sh COMPILER SOURCE_FOLDER
#
# A mistake in a user's own type is told in one sentence, which stands in the first error, and not by
# all that the headers would have made of it: `most_lines` at most, notes and quoted lines included.
# Every header reads core/compiler.hpp, so that no option it refuses goes by.
set -uo pipefail
compiler=$1 source=$2
most_lines=25
failures=0
complain() {
  printf '%s\n' "$*"
  failures=$((failures + 1))
}

# refuses SENTENCE [OPTION ...] <<<CODE
refuses() {
  local sentence=$1 said lines first
  shift
  said=$("$compiler" -std=c++17 -fsyntax-only -I "$source/include" -isystem /usr/include/eigen3 "$@" -x c++ - 2>&1)
  if [ $? -eq 0 ]; then
    complain "compiles, where \"$sentence\" is to be said"
    return
  fi
  first=$(grep -m1 'error: ' <<<"$said")
  [[ $first == *"$sentence"* ]] || complain "says not \"$sentence\" but \"$first\""
  lines=$(wc -l <<<"$said")
  [ "$lines" -le "$most_lines" ] || complain "needs $lines lines for \"$sentence\""
}

compiles() {
  "$compiler" -std=c++17 -fsyntax-only -I "$source/include" -isystem /usr/include/eigen3 "$@" -x c++ - ||
    complain "does not compile with $*"
}

# ---- options ------------------------------------------------------------------------------------
for option in -ffast-math -Ofast -ffinite-math-only; do
  refuses 'holdfast does not compile under -ffast-math' "$option" <<<'#include "holdfast/core/version.hpp"'
done
refuses 'compile the files that include it without -fno-exceptions' -fno-exceptions <<<'#include "holdfast/core/version.hpp"'
compiles -Ofast -fno-fast-math <<<'#include "holdfast/core/errors.hpp"'

for header in $(cd "$source/include" && find . -name '*.hpp'); do
  grep -qE '^#include "holdfast/' "$source/include/$header" || [ "$header" = ./holdfast/core/compiler.hpp ] ||
    complain "$header reads no header of the library: core/compiler.hpp at least"
done

# ---- types --------------------------------------------------------------------------------------
refuses 'the numbers of a plant are real' <<'CODE'
#include "holdfast/plant/two_mass.hpp"
holdfast::TwoMass<int> plant{};
CODE
refuses 'a gain is a real number' <<'CODE'
#include "holdfast/control/gains.hpp"
holdfast::PdGains<int> gains{};
CODE
refuses 'a time is a real number' <<'CODE'
#include "holdfast/control/sampled_loop.hpp"
holdfast::Sampling<int> sampling{1};
CODE

own_plant='
struct OwnPlant {
  using Matrix = Eigen::Matrix<double, 6, 6>;
  using Column = Eigen::Matrix<double, 6, 1>;
  Matrix state_matrix() const { return Matrix::Zero(); }
  Column control_input() const { return Column::Zero(); }
  Column excitation_input() const { return Column::Zero(); }
};'
refuses 'declares its measured quantities by `ports()`' <<CODE
#include "holdfast/control/loop_map.hpp"
$own_plant
auto map = holdfast::loop_map(OwnPlant{}, {0.01});
CODE
refuses 'use a TwoMass, a LinearPlant or with_controller()' <<CODE
#include "holdfast/motion/implemented_loop.hpp"
$own_plant
holdfast::ImplementedLoopOf<OwnPlant> loop{};
CODE
refuses 'use a TwoMass, a LinearPlant or with_controller()' <<CODE
#include "holdfast/motion/ideal_loop.hpp"
$own_plant
holdfast::IdealLoop<double, OwnPlant> loop{};
CODE

refuses 'the state of a plant is a column vector, one number per state variable' <<'CODE'
#include "holdfast/motion/implemented_loop.hpp"
auto begin(const holdfast::ImplementedLoop& loop) {
  return holdfast::event_motion(loop, Eigen::Matrix<double, 6, 1>::Zero());
}
CODE
refuses 'the state of a plant is a column vector, one number per state variable' <<'CODE'
#include "holdfast/motion/ideal_loop.hpp"
auto begin(const holdfast::IdealLoop<double>& loop) {
  return holdfast::harmonically_forced_motion(loop, Eigen::Vector3d(1.0, 2.0, 3.0));
}
CODE
refuses 'the state of a plant is a column vector, one number per state variable' <<'CODE'
#include "holdfast/orbit/orbit_search.hpp"
auto find(const holdfast::IdealLoop<double>& loop) {
  return holdfast::find_periodic_orbit(loop, Eigen::RowVector4d(1.0, 2.0, 3.0, 4.0));
}
CODE

refuses 'a controller declares its number of states' <<'CODE'
#include "holdfast/control/controlled_plant.hpp"
struct Law {
  double command(const holdfast::ControlSample&, Eigen::Matrix<double, 1, 1>&) const { return 0.0; }
};
auto plant = holdfast::with_controller(holdfast::kollar2022_plant(), Law{});
CODE
refuses 'a controller has `double command' <<'CODE'
#include "holdfast/control/controlled_plant.hpp"
struct Law {
  static constexpr int states = 1;
  double command(const holdfast::ControlSample&, Eigen::Matrix<double, 1, 1>& x) { return x[0] += 1.0; }
};
auto plant = holdfast::with_controller(holdfast::kollar2022_plant(), Law{});
CODE
refuses 'a controller has `double command' <<'CODE'
#include "holdfast/control/controlled_plant.hpp"
struct Law {
  static constexpr int states = 1;
  double command(const holdfast::ControlSample&, Eigen::Matrix<double, 2, 1>& x) const { return x[0]; }
};
holdfast::OwnController own{Law{}};
CODE

printf '%d failures\n' "$failures"
[ "$failures" -eq 0 ]
