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
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"
#include "holdfast/stability/polynomial/loop_derivatives.hpp"
#include "holdfast/stability/polynomial/loop_polynomial.hpp"
#include "holdfast/stability/polynomial/root_sensitivity.hpp"

namespace holdfast {

/// Derivatives of one quantity by all that the sampled loop is made of, each per SI unit. A gain's
/// own entry is 0 where the quantity is that gain.
struct LoopSensitivity {
  double conductor_mass;       ///< by m₁, per kg
  double conductor_stiffness;  ///< by k₁, per N/m
  double conductor_damping;    ///< by c₁, per N s/m
  double absorber_mass;        ///< by m₂, per kg
  double absorber_stiffness;   ///< by k₂, per N/m
  double absorber_damping;     ///< by c₂, per N s/m
  double sampling_period;      ///< by τ, per s
  double processing_delay;     ///< by δ, per s
  double proportional_gain;    ///< by P, per N/m
  double differential_gain;    ///< by D, per N s/m
};

/// Number of entries of `LoopSensitivity`.
inline constexpr int loop_parameters = 10;

/// The entries in the order of their declaration.
template <class Scalar = double>
Vector<Scalar, loop_parameters> entries_of(const LoopSensitivity& s) {
  Vector<Scalar, loop_parameters> result;
  result << s.conductor_mass, s.conductor_stiffness, s.conductor_damping, s.absorber_mass,
      s.absorber_stiffness, s.absorber_damping, s.sampling_period, s.processing_delay,
      s.proportional_gain, s.differential_gain;
  return result;
}

/// The sensitivity with these entries.
/// @param entries  `loop_parameters` × 1, or an expression of that size
template <class Derived>
LoopSensitivity sensitivity_of(const Eigen::MatrixBase<Derived>& entries) {
  static_assert(Derived::SizeAtCompileTime == loop_parameters, "one entry for each parameter");
  const auto e = entries.eval();
  return {e[0], e[1], e[2], e[3], e[4], e[5], e[6], e[7], e[8], e[9]};
}

/// ∂ ln|y| / ∂ ln|x|: by how many per cent the quantity y changes when a parameter x changes by
/// one. 0 for a parameter that is 0.
/// @param sensitivity  ∂y/∂x
/// @param plant        that at which the derivatives were taken
/// @param sampling     τ (s) and δ (s) there
/// @param gains        P (N/m) and D (N s/m) there
/// @param value        y, not 0
template <class Scalar>
LoopSensitivity logarithmic(const LoopSensitivity& sensitivity, const TwoMass<Scalar>& plant,
                            const Sampling<double>& sampling, const PdGains<double>& gains,
                            double value) {
  const auto parameters = entries_of<Scalar>(
      {plant.conductor_mass, plant.conductor_stiffness, plant.conductor_damping,
       plant.absorber_mass, plant.absorber_stiffness, plant.absorber_damping, sampling.period,
       sampling.processing_delay, gains.proportional, gains.differential});
  return sensitivity_of(entries_of<Scalar>(sensitivity).cwiseProduct(parameters) / value);
}

/// The sensitivity when P follows k₂ and m₂ by Eq. 6, P = k₂ − m₂ ω², instead of being held.
/// @param sensitivity  with P held
/// @param frequency    f = ω / 2π (Hz) to which P is tuned, > 0
inline LoopSensitivity with_tuned_gain(LoopSensitivity sensitivity, double frequency) {
  const double omega = 2.0 * pi<double> * frequency;
  sensitivity.absorber_stiffness += sensitivity.proportional_gain;
  sensitivity.absorber_mass -= omega * omega * sensitivity.proportional_gain;
  sensitivity.proportional_gain = 0.0;
  return sensitivity;
}

namespace detail {

inline constexpr int carried_parameters = 8;  // the plant's six, τ and δ; the gains come from p
using LoopDerivatives = std::array<LoopDerivative, carried_parameters>;

/// The derivatives by the parameters that a polynomial carries, then by P and by D.
template <int Carried = carried_parameters>
using Entries = Vector<double, Carried + 2>;

/// The plant whose members carry their own derivatives, in the order of `LoopSensitivity`.
template <class Scalar>
TwoMass<DualNumber<6>> seeded(const TwoMass<Scalar>& plant) {
  const auto seed = [](const Scalar& value, int index) { return DualNumber<6>(value, 6, index); };
  return {seed(plant.conductor_mass, 0),     seed(plant.conductor_stiffness, 1),
          seed(plant.conductor_damping, 2),  seed(plant.absorber_mass, 3),
          seed(plant.absorber_stiffness, 4), seed(plant.absorber_damping, 5)};
}

template <class Scalar>
std::array<PlantDerivative, 6> plant_derivatives(const TwoMass<Scalar>& plant) {
  const auto carrying = seeded(plant);
  std::array<PlantDerivative, 6> rates;
  for (int i = 0; i < 6; ++i) rates[static_cast<std::size_t>(i)] = plant_derivative<6>(carrying, i);
  return rates;
}

template <class Scalar>
LoopDerivatives loop_derivatives(const TwoMass<Scalar>& plant, const SampledLoop<Scalar>& loop) {
  LoopDerivatives rates;
  const auto by_plant = plant_derivatives(plant);
  for (std::size_t i = 0; i < 6; ++i)
    rates[i] = derivative_by_plant(plant, by_plant[i], loop.sampling);
  rates[6] = derivative_by_period(plant, loop);
  rates[7] = derivative_by_delay(plant, loop);
  return rates;
}

/// The loop's polynomial with its derivatives, in powers of λ − centre.
template <int Carried = carried_parameters>
struct DualPolynomial {
  double centre;  ///< that of `loop_polynomial`
  AffinePolynomial<DualNumber<Carried>, 5> polynomial;
};

template <class Scalar>
DualPolynomial<> dual_polynomial(const TwoMass<Scalar>& plant, const Sampling<Scalar>& sampling) {
  const auto loop = sampled_loop(plant, sampling);
  const auto dual = dual_loop<carried_parameters>(loop, loop_derivatives(plant, loop));
  const double centre = loop_polynomial(loop).centre;
  return {centre, centre == 0.0 ? characteristic_polynomial_in_lambda(dual)
                                : characteristic_polynomial(dual)};
}

template <int Carried>
std::vector<RootSensitivity<Carried>> roots_of(const DualPolynomial<Carried>& loop,
                                               const PdGains<double>& gains) {
  return root_sensitivities<Carried>(loop.polynomial, gains, loop.centre);
}

/// ∂ ln|λ| by every parameter.
template <int Carried>
Entries<Carried> gradient_of(const RootSensitivity<Carried>& root) {
  Entries<Carried> result;
  for (int i = 0; i < Carried; ++i) result[i] = root.logarithmic_derivative(root.rates[i]);
  result[Carried] = root.logarithmic_derivative(root.derivative_by_proportional_gain);
  result[Carried + 1] = root.logarithmic_derivative(root.derivative_by_differential_gain);
  return result;
}

/// The root whose modulus is nearest to a radius.
template <int Carried>
RootSensitivity<Carried> root_at_radius(const std::vector<RootSensitivity<Carried>>& roots,
                                        double radius) {
  const auto distance = [radius](const auto& root) {
    return std::abs(root.excess() - (radius - 1.0));
  };
  return *std::min_element(roots.begin(), roots.end(),
                           [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
}

/// How entry number `own` must follow the others to keep the value of which this is the gradient,
/// such as ln|λ| of a root: −∂_x / ∂_own, and 0 by itself.
template <class Derived>
typename Derived::PlainObject implicit_derivative(const Eigen::MatrixBase<Derived>& gradient,
                                                  int own) {
  typename Derived::PlainObject result = -gradient / gradient[own];
  result[own] = 0.0;
  return result;
}

}  // namespace detail

/// Which gain of the boundary is asked for, the other being held.
enum class BoundaryGain { proportional, differential };

/// How the boundary moves: the sensitivity of the gain at which a root has |λ| = radius, such as an
/// end of `stable_differential_gains` at a fixed P or of `stable_proportional_gains` at a fixed D.
///
/// The modulus of that root is a function of all parameters and stays what it is:
///
///     ∂D/∂x = −(∂ ln|λ|/∂x) / (∂ ln|λ|/∂D),   ∂λ/∂x = −(∂p/∂x)/(∂p/∂λ)
///
/// with ∂p/∂x from the kernel of p itself on numbers that carry derivatives, so that no step size
/// enters. Infinite where the boundary turns back (∂|λ|/∂D = 0). Where two boundary curves meet it
/// is that of one of them. By δ it is one-sided at δ = 0 and at δ = τ.
/// @param plant     m, k and c of both masses, within their ranges
/// @param sampling  τ (s) > 0, δ (s) 0 … τ
/// @param gains     on the boundary, finite
/// @param gain      the one whose sensitivity is returned
/// @param radius    of the boundary, > 0; 1 is that of stability
/// @throws InvalidParameter outside the admissible ranges
template <class Scalar>
LoopSensitivity boundary_gain_sensitivity(const TwoMass<Scalar>& plant,
                                          const Sampling<double>& sampling,
                                          const PdGains<double>& gains, BoundaryGain gain,
                                          double radius = 1.0) {
  validate(plant);
  validate(sampling);
  validate(gains);
  require_positive("radius", radius, "");
  const auto roots = detail::roots_of(detail::dual_polynomial(plant, sampling), gains);
  return sensitivity_of(
      detail::implicit_derivative(detail::gradient_of(detail::root_at_radius(roots, radius)),
                                  gain == BoundaryGain::proportional ? 8 : 9));
}

/// The sensitivity of the spectral radius ρ = max |λ|. Where two roots share the largest modulus ρ
/// has no derivative; that of one of them is returned.
/// @throws InvalidParameter outside the admissible ranges
template <class Scalar>
LoopSensitivity radius_sensitivity(const TwoMass<Scalar>& plant, const Sampling<double>& sampling,
                                   const PdGains<double>& gains) {
  validate(plant);
  validate(sampling);
  validate(gains);
  const auto roots = detail::roots_of(detail::dual_polynomial(plant, sampling), gains);
  const auto& dominant = *std::max_element(
      roots.begin(), roots.end(),
      [](const auto& a, const auto& b) { return a.radius_offset() < b.radius_offset(); });
  return sensitivity_of(detail::gradient_of(dominant) * std::abs(dominant.value()));
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template LoopSensitivity boundary_gain_sensitivity(const TwoMass<double>&,
                                                          const Sampling<double>&,
                                                          const PdGains<double>&, BoundaryGain,
                                                          double);
extern template LoopSensitivity radius_sensitivity(const TwoMass<double>&, const Sampling<double>&,
                                                   const PdGains<double>&);
#endif

}  // namespace holdfast
