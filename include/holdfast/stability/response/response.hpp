#pragma once

#include <cmath>
#include <complex>
#include <limits>
#include <type_traits>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/loop_input.hpp"
#include "holdfast/control/loop_map.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/core/interval_sets.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/harmonic_input.hpp"
#include "holdfast/math/linalg/complex_exponential.hpp"
#include "holdfast/math/linalg/elimination.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/plant/linear_plant.hpp"
#include "holdfast/plant/ports.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// Steady response to unit forces at ω: complex amplitudes of the measured displacement and
/// velocity, which P and D multiply, and of the conductor's displacement z. The measured quantities
/// may be a filter's output; for two masses they are z₁ and ż₁, and z is z₁.
template <class Scalar>
struct LoopPhasors {
  std::complex<Scalar> control_displacement;  ///< t_z (m/N): measured z per control force
  std::complex<Scalar> control_velocity;      ///< t_v (m/(N s)): measured ż per control force
  std::complex<Scalar> force_displacement;    ///< f_z (m/N): measured z per excitation force
  std::complex<Scalar> force_velocity;        ///< f_v (m/(N s)): measured ż per excitation force
  std::complex<Scalar> control_conductor;     ///< t_c (m/N): conductor's z per control force
  std::complex<Scalar> force_conductor;       ///< f_c (m/N): conductor's z per excitation force
};

/// Steady responses Y of a sampled loop without feedback to a unit command and a unit force at ω:
///
///     (λI − S₀) Y = [s, g],   λ = e^{iωτ}
///
/// S₀ and s are the map and the command's column of `LoopMap`; g is the phasor of `input`. For two
/// masses the stored command u_{j−1} is eliminated: S₀ = A_d and s = Γ₀ + Γ₁/λ.
/// @tparam Loop              `SampledLoop` of the two masses, or `LoopMap` of any order
/// @param loop               loop from `sampled_loop` or `loop_map`
/// @param input              `harmonic_input` of the same loop and ω
/// @param angular_frequency  ω (rad/s), > 0
/// @throws InvalidParameter where the input has another size than the loop
template <class Loop, class Scalar, int States>
LoopPhasors<Scalar> loop_phasors(const Loop& loop, const HarmonicInput<Scalar, States>& input,
                                 const detail::Undeduced<Scalar>& angular_frequency) {
  using Complex = std::complex<Scalar>;
  constexpr bool closed = std::is_same_v<Loop, SampledLoop<Scalar>>;
  for (const auto* part : {&input.cosine, &input.sine})
    require_size("size of the harmonic input", part->size(), loop.increment.rows());
  const Scalar angle = angular_frequency * loop.sampling.period;
  // (λ − 1) I − (S₀ − I): both parts small and accurate where sampling is fast.
  Matrix<Complex, States> system = -loop.increment.template cast<Complex>();
  system.diagonal().array() += circle_increment(angle);
  Matrix<Complex, States, 2> sources(input.cosine.size(), 2);
  if constexpr (closed) {
    sources.col(0) = loop.present_force.template cast<Complex>() +
                     loop.previous_force.template cast<Complex>() / std::polar(Scalar(1), angle);
  } else {
    sources.col(0) = loop.command.template cast<Complex>();
  }
  sources.col(1) =
      input.cosine.template cast<Complex>() - Complex(0, 1) * input.sine.template cast<Complex>();
  const Matrix<Complex, States, 2> y = eliminated(system, sources);
  if constexpr (closed) {
    return {y(0, 0), y(1, 0), y(0, 1), y(1, 1), y(0, 0), y(0, 1)};
  } else {
    const auto of = [&y](const RowVector<Scalar, Eigen::Dynamic>& row) {
      return Matrix<Complex, 1, 2>(row.template cast<Complex>() * y);
    };
    const auto z = of(loop.displacement), v = of(loop.velocity), c = of(loop.conductor);
    return {z[0], v[0], z[1], v[1], c[0], c[1]};
  }
}

namespace detail {

/// The coefficients of |a + x b|² = |a|² + 2 Re(ā b) x + |b|² x².
template <class Scalar>
Vector<Scalar, 3> squared_modulus(const std::complex<Scalar>& a, const std::complex<Scalar>& b) {
  return {std::norm(a), Scalar(2) * std::real(std::conj(a) * b), std::norm(b)};
}

}  // namespace detail

/// Quotient N(D)/M(D) of two quadratics in D, with the constant coefficients first.
template <class Scalar>
struct RatioOfQuadratics {
  Vector<Scalar, 3> numerator;    ///< numerator N(D)
  Vector<Scalar, 3> denominator;  ///< denominator M(D)

  /// The quotient at D = x; infinite or NaN where M vanishes.
  Scalar at(const Scalar& x) const { return evaluate(numerator, x) / evaluate(denominator, x); }

  /// The quadratic N′M − N M′, whose roots are the stationary points of the quotient.
  Vector<Scalar, 3> slope_numerator() const {
    const Vector<Scalar, 3>&n = numerator, &m = denominator;
    return {n[1] * m[0] - n[0] * m[1], Scalar(2) * (n[2] * m[0] - n[0] * m[2]),
            n[2] * m[1] - n[1] * m[2]};
  }
};

