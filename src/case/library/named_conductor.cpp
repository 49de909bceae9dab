#include "case/library/named_conductor.hpp"

#include <algorithm>
#include <cmath>

#include "case/case_keys.hpp"
#include "case/library/conductor_library.hpp"
#include "io/text/text.hpp"

namespace holdfast::program {

bool is_from_library(const Case& the_case, std::string_view key) {
  const auto& keys = library_keys();
  return !the_case.conductor.name.empty() && the_case.places.count(std::string(key)) == 0 &&
         std::any_of(keys.begin(), keys.end(),
                     [&](const LibraryKey& known) { return known.name == key; });
}

std::string idle_name_text(const Case& the_case) {
  const LibraryConductor* conductor = find_conductor(the_case.conductor.name);
  if (conductor == nullptr) return "";
  std::string differ;
  for (const LibraryKey& key : library_keys()) {
    if (key.name == "conductor.layers") continue;  // nothing that a conductor is known by
    if (is_from_library(the_case, key.name)) return "";
    const double given = case_value(the_case, key.name), known = conductor->*key.value;
    const bool tells = key.name == "conductor.mass_per_length" || key.name == "conductor.area" ||
                       key.name == "conductor.diameter";
    if (tells && std::isfinite(given) && std::abs(given - known) > 0.1 * known)
      differ += (differ.empty() ? "" : ", ") + std::string(key.name) + " " + format_rounded(given) +
                " instead of " + format_rounded(known) + " " + find_case_key(key.name)->unit;
  }
  if (differ.empty()) return "";
  return the_case.places.at("conductor.name") + ": conductor.name = \"" + conductor->name +
         "\" fills nothing, since every value that it stands for is given, and they are not its: " +
         differ + "; take them away to have those of the library";
}

std::string borrowed_damping_text(const Case& the_case) {
  if (the_case.conductor.name.empty() || the_case.places.count("conductor.damping_ratio") > 0)
    return "";
  return "conductor.damping_ratio is " + format_number(the_case.conductor.damping_ratio) +
         ", that of the built-in cable: a stranded conductor at its tension has some 0.0001 to "
         "0.002, which no library tells; give it";
}

}  // namespace holdfast::program
