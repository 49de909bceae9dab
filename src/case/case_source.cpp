#include "case/case_source.hpp"

#include <utility>

#include "case/case_file.hpp"
#include "case/device/impedance_table.hpp"
#include "case/model/own/own_parts.hpp"
#include "holdfast/excitation/recorded_force.hpp"
#include "io/text/record_file.hpp"
#include "text/text.hpp"

namespace holdfast::program {

void CaseSource::attach_tables(Case& the_case) const {
  for (case_tables::Device& device : the_case.devices) {
    if (device.kind != "measured" || device.table != nullptr) continue;
    const auto read = tables.find(device.file);
    device.table = read != tables.end()
                       ? read->second
                       : std::make_shared<const ImpedanceTable>(read_impedance_table(device.file));
  }
}

void CaseSource::attach_record(Case& the_case) {
  attach_tables(the_case);
  for (const case_tables::Device& device : the_case.devices)
    if (device.table != nullptr) tables[device.file] = device.table;
  const auto& excitation = the_case.excitation;
  if (excitation.record.empty()) return;
  ForceRecord read = read_force_record(excitation.record);
  const auto interpolation = excitation.record_interpolation == "held"
                                 ? RecordInterpolation::held
                                 : RecordInterpolation::linear;
  force_record = std::make_shared<const RecordedForce>(std::move(read.times),
                                                       std::move(read.forces), interpolation);
  the_case.force_record = force_record;
}

Case CaseSource::load(const std::vector<std::string>& further) const {
  std::vector<std::string> all = overrides;
  all.insert(all.end(), further.begin(), further.end());
  Case loaded = text ? load_case_text(*text, name, all) : load_case(std::nullopt, all);
  loaded.force_record = force_record;
  loaded.own = own;
  require_consistent(loaded);
  attach_tables(loaded);
  return loaded;
}

std::string record_doubt(const Case& the_case) {
  if (the_case.force_record == nullptr) return "";
  constexpr double many = 300.0;  // sampling periods
  constexpr std::size_t a_series = 10;
  const std::vector<double>& times = the_case.force_record->times();
  const double usual = usual_step(times), first = times.front();
  const double periods = usual / the_case.control.sampling_period;
  std::string said = gap_text(times);
  const auto add = [&](const std::string& more) { said += (said.empty() ? "" : "; ") + more; };
  if (first > 1.5 * usual)
    add("its first row is at " + format_rounded(first) + " s; before that the force is 0");
  if (periods > many && times.size() >= a_series)
    add("its rows are " + format_rounded(usual) + " s apart (" + format_rounded(periods) +
        " sampling periods): is time_s in ms?");
  return said.empty() ? "" : the_case.excitation.record + ": " + said;
}

}  // namespace holdfast::program
