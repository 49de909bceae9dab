#include "jobs/attractor/verdict_table.hpp"

#include <limits>
#include <optional>

#include "case/model/loop_of_case.hpp"
#include "holdfast/chaos/motion_classification.hpp"
#include "io/text/table.hpp"
#include "io/text/text.hpp"
#include "jobs/charts/conditioning.hpp"
#include "process/exit.hpp"
#include "process/interrupt.hpp"
#include "process/progress.hpp"

namespace holdfast::program {
namespace {

std::vector<Column> verdict_columns() {
  return {
      {"verdict", "",
       "periodic(N), quasi-periodic, irregular, exponent <= 0, chaotic, diverges or undecided",
       "string"},
      {"period_samples", "", "N; 0 unless periodic", "integer"},
      {"period_s", "s", "period; nan unless periodic"},
      {"certified", "", "1: the orbit is solved exactly and verified", "integer"},
      {"largest_exponent", "", "Lyapunov exponent per sample, natural logarithm"},
      {"exponent_half_width", "", "of its 95 % interval; 0 where the orbit is exact"},
      {"zero_one_K", "", "median K of the 0-1 test: 0 regular, 1 chaotic"},
      {"closest_return", "", "smallest distance of two states over the extent of the motion"},
      {"recurrence_determinism", "", "share of the recurrent points that lie on diagonals"},
      {"contact_entropy", "", "bit per sample that the sequence of contacts carries"},
      {"subharmonic_order", "",
       "smallest m for which the multiples of f/m hold 99.9 % of the power; 0: none", "integer"},
      {"continuous_share", "", "share of the power between the lines of the spectrum"},
      {"rests_on", "", "what the verdict rests on", "string"}};
}

/// A number where it is known, else nan.
template <class Part, class Read>
double known(const std::optional<Part>& part, const Read& read) {
  return part ? read(*part) : std::numeric_limits<double>::quiet_NaN();
}

struct Classified {
  Classification classification;
  ChaosIndicators indicators;
  std::string warning;
};

template <class Orbit>
std::string warning_of(const OrbitResultOf<Orbit>& search) {
  const bool certified = search.outcome == OrbitOutcome::certified;
  return certified ? near_border_warning(search.orbit->border_share()) : "";
}

Classified classified(const Case& the_case, std::int64_t largest_period, Switching switching) {
  const Vector<double, 4> state = initial_state_of(the_case);
  const OrbitLimits limits{largest_period, 0, throw_if_interrupted};
  if (is_of_the_paper(the_case, switching)) {
    const SampledClassification found = classify_motion(ideal_loop_of(the_case), state, limits);
    return {found.classification, found.indicators, warning_of(found.search)};
  }
  const EventClassification found =
      classify_motion(implemented_loop_of(the_case, switching), state, limits);
  return {found.classification, found.indicators, warning_of(found.search)};
}

/// The verdict for a reader who does not count columns: "periodic(100), 0.1 s: …".
void say(const Classification& classification, double period, const JobContext& context) {
  if (!progress_wanted(context)) return;
  const std::string seconds = classification.period > 0 ? ", " + format_rounded(period) + " s" : "";
  report_error(attractor_type_text(classification) + seconds + ": " + classification.rests_on);
}

}  // namespace

void write_verdict(const JobContext& context, std::int64_t largest_period, Switching switching) {
  Table table(context, verdict_columns());
  const auto [classification, indicators, warning] =
      classified(context.case_data, largest_period, switching);
  report_warning(warning, context.quiet);
  const double period = classification.period > 0 ? static_cast<double>(classification.period) *
                                                        context.case_data.control.sampling_period
                                                  : std::numeric_limits<double>::quiet_NaN();
  table.row(
      attractor_type_text(classification), classification.period, period,
      indicators.certified_period ? 1 : 0,
      known(indicators.largest_exponent, [](const auto& exponent) { return exponent.value; }),
      known(indicators.largest_exponent, [](const auto& exponent) { return exponent.half_width; }),
      known(indicators.zero_one, [](double k) { return k; }),
      known(indicators.closest_return, [](const auto& closest) { return closest.distance; }),
      known(indicators.recurrence, [](const auto& shares) { return shares.determinism; }),
      known(indicators.switching, [](const auto& complexity) { return complexity.entropy; }),
      indicators.lines ? indicators.lines->division : 0,
      known(indicators.lines, [](const auto& lines) { return lines.continuous; }),
      classification.rests_on);
  table.commit();
  say(classification, period, context);
}

}  // namespace holdfast::program
