#include "case/model/span/span_of_case.hpp"
#include "job.hpp"
#include "jobs/span/aeolian_amplitudes.hpp"
#include "jobs/span/span_words.hpp"

namespace holdfast::program {
namespace {

std::string range_word(BalanceRange range) {
  if (range == BalanceRange::within) return "";
  return range == BalanceRange::below ? "at_most" : "at_least";
}

struct AeolianQuestion {
  std::string frequency = "3:150:148";
  bool no_control = false;

  void add_to(const Job& job) {
    job.add("--frequency", frequency);
    job.add("--no-control", no_control);
  }

  void run(const JobContext& context) const {
    const Case& the_case = context.case_data;
    const Axis axis = parse_frequencies("--frequency", frequency);
    require_measured(the_case, axis.min, axis.max);
    report_warning(absent_absorber_note(the_case), context.quiet);
    const AeolianBalance balance(the_case, !no_control);
    report_warning(self_damping_note(the_case), context.quiet);
    report_warning(unknown_strain_note(balance), context.quiet);
    require_text_meant(context, axis.count, "rows", "give a smaller COUNT in --frequency");
    Table table(context, columns_of("aeolian"));
    RangeCount ranges;
    for (std::int64_t k = 0; k < axis.count; ++k) {
      throw_if_interrupted();
      for (const AeolianRow& row : balance.rows(axis.at(k))) {
        table.row(row.frequency, row.wind_speed, row.wind_law, row.damping_law,
                  row.bare.amplitude.amplitude, row.damped.amplitude.amplitude, row.bare.strain,
                  row.damped.strain, range_word(row.damped.amplitude.range),
                  range_word(row.bare.amplitude.range));
        ranges.add(row, balance.has_devices());
      }
    }
    report_warning(ranges.text(), context.quiet);
    report_warning(instability_note(the_case, !no_control), context.quiet);
    table.commit();
  }
};

}  // namespace

void add_aeolian(CLI::App& program) { add_job<AeolianQuestion>(program, "aeolian"); }

}  // namespace holdfast::program
