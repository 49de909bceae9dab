#pragma once

#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/core/interval_sets.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/harmonic_input.hpp"
#include "holdfast/math/linalg/elimination.hpp"
#include "holdfast/math/poly/polynomial.hpp"

namespace holdfast {

/// The steady response of the conductor to unit forces at ω, as complex amplitudes of z₁ and ż₁.
template <class Scalar>
struct ResponsePhasors {
  std::complex<Scalar> control_displacement;  ///< t₁ (m/N): z₁ to the control force
  std::complex<Scalar> control_velocity;      ///< t₂ (m/(N s)): ż₁ to the control force
  std::complex<Scalar> force_displacement;    ///< f₁ (m/N): z₁ to the excitation
  std::complex<Scalar> force_velocity;        ///< f₂ (m/(N s)): ż₁ to the excitation

  /// t₁ f₂ − t₂ f₁, by which D enters the numerator of the controlled amplitude.
  std::complex<Scalar> numerator_slope() const {
    return control_displacement * force_velocity - control_velocity * force_displacement;
  }
};

/// The steady response to unit forces at ω where what is measured need not be the conductor's own
/// motion, but for instance a filter's.
template <class Scalar>
struct LoopPhasors {
  ResponsePhasors<Scalar> measured;           ///< t_z, t_v, f_z, f_v: of what P and D multiply
  std::complex<Scalar> control_conductor;     ///< t_c (m/N): z to the control force
  std::complex<Scalar> excitation_conductor;  ///< f_c (m/N): z to the excitation

  /// t_c f_z − f_c t_z, by which P enters the numerator of the controlled amplitude; 0 where z
  /// itself is measured.
  std::complex<Scalar> proportional_slope() const {
    return control_conductor * measured.force_displacement -
           excitation_conductor * measured.control_displacement;
  }
  /// t_c f_v − f_c t_v, by which D enters it.
  std::complex<Scalar> differential_slope() const {
    return control_conductor * measured.force_velocity -
           excitation_conductor * measured.control_velocity;
  }
};

namespace detail {

/// Coefficients of |a + x b|² = |a|² + 2 Re(ā b) x + |b|² x².
template <class Scalar>
Vector<Scalar, 3> squared_modulus(const std::complex<Scalar>& a, const std::complex<Scalar>& b) {
  return {std::norm(a), Scalar(2) * std::real(std::conj(a) * b), std::norm(b)};
}

}  // namespace detail

/// A quotient of two quadratics in D, coefficients constant first.
template <class Scalar>
struct RatioOfQuadratics {
  Vector<Scalar, 3> numerator;    ///< N
  Vector<Scalar, 3> denominator;  ///< M

  /// The quotient at D = x; infinite or NaN where M vanishes.
  Scalar at(const Scalar& x) const { return evaluate(numerator, x) / evaluate(denominator, x); }

  /// N′M − N M′, a quadratic: its roots are where the quotient is stationary.
  Vector<Scalar, 3> slope_numerator() const {
    const Vector<Scalar, 3>&n = numerator, &m = denominator;
    return {n[1] * m[0] - n[0] * m[1], Scalar(2) * (n[2] * m[0] - n[0] * m[2]),
            n[2] * m[1] - n[1] * m[2]};
  }
};

/// Closed-form steady response of the sampled loop without backlash to F_m cos ωt.
///
/// With z_j = Re(Z e^{iωτj}), λ = e^{iωτ} and the phasor g of the force (held or exact),
///
///     (λI − A_d) Z = (Γ₀ + Γ₁/λ) U + g F_m,   U = P Z₁ + D Z₂
///
/// so the conductor's amplitude is a Möbius function of the gains whose numerator does not contain
/// P:
///
///     Z₁ / F_m = (f₁ + D (t₁ f₂ − t₂ f₁)) / (1 − P t₁ − D t₂)
///
/// t, f: responses of (z₁, ż₁) to the control force and to the excitation. Where others than the
/// conductor's z and ż are measured (`LoopPhasors`), the amplitude is
///
///     Z / F_m = (f_c + P (t_c f_z − f_c t_z) + D (t_c f_v − f_c t_v)) / (1 − P t_z − D t_v)
///
/// The amplitude is that of the samples; it is a steady motion only where the loop is stable. Used
/// for Kollár 2022, Fig. 5.
template <class Scalar>
class SteadyResponse {
 public:
  using Complex = std::complex<Scalar>;  ///< the type of the phasors

