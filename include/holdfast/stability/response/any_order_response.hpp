#pragma once

#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <type_traits>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/loop_input.hpp"
#include "holdfast/control/loop_map.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/harmonic_input.hpp"
#include "holdfast/plant/linear_plant.hpp"
#include "holdfast/plant/ports.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/response/response.hpp"
#include "holdfast/stability/response/response_derivatives.hpp"

namespace holdfast {

/// The steady response of a loop of any order, and how it moves with its sampling:
///
///     (λI − S₀) Y = Q,   (λI − S₀) Y′ = Q′ − (λ′I − S₀′) Y,   Q = [s, g],   λ = e^{iωτ}
///
/// s being how the command enters and g the phasor of the excitation, which moves no command.
template <class Scalar>
class AnyOrderResponse {
 public:
  using Complex = std::complex<Scalar>;  ///< the type of the phasors

  /// @param map                the loop, whose gains do not matter
  /// @param input              `harmonic_input` of the same loop and ω
  /// @param angular_frequency  ω (rad/s), > 0
  AnyOrderResponse(const LoopMap<Scalar>& map, const HarmonicInput<Scalar, Eigen::Dynamic>& input,
                   const Scalar& angular_frequency);

  /// The responses of the conductor and of what is measured.
  LoopPhasors<Scalar> phasors() const { return read(response_); }

  /// Their derivatives along a line through the samplings.
  /// @param rate         of the loop's map, per unit of what varies
  /// @param input_rate   of the harmonic input, likewise
  /// @param period_rate  of τ, likewise: λ′ = iωλτ′
  LoopPhasors<Scalar> along(const LoopMapDerivative<Scalar>& rate,
                            const HarmonicInput<Scalar, Eigen::Dynamic>& input_rate,
                            const Scalar& period_rate) const;

 private:
  using Columns = Matrix<Complex, Eigen::Dynamic, 2>;

  static Columns sources(const Vector<Scalar, Eigen::Dynamic>& command,
                         const HarmonicInput<Scalar, Eigen::Dynamic>& input);
  LoopPhasors<Scalar> read(const Columns& response) const;

