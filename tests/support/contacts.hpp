#pragma once

#include "holdfast/contact/contact.hpp"

namespace holdfast::test {

/// The play of a drive of the two masses, switching when it happens.
inline DriveContact<> exact_backlash(const TwoMass<double>& plant, double width) {
  return {plant, {ContactLaw::play, width}, Switching::exact, Vector<double, 4>::Zero()};
}

/// Its dead zone likewise.
inline DriveContact<> exact_dead_zone(const TwoMass<double>& plant, double width, double stiffness,
                                      double damping, const Vector<double, 4>& state) {
  return {plant, {ContactLaw::dead_zone, width, stiffness, damping}, Switching::exact, state};
}

}  // namespace holdfast::test
