#include <cmath>

#include "case/model/linear_loop.hpp"
#include "case/model/modal/modal_plant_of_case.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/stability/margins/margins.hpp"
#include "holdfast/stability/margins/proved_margins.hpp"
#include "job.hpp"
#include "jobs/charts/names.hpp"
#include "jobs/charts/proved_poles.hpp"
#include "jobs/design/gain_margins.hpp"

namespace holdfast::program {
namespace {

constexpr Named<MarginEndOutcome> margin_end_names[] = {
    {MarginEndOutcome::undefined, "undefined"},
    {MarginEndOutcome::boundary, "boundary"},
    {MarginEndOutcome::none, "none"},
    {MarginEndOutcome::beyond_search, "beyond_search"}};

/// Outcome of the proof in one direction.
struct ProofWords {
  std::string outcome;  // proved; in part, or not proved, and why
  double stable_to;     // NaN where nothing is proved
};

/// Whether the proof leaves at most a hundredth of the way to the proved unstable loop open.
bool is_whole(const ProvedMarginEnd& proved, double value) {
  const double open = std::abs(proved.unstable_at - proved.stable_to);
  return proved.stop == ProofStop::at_end && !(open > 0.01 * std::abs(proved.unstable_at - value));
}

ProofWords proof_words(const ProvedMarginEnd& proved, double value) {
  if (is_whole(proved, value)) return {"proved", proved.stable_to};
  const std::string why = proved.stop == ProofStop::work
                              ? "the proof reached its limit of steps"
                              : "a root is too near the unit circle for a proof";
  if (proved.stable_to == value) return {"not proved: " + why, std::nan("")};
  return {"in part: " + why, proved.stable_to};
}

struct MarginsQuestion {
  bool prove = false;

  void add_to(const Job& job) { job.add("--prove", prove); }
  void run(const JobContext& context) const;
};

/// Table of margins, with the columns of the proof if one was requested.
class MarginsTable {
 public:
  MarginsTable(const JobContext& context, const std::optional<ProvedMargins>& proved)
      : table_(context, columns_of(proved ? "proved margins" : "margins")), proved_(proved) {}

  /// Writes the lower and the upper limit of the stable range of one quantity.
  void write(const char* quantity, const char* unit, double value, const TwoSidedMargin& margin,
             ProvedMargin ProvedMargins::*proved) {
    const ProvedMargin ends = proved_ ? (*proved_).*proved : ProvedMargin{};
    row(quantity, unit, value, "below", margin.below, ends.below);
    row(quantity, unit, value, "above", margin.above, ends.above);
  }
  void commit() { table_.commit(); }
  /// Whether every limit written so far is proved.
  bool is_proved() const { return is_proved_; }

 private:
  void row(const char* quantity, const char* unit, double value, const char* side,
           const MarginEnd& end, const ProvedMarginEnd& proved) {
    const bool crosses = end.outcome == MarginEndOutcome::boundary;
    const auto with = [&](const auto&... more) {
      table_.row(quantity, unit, value, side, name_in(margin_end_names, end.outcome), end.position,
                 end.distance, crosses ? name_in(curve_names, end.curve) : "", end.frequency,
                 more...);
    };
    if (!proved_) return with();
    const ProofWords words = proof_words(proved, value);
    is_proved_ = is_proved_ && is_whole(proved, value);
    with(words.stable_to, proved.unstable_at, words.outcome);
  }

  Table table_;
  const std::optional<ProvedMargins>& proved_;
  bool is_proved_ = true;
};

void MarginsQuestion::run(const JobContext& context) const {
  const Case& the_case = context.case_data;
  require_absorber(the_case);
  const Sampling<double> sampling = sampling_of(the_case);
  const PdGains<double> gains = gains_of(the_case);
  auto [margins, looked_everywhere] =
      prove ? CaseMargins{LinearLoop(the_case).margins(gains), false}  // the proof will look
            : stability_margins_of(the_case, gains);
  if (margins.outcome == MarginOutcome::not_stable)
    throw NoAnswer("no margins: the loop is not stable (spectral radius " +
                   format_rounded(LinearLoop(the_case).radius(gains_of(the_case))) +
                   "): change the gains");
  if (const std::string otherwise = judged_otherwise(the_case); !otherwise.empty())
    throw NoAnswer("no margins can be given: " + otherwise);
  std::optional<ProvedMargins> proved;
  if (prove) proved = proved_margins_of(the_case, gains, margins);
  if (!prove && !looked_everywhere) {
    std::string doubt =
        "sampling_period was searched in steps of 5 % (larger ones below a period that resolves "
        "every motion) and processing_delay in eighths of a sample: an unstable interval narrower "
        "than a step may be missed";
    if (may_be_proved(the_case)) doubt += "; --prove checks every value";
    report_warning(doubt, context.quiet);
  }
  MarginsTable table(context, proved);
  table.write("differential_gain", "N.s/m", gains.differential, margins.differential_gain,
              &ProvedMargins::differential_gain);
  table.write("proportional_gain", "N/m", gains.proportional, margins.proportional_gain,
              &ProvedMargins::proportional_gain);
  table.write("sampling_period", "s", sampling.period, margins.sampling_period,
              &ProvedMargins::sampling_period);
  table.write("processing_delay", "s", sampling.processing_delay, margins.processing_delay,
              &ProvedMargins::processing_delay);
  if (!table.is_proved())
    report_warning(
        "some ends of the stable ranges are not proved: see the reasons in the column \"proof\"",
        context.quiet);
  table.commit();
}

}  // namespace

void add_margins(CLI::App& program) { add_job<MarginsQuestion>(program, "margins"); }

}  // namespace holdfast::program
