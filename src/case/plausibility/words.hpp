#pragma once

#include <limits>
#include <vector>

#include "case/plausibility/quantities.hpp"

// What both tables of quantities are written with.

namespace holdfast::program::plausibility {

using Quantities = std::vector<PlausibleQuantity>;

inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
inline constexpr double two_pi = 2.0 * 3.14159265358979323846;
inline constexpr AdmissibleRange whatever{};
inline constexpr const char* reach_reason =
    "half of its distance from the nearer support, or 3 m where the case gives [plant] alone; "
    "vibrations have 1e-5 to 0.1 of it";

constexpr AdmissibleRange at_most(double highest) {
  return {-std::numeric_limits<double>::infinity(), highest};
}
constexpr AdmissibleRange at_least(double lowest) { return {lowest}; }

/// A plant alone stands beside the cable of the built-in case, which says nothing of it.
inline bool has_own_cable(const Case& c) { return c.conductor_given || !c.plant_given; }

/// Of the whole conductor, N.
inline double weight_of(const Case& c) {
  return c.conductor.mass_per_length * c.conductor.gravity * c.conductor.span;
}

inline double force_frequency(const Case& c) { return effective_excitation(c).frequency; }

}  // namespace holdfast::program::plausibility
