#include "case/case_source.hpp"

#include <utility>

#include "case/case_file.hpp"
#include "holdfast/excitation/recorded_force.hpp"
#include "io/text/record_file.hpp"

namespace holdfast::program {

void CaseSource::attach_record(Case& the_case) {
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
  return loaded;
}

}  // namespace holdfast::program
