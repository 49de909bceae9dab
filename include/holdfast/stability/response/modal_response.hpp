#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "holdfast/control/loop_map.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/math/linalg/complex_exponential.hpp"
#include "holdfast/math/linalg/eigenbasis.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/math/roots/pole_sum_roots.hpp"
#include "holdfast/plant/conductor_with_absorber.hpp"
#include "holdfast/plant/plant_poles.hpp"
#include "holdfast/stability/response/loop_response.hpp"

namespace holdfast {

/// The zero-order-hold transfer functions of `LoopResponse` as sums over the plant's eigenvalues
/// s_j with residues γ_j β_j (`Residue`). k commands are delayed, and δ′ = δ − (k − 1) τ:
///
///     G(λ) = λ^{1−k} Σ (a_j + b_j/λ) / (λ − e^{s_j τ}),
///     a_j = γ_j β_j (e^{s_j(τ−δ′)} − 1)/s_j,   b_j = γ_j β_j e^{s_j(τ−δ′)} (e^{s_j δ′} − 1)/s_j
///
/// A value costs 10 N complex operations for N eigenvalues; LoopResponse takes 4 N². No polynomial
/// is formed, so that nine digits or more are correct even for hundreds of modes. Where eigenvalues
/// (nearly) coincide, like those of a critically damped drive, LoopResponse is used.
template <class Scalar>
class ModalResponse {
 public:
  using Complex = std::complex<Scalar>;  ///< type of λ and of the responses

  /// @param plant     plant of any order
  /// @param sampling  τ (s) > 0 and δ (s), 0 … 1000 τ
  /// @throws InvalidParameter where the sampling is not admissible or the state matrix not finite
  template <class Plant>
  ModalResponse(const Plant& plant, const Sampling<Scalar>& sampling);

  /// A pole s_j with its residues γ_j β_j for the quantities that P and D multiply.
  struct Residue {
    Complex s;             ///< pole s_j (1/s)
    Complex displacement;  ///< residue for displacement (m/(N s))
    Complex velocity;      ///< residue for velocity (m/(N s²))
  };

  /// @param residues  residues of all eigenvalues of a plant
  /// @param sampling  τ (s) > 0 and δ (s), 0 … 1000 τ
  /// @throws InvalidParameter where the sampling is not admissible
  ModalResponse(const std::vector<Residue>& residues, const Sampling<Scalar>& sampling)
      : ModalResponse(sampling) {
    for (const Residue& residue : residues) add(residue);
  }

  /// The transfer functions at λ = 1 + μ. The argument μ avoids a loss of digits for small τ.
  CommandResponse<Scalar> at_distance_from_one(const Complex& mu) const {
    if (dense_) return weighted(dense_->at_distance_from_one(mu), mu);
    return finished(poles_.sums_at(mu), mu);
  }

  class Nearby;

  /// The transfer functions G_z and G_v at λ = e^{iθ} on the unit circle.
  /// @param angle  θ (rad), 0 … π
  CommandResponse<Scalar> at_angle(const Scalar& angle) const {
    return at_distance_from_one(circle_increment(angle));
  }

  /// The response G(rλ) as a function of λ. Its loop has the roots of this loop divided by r.
  /// @param offset  r − 1, > −1
  /// @return the response; `nullopt` where eigenvalues (nearly) coincide and LoopResponse is used
  std::optional<ModalResponse> at_radius(const Scalar& offset) const {
    if (dense_) return std::nullopt;
    ModalResponse scaled = *this;
    const Scalar radius = Scalar(1) + offset;
    scaled.radius_ = radius * radius_;
    Scalar factor(1);
    for (int k = 0; k < commands_; ++k) factor /= radius;
    scaled.unstable_ = 0;
    scaled.poles_ = {};
    scaled.poles_.past_z = poles_.past_z * factor;
    scaled.poles_.past_v = poles_.past_v * factor;
    for (Pole pole : poles_.all()) {
      pole.increment = (pole.increment - offset) / radius;
      pole.displacement *= factor;
      pole.velocity *= factor;
      pole.past_displacement *= factor / radius;
      pole.past_velocity *= factor / radius;
      const bool outside =
          Scalar(2) * pole.increment.real() + std::norm(pole.increment) > Scalar(0);
      scaled.unstable_ += outside ? 1 : 0;
      scaled.poles_.add(pole);
    }
    return scaled;
  }