/// The steady response of the sampled loop without backlash to the excitation F_m cos ωt.
///
/// The conductor's displacement at the samples is z_j = Re(Z e^{iωτj}). With the symbols of
/// `LoopPhasors`, its phasor Z depends on the gains as
///
///     Z / F_m = (f_c + P (t_c f_z − f_c t_z) + D (t_c f_v − f_c t_v)) / (1 − P t_z − D t_v)
///
/// Where z and ż themselves are measured, as for the two masses, P vanishes from the numerator.
/// With t₁ = t_z, t₂ = t_v, f₁ = f_z and f₂ = f_v of the two masses,
///
///     Z₁ / F_m = (f₁ + D (t₁ f₂ − t₂ f₁)) / (1 − P t₁ − D t₂)
///
/// A steady motion exists only where the loop is stable. Used for Kollár 2022, Fig. 5.
template <class Scalar>
class SteadyResponse {
 public:
  using Complex = std::complex<Scalar>;  ///< the type of the phasors

  /// @param loop               loop from `sampled_loop` or `loop_map`
  /// @param input              `held_harmonic` or `exact_harmonic` of the same loop and ω
  /// @param angular_frequency  ω (rad/s), > 0
  /// @throws InvalidParameter where ω or the size of the input is not admissible
  template <class Loop, int States>
  SteadyResponse(const Loop& loop, const HarmonicInput<Scalar, States>& input,
                 const Scalar& angular_frequency)
      : SteadyResponse(loop_phasors(loop, input, angular_frequency)) {
    require_positive("angular frequency", static_cast<double>(angular_frequency), "rad/s");
  }

  /// Constructs the response from its phasors for unit forces.
  explicit SteadyResponse(const LoopPhasors<Scalar>& phasors)
      : phasors_(phasors),
        reference_(std::abs(phasors.force_conductor)),
        squared_reference_(std::norm(phasors.force_conductor)),
        proportional_slope_(phasors.control_conductor * phasors.force_displacement -
                            phasors.force_conductor * phasors.control_displacement),
        differential_slope_(phasors.control_conductor * phasors.force_velocity -
                            phasors.force_conductor * phasors.control_velocity) {}

  /// The conductor's amplitude |Z| / F_m (m/N) with the given gains.
  Scalar amplitude_per_force(const PdGains<Scalar>& gains) const {
    return std::abs(without_differential(gains.proportional) +
                    gains.differential * differential_slope_) /
           std::abs(Complex(1) - gains.proportional * phasors_.control_displacement -
                    gains.differential * phasors_.control_velocity);
  }

  /// The conductor's amplitude |Z| / F_m (m/N) without control, under the same excitation.
  Scalar uncontrolled_amplitude_per_force() const { return std::abs(phasors_.force_conductor); }

  /// This response with another reference amplitude for `ratio_to_uncontrolled`, for example the
  /// amplitude under a force that is not held over samples (`true_amplitude_per_force`).
  /// @param amplitude_per_force  reference amplitude (m/N), > 0
  SteadyResponse relative_to(const Scalar& amplitude_per_force) const {
    SteadyResponse response = *this;
    response.reference_ = amplitude_per_force;
    response.squared_reference_ = amplitude_per_force * amplitude_per_force;
    return response;
  }

  /// The response of the loop if velocity is not measured: D multiplies the backward difference of
  /// the displacement readings, divided by τ.
  /// @param angle   ωτ (rad)
  /// @param period  τ (s), > 0
  SteadyResponse with_velocity_by_difference(const Scalar& angle, const Scalar& period) const {
    const Complex turn = circle_increment(angle);
    const Complex rate = turn / ((Complex(1) + turn) * period);
    LoopPhasors<Scalar> phasors = phasors_;
    phasors.control_velocity = rate * phasors.control_displacement;
    phasors.force_velocity = rate * phasors.force_displacement;
    return SteadyResponse(phasors).relative_to(reference_);
  }

  /// Ratio of the amplitude to the reference, by default the amplitude without control.
  Scalar ratio_to_uncontrolled(const PdGains<Scalar>& gains) const {
    return amplitude_per_force(gains) / reference_;
  }

  /// The square of `ratio_to_uncontrolled` as a function of D for a given P. With the reference
  /// amplitude R (m/N) and the symbols of `LoopPhasors` it is
  ///
  ///     |f_c + P (t_c f_z − f_c t_z) + D (t_c f_v − f_c t_v)|² / (R² |1 − P t_z − D t_v|²)
  RatioOfQuadratics<Scalar> squared_ratio(const Scalar& proportional_gain) const {
    return {detail::squared_modulus(without_differential(proportional_gain), differential_slope_),
            squared_reference_ * detail::squared_modulus(
                                     Complex(1) - proportional_gain * phasors_.control_displacement,
                                     -phasors_.control_velocity)};
  }

  /// The open intervals of D (N s/m) with `squared_ratio` below 1. Stability there is not checked.
  /// @param proportional_gain  P (N/m), finite
  std::vector<Interval<Scalar>> differential_gains_below(const Scalar& proportional_gain) const {
    const RatioOfQuadratics<Scalar> square = squared_ratio(proportional_gain);
    return where_negative<Scalar>(square.numerator - square.denominator);
  }

