#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "holdfast/core/lanes.hpp"
#include "holdfast/core/select.hpp"
#include "holdfast/math/roots/first_roots.hpp"
#include "holdfast/math/roots/series.hpp"
#include "holdfast/motion/batch/lane_modes.hpp"
#include "holdfast/motion/batch/lane_numbers.hpp"
#include "holdfast/motion/batch/two_mass_series.hpp"
#include "holdfast/motion/next_event.hpp"

namespace holdfast {

/// Whether a function g of time provably stays above zero between two instants, in every lane. For
/// a time h between the instants and |g̈| ≤ M,
///
///     g(x h) ≥ g_0 + (g_1 − g_0) x − 4 d x (1 − x),   d = M h²/8,   0 ≤ x ≤ 1.
///
/// True if this bound is > 0 for all x: min(g_0, g_1) > max(4 d − |g_1 − g_0|, 0)² / 16 d.
/// @param begin  value g_0 at the first instant, in any unit
/// @param end    value g_1 at the second instant, in the same unit
/// @param drop   d > 0, from NoEventBoundOf::drop_below_chord(); for d = 0 the result is false
template <class Scalar>
Mask<Scalar> stays_above_zero(const Scalar& begin, const Scalar& end, const Scalar& drop) {
  using std::abs;
  using std::max;
  using std::min;
  const Scalar rest = max(Scalar(Scalar(4) * drop - abs(Scalar(end - begin))), Scalar(0));
  return Scalar(16) * drop * min(begin, end) > rest * rest;
}

/// The first change of contact in each lane within a time interval of the motion.
template <class Scalar>
struct LaneEvent {
  Mask<Scalar> found;   ///< whether a guard reaches zero in the interval
  Scalar at;            ///< time of the change: 0 beginning, 1 end of the interval; 1 if no change
  Mask<Scalar> second;  ///< true: the second guard reaches zero first; false: the first guard
};

namespace detail {

/// A mask as one byte for each lane: 1 where the mask is set, else 0.
template <class Scalar>
std::array<std::uint8_t, Lanes<Scalar>::count> lane_flags(const Mask<Scalar>& mask) {
  std::array<std::uint8_t, Lanes<Scalar>::count> flags;
  Lanes<Scalar>::store_flags(mask, flags.data());
  return flags;
}

template <class Scalar>
struct GuardOnStretch {
  const LaneGuard<Scalar>& guard;
  const TwoMassSeries<Scalar>& stretch;
  Scalar command;
  std::array<Scalar, 4> row{guard.state[0].all(), guard.state[1].all(), guard.state[2].all(),
                            guard.state[3].all()};
  std::size_t terms = static_cast<std::size_t>(stretch.terms.most);

  /// Computes the power series g of the guard.
  /// @param forced  whether the force enters any lane's guard
  /// @param fresh   whether any lane's contact has just changed
  void expand(bool forced, bool fresh, const Mask<Scalar>& which, LaneSeries<Scalar>& g) const {
    for (std::size_t k = 0; k < terms; ++k)
      g[k] = row[0] * stretch.state[0][k] + row[1] * stretch.state[1][k] +
             row[2] * stretch.state[2][k] + row[3] * stretch.state[3][k];
    const Scalar by_force = guard.force.all(), zeros = guard.zeros.all();
    if (forced)
      for (std::size_t k = 0; k < terms; ++k) g[k] = g[k] + by_force * stretch.force[k];
    g[0] = g[0] + guard.command.all() * command + guard.constant.all();
    if (fresh)
      for (std::size_t k = 0; k < std::min<std::size_t>(terms, 4); ++k)
        g[k] = select(zeros > Scalar(static_cast<double>(k)), Scalar(0), g[k]);
    clear_rounding(which, g);
  }

