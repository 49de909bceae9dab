#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "holdfast/core/lanes.hpp"
#include "holdfast/core/select.hpp"
#include "holdfast/excitation/harmonic_excitation.hpp"
#include "holdfast/math/roots/first_roots.hpp"
#include "holdfast/math/roots/series.hpp"
#include "holdfast/motion/batch/lane_numbers.hpp"
#include "holdfast/motion/taylor_step.hpp"

namespace holdfast {

namespace detail {

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

/// The number of Taylor terms in each lane. It depends only on the rate and length of this lane;
/// the results of a lane are therefore bitwise independent of the other lanes.
template <class Scalar>
struct TermsOfLanes {
  int most;        ///< largest number of terms in any lane, 1 … most_terms
  int least;       ///< smallest number of terms in any lane
  Scalar of_lane;  ///< number of terms in each lane
};

/// Computes the required number of Taylor terms, terms_for(), in all lanes at once.
template <class Scalar>
class LaneTerms {
 public:
  /// @param turns  rate (1/s) times length (s) of the series in each lane, 0 … 1
  TermsOfLanes<Scalar> operator()(const Scalar& turns) const {
    constexpr std::size_t lanes = Lanes<Scalar>::count;
    LaneNumbers<Scalar> of_lane;
    of_lane.set(turns);
    std::array<int, lanes> terms{};
    for (std::size_t lane = 0; lane < lanes; ++lane) terms[lane] = of(of_lane[lane]);
    const auto [least, most] = std::minmax_element(terms.begin(), terms.end());
    return {*most, *least, detail::from_lanes<Scalar>([&](std::size_t lane) {
              return static_cast<double>(terms[lane]);
            })};
  }

 private:
  static constexpr double parts = 64.0;  // equal parts of 0 … 1 for a first guess of the terms

  int of(double turns) const {
    if (!(turns > longest_[0])) return 1;
    int terms = fewest_[static_cast<std::size_t>(parts * std::min(turns, 1.0))];
    while (terms < most_terms && turns > longest_[static_cast<std::size_t>(terms - 1)]) ++terms;
    return terms;
  }

  /// The largest length for which 1, 2, … terms suffice, in units of 1/rate.
  static std::array<double, most_terms> lengths() {
    std::array<double, most_terms> longest{};
    for (int terms = 1; terms <= most_terms; ++terms) {
      double low = 0.0, high = 2.0;
      for (int halving = 0; halving < 40; ++halving) {
        const double middle = 0.5 * (low + high);
        (terms_for(middle) <= terms ? low : high) = middle;
      }
      longest[static_cast<std::size_t>(terms - 1)] = low;
    }
    return longest;
  }

  /// The number of terms needed for rate times length = k/`parts`, for k = 0 … `parts` (64).
  std::array<int, static_cast<std::size_t>(parts) + 1> fewest() const {
    std::array<int, static_cast<std::size_t>(parts) + 1> result{};
    for (std::size_t k = 0; k < result.size(); ++k) {
      const auto shorter = [&](double longest) { return longest < static_cast<double>(k) / parts; };
      const auto terms = std::count_if(longest_.begin(), longest_.end(), shorter) + 1;
      result[k] = std::min(static_cast<int>(terms), most_terms);
    }
    return result;
  }

  std::array<double, most_terms> longest_ = lengths();
  std::array<int, static_cast<std::size_t>(parts) + 1> fewest_ = fewest();
};

/// Acceleration (m/s²) of a mass in a contact mode, in every lane: state · z + constant + force F.
template <class Scalar>
struct LaneAcceleration {
  std::array<Scalar, 4> state;  ///< coefficients of z₁, ż₁, z₂, ż₂: a row of the matrix A
  Scalar constant;              ///< constant part (m/s²), including the effect of the command u
  Scalar force;                 ///< coefficient of the excitation force F (1/kg)
};

/// A harmonic of the excitation at the beginning of a time interval, in every lane.
template <class Scalar>
struct LanePhasor {
  Scalar angular_frequency;        ///< ω (rad/s); 0 for a held force
  ExcitationSample<Scalar> phase;  ///< F_l cos α_l, F_l sin α_l (N): amplitude F_l, phase angle α_l
};

/// The Taylor series of the two masses' motion and of the force over a time h (s), in every lane:
///
///     d_{k+1} = h (A d_k + k! w_k),   z(t + x h) = Σ d_k x^k / k!,   0 ≤ x ≤ 1
///
/// with the state z, its matrix A and the coefficients w_k of the inputs (TaylorStep). Work per
/// term: 8 multiply-adds and 9 products, and 3 more for each harmonic.
template <class Scalar>
struct TwoMassSeries {
  std::array<LaneSeries<Scalar>, 4> state;  ///< series of z₁, ż₁, z₂, ż₂
  LaneSeries<Scalar> force;                 ///< series of F (N)
  TermsOfLanes<Scalar> terms;               ///< numbers of terms in the lanes

