#include "case_source.hpp"

#include "case_file.hpp"
#include "damping_fit.hpp"

namespace holdfast::program {

Case CaseSource::load(const std::vector<std::string>& further) const {
  std::vector<std::string> all = overrides;
  all.insert(all.end(), further.begin(), further.end());
  Case the_case = load_case(file, all);
  settle_plant(the_case);
  return the_case;
}

}  // namespace holdfast::program
