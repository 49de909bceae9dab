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

/// User-defined control law: force (N) at sample k and time t (s), from readings (m, m/s).
using OwnForce =
    std::function<double(std::int64_t k, double t, double displacement, double velocity)>;

/// User-defined parts of a case, which a calling program supplies; a case file cannot.
struct OwnParts {
  std::optional<LinearPlant<double>> plant;  ///< plant instead of conductor and absorber
  Vector<double, Eigen::Dynamic> state;      ///< initial state of that plant
  OwnForce controller;                       ///< control law; empty: P and D
};

/// Throws WrongInput if a key contradicts the user-defined plant or controller, or has no effect.
void require_consistent(const Case& the_case);

/// Throws WrongInput for a key that has no effect because a user-defined plant replaces it.
/// @param place  place where the key is given, with ": " at the end; or empty
void require_counts(const Case& the_case, std::string_view key, const std::string& place = "");

/// Adapter of an OwnForce to the controllers of control/controlled_plant.hpp. Its two memory states
/// are the index of the next sample and the time (s) of the last one.
struct OwnLaw {
  static constexpr int states = 2;
  OwnForce force;  ///< control law; empty: no force
  double period;   ///< τ (s) of regular samples; 0: instants are sums of elapsed times

  double command(const ControlSample& sample, Vector<double, 2>& memory) const {
    const double k = memory[0];
    const double t = period > 0.0 ? k * period : (k > 0.0 ? memory[1] + sample.elapsed : 0.0);
    memory << k + 1.0, t;
    if (!force) return 0.0;
    return force(static_cast<std::int64_t>(k), t, sample.displacement, sample.velocity);
  }
};

/// The user-defined control law of the case.
/// @param controlled  false: the law gives no force
OwnLaw own_law_of(const Case& the_case, bool controlled);

/// Poles of a plant, with the residues from its command to its displacement reading. Throws
/// NoAnswer if two poles nearly coincide, or if the velocity reading is not the derivative of the
/// displacement reading. Charts, responses and motions do not need these poles.
std::vector<PlantPole> poles_of(const LinearPlant<double>& plant);

}  // namespace holdfast::program