  /// Filter w(λ) = constant + change (1 − 1/λ) of displacement readings. D multiplies its output:
  /// G_v = w(λ) G_z. `constant` and `change` are in 1/s (in N/m if both gains are part of them).
  using Weight = typename PoleSum<Scalar>::Weight;

  /// The response of the loop without a velocity sensor: D multiplies filtered displacements.
  /// @param weight  filter w of the readings
  ModalResponse with_velocity_from_displacement(const Weight& weight) const {
    ModalResponse other = *this;
    other.weight_ = weight;
    return other;
  }

  /// This response if velocity is measured (`of_velocity`). Otherwise the response of the loop in
  /// which D multiplies the backward difference of displacement readings: G_v = (1 − 1/λ) G_z/τ.
  ModalResponse with_sensor(bool of_velocity) const {
    if (of_velocity) return *this;
    return with_velocity_from_displacement({Scalar(0), Scalar(1) / period_});
  }

  /// The increments e^{s_j τ} − 1 of the plant's eigenvalues.
  std::vector<Complex> pole_increments() const {
    std::vector<Complex> increments;
    for (const Pole& pole : poles_.all()) increments.push_back(pole.increment);
    return increments;
  }

  /// The number k of delayed commands.
  int held_commands() const { return commands_; }

  /// The function 1 − P G_z − D G_v as a sum over all poles; `parts` is empty with LoopResponse.
  PoleSum<Scalar> loop_parts(const PdGains<Scalar>& gains) const {
    PoleSum<Scalar> loop;
    loop.power = commands_ - 1;
    if (dense_) return loop;
    Scalar p = gains.proportional, d = gains.differential;
    if (weight_) {
      loop.weight = {p + d * weight_->constant, d * weight_->change};
      loop.radius = radius_;
      p = Scalar(1);
      d = Scalar(0);
    }
    loop.past = p * poles_.past_z + d * poles_.past_v;
    for (const Pole& pole : poles_.all())
      loop.parts.push_back({pole.increment, p * pole.displacement + d * pole.velocity,
                            p * pole.past_displacement + d * pole.past_velocity});
    return loop;
  }

  /// Whether δ′ > 0, so that the previous command still acts at the start of a sample (b_j ≠ 0).
  bool is_late_within_sample() const { return late_ > Scalar(0); }

  /// The number of eigenvalues s of the plant with |e^{sτ}| > 1, or > r for a response `at_radius`.
  int unstable_poles() const { return unstable_; }

 private:
  struct Pole {
    Complex increment;                         // e^{s τ} − 1
    Complex displacement, velocity;            // a_j
    Complex past_displacement, past_velocity;  // b_j
  };

  /// Sums Σ a_j/(λ − e_j), e_j = e^{s_j τ}, for displacement z and velocity v.
  struct Sums {
    Complex z{0}, v{0};
  };

  /// The poles in SIMD vectors; unused entries have a pole λ = −7, far from the unit circle. The
  /// coefficient b of a pole e is merged with a by (b/λ)/(λ − e) = (b/e)/(λ − e) − (b/e)/λ.
  struct Poles : detail::ComplexRows<Scalar, 3> {
    std::vector<Pole> late;        // poles that decay within a sample, with their b
    Complex past_z{0}, past_v{0};  // −Σ b/e of all others

    Poles() : detail::ComplexRows<Scalar, 3>(Scalar(-8)) {}

    void add(const Pole& of) {
      const Complex left = Complex(1) + of.increment;
      if (of.past_displacement == Complex(0) && of.past_velocity == Complex(0)) {
        this->push_back({of.increment, of.displacement, of.velocity});
      } else if (std::norm(left) < Scalar(1e-4)) {
        late.push_back(of);
      } else {
        const Complex of_z = of.past_displacement / left, of_v = of.past_velocity / left;
        past_z -= of_z;
        past_v -= of_v;
        this->push_back({of.increment, of.displacement + of_z, of.velocity + of_v});
      }
    }
    /// All poles; those that decay within a sample (`late`) come last, as in `pole_sum_roots`.
    std::vector<Pole> all() const {
      std::vector<Pole> poles;
      for (std::size_t k = 0; k < this->size(); ++k) {
        const auto row = (*this)[k];
        poles.push_back({row[0], row[1], row[2], Complex(0), Complex(0)});
      }
      poles.insert(poles.end(), late.begin(), late.end());
      return poles;
    }
    Sums sums_at(const Complex& mu) const {
      detail::ComplexLanes<Scalar> z, v;
      for (const auto& [increment, of_z, of_v] : this->blocks()) {
        const auto factor = (mu - increment).inverse();
        z += of_z * factor;
        v += of_v * factor;
      }
      return {z.sum(), v.sum()};
    }
  };

