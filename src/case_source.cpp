#include "case_source.hpp"

#include "case_file.hpp"

namespace holdfast::program {

Case CaseSource::load(const std::vector<std::string>& further) const {
  std::vector<std::string> all = overrides;
  all.insert(all.end(), further.begin(), further.end());
  return text ? load_case_text(*text, name, all) : load_case(std::nullopt, all);
}

}  // namespace holdfast::program
