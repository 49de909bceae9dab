#pragma once

#include <optional>
#include <vector>

#include "holdfast/contact/contact.hpp"
#include "holdfast/contact/contact_law.hpp"
#include "holdfast/control/controller.hpp"
#include "holdfast/control/digital_loop.hpp"
#include "holdfast/excitation/harmonic.hpp"
#include "holdfast/excitation/harmonic_excitation.hpp"
#include "holdfast/motion/event_motion.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/plant/ports.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// A sampled loop with the limits of real sensors, computers, drives and clocks, for any backlash
/// law and any excitation. The contact changes either at samples only or at any instant.
/// @tparam Plant  TwoMass<double>, a LinearPlant<double, N> or a ControlledPlant
template <class Plant>
struct ImplementedLoopOf {
  static_assert(detail::IsDriven<Plant>::value,
                "the plant of a motion must define its drive and gap: use a "
                "TwoMass, a LinearPlant or with_controller()");

  Plant plant;                       ///< conductor, absorber and any further states
  DigitalLoop digital;               ///< sampling, gains, controller limits, clock and excitation
  BacklashParameters backlash = {};  ///< law and width; default: ContactLaw::kollar, r₀ = 0
  Switching switching = Switching::sampled;  ///< contact changes at samples only or at any instant
};

/// The implemented loop of the two masses.
using ImplementedLoop = ImplementedLoopOf<TwoMass<double>>;

/// Validates a loop. @throws InvalidParameter where any part is not admissible, or where gains or
/// controller limits are set although the plant contains a user-defined controller
/// (with_controller())
template <class Plant>
void validate(const ImplementedLoopOf<Plant>& loop) {
  validate(loop.plant);
  validate(loop.digital);
  validate(loop.backlash);
  if constexpr (detail::HasController<Plant>::value) {
    const PdGains<double>& gains = loop.digital.gains;
    require_within("gain P in addition to a user-defined controller", gains.proportional, "N/m",
                   0.0, 0.0);
    require_within("gain D in addition to a user-defined controller", gains.differential, "N s/m",
                   0.0, 0.0);
    if (!is_ideal(loop.digital.limits))
      throw InvalidParameter("controller limits (1: set) in addition to a user-defined controller",
                             1.0, "", "0: program quantisation and limits in that controller");
  }
}

/// Converts an IdealLoop (the model of Kollár 2022) to an ImplementedLoop with the same motions.
template <class Plant>
ImplementedLoopOf<Plant> implemented_loop(const IdealLoop<double, Plant>& loop) {
  return {loop.plant,
          digital_loop(loop),
          {ContactLaw::kollar, loop.backlash_width},
          Switching::sampled};
}

/// Converts a loop to an IdealLoop (the model of Kollár 2022) with the same motions, for use with
/// SampledMotion. Conditions: contact changes at samples, ContactLaw::kollar or none, at most one
/// harmonic (at phase 0), no recorded force, no user-defined controller, ideal limits, no jitter.
/// @return nullopt where a condition fails
template <class Plant>
std::optional<IdealLoop<double, Plant>> ideal_loop(const ImplementedLoopOf<Plant>& loop) {
  if (detail::HasController<Plant>::value) return std::nullopt;
  const DigitalLoop& digital = loop.digital;
  const std::vector<Harmonic>& lines = digital.force.harmonics;
  const bool without_backlash = loop.backlash.law == ContactLaw::none;
  if (loop.switching != Switching::sampled || !is_ideal(digital.limits) ||
      digital.jitter.half_width != 0.0 || digital.force.record != nullptr || lines.size() > 1 ||
      (!lines.empty() && lines.front().phase != 0.0) ||
      !(without_backlash || loop.backlash.law == ContactLaw::kollar))
    return std::nullopt;
  HarmonicExcitation<double> excitation{0.0, 1.0};
  if (!lines.empty()) excitation = {lines.front().amplitude, lines.front().frequency};
  return IdealLoop<double, Plant>{loop.plant,
                                  digital.sampling,
                                  digital.gains,
                                  excitation,
                                  without_backlash ? 0.0 : loop.backlash.width,
                                  digital.hold};
}

/// The motion of a loop from the initial state x₀, N × 1; for two masses [z₁, ż₁, z₂, ż₂].
/// @throws InvalidParameter where the loop is not admissible, or the state not finite or not N × 1
template <class Plant>
EventMotion<DriveContact<Plant>> event_motion(const ImplementedLoopOf<Plant>& loop,
                                              const StateOf<Plant>& initial_state) {
  validate(loop);
  return {loop.digital,
          DriveContact<Plant>(loop.plant, loop.backlash, loop.switching, initial_state),
          initial_state};
}
/// The motion of an implemented loop from an initial state given as any Eigen column vector.
template <class Plant, class Column>
EventMotion<DriveContact<Plant>> event_motion(const ImplementedLoopOf<Plant>& loop,
                                              const Eigen::MatrixBase<Column>& initial_state) {
  return event_motion(loop, detail::state_of(loop.plant, initial_state));
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template EventMotion<DriveContact<>> event_motion(const ImplementedLoop&,
                                                         const StateOf<TwoMass<double>>&);
extern template EventMotion<DriveContact<ControlledPlant>> event_motion(
    const ImplementedLoopOf<ControlledPlant>&, const StateOf<ControlledPlant>&);
#endif

}  // namespace holdfast
