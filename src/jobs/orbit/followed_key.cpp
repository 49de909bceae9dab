#include "jobs/orbit/followed_key.hpp"

#include "case/case_keys.hpp"
#include "process/errors.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

bool moves_the_orbit(const std::string& key) {
  const bool of_the_loop = key == "control.proportional_gain" ||
                           key == "control.differential_gain" || key == "control.processing_delay";
  return of_the_loop || key.rfind("plant.", 0) == 0 || key == "backlash.width" ||
         key == "excitation.amplitude";
}

}  // namespace

std::pair<std::string, Range> parse_key_range(const std::string& option, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) throw WrongInput(option + " " + text + ": expected KEY=MIN:MAX");
  return {text.substr(0, equals), parse_range(option, text.substr(equals + 1))};
}

bool moves_the_coincidence(const std::string& key) {
  return key == "control.sampling_period" || key == "excitation.frequency";
}

double followed_value(const Case& the_case, const std::string& option, const std::string& text,
                      const std::string& key, const Range& range, bool own_ratio) {
  const double value = case_value(the_case, key);
  if (moves_the_coincidence(key) && !own_ratio)
    throw WrongInput(option + " " + key +
                     ": another value changes how sampling and excitation coincide, so the orbit "
                     "cannot be followed along it");
  if (!moves_the_orbit(key) && !moves_the_coincidence(key))
    throw WrongInput(
        option + " " + key +
        ": expected control.proportional_gain, differential_gain or processing_delay, a key "
        "of [plant], backlash.width or excitation.amplitude");
  const CaseKey& known = *find_case_key(key);
  for (const double end : {range.min, range.max}) {
    if (!known.range.contains(end))
      throw WrongInput(option + " " + text + ": " + key + " must be " + known.admissible());
  }
  if (!(range.min <= value && value <= range.max))
    throw WrongInput(option + " " + text + ": the case's " + key + " = " + format_number(value) +
                     " lies outside");
  if (key == "backlash.width" && value == 0.0)
    throw WrongInput(
        option +
        " backlash.width: the case has no backlash, where the rule is another one; set a "
        "width greater than 0 m");
  return value;
}

}  // namespace holdfast::program
