#include <cstdint>
#include <limits>
#include <memory>
#include <optional>

#include "case/model/loop_of_case.hpp"
#include "holdfast/chaos/motion_classification.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/orbit/orbit_search.hpp"
#include "io/text/table.hpp"
#include "io/text/text.hpp"
#include "job.hpp"
#include "jobs/charts/conditioning.hpp"
#include "motion_options.hpp"
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

template <class Orbit>
std::string warning_of(const OrbitResultOf<Orbit>& search) {
  const bool certified = search.outcome == OrbitOutcome::certified;
  return certified ? near_border_warning(search.orbit->border_share()) : "";
}

/// The verdict for a reader who does not count columns: "periodic(100), 0.1 s: …".
void say(const Classification& classification, double period, const JobContext& context) {
  if (!progress_wanted(context)) return;
  const std::string seconds = classification.period > 0 ? ", " + format_rounded(period) + " s" : "";
  report_error(attractor_type_text(classification) + seconds + ": " + classification.rests_on);
}

/// One row with the verdict, the numbers behind it and the sentence that says what it rests on.
/// @tparam Found  of either model
template <class Found>
void write(const JobContext& context, Table& table, const Found& found) {
  const Classification& classification = found.classification;
  const ChaosIndicators& indicators = found.indicators;
  report_warning(warning_of(found.search), context.quiet);
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

struct VerdictOptions {
  std::int64_t largest_period = OrbitLimits{}.largest_period;
  Switching switching = Switching::sampled;
};

void run(const JobContext& context, const VerdictOptions& options) {
  Table table(context, verdict_columns());
  const Case& the_case = context.case_data;
  const Vector<double, 4> state = initial_state_of(the_case);
  const OrbitLimits limits{options.largest_period, 0, throw_if_interrupted};
  if (is_of_the_paper(the_case, options.switching))
    write(context, table, classify_motion(ideal_loop_of(the_case), state, limits));
  else
    write(context, table,
          classify_motion(implemented_loop_of(the_case, options.switching), state, limits));
}

}  // namespace

void add_verdict(CLI::App& program) {
  const Job job(program, "verdict", question::attractor,
                "What the motion is: periodic, quasi-periodic, chaotic, …, and what that rests on");
  const auto options = std::make_shared<VerdictOptions>();
  add_largest_period(job, options->largest_period);
  add_switching(job, options->switching);
  job->final_callback([job, options] { run(job.context(), *options); });
}

}  // namespace holdfast::program
