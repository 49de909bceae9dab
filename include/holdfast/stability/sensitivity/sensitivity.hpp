#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/boundary/boundary_point.hpp"
#include "holdfast/stability/chart/loop_chart.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"
#include "holdfast/stability/polynomial/loop_derivatives.hpp"
#include "holdfast/stability/polynomial/loop_polynomial.hpp"

namespace holdfast {

/// Derivatives of one quantity by all that the sampled loop is made of, each per SI unit. A gain's
/// own entry is 0 where the quantity is that gain.
struct LoopSensitivity {
  /// In the order of `LoopParameter`, `loop_parameters` × 1.
  Vector<double, loop_parameters> entries = Vector<double, loop_parameters>::Zero();

  /// The derivative by one parameter.
  double& operator[](LoopParameter parameter) { return entries[static_cast<int>(parameter)]; }
  /// The derivative by one parameter.
  double operator[](LoopParameter parameter) const { return entries[static_cast<int>(parameter)]; }
};

/// ∂ ln|y| / ∂ ln|x|: by how many per cent the quantity y changes when a parameter x changes by
/// one. 0 for a parameter that is 0.
/// @param sensitivity  ∂y/∂x
/// @param point        the loop at which the derivatives were taken
/// @param value        y, not 0
inline LoopSensitivity logarithmic(LoopSensitivity sensitivity, OperatingPoint point,
                                   double value) {
  for (int k = 0; k < loop_parameters; ++k)
    sensitivity.entries[k] *= value_of(point, static_cast<LoopParameter>(k));
  sensitivity.entries /= value;
  return sensitivity;
}

/// The sensitivity when P follows k₂ and m₂ by Eq. 6, P = k₂ − m₂ ω², instead of being held.
/// @param sensitivity  with P held
/// @param frequency    f = ω / 2π (Hz) to which P is tuned, > 0
inline LoopSensitivity with_tuned_gain(LoopSensitivity sensitivity, double frequency) {
  const double omega = 2.0 * pi<double> * frequency;
  double& by_gain = sensitivity[LoopParameter::proportional_gain];
  sensitivity[LoopParameter::absorber_stiffness] += by_gain;
  sensitivity[LoopParameter::absorber_mass] -= omega * omega * by_gain;
  by_gain = 0.0;
  return sensitivity;
}

namespace detail {

/// Derivatives by the parameters of a loop, in the order of `LoopParameter`: the plant's six, τ, δ
/// and the gains.
using Entries = Vector<double, loop_parameters>;
using LoopDerivatives = std::array<LoopDerivative, loop_parameters>;
using DualEntry = DualNumber<loop_parameters>;
using LoopRoot = RootSensitivity<loop_parameters>;
inline constexpr int by_period = 6, by_delay = 7, by_p = 8, by_d = 9;

/// How A, b and c move with m, k and c of both masses.
template <class Scalar>
std::array<PlantDerivative, 6> plant_derivatives(const TwoMass<Scalar>& plant) {
  const auto seed = [](const Scalar& value, int index) { return DualNumber<6>(value, 6, index); };
  const TwoMass<DualNumber<6>> carrying{
      seed(plant.conductor_mass, 0),     seed(plant.conductor_stiffness, 1),
      seed(plant.conductor_damping, 2),  seed(plant.absorber_mass, 3),
      seed(plant.absorber_stiffness, 4), seed(plant.absorber_damping, 5)};
  std::array<PlantDerivative, 6> rates;
  for (int i = 0; i < 6; ++i) rates[static_cast<std::size_t>(i)] = plant_derivative<6>(carrying, i);
  return rates;
}

/// How the loop's matrices move; the gains do not move them.
template <class Scalar>
LoopDerivatives loop_derivatives(const TwoMass<Scalar>& plant, const SampledLoop<Scalar>& loop) {
  LoopDerivatives rates;
  const auto by_plant = plant_derivatives(plant);
  for (std::size_t i = 0; i < by_plant.size(); ++i)
    rates[i] = derivative_by_plant(by_plant[i], loop.sampling);
  rates[by_period] = derivative_by_period(plant, loop);
  rates[by_delay] = derivative_by_delay(plant, loop);
  return rates;
}

/// The loop's polynomial with its derivatives, in powers of λ − centre.
struct DualPolynomial {
  double centre;  ///< that of `loop_polynomial`
  AffinePolynomial<DualEntry, 5, PolynomialVariable::about_centre> affine;

