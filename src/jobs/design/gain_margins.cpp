#include "jobs/design/gain_margins.hpp"

#include <cmath>
#include <limits>

#include "case/model/modal/modal_plant_of_case.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/stability/margins/loop_margins.hpp"
#include "holdfast/stability/margins/modal_margins.hpp"

namespace holdfast::program {

GainMargins gain_margins(const Case& the_case, const PdGains<double>& gains) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (!std::isfinite(gains.proportional) || !std::isfinite(gains.differential))
    return {none, none, none, none, false};
  const Sampling<double> sampling = sampling_of(the_case);
  const LoopMargins margins = is_modal(the_case)
                                  ? modal_loop_margins(loop_poles_of(the_case), sampling, gains)
                                  : loop_margins(plant_of(the_case), sampling, gains);
  return {1.0 - margins.unit_circle, 20.0 * std::log10(margins.largest_factor),
          margins.phase * 180.0 / pi<double>, margins.delay.distance,
          margins.delay.outcome == MarginEndOutcome::beyond_search};
}

StabilityMargins stability_margins_of(const Case& the_case, const PdGains<double>& gains) {
  const Sampling<double> sampling = sampling_of(the_case);
  if (!is_modal(the_case)) return stability_margins(plant_of(the_case), sampling, gains);
  MarginSearch search;
  search.longest_period_ratio = 100.0;
  return modal_stability_margins(loop_poles_of(the_case), sampling, gains, search);
}

}  // namespace holdfast::program