  /// @param loop               of `sampled_loop`
  /// @param input              `held_harmonic` or `exact_harmonic` of the same loop and ω
  /// @param angular_frequency  ω (rad/s), > 0
  SteadyResponse(const SampledLoop<Scalar>& loop, const HarmonicInput<Scalar>& input,
                 const Scalar& angular_frequency);

  /// Of a loop of any order.
  explicit SteadyResponse(const LoopPhasors<Scalar>& phasors)
      : phasors_(phasors.measured),
        uncontrolled_(phasors.excitation_conductor),
        proportional_slope_(phasors.proportional_slope()),
        numerator_slope_(phasors.differential_slope()) {}

  /// The responses of what is measured to unit forces.
  const ResponsePhasors<Scalar>& phasors() const { return phasors_; }

  /// |Z₁| / F_m in m/N at the given gains.
  Scalar amplitude_per_force(const PdGains<Scalar>& gains) const {
    return std::abs(without_differential(gains.proportional) +
                    gains.differential * numerator_slope_) /
           std::abs(Complex(1) - gains.proportional * phasors_.control_displacement -
                    gains.differential * phasors_.control_velocity);
  }

  /// |Z₁| / F_m without control, m/N.
  Scalar uncontrolled_amplitude_per_force() const { return std::abs(uncontrolled_); }

  /// Amplitude relative to no control; below 1 the control attenuates.
  Scalar ratio_to_uncontrolled(const PdGains<Scalar>& gains) const {
    return amplitude_per_force(gains) / uncontrolled_amplitude_per_force();
  }

  /// The square of `ratio_to_uncontrolled` as a function of D at a fixed P:
  ///
  ///     |f₁ + D (t₁ f₂ − t₂ f₁)|² / (|1 − P t₁ − D t₂|² |f₁|²)
  ///
  /// or, f₁ above being f_c + P (t_c f_z − f_c t_z) where z itself is not measured.
  RatioOfQuadratics<Scalar> squared_ratio(const Scalar& proportional_gain) const {
    return {
        detail::squared_modulus(without_differential(proportional_gain), numerator_slope_),
        std::norm(uncontrolled_) *
            detail::squared_modulus(Complex(1) - proportional_gain * phasors_.control_displacement,
                                    -phasors_.control_velocity)};
  }

  /// The open intervals of D, stable or not, in which the amplitude stays below `ratio` times that
  /// of no control: where N − ratio² M < 0.
  /// @param proportional_gain  P (N/m), finite
  /// @param ratio              > 0
  std::vector<Interval<Scalar>> differential_gains_below(const Scalar& proportional_gain,
                                                         const Scalar& ratio = Scalar(1)) const;

  /// A differential gain and the amplitude ratio that it gives.
  struct Best {
    /// D (N s/m); NaN where no interval offers a finite D.
    Scalar differential_gain = std::numeric_limits<Scalar>::quiet_NaN();
    /// |Z₁| over that without control; infinite without a D.
    Scalar ratio_to_uncontrolled = std::numeric_limits<Scalar>::infinity();
  };

  /// The D of least steady amplitude over given (stable) intervals of D at a fixed P.
  ///
  /// |Z₁|² is a quotient of two quadratics in D, so its stationary points are the roots of one
  /// quadratic; they and the finite interval ends are compared. An interval end is the limit of
  /// stable gains.
  Best best_differential_gain(const Scalar& proportional_gain,
                              const std::vector<Interval<Scalar>>& intervals) const;