  LoopMap<Scalar> map_;
  Scalar angular_frequency_;
  Eigen::PartialPivLU<Matrix<Complex, Eigen::Dynamic>> factors_;
  Columns response_;
};

template <class Scalar>
AnyOrderResponse<Scalar>::AnyOrderResponse(const LoopMap<Scalar>& map,
                                           const HarmonicInput<Scalar, Eigen::Dynamic>& input,
                                           const Scalar& angular_frequency)
    : map_(map), angular_frequency_(angular_frequency) {
  const Scalar angle = angular_frequency * map.sampling.period;
  const Scalar half_sine = std::sin(angle / Scalar(2));
  Matrix<Complex, Eigen::Dynamic> system = -map.increment.template cast<Complex>();
  system.diagonal().array() += Complex(Scalar(-2) * half_sine * half_sine, std::sin(angle));
  factors_.compute(system);
  response_ = factors_.solve(sources(map.command, input));
}

template <class Scalar>
LoopPhasors<Scalar> AnyOrderResponse<Scalar>::along(
    const LoopMapDerivative<Scalar>& rate, const HarmonicInput<Scalar, Eigen::Dynamic>& input_rate,
    const Scalar& period_rate) const {
  const Complex lambda_rate = Complex(0, angular_frequency_ * period_rate) *
                              std::polar(Scalar(1), angular_frequency_ * map_.sampling.period);
  Columns right = sources(rate.command, input_rate) - lambda_rate * response_;
  right += rate.open_map.template cast<Complex>() * response_;
  return read(factors_.solve(right));
}

template <class Scalar>
typename AnyOrderResponse<Scalar>::Columns AnyOrderResponse<Scalar>::sources(
    const Vector<Scalar, Eigen::Dynamic>& command,
    const HarmonicInput<Scalar, Eigen::Dynamic>& input) {
  Columns result(command.size(), 2);
  result.col(0) = command.template cast<Complex>();
  result.col(1) =
      input.cosine.template cast<Complex>() - Complex(0, 1) * input.sine.template cast<Complex>();
  return result;
}

template <class Scalar>
LoopPhasors<Scalar> AnyOrderResponse<Scalar>::read(const Columns& response) const {
  const auto of = [&response](const RowVector<Scalar, Eigen::Dynamic>& row) {
    return Matrix<Complex, 1, 2>(row.template cast<Complex>() * response);
  };
  const auto z = of(map_.displacement), v = of(map_.velocity), conductor = of(map_.conductor);
  return {{z[0], v[0], z[1], v[1]}, conductor[0], conductor[1]};
}

/// How the harmonic input of a loop of any order moves with τ, per second: with c_d that of the
/// held force, cosine′ = A_d c + ω sine and sine′ = −ω cosine that of the exact one.
template <class Plant, class Scalar>
HarmonicInput<Scalar, Eigen::Dynamic> input_derivative_by_period(
    const Plant& plant, const LoopMap<Scalar>& map, ForceHold hold,
    const HarmonicInput<Scalar, Eigen::Dynamic>& input,
    const detail::Undeduced<Scalar>& angular_frequency) {
  using Column = Vector<Scalar, Eigen::Dynamic>;
  const Eigen::Index n = map.size() - map.held_commands;
  Column late = Column::Zero(map.size());
  late.head(n) = map.open_map.topLeftCorner(n, n) * plant.excitation_input();
  if (hold == ForceHold::sampled) return {late, Column::Zero(map.size())};
  return {late + angular_frequency * input.sine, -angular_frequency * input.cosine};
}

/// The complex amplitude of z over that without control and its rate, from the phasors and theirs.
inline AmplitudeRatio amplitude_ratio(const LoopPhasors<double>& phasors,
                                      const LoopPhasors<double>& rates,
                                      const PdGains<double>& gains) {
  using Complex = std::complex<double>;
  const auto& [p, d] = gains;
  const auto& [t_z, t_v, f_z, f_v] = phasors.measured;
  const auto& [t_z_rate, t_v_rate, f_z_rate, f_v_rate] = rates.measured;
  const Complex t = phasors.control_conductor, f = phasors.excitation_conductor;
  const Complex t_rate = rates.control_conductor, f_rate = rates.excitation_conductor;
  // (f (1 − P t_z − D t_v) + t (P f_z + D f_v)) / (f (1 − P t_z − D t_v))
  const Complex below = 1.0 - p * t_z - d * t_v, fed_back = p * f_z + d * f_v;
  const Complex below_rate = -p * t_z_rate - d * t_v_rate;
  const Complex fed_back_rate = p * f_z_rate + d * f_v_rate;
  const Complex change = t * fed_back / (f * below);
  const Complex change_rate = (t_rate * fed_back + t * fed_back_rate) / (f * below) -
                              change * (f_rate / f + below_rate / below);
  return {1.0 + change, change_rate};
}

namespace detail {

/// What gives a plant's response with its derivatives, from the loop of `loop_of`.
template <class Plant>
using MovingResponse =
    std::conditional_t<has_closed_forms<Plant>, ResponseDerivatives, AnyOrderResponse<double>>;

/// The steady response of a loop in the form that it has: of the two masses, or of any order.
template <class Plant, class Loop>
SteadyResponse<double> response_of_loop(const Plant& plant, const Loop& loop, ForceHold hold,
                                        double angular_frequency) {
  const auto input = harmonic_input(plant, loop, hold, angular_frequency);
  if constexpr (std::is_same_v<Loop, SampledLoop<double>>) {
    return {loop, input, angular_frequency};
  } else {
    return SteadyResponse<double>(
        AnyOrderResponse<double>(loop, input, angular_frequency).phasors());
  }
}

}  // namespace detail

/// The steady response of a plant's loop: in closed form of the two masses with δ ≤ τ, of any other
/// plant, and for longer delays, from the loop's map.
/// @param plant              any order; its ports say what is measured and what the conductor is
/// @param sampling           τ (s) > 0, δ (s) 0 … 1000 τ
/// @param hold               how the excitation enters a sample
/// @param angular_frequency  ω (rad/s), > 0
/// @throws InvalidParameter outside these ranges
template <class Plant>
SteadyResponse<double> steady_response(const Plant& plant, const Sampling<double>& sampling,
                                       ForceHold hold, double angular_frequency) {
  require_positive("angular frequency", angular_frequency, "rad/s");
  if constexpr (has_closed_forms<Plant>) {
    if (sampling.processing_delay <= sampling.period) {
      validate(sampling);
      return detail::response_of_loop(plant, sampled_loop(plant, sampling), hold,
                                      angular_frequency);
    }
  }
  return detail::response_of_loop(plant, loop_map(plant, sampling), hold, angular_frequency);
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template class AnyOrderResponse<double>;
extern template SteadyResponse<double> steady_response(const TwoMass<double>&,
                                                       const Sampling<double>&, ForceHold, double);
extern template SteadyResponse<double> steady_response(const LinearPlant<double>&,
                                                       const Sampling<double>&, ForceHold, double);
#endif

}  // namespace holdfast
