#include "jobs/design/gain_margins.hpp"

#include <cmath>
#include <limits>

#include "case/model/loop_of_case.hpp"
#include "case/model/modal/modal_plant_of_case.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/stability/margins/modal_margins.hpp"
#include "jobs/charts/proved_poles.hpp"
#include "process/errors.hpp"
#include "process/exit.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program {

namespace {

/// Replaces a limit of τ or δ that a step passed over by the nearer limit that the proof found.
void correct_by_proof(StabilityMargins& found, const ProvedMargins& proved, const Case& the_case,
                      const PdGains<double>& gains) {
  const auto poles = loop_poles_of(the_case);
  const Sampling<double> sampling = sampling_of(the_case);
  const auto end = [&](MarginEnd& walked, const ProvedMarginEnd& known, bool of_period) {
    const double value = of_period ? sampling.period : sampling.processing_delay;
    if (std::abs(known.unstable_at - value) < std::abs(walked.position - value))
      walked =
          modal_margin_end(poles, sampling, gains, known.stable_to, known.unstable_at, of_period);
  };
  end(found.sampling_period.below, proved.sampling_period.below, true);
  end(found.sampling_period.above, proved.sampling_period.above, true);
  end(found.processing_delay.below, proved.processing_delay.below, false);
  end(found.processing_delay.above, proved.processing_delay.above, false);
}

/// Whether the proof reaches both limits that the search in steps found, or an unstable loop.
bool reaches(const ProvedMargin& proved, const TwoSidedMargin& walked, double value) {
  const auto one = [&](const ProvedMarginEnd& known, const MarginEnd& end) {
    return end.outcome == MarginEndOutcome::undefined || std::isfinite(known.unstable_at) ||
           std::abs(known.stable_to - value) >= (1.0 - 1e-9) * std::abs(end.position - value);
  };
  return one(proved.below, walked.below) && one(proved.above, walked.above);
}

/// Proves stability for every τ and δ between the case's values and the limits found in steps, for
/// at most a second, and corrects the limits. Does nothing if that time suffices for few steps
/// only.
bool search_by_proof(StabilityMargins& found, const Case& the_case, const PdGains<double>& gains) {
  const Sampling<double> sampling = sampling_of(the_case);
  const auto roots = static_cast<double>(loop_poles_of(the_case).size()) + held_commands(sampling);
  const int steps = static_cast<int>(4e5 / (roots * roots));  // in each direction
  if (steps < 10 || found.outcome != MarginOutcome::stable) return false;
  const auto poles = poles_if_proved(the_case);
  if (poles.empty()) return false;
  const ProvedMargins proved =
      proved_sampling_margins(poles, sampling, gains, found, {1e-5, steps}, throw_if_interrupted);
  const bool everywhere =
      reaches(proved.sampling_period, found.sampling_period, sampling.period) &&
      reaches(proved.processing_delay, found.processing_delay, sampling.processing_delay);
  correct_by_proof(found, proved, the_case, gains);
  return everywhere;
}

}  // namespace

GainMargins gain_margins(const LinearLoop& loop, const PdGains<double>& gains) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (!std::isfinite(gains.proportional) || !std::isfinite(gains.differential))
    return {none, none, none, none, false};
  const LoopMargins margins = loop.whole_margins(gains);
  return {1.0 - margins.unit_circle, 20.0 * std::log10(margins.largest_factor),
          margins.phase * 180.0 / pi<double>, margins.delay.distance,
          margins.delay.outcome == MarginEndOutcome::beyond_search};
}

void warn_of_edge(double spectral_radius, double sampling_period, bool quiet) {
  if (spectral_radius > 1.0 - 1e-6 * std::min(1.0, sampling_period))
    report_warning(
        "the D of least amplitude lies on the boundary of stability (spectral radius 1): give "
        "--margin 0.5 to stay away from this boundary",
        quiet);
}

CaseMargins stability_margins_of(const Case& the_case, const PdGains<double>& gains,
                                 bool of_delay) {
  const LinearLoop loop(the_case);
  StabilityMargins margins = loop.margins(gains, of_delay);
  const bool everywhere = !loop.walks() || search_by_proof(margins, the_case, gains);
  return {margins, everywhere};
}

ProvedMargins proved_margins_of(const Case& the_case, const PdGains<double>& gains,
                                StabilityMargins& found) {
  const ProvedMargins proved = proved_margins(proved_poles_of(the_case), sampling_of(the_case),
                                              gains, found, {}, [] { throw_if_interrupted(); });
  if (proved.stability != ProvedStability::stable)
    throw NoAnswer("the loop is too near instability to be proved stable: leave --prove out");
  if (!has_closed_forms(the_case)) correct_by_proof(found, proved, the_case, gains);
  return proved;
}

}  // namespace holdfast::program
