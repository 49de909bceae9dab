#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/roots/bracketing_root.hpp"
#include "holdfast/stability/boundary/boundary_point.hpp"
#include "holdfast/stability/response/modal_response.hpp"

namespace holdfast {

/// Value of a gain at which roots of the loop cross the unit circle, and the direction of crossing.
template <class Scalar>
struct GainPassage {
  Scalar gain;   ///< P (N/m) or D (N s/m), finite
  Scalar angle;  ///< θ (rad) of the roots e^{±iθ}, 0 … π
  int leaving;  ///< roots that leave the unit disc as the gain grows: 1 or 2; −1 or −2: they enter
};

/// Gains at which roots of a loop of any order cross the unit circle, and numbers of roots outside.
/// They follow from the transfer functions G_z and G_v (`ModalResponse`) at stored angles θ. The
/// number n_out of roots outside, n_plant without control, is given by the winding of p about 0:
///
///     p(λ) = 1 − P G_z(λ) − D G_v(λ),   n_out = n_plant − (1/π) [arg p(e^{iθ})] from 0 to π
///
/// Let one gain be fixed at y and the other (free) gain vary. The loop has the root e^{iθ} if the
/// free gain is X(θ) = (1 − y G_fixed)/G_free and X is real. As the free gain grows, this root
/// leaves the unit disc if Im X rises with θ. The crossings divide the free gain's axis. In one
/// interval n_out is found by winding; its changes at the crossings give all others. Winding checks
/// all intervals if there are at most twelve, else those with n_out ≤ 4 or the least n_out. If a
/// check fails, only winding is used. Work: 10 operations per angle, 10 values of G per crossing.
template <class Scalar>
class UnitCircleCrossings {
 public:
  /// Transfer functions from the command to the measured displacement and velocity, at one angle.
  struct Place {
    Scalar angle;               ///< θ (rad)
    CommandResponse<Scalar> g;  ///< transfer functions G_z and G_v at e^{iθ}
  };

  static constexpr Scalar coarse{0.5};  ///< constructor's `close` that suffices for `roots_outside`

  /// @param response  response of the loop; a copy is stored
  /// @param close     largest step between stored angles, relative to the least distance from the
  ///                  nearest pole, θ = 0 and θ = π; > 0
  explicit UnitCircleCrossings(ModalResponse<Scalar> response, const Scalar& close = Scalar(0.12))
      : response_(std::move(response)) {
    // At smaller angles Im X is only round-off.
    const auto from = [&](const std::complex<Scalar>& end) {
      return Scalar(1e-4) * Nearby(response_, end).nearest(end);
    };
    Scalar angle = from(Scalar(0));
    const Scalar last = pi<Scalar> - from(Scalar(-2));
    // Winding needs few digits: the error of a third is 1e-8 of the far poles' sum.
    Nearby nearby(response_, circle_increment(angle),
                  close < coarse ? Scalar(1) / 8 : Scalar(1) / 3);
    while (angle < last) {
      const auto [g, to_pole] = nearby.read(angle);
      places_.push_back({angle, g});
      const Scalar step = close * std::min({to_pole, angle, pi<Scalar> - angle});
      const Scalar least = Scalar(1e-13) + Scalar(1e-14) * angle;
      angle += std::min(std::max(step, least), Scalar(0.4) / Scalar(response_.held_commands()));
    }
    places_.push_back({pi<Scalar>, response_.at_angle(pi<Scalar>)});
    for (const Place& place : places_) {
      size_of_z_ = std::max(size_of_z_, std::abs(place.g.displacement));
      size_of_v_ = std::max(size_of_v_, std::abs(place.g.velocity));
    }
  }

  /// The response of the loop, from which all crossings are computed.
  const ModalResponse<Scalar>& response() const { return response_; }

  /// The angles at which G_z and G_v are stored, ascending, with their values.
  const std::vector<Place>& places() const { return places_; }

