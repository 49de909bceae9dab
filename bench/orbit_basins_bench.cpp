// Periodic orbits with their certificates, and basins of many initial states.
// Peers of the basins: each state searched for its own orbit, one after another, by the plain
// stepper; and one at a time past the orbits that are known already. All sides alternate in one
// run; the medians and their ratios are printed.
#include <cstdio>
#include <vector>

#include "holdfast/orbit/periodic_orbit.hpp"
#include "holdfast/orbit/region_of_attraction.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/simd/basins.hpp"
#include "medians.hpp"

namespace {

using namespace holdfast;
using States = std::vector<Vector<double, 4>>;

IdealLoop<double> loop_of(double sampling_period, double width) {
  return {kollar2022_plant(), {sampling_period, 0.0}, {-557.0, -13.0}, {0.5, 10.0}, width};
}

/// z₁ and z₂ within ±5 mm, `side` of each.
States states_of(int side) {
  States states;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const double step = 0.01 / (side - 1);
      states.push_back({-0.005 + row * step, 0.0, -0.005 + column * step, 0.0});
    }
  }
  return states;
}

volatile double sink = 0.0;

void orbit(double sampling_period, double width) {
  const IdealLoop<double> loop = loop_of(sampling_period, width);
  const auto found = find_periodic_orbit(loop, Vector<double, 4>::Zero());
  const auto seconds = bench::medians(
      {[&] { sink = find_periodic_orbit(loop, Vector<double, 4>::Zero()).orbit->closure_error; },
       [&] { sink = static_cast<double>(attraction_balls(loop, *found.orbit).size()); },
       [&] { sink = verify_orbit<long double>(loop, *found.orbit).closure_error; }});
  std::printf(
      "%2.0f ms, %.1f mm: orbit of %4ld samples found and verified in %.2f ms (%ld samples from "
      "rest), radius of capture %.2f ms, extended precision %.2f ms\n",
      sampling_period * 1e3, width * 1e3, static_cast<long>(found.orbit->period_samples()),
      seconds[0] * 1e3, static_cast<long>(found.samples), seconds[1] * 1e3, seconds[2] * 1e3);
}

/// Every `stride`-th state by itself.
void one_after_another(const IdealLoop<double>& loop, const States& states,
                       const OrbitLimits& limits, std::size_t stride) {
  for (std::size_t k = 0; k < states.size(); k += stride)
    sink = static_cast<double>(find_periodic_orbit(loop, states[k], limits).samples);
}

void basins(double sampling_period, double width) {
  const IdealLoop<double> loop = loop_of(sampling_period, width);
  const States states = states_of(100);
  constexpr std::size_t stride = 101;
  const OrbitLimits limits{100'000, 0};
  const auto in_turn = [](std::size_t count, std::size_t, const auto& job) { job(0, count); };
  BasinMap map;
  const auto seconds =
      bench::medians({[&] { map = simd::find_basins(loop, states, limits, 1); },
                      [&] { map = simd::find_basins(loop, states, limits, 2); },
                      [&] { map = find_basins<double>(loop, states, limits, in_turn); },
                      [&] { one_after_another(loop, states, limits, stride); }},
                     5);
  const double all = static_cast<double>(states.size());
  const double plain =
      seconds[3] * all / static_cast<double>((states.size() + stride - 1) / stride);
  std::printf(
      "%2.0f ms, %.1f mm: %.0f states, %zu attractors: %.3f s (one core), %.3f s (two), %.3f s "
      "(one "
      "lane); one after another %.1f s: %.0f x\n",
      sampling_period * 1e3, width * 1e3, all, map.attractors.size(), seconds[0], seconds[1],
      seconds[2], plain, plain / seconds[0]);
}

}  // namespace

int main() {
  std::printf("packs of %zu doubles\n", Lanes<simd::Pack<double>>::count);
  for (const auto& [period, width] :
       {std::pair{0.001, 0.0005}, {0.001, 0.002}, {0.003, 0.002}, {0.011, 0.002}}) {
    orbit(period, width);
  }
  for (const auto& [period, width] : {std::pair{0.001, 0.002}, {0.003, 0.002}, {0.011, 0.002}})
    basins(period, width);
}
