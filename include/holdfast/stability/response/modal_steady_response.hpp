#pragma once

#include <complex>
#include <vector>

#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/excitation/harmonic_input.hpp"
#include "holdfast/math/linalg/complex_exponential.hpp"
#include "holdfast/plant/conductor_with_absorber.hpp"
#include "holdfast/plant/modal_plant.hpp"
#include "holdfast/plant/plant_poles.hpp"
#include "holdfast/stability/response/modal_response.hpp"
#include "holdfast/stability/response/response.hpp"

namespace holdfast {

/// The amplitude |z| / F_m (m/N) of a conductor given by its modes, without control. Both the force
/// F_m cos ωt, not held over samples, and the displacement z are at the absorber's place. The
/// amplitude is the modulus of `place_receptance` at s = iω. The arguments are not checked.
/// @param conductor          conductor; its poles are needed only if devices are on the span
/// @param angular_frequency  ω (rad/s), > 0
inline double true_amplitude_per_force(const ConductorWithAbsorber& conductor,
                                       double angular_frequency) {
  return std::abs(place_receptance(conductor, {0.0, angular_frequency}));
}

namespace detail {

/// The `steady_response` of a conductor with all its poles and a measured velocity (unchecked).
template <class Scalar>
SteadyResponse<Scalar> steady_response_by_poles(const ConductorWithAbsorber& conductor,
                                                const Sampling<double>& sampling, ForceHold hold,
                                                double angular_frequency) {
  using Complex = std::complex<double>;
  const Complex turn = circle_increment(angular_frequency * sampling.period);
  const detail::HardwarePoles lags(conductor.hardware);
  const auto answer = [&](const std::vector<PlantPole>& poles, const Sampling<Scalar>& at) {
    return modal_response<Scalar>(poles, at).at_distance_from_one(turn);
  };
  const auto driven = detail::lagged(conductor.poles, lags.drive);
  const auto place = answer(driven, sampling);
  const auto read =
      lags.filter.empty() ? place : answer(detail::lagged(driven, lags.filter), sampling);
  CommandResponse<double> force, read_force;
  if (hold == ForceHold::exact) {
    const Complex s(0.0, angular_frequency);
    const Complex there = place_receptance(conductor, s);
    const Complex filtered = there * detail::HardwarePoles::lag(lags.filter, s);
    force = {there, s * there};
    read_force = {filtered, s * filtered};
  } else {
    // A held force on the conductor alone is a drive without delay whose whole force reaches it.
    std::vector<PlantPole> of_force = conductor.poles;
    for (PlantPole& pole : of_force)
      pole.residue /= detail::transmitted_share(conductor.absorber, pole.s);
    force = answer(of_force, {sampling.period});
    read_force = lags.filter.empty()
                     ? force
                     : answer(detail::lagged(of_force, lags.filter), {sampling.period});
  }
  return SteadyResponse<double>({read.displacement, read.velocity, read_force.displacement,
                                 read_force.velocity, place.displacement, force.displacement});
}

}  // namespace detail

/// The steady response of the loop of a conductor given by its modes to a force at the absorber's
/// place. It equals the `steady_response` of the conductor's `linear_plant`, but the work is only
/// proportional to the number of poles.
/// @param conductor          conductor with all its poles. Without poles, or with a pole of the
///                           filter or drive among them, the `linear_plant` is used
/// @param sampling           τ (s) > 0, δ (s) 0 … 1000 τ
/// @param hold               whether the excitation force is held over each sample
/// @param angular_frequency  ω (rad/s), > 0
/// @throws InvalidParameter where an argument is outside its range
template <class Scalar = double>
SteadyResponse<Scalar> steady_response(const ConductorWithAbsorber& conductor,
                                       const Sampling<double>& sampling, ForceHold hold,
                                       double angular_frequency) {
  require_positive("angular frequency", angular_frequency, "rad/s");
  validate(conductor.hardware);
  if (!conductor.hardware.has_velocity_sensor) {
    ConductorWithAbsorber measured = conductor;
    measured.hardware.has_velocity_sensor = true;
    return steady_response<Scalar>(measured, sampling, hold, angular_frequency)
        .with_velocity_by_difference(angular_frequency * sampling.period, sampling.period);
  }
  if (with_hardware(conductor.poles, conductor.hardware).empty())
    return steady_response(linear_plant<Scalar>(conductor), sampling, hold, angular_frequency);
  return detail::steady_response_by_poles<Scalar>(conductor, sampling, hold, angular_frequency);
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template SteadyResponse<double> steady_response<double>(const ConductorWithAbsorber&,
                                                               const Sampling<double>&, ForceHold,
                                                               double);
#endif

}  // namespace holdfast
