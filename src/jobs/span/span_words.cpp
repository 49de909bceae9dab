#include "jobs/span/span_words.hpp"

#include <algorithm>
#include <cmath>

#include "case/axes/axis.hpp"
#include "case/device/impedance_table.hpp"
#include "case/library/conductor_library.hpp"
#include "case/model/modal/conductor_modes.hpp"
#include "case/model/span/span_loop.hpp"
#include "case/model/span/span_of_case.hpp"
#include "process/errors.hpp"
#include "text/text.hpp"

namespace holdfast::program {

namespace {

/// The value rounded to `digits` significant digits.
double with_digits(double value, double digits, double (*rounded)(double) = std::round) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - digits + 1.0);
  return rounded(value / unit) * unit;
}

}  // namespace

Axis aeolian_frequencies(const Case& the_case) {
  constexpr double calmest = 1.0, fastest = 8.0;  // m/s
  constexpr std::int64_t count = 200;
  const double diameter = the_case.conductor.diameter;
  Axis axis{3.0, 150.0, count};
  if (std::isfinite(diameter)) {
    const double per_speed = strouhal_of(the_case) / diameter;
    axis = {with_digits(calmest * per_speed, 2.0, std::floor),
            with_digits(fastest * per_speed, 2.0, std::ceil), count};
  }
  for (const case_tables::Device& device : the_case.devices) {
    if (!device.table) continue;
    axis.min = std::max(axis.min, device.table->frequency.front());
    axis.max = std::min(axis.max, device.table->frequency.back());
  }
  return axis;
}

void require_frequencies(std::string_view option, std::string_view text, double lowest,
                         double highest) {
  constexpr double fastest = 1000.0;
  if (lowest > 0.0 && highest <= fastest) return;
  throw WrongInput(std::string(option) + " " + std::string(text) +
                   (lowest > 0.0 ? ": no span vibrates this fast in the wind; give at most 1000 Hz"
                                 : ": a frequency must be greater than 0 Hz"));
}

Axis parse_frequencies(std::string_view option, std::string_view text) {
  const Axis axis = parse_axis(option, text);
  require_frequencies(option, text, axis.min, axis.max);
  return axis;
}

std::string unknown_strain_note(const AeolianBalance& balance) {
  if (balance.knows_strain()) return "";
  return "the strains are nan: give conductor.outer_wire_diameter, conductor.outer_wire_modulus "
         "and conductor.bending_stiffness (its least value)";
}

std::string instability_note(const Case& the_case, bool controlled) {
  if (!comes_back(string_of(the_case), span_devices_of(the_case, false)))
    return "a negative stiffness pushes the conductor away more than the tension pulls it back: "
           "the span is unstable at rest, its results are invalid; give less negative stiffness";
  if (!controlled || !has_active_absorber(the_case)) return "";
  for (const case_tables::Device& device : the_case.devices)
    if (device.table)
      return "stability of the control loop is not computed with a measured impedance table";
  if (!is_growing_span(the_case, controlled)) return "";
  return "the loop of absorber and computer is unstable on this span, so no steady vibration is "
         "given: modal-damping shows which modes grow, place finds stable gains";
}

std::string self_damping_note(const Case& the_case) {
  if (!std::isfinite(the_case.conductor.rated_strength)) return "";
  const LibraryConductor* conductor = find_conductor(the_case.conductor.name);
  if (conductor != nullptr && conductor->kind == "ACSR") return "";
  return "the laws of self-damping were measured only on steel-cored aluminium (ACSR), and " +
         (conductor != nullptr ? conductor->name + " is " + conductor->kind +
                                     ": this conductor may damp far less and vibrate more"
                               : "conductor.name names no ACSR conductor: another kind may damp "
                                 "far less and vibrate more") +
         " than these laws predict";
}

std::string life_line_note(const Case& the_case) {
  const LibraryConductor* conductor = find_conductor(the_case.conductor.name);
  if (conductor == nullptr || conductor->kind == "ACSR") return "";
  return "the safe border line was measured on steel-cored aluminium (ACSR), but " +
         conductor->name + " is " + conductor->kind +
         ": in published tests all-alloy conductors broke after 0.4 to 1.5 times the cycles of "
         "this line; other strands were not tested";
}

std::string years_text(double years) {
  constexpr double many = 1000.0;
  return years > many ? "more than 1000" : format_rounded(with_digits(years, 2.0));
}

std::string life_advice(const FatigueLife& life, double years) {
  const Band served = years_of(life.damage);
  if (std::isnan(served.value)) return "";  // of a loop that grows
  const std::string asked = format_rounded(years) + " years";
  const std::string shortest = years_text(served.lowest), longest = years_text(served.highest);
  const std::string band = range_text(shortest, longest);
  if (life.damage.lowest == 0.0 && served.lowest < years)
    return "by some laws the vibration is below their measured range at all frequencies, and the "
           "damage is unknown; the shortest life assumes the lower end of that range, a hundredth "
           "of the diameter (" +
           band + " years)";
  if (served.lowest >= years)
    return "by every pair of laws (wind, self-damping) the conductor lives longer than the " +
           asked + " of site.years (" + band + " years)";
  if (served.highest < years)
    return "by every pair of laws (wind, self-damping) the conductor lives less than the " + asked +
           " of site.years (" + band + " years): damp the conductor more, or lower its tension";
  return "whether the conductor lives the " + asked + " of site.years depends on the law: " + band +
         " years; measure the vibration, or damp the conductor until the shortest life is enough";
}

}  // namespace holdfast::program
