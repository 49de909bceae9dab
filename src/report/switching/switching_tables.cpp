#include "report/switching/switching_tables.hpp"

#include <algorithm>
#include <cstddef>

#include "holdfast/contact/hysteresis.hpp"
#include "io/text/csv.hpp"
#include "io/text/table.hpp"

namespace holdfast::program {
namespace {

std::vector<Column> motion_table_columns() {
  return {{"law", "", "of the backlash", "string"},
          {"sampling_period_s", "s", "tau"},
          {"backlash_width_m", "m", "r0"},
          {"switching", "", "sampled or exact", "string"},
          {"hold", "", "of the force over a sample: sampled or exact", "string"},
          {"duration_s", "s", "of the motion, whose second half is looked at"},
          {"largest_z1_m", "m", "largest absolute z1 of the second half, at all times"},
          {"largest_sampled_z1_m", "m", "the same at the samples"},
          {"engaged_phases_per_half_cycle", "", "how often the drive begins to transmit"},
          {"gap_phases_per_half_cycle", "", "how often it begins to cross its gap"},
          {"stick_phases_per_half_cycle", "", "how often its sides begin to stay together"},
          {"verdict", "", "periodic(N), or why there is no certified orbit", "string"},
          {"period_samples", "", "of the certified orbit; 0: none", "integer"},
          {"period_s", "s", "of the certified orbit; nan: none"},
          {"forcing_periods", "", "in one of the orbit", "integer"},
          {"shortest_period_samples", "",
           "after which sampling and forcing coincide again; 0: never", "integer"},
          {"largest_multiplier", "", "modulus, of one period"}};
}

/// The context of a table of the report.
JobContext context_of(const JobContext& context, const std::string& table) {
  JobContext own = context;
  own.output = *context.output / "data" / (table + ".csv");
  return own;
}

}  // namespace

void write_motions(const JobContext& context, const std::string& name,
                   const std::vector<StudiedMotion>& motions) {
  Table table(context_of(context, name), motion_table_columns());
  for (const StudiedMotion& motion : motions) {
    const auto& [studied, steady, period] = motion;
    const Case& of = studied.the_case;
    table.row(of.backlash.law, of.control.sampling_period, of.backlash.width,
              studied.reading.switching_word(), studied.reading.hold_word(), studied.duration,
              steady.largest_displacement, steady.largest_of_samples,
              steady.phases_per_half_cycle[0], steady.phases_per_half_cycle[1],
              steady.phases_per_half_cycle[2], period.verdict, period.samples, period.seconds,
              period.forcing_periods, shortest_period(studied), period.largest_multiplier);
  }
  table.commit();
}

void write_strips(const JobContext& context, const std::string& name,
                  const std::vector<ContactStrip>& strips) {
  Table table(context_of(context, name), {{"strip", "", "from the top, from 1", "integer"},
                                          {"begin_s", "s", "of a phase"},
                                          {"end_s", "s", "of it"},
                                          {"mode", "", "engaged, gap or stick", "string"},
                                          {"motion", "", "whose strip it is", "string"}});
  for (std::size_t k = 0; k < strips.size(); ++k) {
    for (const ContactPhase& phase : strips[k].window.phases)
      table.row(k + 1, phase.begin, phase.end, word_for(phase.mode), strips[k].name);
  }
  table.commit();
}

void write_window(const JobContext& context, const std::string& name, const MotionWindow& exact,
                  const MotionWindow& sampled) {
  std::vector<Column> columns = {{"time_s", "s", "time"}};
  for (const std::string motion : {"exact", "sampled"}) {
    columns.push_back({motion + "_dz_m", "m", "z2 - z1 with " + motion + " switching"});
    columns.push_back({motion + "_command_N", "N", "u, the command in force"});
    columns.push_back({motion + "_transmitted_N", "N", "what the drive transmits"});
  }
  Table table(context_of(context, name), columns);
  for (std::size_t k = 0; k < std::min(exact.instants.size(), sampled.instants.size()); ++k) {
    const InstantOfMotion &a = exact.instants[k], &b = sampled.instants[k];
    table.row(a.time, relative_displacement(a.state), a.command, a.transmitted,
              relative_displacement(b.state), b.command, b.transmitted);
  }
  table.commit();
}

}  // namespace holdfast::program