 private:
  /// Roots of N′M − N M′ for |Z₁|² = N(D) / M(D), both quadratics in D.
  std::vector<Scalar> stationary_differential_gains(const Scalar& proportional_gain) const;

  /// f_c + P (t_c f_z − f_c t_z), the numerator of Z at D = 0.
  Complex without_differential(const Scalar& proportional_gain) const {
    return uncontrolled_ + proportional_gain * proportional_slope_;
  }

  ResponsePhasors<Scalar> phasors_;          // of what is measured
  Complex uncontrolled_;                     // f_c
  Complex proportional_slope_ = Complex(0);  // t_c f_z − f_c t_z
  Complex numerator_slope_;                  // t_c f_v − f_c t_v
};

template <class Scalar>
SteadyResponse<Scalar>::SteadyResponse(const SampledLoop<Scalar>& loop,
                                       const HarmonicInput<Scalar>& input,
                                       const Scalar& angular_frequency) {
  // (λ − 1) I − (A_d − I): both parts small and accurate where sampling is fast.
  const Scalar angle = angular_frequency * loop.sampling.period;
  const Scalar half_sine = std::sin(angle / Scalar(2));
  const Complex lambda = std::polar(Scalar(1), angle);
  const Complex from_one(Scalar(-2) * half_sine * half_sine, std::sin(angle));
  const Matrix<Complex, 4> resolvent =
      from_one * Matrix<Complex, 4>::Identity() - loop.increment.template cast<Complex>();
  Matrix<Complex, 4, 2> sources;
  sources.col(0) = loop.present_force.template cast<Complex>() +
                   loop.previous_force.template cast<Complex>() / lambda;
  sources.col(1) =
      input.cosine.template cast<Complex>() - Complex(0, 1) * input.sine.template cast<Complex>();
  const Matrix<Complex, 4, 2> solution = eliminated(resolvent, sources);
  phasors_ = {solution(0, 0), solution(1, 0), solution(0, 1), solution(1, 1)};
  uncontrolled_ = phasors_.force_displacement;
  numerator_slope_ = phasors_.numerator_slope();
}

template <class Scalar>
std::vector<Interval<Scalar>> SteadyResponse<Scalar>::differential_gains_below(
    const Scalar& proportional_gain, const Scalar& ratio) const {
  const RatioOfQuadratics<Scalar> square = squared_ratio(proportional_gain);
  return where_negative<Scalar>(square.numerator - ratio * ratio * square.denominator);
}

template <class Scalar>
typename SteadyResponse<Scalar>::Best SteadyResponse<Scalar>::best_differential_gain(
    const Scalar& proportional_gain, const std::vector<Interval<Scalar>>& intervals) const {
  Best best;
  const auto consider = [&](const Scalar& differential) {
    if (!std::isfinite(differential)) return;
    const Scalar ratio = ratio_to_uncontrolled({proportional_gain, differential});
    if (ratio < best.ratio_to_uncontrolled) best = {differential, ratio};
  };
  for (const Interval<Scalar>& interval : intervals) {
    consider(interval.lower);
    consider(interval.upper);
    for (const Scalar& stationary : stationary_differential_gains(proportional_gain)) {
      if (interval.contains(stationary)) consider(stationary);
    }
  }
  return best;
}

template <class Scalar>
std::vector<Scalar> SteadyResponse<Scalar>::stationary_differential_gains(
    const Scalar& proportional_gain) const {
  const Vector<Scalar, 3> slope = squared_ratio(proportional_gain).slope_numerator();
  std::vector<Scalar> result;
  for (const Complex& root : roots(slope)) {
    if (std::abs(root.imag()) <= Scalar(1e-9) * std::abs(root)) result.push_back(root.real());
  }
  return result;
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template class SteadyResponse<double>;
#endif

}  // namespace holdfast
