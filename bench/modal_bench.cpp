// Charts of stable gains of loops of many modes: the resolved circle.
// Peer: eigenvalues of the loop's map, cell by cell, by Eigen; on some cells, scaled to all. The
// sides alternate in one run; medians and their ratio are printed, with the cells in which they
// differ.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "holdfast/cable/taut_string.hpp"
#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/stability/chart/circle_chart.hpp"
#include "medians.hpp"

namespace {

using namespace holdfast;

/// The paper's conductor as a taut string, the absorber on a clamp of 10 g.
LinearPlant<double> string_plant(int modes) {
  return modal_plant<double>(string_modes(taut_string(kollar2022_conductor()), 0.64, modes),
                             {0.16, 74.4, 4.0, 0.010});
}

void chart_of(int modes) {
  const LinearPlant<double> plant = string_plant(modes);
  const Sampling<double> sampling{0.001, 0.0};
  const GainGrid grid{{-1000.0, 200.0, 121}, {-40.0, 20.0, 121}};
  const LoopMap<double> map = loop_map(plant, sampling);
  const std::int64_t compared = modes > 100 ? 3 : 100;
  std::vector<std::uint8_t> chart;
  std::vector<double> radii(static_cast<std::size_t>(compared));
  const auto cell_of = [&](std::int64_t k) { return k * 7919 % grid.cells(); };
  const auto time =
      bench::medians({[&] {
                        chart = stability_chart(ResolvedCircle<double>({plant, sampling}), grid);
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

}  // namespace

int main() {
  std::printf("121 x 121 gains, one core (s); medians\n");
  std::printf("  %5s %12s %14s %10s %12s\n", "modes", "circle", "eigenvalues", "ratio",
              "different");
  for (const int modes : {2, 10, 40, 100, 200}) chart_of(modes);
}