  /// @param masses   accelerations of conductor and absorber
  /// @param begin    values of z₁, ż₁, z₂, ż₂ at x = 0
  /// @param phasors  harmonics of the excitation at x = 0, one or more
  /// @param length   h (s), ≥ 0
  /// @param count    numbers of terms in the lanes, from LaneTerms
  TwoMassSeries(const std::array<LaneAcceleration<Scalar>, 2>& masses,
                const std::array<Scalar, 4>& begin, const std::vector<LanePhasor<Scalar>>& phasors,
                const Scalar& length, const TermsOfLanes<Scalar>& count)
      : terms(count) {
    const auto most = static_cast<std::size_t>(count.most);
    expand_force(phasors, length, most);
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
      if (k + 1 == most) break;
      const Scalar next_one = rate(one, now, constant_one, force[k]);
      const Scalar next_two = rate(two, now, constant_two, force[k]);
      force[k] = force[k] * Scalar(inverse_factorial[k]);
      now = {now[1] * length, next_one, now[3] * length, next_two};
      constant_one = constant_two = Scalar(0);
    }
    force[most - 1] = force[most - 1] * Scalar(inverse_factorial[most - 1]);
    for (auto k = static_cast<std::size_t>(count.least); k < most; ++k) end_lanes(k);
  }

  /// The state [z₁, ż₁, z₂, ż₂] at the time x h, 0 ≤ x ≤ 1.
  std::array<Scalar, 4> state_at(const Scalar& x) const {
    auto k = static_cast<std::size_t>(terms.most - 1);
    std::array<Scalar, 4> sum{state[0][k], state[1][k], state[2][k], state[3][k]};
    while (k-- > 0)
      for (std::size_t i = 0; i < 4; ++i) sum[i] = sum[i] * x + state[i][k];
    return sum;
  }

  /// The value of one of the series (a member of `state`, or `force`) at the time x h, 0 ≤ x ≤ 1.
  Scalar value(const LaneSeries<Scalar>& series, const Scalar& x) const {
    auto k = static_cast<std::size_t>(terms.most - 1);
    Scalar sum = series[k];
    while (k-- > 0) sum = sum * x + series[k];
    return sum;
  }

 private:
  /// Sets the k-th coefficients to zero in the lanes with k terms or fewer.
  void end_lanes(std::size_t k) {
    const Mask<Scalar> has = terms.of_lane > Scalar(static_cast<double>(k));
    for (auto& series : state) series[k] = select(has, series[k], Scalar(0));
    force[k] = select(has, force[k], Scalar(0));
  }

  /// Computes the derivatives of the force, not yet divided by factorials.
  void expand_force(const std::vector<LanePhasor<Scalar>>& phasors, const Scalar& length,
                    std::size_t count) {
    bool first = true;
    for (const LanePhasor<Scalar>& phasor : phasors) {
      const Scalar turn = phasor.angular_frequency * length;
      Scalar cosine = phasor.phase.cosine, sine = phasor.phase.sine;
      for (std::size_t k = 0; k < count; ++k) {
        force[k] = first ? cosine : force[k] + cosine;
        const Scalar next = -turn * sine;
        sine = turn * cosine;
        cosine = next;
      }
      first = false;
    }
  }

  /// The next coefficient of one variable: row of A times the present d_k, plus constant and force.
  static Scalar rate(const LaneAcceleration<Scalar>& row, const std::array<Scalar, 4>& now,
                     const Scalar& constant, const Scalar& force) {
    const Scalar early =
        row.state[0] * now[0] + (row.state[2] * now[2] + (row.force * force + constant));
    return row.state[3] * now[3] + (row.state[1] * now[1] + early);
  }
};

}  // namespace holdfast
