#include "explorer/live_charts.hpp"

#include <limits>

#include "case/model/linear_loop.hpp"
#include "case/model/modal/modal_plant_of_case.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/core/types.hpp"
#include "jobs/charts/chart_rows.hpp"
#include "kernels/instruction_set.hpp"

namespace holdfast::program {
namespace {

/// Steady amplitude (m) of a stable loop without play; NaN for two samples or fewer per period.
double controlled_amplitude(const Case& the_case, const LinearLoop& loop, double frequency) {
  if (!(2.0 * frequency * the_case.control.sampling_period < 1.0))
    return std::numeric_limits<double>::quiet_NaN();
  return excitation_of(the_case).amplitude *
         loop.response(frequency).amplitude_per_force(gains_of(the_case));
}

}  // namespace

std::vector<std::uint8_t> stable_cells(const Case& the_case, const GainGrid& grid) {
  std::vector<std::uint8_t> cells(
      static_cast<std::size_t>(grid.proportional.count * grid.differential.count));
  fill_chart(stability_chart_of(the_case, grid, false, InstructionSet::baseline),
             {static_cast<std::size_t>(grid.differential.count), cells.data(), {}}, 1);
  return cells;
}

Amplitudes amplitudes_over(const Case& the_case, const Axis& frequencies) {
  const LinearLoop loop(the_case);
  Amplitudes amplitudes{loop.radius(gains_of(the_case)) < 1.0, {}};
  for (std::int64_t k = 0; k < frequencies.count; ++k) {
    const double frequency = frequencies.at(k);
    const double controlled = amplitudes.stable ? controlled_amplitude(the_case, loop, frequency)
                                                : std::numeric_limits<double>::quiet_NaN();
    amplitudes.at.push_back({frequency, controlled,
                             excitation_of(the_case).amplitude *
                                 true_amplitude_of(the_case, 2.0 * pi<double> * frequency)});
  }
  return amplitudes;
}

}  // namespace holdfast::program
