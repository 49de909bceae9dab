#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "case/case.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/plant/linear_plant.hpp"
#include "holdfast/plant/plant_poles.hpp"

namespace holdfast::program {

/// A controller in place of P and D: the force (N) of sample k at t (s) by the readings (m, m/s).
using OwnForce =
    std::function<double(std::int64_t k, double t, double displacement, double velocity)>;

/// Parts of a case that are its user's own, beyond what a case file can say. Only a program in
/// whose memory the case is can give them.
struct OwnParts {
  std::optional<LinearPlant<double>> plant;  ///< in place of conductor and absorber
  Vector<double, Eigen::Dynamic> state;      ///< of that plant, where it starts
  OwnForce controller;                       ///< empty: P and D
};

/// Throws WrongInput where the case says something that its own plant or controller takes no notice
/// of, or would contradict.
void require_consistent(const Case& the_case);

/// Throws WrongInput where a key is of a plant that one of the user's own stands in place of.
/// @param place  where it is given, with a colon behind; or empty
void require_counts(const Case& the_case, std::string_view key, const std::string& place = "");

/// OwnForce as a controller of the library (control/controlled_plant.hpp); its memory are the
/// number and the instant of the sample.
struct OwnLaw {
  static constexpr int states = 2;
  OwnForce force;  ///< empty: none
  double period;   ///< τ (s) of a steady clock; 0: instants are sums of what elapsed

  double command(const ControlSample& sample, Vector<double, 2>& memory) const {
    const double k = memory[0];
    const double t = period > 0.0 ? k * period : (k > 0.0 ? memory[1] + sample.elapsed : 0.0);
    memory << k + 1.0, t;
    if (!force) return 0.0;
    return force(static_cast<std::int64_t>(k), t, sample.displacement, sample.velocity);
  }
};

/// Control law of the case.
/// @param controlled  else without force
OwnLaw own_law_of(const Case& the_case, bool controlled);

/// The poles of a plant from its command to its readings. Throws NoAnswer where two of them
/// coincide too nearly to be told apart, or what D multiplies is not the rate of what P does: such
/// a plant has charts, responses and motions, and no sum over its poles.
std::vector<PlantPole> poles_of(const LinearPlant<double>& plant);

}  // namespace holdfast::program
