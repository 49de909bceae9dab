#pragma once

#include <cmath>
#include <complex>
#include <optional>
#include <vector>

#include "holdfast/control/loop_map.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/math/linalg/eigenbasis.hpp"
#include "holdfast/stability/response/loop_response.hpp"

namespace holdfast {

/// The zero-order-hold transfer functions of `LoopResponse` as sums over the plant's eigenvalues
/// s_k: with k commands on their way and δ′ of the delay within a sample,
///
///     G(λ) = λ^{1−k} Σ (a_k + b_k/λ) / (λ − e^{s_k τ}),
///     a_k = γ_k β_k (e^{s_k(τ−δ′)} − 1)/s_k,   b_k = γ_k β_k e^{s_k(τ−δ′)} (e^{s_k δ′} − 1)/s_k
///
/// A value costs 10 N complex operations where LoopResponse takes 4 N²; no power of λ is formed, so
/// that hundreds of modes keep nine digits and more. Where eigenvalues (nearly) coincide, as those
/// of a critically damped drive do, LoopResponse gives the values.
template <class Scalar>
class ModalResponse {
 public:
  using Complex = std::complex<Scalar>;  ///< of λ and of what is returned

  /// @param plant     any order
  /// @param sampling  τ > 0 and δ ≥ 0, which may exceed τ by up to 1000 samples
  /// @throws InvalidParameter where the sampling is another or the state matrix is not finite
  template <class Plant>
  ModalResponse(const Plant& plant, const Sampling<Scalar>& sampling) {
    require_positive("sampling period tau", static_cast<double>(sampling.period), "s");
    require_within("processing delay", static_cast<double>(sampling.processing_delay), "s", 0.0,
                   1000.0 * static_cast<double>(sampling.period));
    commands_ = holdfast::held_commands(
        {static_cast<double>(sampling.period), static_cast<double>(sampling.processing_delay)});
    const Matrix<Scalar, Eigen::Dynamic> matrix = plant.state_matrix();
    require_finite("entries of the plant's state matrix", static_cast<double>(matrix.sum()), "");
    const EigenBasis<Scalar> basis(matrix);
    if (!basis.is_sound()) dense_.emplace(loop_map(plant, sampling));
    const auto ports = ports_of(plant);
    const auto beta = basis.coordinates(plant.control_input());
    const auto of_z = basis.readings(ports.measured_displacement);
    const auto of_v = basis.readings(ports.measured_velocity);
    const auto values = basis.values();
    const Scalar period = sampling.period;
    const Scalar late = sampling.processing_delay - Scalar(commands_ - 1) * period;
    for (Eigen::Index k = 0; k < values.size(); ++k) {
      Complex s = values[k];
      // What nothing damps lies on the circle but for round-off: here just within it.
      if (std::abs(s.real()) * period < undamped) s.real(-undamped / period);
      const Complex present = integral(s, period - late);
      const Complex past = std::exp(s * (period - late)) * integral(s, late);
      poles_.push_back({expm1(s * period), of_z[k] * beta[k] * present, of_v[k] * beta[k] * present,
                        of_z[k] * beta[k] * past, of_v[k] * beta[k] * past});
      unstable_ += s.real() > Scalar(0) ? 1 : 0;
    }
    has_past_ = late > Scalar(0);
  }

  /// G_z and G_v at λ = 1 + μ, given by μ so that nothing is lost where sampling is fast.
  CommandResponse<Scalar> at_distance_from_one(const Complex& mu) const {
    if (dense_) return dense_->at_distance_from_one(mu);
    Complex z(0), v(0), past_z(0), past_v(0);
    for (const Pole& pole : poles_) {
      const Complex away = mu - pole.increment;
      const Complex inverse = std::conj(away) / std::norm(away);
      z += times(pole.displacement, inverse);
      v += times(pole.velocity, inverse);
      if (!has_past_) continue;
      past_z += times(pole.past_displacement, inverse);
      past_v += times(pole.past_velocity, inverse);
    }
    const Complex lambda = Complex(1) + mu;
    if (has_past_) {
      z += past_z / lambda;
      v += past_v / lambda;
    }
    for (int k = 1; k < commands_; ++k) {
      z /= lambda;
      v /= lambda;
    }
    return {z, v};
  }

  /// G_z and G_v at λ = e^{iθ}.
  /// @param angle  θ (rad), 0 … π
  CommandResponse<Scalar> at_angle(const Scalar& angle) const {
    return at_distance_from_one(circle_increment(angle));
  }

  /// e^{s_k τ} − 1 of the plant's eigenvalues.
  std::vector<Complex> pole_increments() const {
    std::vector<Complex> increments;
    for (const Pole& pole : poles_) increments.push_back(pole.increment);
    return increments;
  }

  /// k, the commands on their way.
  int held_commands() const { return commands_; }

  /// How many of the plant's own eigenvalues grow.
  int unstable_poles() const { return unstable_; }

 private:
  struct Pole {
    Complex increment;                         // e^{s τ} − 1
    Complex displacement, velocity;            // a_k
    Complex past_displacement, past_velocity;  // b_k
  };

  /// A product without the checks for NaN that std::complex makes.
  static Complex times(const Complex& a, const Complex& b) {
    return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
  }

  /// e^x − 1 to full relative accuracy.
  static Complex expm1(const Complex& x) {
    const Scalar half_sine = std::sin(x.imag() / Scalar(2)), grown = std::expm1(x.real());
    return {grown * std::cos(x.imag()) - Scalar(2) * half_sine * half_sine,
            (grown + Scalar(1)) * std::sin(x.imag())};
  }

  /// ∫₀^t e^{s r} dr.
  static Complex integral(const Complex& s, const Scalar& t) {
    return s == Complex(0) ? Complex(t) : expm1(s * t) / s;
  }

  static constexpr Scalar undamped{1e-11};  // of −Re s τ

  std::vector<Pole> poles_;
  std::optional<LoopResponse<Scalar>> dense_;  // where the sums are not to be trusted
  int commands_ = 1, unstable_ = 0;
  bool has_past_ = false;
};

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template class ModalResponse<double>;
extern template ModalResponse<double>::ModalResponse(const LinearPlant<double>&,
                                                     const Sampling<double>&);
#endif

}  // namespace holdfast
