// Loops of many modes. Charts of stable gains by the resolved circle; peer: eigenvalues of the
// loop's map, cell by cell, by Eigen, on some cells, scaled to all. Motions with play by natural
// motions; peer: the dense stepper of the same plant. The sides alternate in one run; medians and
// their ratio are printed, with the cells in which the charts differ.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "holdfast/cable/taut_string.hpp"
#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/motion/modal/modal_motion.hpp"
#include "holdfast/motion/trajectory.hpp"
#include "holdfast/stability/chart/circle_chart.hpp"
#include "medians.hpp"

namespace {

using namespace holdfast;

/// The paper's conductor as a taut string.
std::vector<PlaceMode<double>> string_of(int modes) {
  return string_modes(taut_string(kollar2022_conductor()), 0.64, modes);
}

/// On a clamp of 10 g.
constexpr Absorber<double> absorber{0.16, 74.4, 4.0, 0.010};

void chart_of(int modes) {
  const auto places = string_of(modes);
  const Sampling<double> sampling{0.001, 0.0};
  const GainGrid grid{{-1000.0, 200.0, 121}, {-40.0, 20.0, 121}};
  const LoopMap<double> map = loop_map(modal_plant(places, absorber), sampling);
  const std::int64_t compared = modes > 100 ? 3 : 100;
  std::vector<std::uint8_t> chart;
  std::vector<double> radii(static_cast<std::size_t>(compared));
  const auto cell_of = [&](std::int64_t k) { return k * 7919 % grid.cells(); };
  const auto time = bench::medians(
      {[&] {
         chart = stability_chart(
             UnitCircleCrossings<double>(modal_response(places, absorber, sampling)), grid);
       },
       [&] {
         for (std::int64_t k = 0; k < compared; ++k) {
           const std::int64_t cell = cell_of(k), width = grid.differential.count;
           radii[static_cast<std::size_t>(k)] =
               spectral_radius(map.closed_map(grid.at(cell / width, cell % width)));
         }
       }},
      modes > 100 ? 3 : bench::usual_repetitions);
  int different = 0;
  for (std::int64_t k = 0; k < compared; ++k) {
    const double radius = radii[static_cast<std::size_t>(k)];
    const bool stable = chart[static_cast<std::size_t>(cell_of(k))] == 1;
    if (std::abs(radius - 1.0) > 1e-9 && stable != (radius < 1.0)) ++different;
  }
  const double dense = time[1] / static_cast<double>(compared) * static_cast<double>(grid.cells());
  std::printf("  %5d %12.4f %14.1f %10.0f %12d\n", modes, time[0], dense, dense / time[0],
              different);
}

void motion_of(int modes) {
  const ModalLoop loop{string_of(modes), absorber, {0.001, 0.0},      {-557.0, -4.0},
                       {0.5, 10.0},      0.0005,   ForceHold::sampled};
  const ModalMotion::Full rest = ModalMotion::Full::Zero(2 * modes + 2);
  auto motion = modal_motion(loop, rest);
  auto dense = harmonically_forced_motion(
      IdealLoop<double, LinearPlant<double>>{modal_plant(loop.modes, loop.absorber), loop.sampling,
                                             loop.gains, loop.excitation, loop.backlash_width,
                                             loop.hold},
      rest);
  const std::int64_t samples = 4000000 / modes, fewer = std::max<std::int64_t>(20, samples / modes);
  const auto time = bench::medians(
      {[&] { run_trajectory(*motion, samples, {}); }, [&] { run_trajectory(dense, fewer, {}); }});
  const double ns = 1e9 * time[0] / static_cast<double>(samples);
  const double dense_ns = 1e9 * time[1] / static_cast<double>(fewer);
  std::printf("  %5d %12.1f %14.1f %10.1f\n", modes, ns, dense_ns, dense_ns / ns);
}

}  // namespace

int main() {
  std::printf("a sample with play, one core (ns); medians\n");
  std::printf("  %5s %12s %14s %10s\n", "modes", "natural", "dense", "ratio");
  for (const int modes : {10, 40, 100, 200, 400}) motion_of(modes);
  std::printf("121 x 121 gains, one core (s); medians\n");
  std::printf("  %5s %12s %14s %10s %12s\n", "modes", "circle", "eigenvalues", "ratio",
              "different");
  for (const int modes : {2, 10, 40, 100, 200}) chart_of(modes);
}
