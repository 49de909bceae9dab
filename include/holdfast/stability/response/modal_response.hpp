#pragma once

#include <cmath>
#include <complex>
#include <optional>
#include <vector>

#include "holdfast/control/loop_map.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/math/linalg/complex_exponential.hpp"
#include "holdfast/math/linalg/eigenbasis.hpp"
#include "holdfast/plant/conductor_with_absorber.hpp"
#include "holdfast/plant/plant_poles.hpp"
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
  ModalResponse(const Plant& plant, const Sampling<Scalar>& sampling);

  /// s_k with γ_k β_k of what P and of what D multiplies.
  struct Residue {
    Complex s;             ///< 1/s
    Complex displacement;  ///< m/(N s)
    Complex velocity;      ///< m/(N s²)
  };

  /// @param residues  of all eigenvalues of a plant
  /// @param sampling  as above
  /// @throws InvalidParameter where the sampling is another
  ModalResponse(const std::vector<Residue>& residues, const Sampling<Scalar>& sampling)
      : ModalResponse(sampling) {
    for (const Residue& residue : residues) add(residue);
  }

  /// G_z and G_v at λ = 1 + μ, given by μ so that nothing is lost where sampling is fast.
  CommandResponse<Scalar> at_distance_from_one(const Complex& mu) const {
    if (dense_) return dense_->at_distance_from_one(mu);
    const bool has_past = late_ > Scalar(0);
    Complex z(0), v(0), past_z(0), past_v(0);
    for (const Pole& pole : poles_) {
      const Complex away = mu - pole.increment;
      const Complex inverse = std::conj(away) / std::norm(away);
      z += times(pole.displacement, inverse);
      v += times(pole.velocity, inverse);
      if (!has_past) continue;
      past_z += times(pole.past_displacement, inverse);
      past_v += times(pole.past_velocity, inverse);
    }
    const Complex lambda = Complex(1) + mu;
    if (has_past) {
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

  /// The response of a loop whose roots are those of this one's divided by r: G(rλ).
  /// @param offset  r − 1, above −1
  /// @return nothing where LoopResponse gives the values
  std::optional<ModalResponse> at_radius(const Scalar& offset) const {
    if (dense_) return std::nullopt;
    ModalResponse scaled = *this;
    const Scalar radius = Scalar(1) + offset;
    Scalar factor(1);
    for (int k = 0; k < commands_; ++k) factor /= radius;
    scaled.unstable_ = 0;
    for (Pole& pole : scaled.poles_) {
      pole.increment = (pole.increment - offset) / radius;
      pole.displacement *= factor;
      pole.velocity *= factor;
      pole.past_displacement *= factor / radius;
      pole.past_velocity *= factor / radius;
      const bool outside =
          Scalar(2) * pole.increment.real() + std::norm(pole.increment) > Scalar(0);
      scaled.unstable_ += outside ? 1 : 0;
    }
    return scaled;
  }

  /// e^{s_k τ} − 1 of the plant's eigenvalues.
  std::vector<Complex> pole_increments() const {
    std::vector<Complex> increments;
    for (const Pole& pole : poles_) increments.push_back(pole.increment);
    return increments;
  }

  /// k, the commands on their way.
  int held_commands() const { return commands_; }

  /// A pole's part in P G_z + D G_v.
  struct LoopPart {
    Complex increment;  ///< e^{s_k τ} − 1
    Complex present;    ///< P and D times a_k
    Complex past;       ///< P and D times b_k
  };

  /// The parts of all poles; nothing where LoopResponse gives the values.
  std::vector<LoopPart> loop_parts(const PdGains<Scalar>& gains) const {
    std::vector<LoopPart> parts;
    if (dense_) return parts;
    const Scalar p = gains.proportional, d = gains.differential;
    for (const Pole& pole : poles_)
      parts.push_back({pole.increment, p * pole.displacement + d * pole.velocity,
                       p * pole.past_displacement + d * pole.past_velocity});
    return parts;
  }

  /// Whether a command comes between two samples.
  bool is_late_within_sample() const { return late_ > Scalar(0); }

  /// How many of the plant's own eigenvalues grow.
  int unstable_poles() const { return unstable_; }

 private:
  struct Pole {
    Complex increment;                         // e^{s τ} − 1
    Complex displacement, velocity;            // a_k
    Complex past_displacement, past_velocity;  // b_k
  };

  explicit ModalResponse(const Sampling<Scalar>& sampling) : period_(sampling.period) {
    require_positive("sampling period tau", static_cast<double>(sampling.period), "s");
    require_within("processing delay", static_cast<double>(sampling.processing_delay), "s", 0.0,
                   1000.0 * static_cast<double>(sampling.period));
    commands_ = holdfast::held_commands(
        {static_cast<double>(sampling.period), static_cast<double>(sampling.processing_delay)});
    late_ = sampling.processing_delay - Scalar(commands_ - 1) * sampling.period;
  }

  void add(const Residue& residue) {
    Complex s = residue.s;
    // What nothing damps lies on the circle but for round-off: here just within it. What creeps
    // back does so however slowly.
    const bool creeps = s.imag() == Scalar(0) && s.real() < Scalar(0);
    if (std::abs(s.real()) * period_ < undamped && !creeps) s.real(-undamped / period_);
    const Complex present = exponential_integral(s, period_ - late_);
    const Complex past = std::exp(s * (period_ - late_)) * exponential_integral(s, late_);
    poles_.push_back({complex_expm1(s * period_), residue.displacement * present,
                      residue.velocity * present, residue.displacement * past,
                      residue.velocity * past});
    unstable_ += s.real() > Scalar(0) ? 1 : 0;
  }

  /// A product without the checks for NaN that std::complex makes.
  static Complex times(const Complex& a, const Complex& b) {
    return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
  }

  static constexpr Scalar undamped{1e-11};  // of −Re s τ

  std::vector<Pole> poles_;
  std::optional<LoopResponse<Scalar>> dense_;  // where the sums are not to be trusted
  int commands_ = 1, unstable_ = 0;
  Scalar period_, late_{0};  // τ and δ′
};

template <class Scalar>
template <class Plant>
ModalResponse<Scalar>::ModalResponse(const Plant& plant, const Sampling<Scalar>& sampling)
    : ModalResponse(sampling) {
  const Matrix<Scalar, Eigen::Dynamic> matrix = plant.state_matrix();
  require_finite("entries of the plant's state matrix", static_cast<double>(matrix.sum()), "");
  const EigenBasis<Scalar> basis(matrix);
  if (!basis.is_sound()) dense_.emplace(loop_map(plant, sampling));
  const auto ports = ports_of(plant);
  const auto beta = basis.coordinates(plant.control_input());
  const auto of_z = basis.readings(ports.measured_displacement);
  const auto of_v = basis.readings(ports.measured_velocity);
  const auto values = basis.values();
  for (Eigen::Index k = 0; k < values.size(); ++k)
    add({values[k], of_z[k] * beta[k], of_v[k] * beta[k]});
}

/// The response of which these are all poles.
/// @tparam Scalar   double; a parameter so that nothing is compiled where this is not called
/// @param poles     of `plant_poles`
/// @param sampling  τ and δ
/// @throws InvalidParameter where the sampling is not admissible
template <class Scalar = double>
ModalResponse<Scalar> modal_response(const std::vector<PlantPole>& poles,
                                     const Sampling<detail::Undeduced<Scalar>>& sampling) {
  std::vector<typename ModalResponse<Scalar>::Residue> residues;
  residues.reserve(poles.size());
  for (const PlantPole& pole : poles)
    residues.push_back({pole.s, pole.residue, pole.s * pole.residue});
  return {residues, sampling};
}

/// The response of a conductor by its modes with the absorber and the loop's hardware: from their
/// poles, or where those are not all told apart from the eigenvalues of the plant.
/// @tparam Scalar    double, as above
/// @param conductor  with all its poles, or none
/// @param sampling   τ and δ
/// @throws InvalidParameter where conductor, absorber, hardware or sampling are not admissible
template <class Scalar = double>
ModalResponse<Scalar> modal_response(const ConductorWithAbsorber& conductor,
                                     const Sampling<detail::Undeduced<Scalar>>& sampling) {
  const auto poles = with_hardware(conductor.poles, conductor.hardware);
  if (poles.empty() || conductor.poles.empty()) return {linear_plant<Scalar>(conductor), sampling};
  return modal_response<Scalar>(poles, sampling);
}

/// The same, whose poles are found here.
/// @tparam Scalar   double, as above
/// @param modes     as the absorber's place sees them
/// @param absorber  with its clamp
/// @param sampling  as above
/// @throws InvalidParameter as above
template <class Scalar = double>
ModalResponse<Scalar> modal_response(const std::vector<PlaceMode<detail::Undeduced<Scalar>>>& modes,
                                     const Absorber<detail::Undeduced<Scalar>>& absorber,
                                     const Sampling<detail::Undeduced<Scalar>>& sampling) {
  return modal_response<Scalar>(
      ConductorWithAbsorber{modes, absorber, plant_poles(modes, absorber)}, sampling);
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template class ModalResponse<double>;
extern template ModalResponse<double>::ModalResponse(const LinearPlant<double>&,
                                                     const Sampling<double>&);
extern template ModalResponse<double> modal_response<double>(const ConductorWithAbsorber&,
                                                             const Sampling<double>&);
extern template ModalResponse<double> modal_response<double>(const std::vector<PlantPole>&,
                                                             const Sampling<double>&);
#endif

}  // namespace holdfast