  /// Differential gain D of least amplitude with its amplitude ratio.
  struct Best {
    /// The differential gain D (N s/m); NaN where no interval contains a finite D.
    Scalar differential_gain = std::numeric_limits<Scalar>::quiet_NaN();
    /// The value of `ratio_to_uncontrolled` at this D; infinite where D is NaN.
    Scalar ratio_to_uncontrolled = std::numeric_limits<Scalar>::infinity();
  };

  /// The D of least steady amplitude in given intervals of D, for a given P (N/m).
  ///
  /// The stationary points of `squared_ratio`, roots of one quadratic, and the finite interval ends
  /// are compared. The result may be an end; at that of a stable interval a root is on the circle.
  Best best_differential_gain(const Scalar& proportional_gain,
                              const std::vector<Interval<Scalar>>& intervals) const {
    Best best;
    const auto consider = [&](const Scalar& differential) {
      if (!std::isfinite(differential)) return;
      const Scalar ratio = ratio_to_uncontrolled({proportional_gain, differential});
      if (ratio < best.ratio_to_uncontrolled) best = {differential, ratio};
    };
    const auto stationary = roots(squared_ratio(proportional_gain).slope_numerator());
    for (const Interval<Scalar>& interval : intervals) {
      consider(interval.lower);
      consider(interval.upper);
      for (const Complex& root : stationary) {
        const bool real = std::abs(root.imag()) <= Scalar(1e-9) * std::abs(root);
        if (real && interval.contains(root.real())) consider(root.real());
      }
    }
    return best;
  }

 private:
  /// The numerator f_c + P (t_c f_z − f_c t_z) of Z at D = 0.
  Complex without_differential(const Scalar& proportional_gain) const {
    return phasors_.force_conductor + proportional_gain * proportional_slope_;
  }

  LoopPhasors<Scalar> phasors_;
  Scalar reference_;          // m/N, what ratios are relative to
  Scalar squared_reference_;  // of it, (m/N)²
  // By which P and D enter the numerator of Z; that of P is 0 where z itself is measured.
  Complex proportional_slope_;  // t_c f_z − f_c t_z
  Complex differential_slope_;  // t_c f_v − f_c t_v
};

/// The steady response of a loop: in closed form for two masses and δ ≤ τ, else by `loop_map`.
/// @param plant              plant of any order; its ports define measurement and conductor
/// @param sampling           τ (s) > 0, δ (s) 0 … 1000 τ
/// @param hold               whether the excitation force is held over each sample
/// @param angular_frequency  ω (rad/s), > 0
/// @throws InvalidParameter where an argument is outside its range
template <class Plant>
SteadyResponse<double> steady_response(const Plant& plant, const Sampling<double>& sampling,
                                       ForceHold hold, double angular_frequency) {
  require_positive("angular frequency", angular_frequency, "rad/s");
  const auto of = [&](const auto& loop) -> SteadyResponse<double> {
    return {loop, harmonic_input(plant, loop, hold, angular_frequency), angular_frequency};
  };
  if constexpr (has_closed_forms<Plant>) {
    if (sampling.processing_delay <= sampling.period) {
      validate(sampling);
      return of(sampled_loop(plant, sampling));
    }
  }
  return of(loop_map(plant, sampling));
}

/// The amplitude |Z| / F_m (m/N) of the plant without control under the force F_m cos ωt, not held
/// over samples: |h (iωI − A)⁻¹ c| with state matrix A, excitation input c and displacement row h.
/// @param plant              plant of any order; the motion is steady only if the plant is stable
/// @param angular_frequency  ω (rad/s), > 0
/// @throws InvalidParameter where ω is outside its range
template <class Plant>
double true_amplitude_per_force(const Plant& plant, double angular_frequency) {
  require_positive("angular frequency", angular_frequency, "rad/s");
  const double eighth = pi<double> / (4.0 * angular_frequency);  // at any samples it is the same
  return steady_response(plant, {eighth}, ForceHold::exact, angular_frequency)
      .uncontrolled_amplitude_per_force();
}

namespace detail {

/// The steady response of a plant's loop, with ratios relative to the true or to the held force.
template <class Plant, class Loop>
SteadyResponse<double> response_of_loop(const Plant& plant, const Loop& loop, ForceHold hold,
                                        double angular_frequency, bool relative_to_true_force) {
  const SteadyResponse<double> response(loop, harmonic_input(plant, loop, hold, angular_frequency),
                                        angular_frequency);
  return relative_to_true_force
             ? response.relative_to(true_amplitude_per_force(plant, angular_frequency))
             : response;
}

}  // namespace detail

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template class SteadyResponse<double>;
extern template SteadyResponse<double> steady_response(const TwoMass<double>&,
                                                       const Sampling<double>&, ForceHold, double);
extern template SteadyResponse<double> steady_response(const LinearPlant<double>&,
                                                       const Sampling<double>&, ForceHold, double);
#endif

}  // namespace holdfast
