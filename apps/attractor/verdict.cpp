#include <limits>

#include "case/model/conditioning.hpp"
#include "case/model/modal/modes_warning.hpp"
#include "case/model/moving_loop.hpp"
#include "holdfast/chaos/modal_classification.hpp"
#include "holdfast/chaos/motion_classification.hpp"
#include "job.hpp"

namespace holdfast::program {
namespace {

/// A number read from an optional part; NaN if there is no such part.
template <class Part, class Read>
double known(const std::optional<Part>& part, const Read& read) {
  return part ? read(*part) : std::numeric_limits<double>::quiet_NaN();
}

template <class Orbit>
void warn_of(const OrbitResultOf<Orbit>& search, bool quiet) {
  if (search.outcome != OrbitOutcome::certified) return;
  const Orbit& orbit = *search.orbit;
  report_warning(near_border_warning(orbit.border_share()), quiet);
  report_warning(shifted_copies_warning(orbit.period_samples(), orbit.ratio.denominator), quiet);
}

/// Reports the verdict on standard error as one sentence: "periodic(100), 0.1 s: …".
void say(const Classification& classification, double period, const JobContext& context) {
  if (!progress_wanted(context)) return;
  const std::string seconds = classification.period > 0 ? ", " + format_rounded(period) + " s" : "";
  report_error(attractor_type_text(classification) + seconds + ": " + classification.rests_on);
}

/// Writes one row: the verdict, its indicators and the evidence.
/// @tparam Found  classification of a motion in any model
template <class Found>
void write(const JobContext& context, Table& table, const Found& found) {
  const Classification& classification = found.classification;
  const ChaosIndicators& indicators = found.indicators;
  warn_of(found.search, context.quiet);
  report_warning(stepped_reading_warning(context.case_data), context.quiet);
  const double period = classification.period > 0 ? static_cast<double>(classification.period) *
                                                        context.case_data.control.sampling_period
                                                  : std::numeric_limits<double>::quiet_NaN();
  const auto itself = [](double number) { return number; };
  table.row(
      attractor_type_text(classification), classification.period, period,
      indicators.certified_period ? 1 : 0,
      known(indicators.largest_exponent, [](const auto& exponent) { return exponent.value; }),
      known(indicators.largest_exponent, [](const auto& exponent) { return exponent.half_width; }),
      known(indicators.zero_one, itself), known(indicators.closest_return, itself),
      known(indicators.determinism, itself),
      known(indicators.switching, [](const auto& complexity) { return complexity.entropy; }),
      indicators.lines ? indicators.lines->division : 0,
      known(indicators.lines, [](const auto& lines) { return lines.continuous; }),
      classification.rests_on);
  table.commit();
  say(classification, period, context);
}

struct VerdictQuestion {
  std::int64_t largest_period = OrbitLimits{}.largest_period;
  Switching switching = Switching::sampled;

  void add_to(const Job& job) {
    job.add("--max-period", largest_period);
    job.add("--switching", switching);
  }

  void run(const JobContext& context) const {
    Table table(context, columns_of("verdict"));
    const Case& the_case = context.case_data;
    const OrbitLimits limits{largest_period, 0, throw_if_interrupted};
    report_warning(dense_work_warning(the_case, switching), context.quiet);
    const auto classify = [&](const auto& moving) {
      write(context, table, classify_motion(moving.loop, moving.state, limits));
    };
    std::visit(classify, smooth_loop_of(the_case, switching));
  }
};

}  // namespace

void add_verdict(CLI::App& program) { add_job<VerdictQuestion>(program, "verdict"); }

}  // namespace holdfast::program