  /// The number of the loop's roots outside the unit circle. It is −1 (unknown) if a root is on the
  /// circle or if the gains are not finite or so large that p is only round-off.
  int roots_outside(const PdGains<Scalar>& gains) const {
    Turn turn{gains, static_cast<std::int64_t>(20 * places_.size())};
    std::vector<std::complex<Scalar>> p;
    p.reserve(places_.size());
    for (const Place& place : places_)  // −0 counts as 0
      p.push_back(characteristic(place.g, gains) + std::complex<Scalar>(0));
    for (std::size_t i = 1; i < p.size(); ++i)
      if (!turn.takes(p[i - 1], p[i]) && !turn.takes(p[i - 1], p[i], Scalar(4) * bend_of(p, i)))
        halve(turn, {places_[i - 1].angle, p[i - 1]}, {places_[i].angle, p[i]});
    const Scalar half_turns =
        (std::arg(p.back()) - std::arg(p.front())) / pi<Scalar> + Scalar(2 * turn.crossings);
    if (turn.budget < 0 || !(std::abs(half_turns - std::round(half_turns)) < 0.05)) return -1;
    return response_.unstable_poles() - static_cast<int>(std::lround(half_turns));
  }

  /// Estimates of λ − 1 for the roots λ nearest to the unit circle, nearest first: one Newton step
  /// from each minimum of |p| on the circle. For use where `loop_roots` does not converge.
  std::vector<std::complex<Scalar>> roots_nearby(const PdGains<Scalar>& gains) const {
    std::vector<std::pair<Scalar, std::complex<Scalar>>> found;
    const auto size = [&](std::size_t i) { return std::abs(characteristic(places_[i].g, gains)); };
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, places_.size() - 1);
      if (size(i) > size(before) || size(i) > size(after)) continue;
      const Place &left = places_[before], &right = places_[after];
      const std::complex<Scalar> lambda = Scalar(1) + circle_increment(places_[i].angle);
      const std::complex<Scalar> slope =
          (characteristic(right.g, gains) - characteristic(left.g, gains)) /
          (std::complex<Scalar>(0, 1) * lambda * (right.angle - left.angle));
      const std::complex<Scalar> step = characteristic(places_[i].g, gains) / slope;
      found.emplace_back(std::abs(step), circle_increment(places_[i].angle) - step);
    }
    std::sort(found.begin(), found.end(),
              [](const auto& one, const auto& other) { return one.first < other.first; });
    std::vector<std::complex<Scalar>> roots;
    roots.reserve(found.size());
    for (const auto& [distance, root] : found) roots.push_back(root);
    return roots;
  }

  /// The values of one gain, ascending, at which roots cross the unit circle; the other is fixed.
  /// @param free   the gain that varies
  /// @param gains  the fixed gain; the value of the free gain is not used
  std::vector<GainPassage<Scalar>> passages(FreeGain free, const PdGains<Scalar>& gains) const {
    const Line line{free, gains};
    Nearby nearby(response_, circle_increment(places_.front().angle));
    std::vector<GainPassage<Scalar>> found;
    // The last place, θ = π, is left out: Im X is round-off there.
    std::vector<Scalar> values;
    for (std::size_t i = 0; i + 1 < places_.size(); ++i)
      values.push_back(line.imaginary(places_[i].g));
    add_real_root(line, places_.front(), values.front(), found);
    for (std::size_t i = 1; i < values.size(); ++i) {
      if ((values[i - 1] > Scalar(0)) != (values[i] > Scalar(0))) {
        add_pair(line, places_[i - 1].angle, values[i - 1], places_[i].angle, values[i], nearby,
                 found);
      } else if (i + 1 < values.size()) {
        add_close_pairs(line, i, &values[i], nearby, found);
      }
    }
    add_real_root(line, places_.back(), -values.back(), found);
    std::sort(found.begin(), found.end(),
              [](const auto& a, const auto& b) { return a.gain < b.gain; });
    return found;
  }

  /// The open intervals of one gain (N/m or N s/m) in which the loop is stable; the other is fixed.
  /// @param free   the gain that varies
  /// @param gains  the fixed gain; the value of the free gain is not used
  /// @param checks whether the numbers n_out found from the crossings are checked by winding
  /// @throws InvalidParameter where the fixed gain is not finite
  std::vector<Interval<Scalar>> stable_gains(FreeGain free, const PdGains<Scalar>& gains,
                                             bool checks = true) const {
    detail::require_held(gains, free);
    const auto found = passages(free, gains);
    const auto outside = [&](const Interval<Scalar>& gap) {
      const Scalar x = gap.contains(Scalar(0)) ? Scalar(0) : gap.representative();
      return roots_outside(detail::with_gain(gains, free, x));
    };
    return without_roots_outside(found, outside, checks);
  }

 private:
  using Nearby = typename ModalResponse<Scalar>::Nearby;

  /// Line in the plane of P and D along which one gain varies.
  struct Line {
    FreeGain free;
    PdGains<Scalar> gains;

    std::complex<Scalar> of_free(const CommandResponse<Scalar>& g) const {
      return free == FreeGain::differential ? g.velocity : g.displacement;
    }
    std::complex<Scalar> rest(const CommandResponse<Scalar>& g) const {
      return Scalar(1) - (free == FreeGain::differential ? gains.proportional * g.displacement
                                                         : gains.differential * g.velocity);
    }
    /// A smooth function with the sign of Im X, for X of `UnitCircleCrossings`.
    Scalar imaginary(const CommandResponse<Scalar>& g) const {
      const std::complex<Scalar> a = rest(g), b = of_free(g);
      return a.imag() * b.real() - a.real() * b.imag();
    }
    Scalar gain(const CommandResponse<Scalar>& g) const { return (rest(g) / of_free(g)).real(); }
  };

  static std::complex<Scalar> characteristic(const CommandResponse<Scalar>& g,
                                             const PdGains<Scalar>& gains) {
    return Scalar(1) - gains.proportional * g.displacement - gains.differential * g.velocity;
  }

  /// Winding of p about 0 along the circle: how often p crosses the negative real axis.
  struct Turn {
    PdGains<Scalar> gains;
    std::int64_t budget;  ///< number of values of G that may still be computed
    int crossings = 0;    ///< counterclockwise crossings minus clockwise ones

    /// Whether arg p can be followed along the chord from a to b: their angles differ by ≤ 45°, or
    /// the chord is over `distance` from 0. If so, counts a crossing of the negative real axis.
    bool takes(const std::complex<Scalar>& a, const std::complex<Scalar>& b,
               const Scalar& distance = std::numeric_limits<Scalar>::infinity()) {
      const Scalar along = a.real() * b.real() + a.imag() * b.imag();
      const Scalar across = a.real() * b.imag() - a.imag() * b.real();
      if (!(std::abs(across) <= along || std::abs(across) > distance * std::abs(b - a)))
        return false;
      const bool below = a.imag() < Scalar(0);
      if (below != (b.imag() < Scalar(0)) && (below ? across < Scalar(0) : across > Scalar(0)))
        crossings += below ? -1 : 1;
      return true;
    }
  };

  /// Estimated distance of p from the chord between places i − 1 and i; ∞ for the outer chords.
  Scalar bend_of(const std::vector<std::complex<Scalar>>& p, std::size_t i) const {
    if (i < 2 || i + 1 == p.size()) return std::numeric_limits<Scalar>::infinity();
    const Scalar step = places_[i].angle - places_[i - 1].angle;
    const auto from = [&](std::size_t j) {
      const Scalar other = places_[j].angle - places_[j - 1].angle;
      const auto expected = (p[j] - p[j - 1]) * (step / other);
      return std::abs(p[i] - p[i - 1] - expected) * step / (Scalar(4) * (step + other));
    };
    return std::max(from(i - 1), from(i + 1));
  }

  /// Adds the winding of p between two angles by halving. A half is replaced by its chord if this
  /// is farther from 0 than `bend`, the distance of the middle value from the undivided chord.
  void halve(Turn& turn, const std::pair<Scalar, std::complex<Scalar>>& from,
             const std::pair<Scalar, std::complex<Scalar>>& to) const {
    const Scalar middle = (from.first + to.first) / Scalar(2);
    if (!(from.first < middle && middle < to.first)) turn.budget = 0;
    if (--turn.budget < 0) return;
    const std::pair between{middle, characteristic(response_.at_angle(middle), turn.gains)};
    const Scalar bend = std::abs(between.second - (from.second + to.second) / Scalar(2));
    if (!std::isfinite(bend)) turn.budget = -1;
    if (!turn.takes(from.second, between.second, bend)) halve(turn, from, between);
    if (!turn.takes(between.second, to.second, bend)) halve(turn, between, to);
  }

  /// Adds the crossing of a root pair between two angles at which Im X has opposite signs.
  void add_pair(const Line& line, const Scalar& lower, const Scalar& at_lower, const Scalar& upper,
                const Scalar& at_upper, Nearby& nearby,
                std::vector<GainPassage<Scalar>>& found) const {
    const auto zero = bracketing_root<Scalar>(
        [&](const Scalar& angle) { return line.imaginary(nearby.read(angle).first); },
        {lower, upper, at_lower, at_upper}, Scalar(0));
    keep({line.gain(nearby.read(zero.lower).first), zero.lower, at_upper > Scalar(0) ? 2 : -2},
         line, found);
  }

  /// Adds a crossing, unless its gain is only round-off (λ = 1 for a drive between the masses).
  void keep(const GainPassage<Scalar>& passage, const Line& line,
            std::vector<GainPassage<Scalar>>& found) const {
    const Scalar size = line.free == FreeGain::differential ? size_of_v_ : size_of_z_;
    if (std::abs(passage.gain) * size < Scalar(1e12)) found.push_back(passage);
  }

  /// Adds the crossing of a real root at λ = 1 or −1.
  /// @param rising  any number with the sign of d(Im X)/dθ at the place
  void add_real_root(const Line& line, const Place& place, const Scalar& rising,
                     std::vector<GainPassage<Scalar>>& found) const {
    const Scalar end = place.angle < Scalar(1) ? Scalar(0) : pi<Scalar>;
    // G is real at θ = 0 and π except for round-off.
    const CommandResponse<Scalar> g = response_.at_angle(end);
    keep({line.rest(g).real() / line.of_free(g).real(), end, rising > Scalar(0) ? 1 : -1}, line,
         found);
  }

  /// Adds two crossings between neighbouring stored angles, whose Im X then has the same sign. They
  /// are sought where |Im X| is less at place i than at both neighbouring places.
  /// @param at  pointer to Im X at place i, in the array of Im X at all places
  void add_close_pairs(const Line& line, std::size_t i, const Scalar* at, Nearby& nearby,
                       std::vector<GainPassage<Scalar>>& found) const {
    const Scalar before = at[-1], here = at[0], after = at[1];
    if ((after > Scalar(0)) != (here > Scalar(0)) || std::abs(here) > std::abs(before) ||
        std::abs(here) > std::abs(after))
      return;
    const Scalar sign = here > Scalar(0) ? Scalar(1) : Scalar(-1);
    const Scalar lower = places_[i - 1].angle, upper = places_[i + 1].angle;
    // Two crossings are excluded by a parabola through the three values far from zero.
    const Scalar way = places_[i].angle - lower, on = upper - places_[i].angle;
    const Scalar curvature = ((after - here) / on - (here - before) / way) / (way + on);
    const Scalar at_here = (here - before) / way + curvature * way;
    const Scalar vertex = sign * (here - at_here * at_here / (Scalar(4) * curvature));
    if (vertex > Scalar(0.1) * std::max(std::abs(before), std::abs(after))) return;
    const auto at_angle = [&](const Scalar& angle) {
      return sign * line.imaginary(nearby.read(angle).first);
    };
    const Scalar beyond = detail::narrow_to_minimum(lower, upper, 40, at_angle);
    const Scalar value = sign * at_angle(beyond);
    if (sign * value > Scalar(0)) return;
    add_pair(line, lower, before, beyond, value, nearby, found);
    add_pair(line, beyond, value, upper, after, nearby, found);
  }

  /// The intervals between crossings with no root outside the circle; undecided ones are left out.
  template <class Outside>
  static std::vector<Interval<Scalar>> without_roots_outside(
      const std::vector<GainPassage<Scalar>>& found, const Outside& outside, bool checks) {
    std::vector<Interval<Scalar>> gaps(found.size() + 1);  // unbounded at first
    for (std::size_t k = 0; k < found.size(); ++k)
      gaps[k].upper = gaps[k + 1].lower = found[k].gain;
    // The count begins in the relatively widest gap, since p of huge gains has much round-off.
    const auto width = [](const Interval<Scalar>& gap) {
      return (gap.upper - gap.lower) / (std::abs(gap.lower) + std::abs(gap.upper));
    };
    std::size_t first = 0;
    for (std::size_t k = 1; k + 1 < gaps.size(); ++k)
      if (first == 0 || width(gaps[k]) > width(gaps[first])) first = k;
    std::vector<int> roots(gaps.size());
    roots[first] = outside(gaps[first]);
    for (std::size_t k = first; k + 1 < gaps.size(); ++k)
      roots[k + 1] = roots[k] + found[k].leaving;
    for (std::size_t k = first; k-- > 0;) roots[k] = roots[k + 1] - found[k].leaving;
    const int fewest = *std::min_element(roots.begin(), roots.end());
    const int doubtful = gaps.size() <= 12 ? std::numeric_limits<int>::max() : std::max(4, fewest);
    bool agree = fewest >= 0;
    for (std::size_t k = 0; k < gaps.size() && agree && checks; ++k)
      if (k != first && roots[k] <= doubtful && gaps[k].lower < gaps[k].upper) {
        const int counted = outside(gaps[k]);
        agree = counted == roots[k] || counted < 0;
        roots[k] = counted;
      }
    std::vector<Interval<Scalar>> stable;
    for (std::size_t k = 0; k < gaps.size(); ++k)
      if (gaps[k].lower < gaps[k].upper && (agree ? roots[k] : outside(gaps[k])) == 0)
        stable.push_back(gaps[k]);
    return stable;
  }

  ModalResponse<Scalar> response_;
  std::vector<Place> places_;           // ascending, from about 0 to π
  Scalar size_of_z_{0}, size_of_v_{0};  // max |G_z| and |G_v| over them
};

