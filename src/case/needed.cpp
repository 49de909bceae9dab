#include "case/needed.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "case/library/conductor_library.hpp"

namespace holdfast::program {
namespace {

/// A key and an alternative to it.
struct Instead {
  std::string_view key;
  const char* other;
};

constexpr std::array<Instead, 7> others = {{
    {"conductor.sag", "conductor.tension (N)"},
    {"stringing.tension", "stringing.sag (m)"},
    {"excitation.frequency", "[wind]"},
    {"absorber.mass", "plant.absorber_mass (kg)"},
    {"plant.absorber_mass", "absorber.mass (kg)"},
    {"conductor.diameter", "wind.diameter (m)"},
    {"reduction.first_frequency", "the whole [conductor]"},
}};

/// A key with unit and alternative key: "conductor.sag (m) or conductor.tension (N)".
std::string key_text(const std::string& name) {
  const std::string& unit = find_case_key(name)->unit;
  const auto* other = std::find_if(others.begin(), others.end(),
                                   [&](const Instead& one) { return one.key == name; });
  return name + " (" + (unit.empty() ? "a number" : unit) + ")" +
         (other == others.end() ? "" : std::string(" or ") + other->other);
}

}  // namespace

bool is_absent(const Case& the_case, const CaseKey& key) {
  if (!key.is_number()) return false;
  // A copy of the case would cost more than all else; nothing is written.
  const double* value = key.number(const_cast<Case&>(the_case));
  return value != nullptr && std::isnan(*value);
}

void require_keys(const Case& the_case, const std::vector<std::string>& keys) {
  // With a given tension, the sag follows from mass and span.
  const bool is_tight = std::isfinite(the_case.conductor.tension);
  std::vector<std::string> missing;
  const auto ask = [&](const std::string& name) {
    const bool is_asked = std::find(missing.begin(), missing.end(), name) != missing.end();
    if (is_absent(the_case, *find_case_key(name)) && !is_asked) missing.push_back(name);
  };
  for (const std::string& name : keys) {
    if (name == "conductor.sag" && is_tight) {
      ask("conductor.mass_per_length");
      ask("conductor.span");
    } else {
      ask(name);
    }
  }
  if (missing.empty()) return;
  std::string listed;
  for (const std::string& name : missing) listed += (listed.empty() ? "" : ", ") + key_text(name);
  const bool is_named = std::any_of(missing.begin(), missing.end(), is_library_key);
  throw MissingKeys("the case does not give what the job needs: " + listed +
                    (is_named ? "; or give conductor.name to take data from the library" : ""));
}

double needed(const Case& the_case, std::string_view key) {
  require_keys(the_case, {std::string(key)});
  return case_value(the_case, key);
}

}  // namespace holdfast::program