  CommandResponse<Scalar> finished(const Sums& sums, const Complex& mu) const {
    using detail::plain_product;
    const Complex back = detail::inverse(Complex(1) + mu);
    CommandResponse<Scalar> g{sums.z + plain_product(poles_.past_z, back),
                              sums.v + plain_product(poles_.past_v, back)};
    for (const Pole& pole : poles_.late) {
      const Complex factor = detail::inverse(mu - pole.increment);
      g.displacement += (pole.displacement + pole.past_displacement * back) * factor;
      g.velocity += (pole.velocity + pole.past_velocity * back) * factor;
    }
    for (int k = 1; k < commands_; ++k) {
      g.displacement = plain_product(g.displacement, back);
      g.velocity = plain_product(g.velocity, back);
    }
    return weighted(g, mu);
  }

  CommandResponse<Scalar> weighted(CommandResponse<Scalar> g, const Complex& mu) const {
    if (!weight_) return g;
    const Complex lambda = radius_ * (Complex(1) + mu);
    const Complex away = (radius_ - Scalar(1)) + radius_ * mu;  // λ − 1
    g.velocity = (weight_->constant + weight_->change * away / lambda) * g.displacement;
    return g;
  }

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
    // An undamped motion lies on the circle but for round-off: here just within it. A creeping one
    // comes back however slowly.
    const bool creeps = s.imag() == Scalar(0) && s.real() < Scalar(0);
    if (std::abs(s.real()) * period_ < undamped && !creeps) s.real(-undamped / period_);
    const Complex increment = complex_expm1(s * period_);
    const Scalar on_time = period_ - late_;
    const Complex grown = late_ == Scalar(0) ? increment : complex_expm1(s * on_time);
    const Complex present = s == Complex(0) ? Complex(on_time) : grown / s;
    const Complex past =
        late_ == Scalar(0) ? Complex(0) : (Scalar(1) + grown) * exponential_integral(s, late_);
    poles_.add({increment, residue.displacement * present, residue.velocity * present,
                residue.displacement * past, residue.velocity * past});
    unstable_ += s.real() > Scalar(0) ? 1 : 0;
  }

  static constexpr Scalar undamped{1e-11};  // of −Re s τ

  Poles poles_;
  std::optional<LoopResponse<Scalar>> dense_;  // where the sums are not to be trusted
  int commands_ = 1, unstable_ = 0;
  Scalar period_, late_{0};       // τ and δ′
  std::optional<Weight> weight_;  // nothing where the velocity is measured
  Scalar radius_{1};              // r of G(rλ)
};