/// The excess ρ − 1 of a loop's spectral radius ρ, < 0 if stable. If `loop_roots` fails, the radius
/// of the smallest circle without roots outside is found to ten digits by bisection.
/// @param response  response of the plant given by its poles
/// @param gains     gains P (N/m) and D (N s/m)
/// @return excess (by bisection not below −0.44); NaN if `loop_roots` fails and eigenvalues of the
///         plant nearly coincide
template <class Scalar>
Scalar loop_excess_or_turn(const ModalResponse<Scalar>& response, const PdGains<Scalar>& gains) {
  const Scalar excess = loop_excess(response, gains);
  if (std::isfinite(excess)) return excess;
  if (!response.at_radius(Scalar(0))) return std::numeric_limits<Scalar>::quiet_NaN();
  const auto holds_all = [&](const Scalar& offset) {
    return UnitCircleCrossings<Scalar>(*response.at_radius(offset)).roots_outside(gains) == 0;
  };
  const Scalar sign(holds_all(Scalar(0)) ? -1 : 1);
  const auto is_beyond = [&](const Scalar& size) { return holds_all(sign * size) == (sign > 0); };
  Scalar within(1e-13), beyond = within;
  while (!is_beyond(beyond)) {
    if (beyond > Scalar(sign < 0 ? 0.2 : 1e6)) return sign * beyond;
    within = beyond;
    beyond *= Scalar(4);
  }
  while (beyond - within > Scalar(1e-10) * beyond) {
    const Scalar middle = (within + beyond) / Scalar(2);
    (is_beyond(middle) ? beyond : within) = middle;
  }
  return sign * beyond;
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template class UnitCircleCrossings<double>;
#endif

}  // namespace holdfast
