#include "holdfast/stability/margins/margins.hpp"
#include "case/model/loop_of_case.hpp"
#include "case/model/plant_of_case.hpp"
#include "job.hpp"
#include "jobs/charts/names.hpp"
#include "jobs/design/gain_margins.hpp"

namespace holdfast::program {
namespace {

constexpr Named<MarginEndOutcome> margin_end_names[] = {
    {MarginEndOutcome::undefined, "undefined"},
    {MarginEndOutcome::boundary, "boundary"},
    {MarginEndOutcome::none, "none"},
    {MarginEndOutcome::beyond_search, "beyond_search"}};

/// Writes the two ends of one quantity's stable stretch.
void write(Table& table, const char* quantity, const char* unit, double value,
           const TwoSidedMargin& margin) {
  const auto row = [&](const char* side, const MarginEnd& end) {
    const bool crosses = end.outcome == MarginEndOutcome::boundary;
    table.row(quantity, unit, value, side, name_in(margin_end_names, end.outcome), end.position,
              end.distance, crosses ? name_in(curve_names, end.curve) : "", end.frequency);
  };
  row("below", margin.below);
  row("above", margin.above);
}

void tell_margins(const JobContext& context) {
  const Case& the_case = context.case_data;
  const Sampling<double> sampling = sampling_of(the_case);
  const PdGains<double> gains = gains_of(the_case);
  const StabilityMargins margins = stability_margins_of(the_case, gains);
  if (margins.outcome == MarginOutcome::not_stable)
    throw NoAnswer("the loop is not stable, so it has no margins: its spectral radius is " +
                   format_rounded(spectral_radius_of(the_case)));
  if (is_modal(the_case))
    report_warning(
        "with the plant of the case's period sampling_period was walked in steps of 5 % and "
        "processing_delay in eighths of a sample: a gap of instability narrower than that is not "
        "seen",
        context.quiet);
  Table table(context, columns_of("margins"));
  write(table, "differential_gain", "N.s/m", gains.differential, margins.differential_gain);
  write(table, "proportional_gain", "N/m", gains.proportional, margins.proportional_gain);
  write(table, "sampling_period", "s", sampling.period, margins.sampling_period);
  write(table, "processing_delay", "s", sampling.processing_delay, margins.processing_delay);
  table.commit();
}

}  // namespace

void add_margins(CLI::App& program) { add_job(program, "margins", tell_margins); }

}  // namespace holdfast::program
