#pragma once

#include <optional>
#include <type_traits>

#include "holdfast/contact/hysteresis.hpp"
#include "holdfast/control/digital_loop.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/control/loop_input.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/rational.hpp"
#include "holdfast/excitation/forcing.hpp"
#include "holdfast/excitation/harmonic_excitation.hpp"
#include "holdfast/excitation/multi_harmonic_force.hpp"
#include "holdfast/motion/sampled_motion.hpp"
#include "holdfast/plant/linear_plant.hpp"
#include "holdfast/plant/port_readings.hpp"
#include "holdfast/plant/ports.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// The sampled loop of Kollár 2022: plant, sampling, gains, excitation and backlash.
/// @tparam Plant  TwoMass<Scalar> or a LinearPlant<Scalar, N>
template <class Scalar, class Plant = TwoMass<Scalar>>
struct IdealLoop {
  static_assert(detail::IsDriven<Plant>::value,
                "the plant of a motion must define its drive and gap: use a "
                "TwoMass, a LinearPlant or with_controller()");

  Plant plant;                            ///< conductor, absorber and further states
  Sampling<Scalar> sampling;              ///< sampling period τ, processing delay δ (s)
  PdGains<Scalar> gains;                  ///< gains P (N/m) and D (N s/m)
  HarmonicExcitation<Scalar> excitation;  ///< amplitude F_m (N), frequency f (Hz)
  Scalar backlash_width = Scalar(0);      ///< width r₀ of the backlash (m), ≥ 0
  ForceHold hold = ForceHold::sampled;    ///< force held over each sampling period, or exact
};

/// Validates a loop. @throws InvalidParameter where any part is not admissible
template <class Plant>
void validate(const IdealLoop<double, Plant>& loop) {
  validate(loop.plant);
  validate(loop.sampling);
  validate(loop.gains);
  validate(loop.excitation);
  validate_backlash_width(loop.backlash_width);
}

/// Converts a loop to another number type, for instance `long double`.
template <class To, class From, class Plant>
auto converted(const IdealLoop<From, Plant>& loop) {
  const auto plant = converted<To>(loop.plant);
  return IdealLoop<To, std::decay_t<decltype(plant)>>{
      plant,
      {To(loop.sampling.period), To(loop.sampling.processing_delay)},
      {To(loop.gains.proportional), To(loop.gains.differential)},
      {To(loop.excitation.amplitude), To(loop.excitation.frequency)},
      To(loop.backlash_width),
      loop.hold};
}

/// The DigitalLoop of an IdealLoop: its sampling, gains and harmonic force, with an ideal computer.
template <class Plant>
DigitalLoop digital_loop(const IdealLoop<double, Plant>& loop) {
  return {loop.sampling, loop.gains, multi_harmonic_force(loop.excitation), loop.hold};
}

/// The excitation frequency f (Hz) times the sampling period τ (s) as a fraction p/q in lowest
/// terms; 0/1 without excitation. @return nullopt where q > 10⁶ (f and 1/τ incommensurate)
template <class Plant>
std::optional<Rational> forcing_ratio(const IdealLoop<double, Plant>& loop) {
  return forcing_ratio(digital_loop(loop));
}

/// The motion of a sampled loop under a harmonic force that repeats every q samples: f τ = p/q with
/// the frequency f and the sampling period τ.
template <class Scalar, class Plant = TwoMass<Scalar>>
using PeriodicallyForcedMotion =
    SampledMotion<Scalar, Backlash<Scalar>, PeriodicForcing<Scalar, states_of<Plant>>, Plant>;

/// The motion of a sampled loop under a harmonic force of any frequency.
template <class Scalar, class Plant = TwoMass<Scalar>>
using HarmonicallyForcedMotion =
    SampledMotion<Scalar, Backlash<Scalar>, HarmonicForcing<Scalar, states_of<Plant>>, Plant>;

namespace detail {

/// The motion of a loop under Forcing(input, more...), `input` being the loop's HarmonicInput.
template <class Forcing, class Scalar, class Plant, class... More>
SampledMotion<Scalar, Backlash<Scalar>, Forcing, Plant> forced_motion(
    const IdealLoop<Scalar, Plant>& loop, const StateOf<Plant>& initial_state,
    const More&... more) {
  validate(converted<double>(loop));
  require_state(initial_state, loop.plant);
  const auto sampled = sampled_loop(loop.plant, loop.sampling);
  const auto input =
      harmonic_input(loop.plant, sampled, loop.hold, loop.excitation.angular_frequency());
  return {sampled,
          loop.gains,
          Forcing(input, more...),
          Backlash<Scalar>(loop.backlash_width),
          initial_state,
          PortReadings<Plant>(loop.plant)};
}

}  // namespace detail

/// The motion from an initial state under a harmonic force that repeats exactly every q samples.
/// @param loop           the loop with its excitation and backlash
/// @param ratio          p/q from forcing_ratio(), from which the phases of the force are computed
/// @param initial_state  x₀, N × 1; for two masses [z₁, ż₁, z₂, ż₂] (m, m/s, m, m/s)
/// @throws InvalidParameter where the loop or the state is not admissible
template <class Scalar, class Plant>
PeriodicallyForcedMotion<Scalar, Plant> periodically_forced_motion(
    const IdealLoop<Scalar, Plant>& loop, const Rational& ratio,
    const StateOf<Plant>& initial_state) {
  return detail::forced_motion<PeriodicForcing<Scalar, states_of<Plant>>>(
      loop, initial_state, loop.excitation.amplitude, ratio);
}
/// The periodically forced motion from any Eigen column vector; `ratio` is from forcing_ratio().
template <class Scalar, class Plant, class Column>
PeriodicallyForcedMotion<Scalar, Plant> periodically_forced_motion(
    const IdealLoop<Scalar, Plant>& loop, const Rational& ratio,
    const Eigen::MatrixBase<Column>& initial_state) {
  return periodically_forced_motion(loop, ratio, detail::state_of(loop.plant, initial_state));
}

/// The motion from an initial state under a harmonic force of any frequency.
/// @param loop           the loop with its excitation and backlash
/// @param initial_state  state x₀, N × 1
/// @throws InvalidParameter where the loop or the state is not admissible
template <class Scalar, class Plant>
HarmonicallyForcedMotion<Scalar, Plant> harmonically_forced_motion(
    const IdealLoop<Scalar, Plant>& loop, const StateOf<Plant>& initial_state) {
  return detail::forced_motion<HarmonicForcing<Scalar, states_of<Plant>>>(
      loop, initial_state, loop.excitation, loop.sampling.period);
}
/// The harmonically forced motion from an initial state given as any Eigen column vector.
template <class Scalar, class Plant, class Column>
HarmonicallyForcedMotion<Scalar, Plant> harmonically_forced_motion(
    const IdealLoop<Scalar, Plant>& loop, const Eigen::MatrixBase<Column>& initial_state) {
  return harmonically_forced_motion(loop, detail::state_of(loop.plant, initial_state));
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template HarmonicallyForcedMotion<double> harmonically_forced_motion(
    const IdealLoop<double>&, const StateOf<TwoMass<double>>&);
extern template PeriodicallyForcedMotion<double> periodically_forced_motion(
    const IdealLoop<double>&, const Rational&, const StateOf<TwoMass<double>>&);
#endif

}  // namespace holdfast