 private:
  /// Sets leading coefficients to zero where they are rounding errors, as next_event() does.
  void clear_rounding(const Mask<Scalar>& which, LaneSeries<Scalar>& g) const {
    using std::abs;
    const Scalar rounding(4.0 * std::numeric_limits<double>::epsilon());
    Scalar known = abs(Scalar(guard.command.all() * command)) + abs(guard.constant.all());
    Mask<Scalar> still = which;
    for (std::size_t k = 0; k < terms; ++k) {
      Scalar size = known + abs(Scalar(guard.force.all() * stretch.force[k]));
      for (std::size_t i = 0; i < 4; ++i) size = size + abs(Scalar(row[i] * stretch.state[i][k]));
      still = still & (abs(g[k]) <= rounding * size);
      if (!any(still)) return;
      g[k] = select(still, Scalar(0), g[k]);
      known = Scalar(0);
    }
  }
};

/// Stores the first nonzero sign of a lane's guard (first_sign()) in the contact if it is unknown.
template <class Scalar>
void learn_sign(LaneModes<Scalar>& modes, std::size_t lane, int terms, LaneSeries<Scalar>& g) {
  Series alone(terms);
  for (Eigen::Index k = 0; k < terms; ++k) alone[k] = lane_of(g[static_cast<std::size_t>(k)], lane);
  const double sign = first_sign(alone);
  if (sign != 0.0) alone *= sign;
  for (Eigen::Index k = 0; k < terms; ++k) {
    LaneNumbers<Scalar> numbers;
    numbers.set(g[static_cast<std::size_t>(k)]);
    numbers[lane] = alone[k];
    g[static_cast<std::size_t>(k)] = numbers.all();
  }
  if (sign != 0.0) modes.contact(lane).learn_sign(0, sign);
}

template <class Scalar>
void learn_signs(LaneModes<Scalar>& modes, const Mask<Scalar>& which, int terms,
                 LaneSeries<Scalar>& g) {
  const auto asked = lane_flags<Scalar>(which);
  for (std::size_t lane = 0; lane < asked.size(); ++lane)
    if (asked[lane] != 0 && modes.without_sign()[lane]) learn_sign(modes, lane, terms, g);
}

}  // namespace detail

/// The search for the first zero of any guard (GuardOf) in a time interval, in all lanes at once.
///
/// As in next_event(), no zero is missed. Work: 5 multiply-adds for each guard and Taylor term, and
/// first_roots(). No memory is allocated.
template <class Scalar>
class LaneEventSearch {
 public:
  /// @param modes    contact modes of the lanes; unknown signs of guards are determined and stored
  /// @param stretch  series of the motion over the interval, at most 1/modes.rate() (s) long
  /// @param command  command u in force (N)
  /// @param which    lanes to be searched; the result has no event in any other lane
  LaneEvent<Scalar> operator()(LaneModes<Scalar>& modes, const TwoMassSeries<Scalar>& stretch,
                               const Scalar& command, const Mask<Scalar>& which) {
    const Mask<Scalar> guarded = which & modes.guarded();
    const int terms = stretch.terms.most;
    const auto expand = [&](std::size_t number, LaneSeries<Scalar>& g) {
      detail::GuardOnStretch<Scalar>{modes.guard(number), stretch, command}.expand(
          modes.sticking().any(), modes.freshly_changed().any(), guarded, g);
      if (number == 0 && modes.without_sign().any()) detail::learn_signs(modes, guarded, terms, g);
    };
    if (modes.with_two_guards().none()) {
      expand(0, one_[0]);
      const auto [root] = first_roots<Scalar, 1>(one_, terms, {guarded});
      return {root.found, root.at, Scalar(0) > Scalar(0)};
    }
    expand(0, two_[0]);
    expand(1, two_[1]);
    const auto [first, second] = first_roots<Scalar, 2>(two_, terms, {guarded, guarded});
    const Mask<Scalar> later = without<Scalar>(second.found, first.found & (first.at <= second.at));
    const Mask<Scalar> found = first.found | second.found;
    return {found, select(later, second.at, first.at), later};
  }

 private:
  std::array<LaneSeries<Scalar>, 1> one_{};
  std::array<LaneSeries<Scalar>, 2> two_{};
};

}  // namespace holdfast
