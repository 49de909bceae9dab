#pragma once

#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "holdfast/control/harmonic_input.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/core/polynomial.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

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
/// t, f: responses of (z₁, ż₁) to the control force and to the excitation. The amplitude is that of
/// the samples; it is a steady motion only where the loop is stable. Used for Kollár 2022, Fig. 5.
template <class Scalar>
class SteadyResponse {
 public:
  using Complex = std::complex<Scalar>;

  /// @param angular_frequency  ω (rad/s), > 0
  /// @param input              `held_harmonic` or `exact_harmonic` of the same loop and ω
  SteadyResponse(const SampledLoop<Scalar>& loop, const HarmonicInput<Scalar>& input,
                 const Scalar& angular_frequency) {
    const Complex lambda = std::polar(Scalar(1), angular_frequency * loop.sampling.period);
    const Matrix<Complex, 4> resolvent =
        lambda * Matrix<Complex, 4>::Identity() - loop.transition.template cast<Complex>();
    Matrix<Complex, 4, 2> sources;
    sources.col(0) = loop.present_force.template cast<Complex>() +
                     loop.previous_force.template cast<Complex>() / lambda;
    sources.col(1) =
        input.cosine.template cast<Complex>() - Complex(0, 1) * input.sine.template cast<Complex>();
    const Matrix<Complex, 4, 2> solution = resolvent.partialPivLu().solve(sources);
    control_displacement_ = solution(0, 0);
    control_velocity_ = solution(1, 0);
    force_displacement_ = solution(0, 1);
    force_velocity_ = solution(1, 1);
    numerator_slope_ =
        control_displacement_ * force_velocity_ - control_velocity_ * force_displacement_;
  }

  /// |Z₁| / F_m in m/N at the given gains.
  Scalar amplitude_per_force(const PdGains<Scalar>& gains) const {
    return std::abs(force_displacement_ + gains.differential * numerator_slope_) /
           std::abs(Complex(1) - gains.proportional * control_displacement_ -
                    gains.differential * control_velocity_);
  }

  /// |Z₁| / F_m without control, m/N.
  Scalar uncontrolled_amplitude_per_force() const { return std::abs(force_displacement_); }

  /// Amplitude relative to no control; below 1 the control attenuates.
  Scalar ratio_to_uncontrolled(const PdGains<Scalar>& gains) const {
    return amplitude_per_force(gains) / uncontrolled_amplitude_per_force();
  }

  /// A differential gain and the amplitude ratio that it gives.
  struct Best {
    Scalar differential_gain = std::numeric_limits<Scalar>::quiet_NaN();
    Scalar ratio_to_uncontrolled = std::numeric_limits<Scalar>::infinity();
  };

  /// The D of least steady amplitude over given (stable) intervals of D at a fixed P.
  ///
  /// |Z₁|² is a quotient of two quadratics in D, so its stationary points are the roots of one
  /// quadratic; they and the finite interval ends are compared. An interval end is the limit of
  /// stable gains.
  Best best_differential_gain(const Scalar& proportional_gain,
                              const std::vector<Interval<Scalar>>& intervals) const {
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

 private:
  /// Roots of N′M − N M′ for |Z₁|² = N(D) / M(D), both quadratics in D.
  std::vector<Scalar> stationary_differential_gains(const Scalar& proportional_gain) const {
    const Vector<Scalar, 3> n = squared_modulus(force_displacement_, numerator_slope_);
    const Vector<Scalar, 3> m =
        squared_modulus(Complex(1) - proportional_gain * control_displacement_, -control_velocity_);
    Vector<Scalar, 3> slope;
    slope << n[1] * m[0] - n[0] * m[1], Scalar(2) * (n[2] * m[0] - n[0] * m[2]),
        n[2] * m[1] - n[1] * m[2];
    std::vector<Scalar> result;
    for (const Complex& root : roots(slope)) {
      if (std::abs(root.imag()) <= Scalar(1e-9) * std::abs(root)) result.push_back(root.real());
    }
    return result;
  }

  /// Coefficients of |a + x b|² = |a|² + 2 Re(ā b) x + |b|² x².
  static Vector<Scalar, 3> squared_modulus(const Complex& a, const Complex& b) {
    return {std::norm(a), Scalar(2) * std::real(std::conj(a) * b), std::norm(b)};
  }

  Complex control_displacement_, control_velocity_;  // t₁, t₂
  Complex force_displacement_, force_velocity_;      // f₁, f₂
  Complex numerator_slope_;                          // t₁ f₂ − t₂ f₁
};

}  // namespace holdfast
