#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "holdfast/excitation/harmonic_excitation.hpp"
#include "holdfast/math/roots/first_roots.hpp"
#include "holdfast/math/roots/series.hpp"

namespace holdfast {

namespace detail {

/// 1/k!, k < most_terms.
constexpr std::array<double, most_terms> inverse_factorials() {
  std::array<double, most_terms> result{};
  double factorial = 1.0;
  for (std::size_t k = 0; k < result.size(); ++k) {
    if (k > 0) factorial *= static_cast<double>(k);
    result[k] = 1.0 / factorial;
  }
  return result;
}

}  // namespace detail

/// How a mass of the two is accelerated in one mode of the contact, in every lane:
/// state · [z₁, ż₁, z₂, ż₂] + constant + force F (m/s²).
template <class Scalar>
struct LaneAcceleration {
  std::array<Scalar, 4> state;  ///< of the row of A
  Scalar constant;              ///< drift + b u (m/s²)
  Scalar force;                 ///< per newton of F
};

/// A harmonic of the excitation at the begin of a stretch, in every lane.
template <class Scalar>
struct LanePhasor {
  Scalar angular_frequency;        ///< ω (rad/s); 0 of a force that is held
  ExcitationSample<Scalar> phase;  ///< F_l cos and F_l sin of its angle there (N)
};

/// Taylor's series of two masses over a length h, in every lane: TaylorStep on packs, and the force
/// with it.
///
///     d_{k+1} = h (A d_k + w_k),   z(t + x h) = Σ d_k x^k / k!
///
/// with w_k as there. Two of the four rows of A say that ż = dz/dt and cost one product. Work per
/// term: 8 multiply-adds and 9 products, 3 for each harmonic.
template <class Scalar>
struct TwoMassSeries {
  std::array<LaneSeries<Scalar>, 4> state;  ///< of z₁, ż₁, z₂, ż₂
  LaneSeries<Scalar> force;                 ///< of F (N)

  /// @param masses   accelerations of conductor and absorber
  /// @param begin    z₁, ż₁, z₂, ż₂ at x = 0
  /// @param phasors  of the excitation there
  /// @param length   h (s), ≥ 0
  /// @param terms    1 … `most_terms`
  TwoMassSeries(const std::array<LaneAcceleration<Scalar>, 2>& masses,
                const std::array<Scalar, 4>& begin, const std::vector<LanePhasor<Scalar>>& phasors,
                const Scalar& length, int terms) {
    expand_force(phasors, length, terms);
    const auto scaled = [&](const LaneAcceleration<Scalar>& row) {
      return LaneAcceleration<Scalar>{{row.state[0] * length, row.state[1] * length,
                                       row.state[2] * length, row.state[3] * length},
                                      row.constant * length,
                                      row.force * length};
    };
    const LaneAcceleration<Scalar> one = scaled(masses[0]), two = scaled(masses[1]);
    std::array<Scalar, 4> now = begin;
    Scalar constant_one = one.constant, constant_two = two.constant;
    constexpr auto inverse_factorial = detail::inverse_factorials();
    for (std::size_t k = 0;; ++k) {
      for (std::size_t i = 0; i < 4; ++i) state[i][k] = now[i] * Scalar(inverse_factorial[k]);
      if (k + 1 == static_cast<std::size_t>(terms)) break;
      const Scalar next_one = rate(one, now, constant_one, force[k]);
      const Scalar next_two = rate(two, now, constant_two, force[k]);
      force[k] = force[k] * Scalar(inverse_factorial[k]);
      now = {now[1] * length, next_one, now[3] * length, next_two};
      constant_one = constant_two = Scalar(0);
    }
    const auto last = static_cast<std::size_t>(terms - 1);
    force[last] = force[last] * Scalar(inverse_factorial[last]);
  }

  /// The value of one of the series at x.
  static Scalar value(const LaneSeries<Scalar>& series, int terms, const Scalar& x) {
    Scalar sum = series[static_cast<std::size_t>(terms - 1)];
    for (auto k = static_cast<std::size_t>(terms - 1); k-- > 0;) sum = sum * x + series[k];
    return sum;
  }

 private:
  /// The derivatives of the force, not yet divided.
  void expand_force(const std::vector<LanePhasor<Scalar>>& phasors, const Scalar& length,
                    int terms) {
    const auto count = static_cast<std::size_t>(terms);
    for (std::size_t k = 0; k < count; ++k) force[k] = Scalar(0);
    for (const LanePhasor<Scalar>& phasor : phasors) {
      const Scalar turn = phasor.angular_frequency * length;
      Scalar cosine = phasor.phase.cosine, sine = phasor.phase.sine;
      for (std::size_t k = 0; k < count; ++k) {
        force[k] = force[k] + cosine;
        const Scalar next = -turn * sine;
        sine = turn * cosine;
        cosine = next;
      }
    }
  }

  /// What was computed last comes in last.
  static Scalar rate(const LaneAcceleration<Scalar>& row, const std::array<Scalar, 4>& now,
                     const Scalar& constant, const Scalar& force) {
    const Scalar early =
        row.state[0] * now[0] + (row.state[2] * now[2] + (row.force * force + constant));
    return row.state[3] * now[3] + (row.state[1] * now[1] + early);
  }
};

}  // namespace holdfast