/// Fast evaluation of a ModalResponse at many λ near one point, the centre. Of the N poles the 3 √N
/// nearest are summed one by one. The sum of the others is a Taylor series of the same accuracy.
/// Values at 30 angles per pole then cost order N^{3/2} operations in all, not N².
template <class Scalar>
class ModalResponse<Scalar>::Nearby {
 public:
  /// @param response  the response, which must outlive this object
  /// @param centre    offset μ = λ − 1 of the centre of the Taylor series
  /// @param share     ratio, < 1, of the radius of the series to the distance from the centre to
  ///                  the nearest pole in the series; the relative error is share¹⁷
  Nearby(const ModalResponse& response, const Complex& centre, Scalar share = Scalar(0.125))
      : response_(&response), centre_(centre), share_(share) {
    const Poles& all = response.poles_;
    std::vector<Scalar> distances;  // squared, of all but the late ones
    for (std::size_t k = 0; k < all.size(); ++k)
      distances.push_back(std::norm(centre - all[k].front()));
    const Scalar wanted = Scalar(8) + Scalar(3) * std::sqrt(static_cast<Scalar>(all.size()));
    const std::size_t count = std::min(static_cast<std::size_t>(wanted), all.size());
    Scalar farthest = std::numeric_limits<Scalar>::infinity();  // squared, of a near pole
    if (count < all.size()) {
      std::vector<Scalar> sorted = distances;
      std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(count),
                       sorted.end());
      farthest = sorted[count];
      reach_ = std::sqrt(farthest);
    }
    detail::ComplexRows<Scalar, 3> far(Scalar(-8));
    for (std::size_t k = 0; k < all.size(); ++k)
      distances[k] < farthest ? near_.push_back(all[k]) : far.push_back(all[k]);
    add_far(far);
  }

  /// Whether the series is accurate at λ = 1 + μ.
  bool holds(const Complex& mu) const { return std::abs(mu - centre_) <= share_ * reach_; }

  /// Moves the centre to μ if the series is not accurate at λ = 1 + μ (`holds`). If μ is only a
  /// little out of range, the centre moves beyond μ: later values are expected in this direction.
  void follow(const Complex& mu) {
    if (holds(mu)) return;
    const Complex way = mu - centre_;
    const Scalar ahead = Scalar(0.9) * share_ * reach_ / std::abs(way);
    if (ahead > Scalar(0.5)) *this = Nearby(*response_, mu + ahead * way, share_);
    if (!holds(mu)) *this = Nearby(*response_, mu, share_);
  }

  /// The responses G_z and G_v at λ = 1 + μ.
  CommandResponse<Scalar> at(const Complex& mu) const {
    if (response_->dense_) return response_->at_distance_from_one(mu);
    Sums sums = far_.back();
    for (std::size_t j = far_.size() - 1; j-- > 0;) {
      const Complex way = mu - centre_;
      sums = {far_[j].z + detail::plain_product(way, sums.z),
              far_[j].v + detail::plain_product(way, sums.v)};
    }
    const Sums near = near_.sums_at(mu);
    return response_->finished({sums.z + near.z, sums.v + near.v}, mu);
  }

  /// The responses at λ = e^{iθ}, and the distance from λ to the nearest pole. The centre follows
  /// λ. Near θ = 0 and π, where imaginary parts must be accurate, all terms are summed.
  std::pair<CommandResponse<Scalar>, Scalar> read(const Scalar& angle) {
    const Complex mu = circle_increment(angle);
    follow(mu);
    const Scalar to_pole = nearest(mu);
    const bool at_end = std::min(angle, pi<Scalar> - angle) < Scalar(0.1) * to_pole;
    return {at_end ? response_->at_angle(angle) : at(mu), to_pole};
  }

  /// The distance from λ = 1 + μ to the nearest pole; a lower bound of it if no pole is near.
  Scalar nearest(const Complex& mu) const {
    const Scalar far = std::min(Scalar(2), reach_ - std::abs(mu - centre_));
    auto least = decltype(detail::ComplexLanes<Scalar>::re)::Constant(far * far).eval();
    for (const auto& block : near_.blocks()) {
      const auto away = mu - block.front();
      least = least.min(away.re * away.re + away.im * away.im);
    }
    return std::sqrt(least.minCoeff());
  }

 private:
  /// Computes the series of the far poles: 1/(μ − e) = Σ (−1)^j (μ − μ₀)^j/(μ₀ − e)^{j+1}.
  void add_far(const detail::ComplexRows<Scalar, 3>& poles) {
    std::array<std::array<detail::ComplexLanes<Scalar>, 2>, terms> series;
    for (const auto& [increment, of_z, of_v] : poles.blocks()) {
      const auto ratio = (centre_ - increment).inverse();
      auto factor_z = of_z * ratio, factor_v = of_v * ratio;
      for (auto& [z, v] : series) {
        z += factor_z;
        v += factor_v;
        factor_z = factor_z * ratio;
        factor_v = factor_v * ratio;
      }
    }
    Scalar sign(1);
    for (std::size_t j = 0; j < terms; ++j, sign = -sign)
      far_[j] = {sign * series[j][0].sum(), sign * series[j][1].sum()};
  }

  const ModalResponse* response_;
  Complex centre_;
  Scalar share_;
  Scalar reach_ = std::numeric_limits<Scalar>::infinity();
  Poles near_;
  static constexpr std::size_t terms = 17;  // 8^−17 is round-off
  std::array<Sums, terms> far_{};
};

