// How much of the vibration does control leave, over the sampling period and the backlash?
#include <cstdio>
#include <vector>

#include "holdfast/core/axis.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/sweep/metric_batch.hpp"

int main() {
  using namespace holdfast;
  const Axis periods{0.002, 0.010, 5}, widths{0.0, 0.003, 7};  // τ (s), r₀ (m)
  const IdealLoop<double> free{kollar2022_plant(), {}, {0.0, 0.0}, {0.5, 10.0}};
  std::vector<SweepMotion> motions;  // of each period one without control, then one of each width
  for (int i = 0; i < periods.count; ++i) {
    motions.push_back({free, Vector<double, 4>::Zero()});
    motions.back().loop.sampling.period = periods.at(i);
    for (int j = 0; j < widths.count; ++j) {
      motions.push_back(motions.back());
      motions.back().loop.gains = {-557.0, -13.0};
      motions.back().loop.backlash_width = widths.at(j);
    }
  }
  std::vector<MotionMetrics> metrics(motions.size());
  motion_metrics<double>(motions.data(), motions.size(), 40.0, metrics.data());

  std::printf("r0 (mm)     ");
  for (int j = 0; j < widths.count; ++j) std::printf("%7.1f", 1e3 * widths.at(j));
  const auto columns = static_cast<std::size_t>(widths.count) + 1;
  for (std::size_t k = 0; k < metrics.size(); ++k) {
    const double without_control = metrics[k - k % columns].steady_rms;
    if (k % columns == 0)
      std::printf("\ntau = %2.0f ms:", 1e3 * motions[k].loop.sampling.period);
    else
      std::printf(" %4.0f %%", 100.0 * metrics[k].steady_rms / without_control);
  }
  std::printf("\n");
}