  /// At some gains, which carry their derivatives too.
  Polynomial<DualEntry, 5> at(const PdGains<double>& gains) const {
    return affine.at({DualEntry(gains.proportional, loop_parameters, by_p),
                      DualEntry(gains.differential, loop_parameters, by_d)});
  }
};

/// @throws InvalidParameter for a plant, sampling or gains outside their ranges
template <class Scalar>
DualPolynomial dual_polynomial(const TwoMass<Scalar>& plant, const Sampling<Scalar>& sampling,
                               const PdGains<double>& gains) {
  validate(plant);
  validate(sampling);
  validate(gains);
  const auto loop = sampled_loop(plant, sampling);
  const auto dual = dual_loop<loop_parameters>(loop, loop_derivatives(plant, loop));
  const double centre = loop_polynomial(loop).centre;
  return {centre, polynomial_about(static_cast<int>(centre), dual)};
}

/// All roots of a loop with their rates by all parameters.
template <class Scalar>
std::vector<LoopRoot> moving_roots(const TwoMass<Scalar>& plant, const Sampling<double>& sampling,
                                   const PdGains<double>& gains) {
  const DualPolynomial polynomial = dual_polynomial(plant, sampling, gains);
  return root_sensitivities<loop_parameters>(polynomial.at(gains), polynomial.centre);
}

/// How entry number `own` must follow the others to keep the value of which this is the gradient,
/// such as ln|λ| of a root: −∂_x / ∂_own, and 0 by itself.
inline Entries implicit_derivative(const Entries& gradient, int own) {
  Entries result = -gradient / gradient[own];
  result[own] = 0.0;
  return result;
}

}  // namespace detail

/// How the boundary moves: the sensitivity of the gain at which a root has |λ| = radius, such as an
/// end of `stable_differential_gains` at a fixed P or of `stable_proportional_gains` at a fixed D.
///
/// The modulus of that root is a function of all parameters and stays what it is:
///
///     ∂D/∂x = −(∂ ln|λ|/∂x) / (∂ ln|λ|/∂D),   ∂λ/∂x = −(∂p/∂x)/(∂p/∂λ)
///
/// with ∂p/∂x from numbers that carry derivatives. Infinite where the boundary turns back
/// (∂|λ|/∂D = 0). Where two boundary curves meet it is that of one of them. By δ it is one-sided at
/// δ = 0 and at δ = τ.
/// @param plant     m, k and c of both masses, within their ranges
/// @param sampling  τ (s) > 0, δ (s) 0 … τ
/// @param gains     on the boundary, finite
/// @param gain      the one whose sensitivity is returned, the other being held
/// @param radius    of the boundary, > 0; 1 is that of stability
/// @throws InvalidParameter outside the admissible ranges
template <class Scalar>
LoopSensitivity boundary_gain_sensitivity(const TwoMass<Scalar>& plant,
                                          const Sampling<double>& sampling,
                                          const PdGains<double>& gains, FreeGain gain,
                                          double radius = 1.0) {
  const auto roots = detail::moving_roots(plant, sampling, gains);
  require_positive("radius", radius, "");
  const auto distance = [radius](const auto& root) {
    return std::abs(root.excess() - (radius - 1.0));
  };
  const auto& nearest =
      *std::min_element(roots.begin(), roots.end(),
                        [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  return {detail::implicit_derivative(
      nearest.logarithmic_rates(), gain == FreeGain::proportional ? detail::by_p : detail::by_d)};
}

/// The sensitivity of the spectral radius ρ = max |λ|. Where two roots share the largest modulus ρ
/// has no derivative; that of one of them is returned.
/// @throws InvalidParameter outside the admissible ranges
template <class Scalar>
LoopSensitivity radius_sensitivity(const TwoMass<Scalar>& plant, const Sampling<double>& sampling,
                                   const PdGains<double>& gains) {
  const auto roots = detail::moving_roots(plant, sampling, gains);
  const auto& dominant = *std::max_element(
      roots.begin(), roots.end(),
      [](const auto& a, const auto& b) { return a.radius_offset() < b.radius_offset(); });
  return {dominant.logarithmic_rates() * std::abs(dominant.value())};
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template LoopSensitivity boundary_gain_sensitivity(const TwoMass<double>&,
                                                          const Sampling<double>&,
                                                          const PdGains<double>&, FreeGain, double);
extern template LoopSensitivity radius_sensitivity(const TwoMass<double>&, const Sampling<double>&,
                                                   const PdGains<double>&);
#endif

}  // namespace holdfast