template <class Scalar>
template <class Plant>
ModalResponse<Scalar>::ModalResponse(const Plant& plant, const Sampling<Scalar>& sampling)
    : ModalResponse(sampling) {
  const Matrix<Scalar, Eigen::Dynamic> matrix = plant.state_matrix();
  require_finite("sum of the state matrix's entries", static_cast<double>(matrix.sum()), "");
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

/// The response of a plant given by all its poles.
/// @param poles     poles of `plant_poles`
/// @param sampling  τ (s) > 0 and δ (s), 0 … 1000 τ
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

/// The response of a conductor given by its modes, with absorber, measurement filter and drive. It
/// is computed from the poles of `with_hardware` or, if there are none, from `linear_plant`.
/// @param conductor  conductor with all its poles, or without poles
/// @param sampling   τ (s) > 0 and δ (s), 0 … 1000 τ
/// @throws InvalidParameter where conductor, absorber, hardware or sampling are not admissible
template <class Scalar = double>
ModalResponse<Scalar> modal_response(const ConductorWithAbsorber& conductor,
                                     const Sampling<detail::Undeduced<Scalar>>& sampling) {
  const auto poles = with_hardware(conductor.poles, conductor.hardware);
  const auto response = poles.empty()
                            ? ModalResponse<Scalar>(linear_plant<Scalar>(conductor), sampling)
                            : modal_response<Scalar>(poles, sampling);
  return response.with_sensor(conductor.hardware.has_velocity_sensor);
}

/// The response of modes at the absorber's place, with poles computed by `plant_poles`.
/// @throws InvalidParameter where modes, absorber or sampling are not admissible
template <class Scalar = double>
ModalResponse<Scalar> modal_response(const std::vector<PlaceMode<detail::Undeduced<Scalar>>>& modes,
                                     const Absorber<detail::Undeduced<Scalar>>& absorber,
                                     const Sampling<detail::Undeduced<Scalar>>& sampling) {
  return modal_response<Scalar>(
      ConductorWithAbsorber{modes, absorber, plant_poles(modes, absorber)}, sampling);
}

/// All roots λ of the loop, 1 = P G_z(λ) + D G_v(λ), by `pole_sum_roots`. Their number is the
/// number of the plant's states plus the number k of delayed commands. Without velocity sensor the
/// previous reading is one more state, with one more root; for D = 0 this root, 0, is left out.
/// @param response  response of the plant given by its poles
/// @param gains     P (N/m) and D (N s/m)
/// @return all roots; empty if they are not found, if eigenvalues of the plant nearly coincide, or
/// if more than 20 commands are delayed
template <class Scalar>
std::vector<std::complex<Scalar>> loop_roots(const ModalResponse<Scalar>& response,
                                             const PdGains<Scalar>& gains) {
  return pole_sum_roots(response.loop_parts(gains), response.is_late_within_sample());
}

/// The root λ of largest modulus of a loop.
/// @param response  response of the plant given by its poles
/// @param gains     P (N/m) and D (N s/m)
/// @return the root; NaN where `loop_roots` finds none
template <class Scalar>
std::complex<Scalar> largest_loop_root(const ModalResponse<Scalar>& response,
                                       const PdGains<Scalar>& gains) {
  const auto roots = loop_roots(response, gains);
  const auto largest = std::max_element(
      roots.begin(), roots.end(),
      [](const auto& one, const auto& other) { return std::norm(one) < std::norm(other); });
  if (largest == roots.end()) return {std::numeric_limits<Scalar>::quiet_NaN(), Scalar(0)};
  return *largest;
}

/// The excess ρ − 1 of a loop's spectral radius ρ, < 0 if stable; NaN where `loop_roots` is empty.
/// @param response  response of the plant given by its poles
/// @param gains     P (N/m) and D (N s/m)
template <class Scalar>
Scalar loop_excess(const ModalResponse<Scalar>& response, const PdGains<Scalar>& gains) {
  const std::complex<Scalar> mu = largest_loop_root(response, gains) - Scalar(1);
  const Scalar squared = Scalar(2) * mu.real() + std::norm(mu);  // |λ|² − 1
  return squared / (Scalar(1) + std::sqrt(Scalar(1) + squared));
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
