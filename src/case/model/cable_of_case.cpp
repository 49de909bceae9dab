#include "case/model/cable_of_case.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "case/case_keys.hpp"
#include "case/library/conductor_library.hpp"
#include "case/needed.hpp"
#include "holdfast/cable/modes.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "process/errors.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

StiffnessReading stiffness_reading_of(const Case& the_case) {
  const std::string& reading = the_case.reduction.stiffness_reading;
  if (reading == "tangent") return StiffnessReading::tangent;
  return reading == "secant" ? StiffnessReading::secant : StiffnessReading::least_squares;
}

/// Beginning of a message: the given key that conflicts with a default range; else empty.
std::string blame_for_range(const Case& the_case, const char* key, const char* range) {
  const bool by_key = the_case.is_given(key) && !the_case.is_given(range);
  return by_key ? std::string(key) + " = " + format_number(case_value(the_case, key)) +
                      " m is too small for "
                : "";
}

/// Displacement (m, downward) of the highest position of the absorber's place in the statics.
double highest_reading(const Case& the_case) {
  const auto irvine = irvine_statics_of(the_case);
  return irvine.displacement(irvine.lowest_force() * (1.0 - 1e-6));
}

double known_or_zero(double value) { return std::isnan(value) ? 0.0 : value; }

}  // namespace

bool plant_is_reduced(const Case& the_case) {
  const auto& keys = case_keys();
  return the_case.conductor_given && std::any_of(keys.begin(), keys.end(), [&](const CaseKey& key) {
           return key.table() == "plant" && !key.beyond_two_masses && !the_case.is_given(key.name);
         });
}

bool has_own_cable(const Case& the_case) {
  return the_case.conductor_given || !the_case.plant_given;
}

bool is_from_library(const Case& the_case, std::string_view key) {
  return !the_case.conductor.name.empty() && !the_case.is_given(std::string(key)) &&
         is_library_key(key);
}

bool is_users(const Case& the_case, const std::string& key) {
  return the_case.is_given(key) || is_from_library(the_case, key) ||
         (key == "conductor.sag" && std::isfinite(the_case.conductor.tension));
}

bool is_half_borrowed(const Case& the_case, const std::vector<std::string>& keys) {
  if (the_case.stands_alone) return false;
  int telling = 0;
  for (const char* key : {"conductor.name", "conductor.mass_per_length", "conductor.span",
                          "conductor.tension", "conductor.sag"})
    telling += the_case.is_given(key) ? 1 : 0;
  const auto is_borrowed = [&](const std::string& key) {
    const std::string table = key.substr(0, key.find('.'));
    return (table == "conductor" || table == "absorber") && key != "conductor.gravity" &&
           key != "conductor.tension" && !is_users(the_case, key);
  };
  return telling >= 2 && std::any_of(keys.begin(), keys.end(), is_borrowed);
}

double parabolic_tension_of(const Case& the_case) {
  const auto& c = the_case.conductor;
  return c.mass_per_length * c.gravity * c.span * c.span / (8.0 * c.sag);
}

double damping_ratio_of(const Case& the_case) {
  return needed(the_case, "conductor.damping_ratio");
}

Conductor<double> conductor_of(const Case& the_case) {
  require_keys(the_case, {"conductor.mass_per_length", "conductor.span", "conductor.sag",
                          "conductor.area", "conductor.youngs_modulus"});
  const auto& c = the_case.conductor;
  return {
      c.mass_per_length, c.span, c.sag, c.area, c.youngs_modulus, known_or_zero(c.damping_ratio),
      c.gravity};
}

StaticsFromRest<IrvinePointLoad<double>> irvine_statics_of(const Case& the_case) {
  return irvine_statics(conductor_of(the_case), needed(the_case, "absorber.position"),
                        known_or_zero(the_case.absorber.mass));
}

StaticsFromRest<CatenaryPointLoad<double>> exact_statics_of(const Case& the_case) {
  return exact_statics(conductor_of(the_case), needed(the_case, "absorber.position"),
                       known_or_zero(the_case.absorber.mass));
}

ReadingRange reading_range_of(const Case& the_case) {
  ReadingRange range{the_case.reduction.reading_below, the_case.reduction.reading_above};
  if (!the_case.stands_alone) return range;
  const auto stays_within = [&](const char* key, double& reading, double most) {
    if (!the_case.is_given(key)) reading = std::min(reading, 0.5 * most);
  };
  stays_within("reduction.reading_above", range.above, -highest_reading(the_case));
  stays_within("reduction.reading_below", range.below, the_case.conductor.sag);
  return range;
}

void require_reading_range(const Case& the_case) {
  const ReadingRange range = reading_range_of(the_case);
  const double highest = highest_reading(the_case);
  if (!(-range.above > highest))
    throw WrongInput(blame_for_range(the_case, "absorber.position", "reduction.reading_above") +
                     "reduction.reading_above = " + format_number(range.above) +
                     " m: must be less than " + format_rounded(-highest) +
                     " m, the largest lift of the absorber's place in the static model");
  if (!(range.below <= the_case.conductor.sag))
    throw WrongInput(blame_for_range(the_case, "conductor.sag", "reduction.reading_below") +
                     "reduction.reading_below = " + format_number(range.below) +
                     " m: must be at most the sag, " + format_number(the_case.conductor.sag) +
                     " m");
}

double conductor_stiffness_of(const Case& the_case) {
  if (stiffness_reading_of(the_case) != StiffnessReading::tangent) require_reading_range(the_case);
  return conductor_stiffness(irvine_statics_of(the_case), stiffness_reading_of(the_case),
                             reading_range_of(the_case));
}

std::pair<double, double> default_frequencies(const Case& the_case) {
  constexpr std::size_t wanted = 6;
  const double place = needed(the_case, "absorber.position") / the_case.conductor.span;
  std::vector<double> moving;
  // A place near a support is moved by high modes only; then modes 1 and 6 are taken.
  const auto modes = irvine_modes(conductor_of(the_case), 200);
  for (const CableMode& mode : modes) {
    if (std::abs(mode.shape(place)) >= 0.1) moving.push_back(mode.frequency);
  }
  if (moving.size() < wanted) return {modes[0].frequency, modes[wanted - 1].frequency};
  return {moving.front(), moving[wanted - 1]};
}

std::string borrowed_cable_warning(const Case& the_case) {
  if (has_own_cable(the_case) || the_case.stands_alone) return "";
  return "the case gives [plant] and no [conductor]: the cable is that of the built-in case";
}

void require_force_within_statics(const Case& the_case, double force) {
  const double lowest = irvine_statics_of(the_case).lowest_force();
  if (force > lowest) return;
  throw WrongInput("a force of " + format_number(force) +
                   " N lifts half of the cable's weight or more, which the static model excludes: "
                   "the force must be greater than " +
                   format_rounded(lowest) + " N");
}

}  // namespace holdfast::program
