#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "holdfast/core/lanes.hpp"
#include "holdfast/core/select.hpp"
#include "holdfast/math/roots/first_root.hpp"
#include "holdfast/math/roots/series.hpp"

namespace holdfast {

/// The coefficients c₀, c₁, … of one polynomial in each SIMD lane; further entries are unused.
template <class Scalar>
using LaneSeries = std::array<Scalar, most_terms>;

/// The first zero in [0, 1] of the polynomial in each SIMD lane, as in `FirstRoot`.
template <class Scalar>
struct FirstRoots {
  Mask<Scalar> found;  ///< whether there is a zero: RootOutcome::crossing or grazing
  Scalar at;           ///< argument x of the zero, 0 ≤ x ≤ 1; 1 if there is no zero
};

namespace detail {

/// The numbers k (k − 1), k < most_terms: the second derivatives of x^k at 1.
constexpr std::array<double, most_terms> curvatures_of_powers() {
  std::array<double, most_terms> result{};
  for (std::size_t k = 1; k < result.size(); ++k)
    result[k] = static_cast<double>(k) * static_cast<double>(k - 1);
  return result;
}

/// The search of first_root() in every lane of a pack.
template <class Scalar>
struct RootSearch {
  LaneSeries<Scalar>& p;
  Mask<Scalar> active = Scalar(0) > Scalar(0), found = active;
  Scalar x = Scalar(0), at = Scalar(1), rounding = Scalar(0), bend = Scalar(0), sag = Scalar(0);

  /// Divides by x until p(0) is not exactly zero; if then p(0) < 0, the root is at x = 0.
  RootSearch(LaneSeries<Scalar>& polynomial, int terms, const Mask<Scalar>& lanes)
      : p(polynomial), active(lanes) {
    divide_out_zeros(terms);
    const Scalar zero(0);
    const Mask<Scalar> below = active & (p[0] < zero);
    found = below;
    at = select(below, zero, at);
    scale(terms);
    active = active & (p[0] > zero);
  }

  /// Takes a step by p(x) and p′(x): accepts the root, or moves over an interval without root.
  void step(const Scalar& value, const Scalar& slope) {
    using std::max;
    using std::min;
    const Scalar zero(0), one(1);
    const Mask<Scalar> down = active & (value <= rounding) & (slope < zero);
    if (any(down)) {
      const Mask<Scalar> touches = slope * slope <= Scalar(32) * bend * rounding;
      const Scalar beyond = select(touches, zero, Scalar(max(value, zero) / -slope));
      at = select(down, Scalar(min(Scalar(x + beyond), one)), at);
      found = found | down;
      active = without<Scalar>(active, down);
      if (!any(active)) return;
    }
    const Scalar way = safe_way(max(value, rounding), slope);
    x = x + way;
    active = active & (x < one);
    // The next value is certainly zero within rounding, and the slope is negative.
    const Mask<Scalar> there = active & (bend * way * way <= Scalar(0.125) * rounding) &
                               (slope * slope > Scalar(64) * bend * rounding) & (slope < zero);
    at = select(there, x, at);
    found = found | there;
    active = without<Scalar>(active, there);
  }

 private:
  /// The distance s > 0 at which height + slope s + sag s²/2 is zero, sag ≤ p″; ∞ if none exists.
  Scalar safe_way(const Scalar& height, const Scalar& slope) const {
    using std::max;
    using std::sqrt;
    const Scalar zero(0), two(2), never(std::numeric_limits<double>::infinity());
    const Scalar square = slope * slope - two * sag * height;
    const Scalar root = sqrt(max(square, zero));
    const Mask<Scalar> rises = slope > zero;
    const Scalar way = select(rises, Scalar(slope + root), Scalar(two * height)) /
                       select(rises, Scalar(-sag), Scalar(root - slope));
    const Mask<Scalar> is_number = (way <= zero) | (way > zero);
    const Mask<Scalar> meets = without<Scalar>((square >= zero) & is_number, rises & (sag >= zero));
    return select(meets, way, never);
  }

  void divide_out_zeros(int terms) {
    const auto last = static_cast<std::size_t>(terms - 1);
    for (int shifts = 1; shifts < terms; ++shifts) {
      const Mask<Scalar> zero = active & (p[0] == Scalar(0));
      if (!any(zero)) return;
      for (std::size_t k = 0; k < last; ++k) p[k] = select(zero, p[k + 1], p[k]);
      p[last] = select(zero, Scalar(0), p[last]);
    }
  }

  /// Scales the polynomial so that squares do not overflow, and computes its bounds.
  void scale(int terms) {
    using std::abs;
    using std::max;
    constexpr auto curvatures = curvatures_of_powers();
    const auto count = static_cast<std::size_t>(terms);
    Scalar sum(0);
    for (std::size_t k = 0; k < count; ++k) {
      const Scalar size = abs(p[k]);
      sum = sum + size;
      bend = bend + Scalar(curvatures[k]) * size;
    }
    const Mask<Scalar> squares_fit = (sum > Scalar(1e-100)) & (sum < Scalar(1e100));
    active = active & (sum < Scalar(std::numeric_limits<double>::infinity()));
    if (any(without<Scalar>(active, squares_fit))) {
      const Scalar factor =
          select(squares_fit, Scalar(1), Scalar(Scalar(1) / max(sum, Scalar(1e-300))));
      for (std::size_t k = 0; k < count; ++k) p[k] = p[k] * factor;
      sum = sum * factor;
      bend = bend * factor;
    }
    if (terms > 2) sag = Scalar(2) * (p[2] + abs(p[2])) - bend;
    rounding = Scalar(4.0 * std::numeric_limits<double>::epsilon()) * sum;
  }
};

/// Runs the scalar search in one lane, for a polynomial that needs many steps.
template <class Scalar>
void search_alone(RootSearch<Scalar>& search, int terms, std::size_t lane) {
  typename Lanes<Scalar>::Value at[Lanes<Scalar>::count], found[Lanes<Scalar>::count];
  Series series(terms);
  for (Eigen::Index k = 0; k < terms; ++k)
    series[k] = lane_of(search.p[static_cast<std::size_t>(k)], lane);
  const FirstRoot root = first_root_of_positive(series);
  Lanes<Scalar>::store(search.at, at);
  Lanes<Scalar>::store(select(search.found, Scalar(1), Scalar(0)), found);
  at[lane] = root.at;
  found[lane] = root.outcome == RootOutcome::none ? 0.0 : 1.0;
  search.at = Lanes<Scalar>::load(at);
  search.found = Lanes<Scalar>::load(found) > Scalar(0.5);
}

/// Takes one step in every search; p(x) and p′(x) are computed in parallel to hide latency.
template <class Scalar, std::size_t Count>
void step_all(std::array<RootSearch<Scalar>, Count>& searches, int terms) {
  std::array<Scalar, Count> value, slope;
  for (std::size_t g = 0; g < Count; ++g) {
    value[g] = searches[g].p[static_cast<std::size_t>(terms - 1)];
    slope[g] = Scalar(0);
  }
  for (auto k = static_cast<std::size_t>(terms - 1); k-- > 0;) {
    for (std::size_t g = 0; g < Count; ++g) {
      slope[g] = slope[g] * searches[g].x + value[g];
      value[g] = value[g] * searches[g].x + searches[g].p[k];
    }
  }
  for (std::size_t g = 0; g < Count; ++g) searches[g].step(value[g], slope[g]);
}

template <class Scalar, std::size_t Count>
void search_all(std::array<RootSearch<Scalar>, Count>& searches, int terms) {
  constexpr int patience = 16;
  const auto left = [&] {
    Mask<Scalar> some = searches[0].active;
    for (std::size_t g = 1; g < Count; ++g) some = some | searches[g].active;
    return some;
  };
  // At x = 0 value and slope are the first two coefficients.
  for (RootSearch<Scalar>& search : searches)
    search.step(search.p[0], terms > 1 ? search.p[1] : Scalar(0));
  for (int evaluations = 1; evaluations < patience && any(left()); ++evaluations)
    step_all(searches, terms);
  for (RootSearch<Scalar>& search : searches) {
    if (!any(search.active)) continue;
    std::uint8_t open[Lanes<Scalar>::count];
    Lanes<Scalar>::store_flags(search.active, open);
    for (std::size_t lane = 0; lane < Lanes<Scalar>::count; ++lane)
      if (open[lane] != 0) search_alone(search, terms, lane);
  }
}

}  // namespace detail

/// The first roots in [0, 1] of one or two polynomials in every SIMD lane, by the method of
/// first_root(). All lanes step together; a lane that needs more than 16 steps continues alone.
///
/// Work: 2 `terms` multiply-adds for each step and polynomial. If any lane has a root, there are
/// about five steps; otherwise the first two coefficients mostly suffice to exclude a root.
/// @param polynomials  `Count` polynomials in every lane, Count = 1 or 2; they are overwritten
/// @param terms        number of terms of every polynomial, 1 … `most_terms`
/// @param lanes        masks of the lanes that take part, for each polynomial; others find no root
template <class Scalar, std::size_t Count>
std::array<FirstRoots<Scalar>, Count> first_roots(
    std::array<LaneSeries<Scalar>, Count>& polynomials, int terms,
    const std::array<Mask<Scalar>, Count>& lanes) {
  using Search = detail::RootSearch<Scalar>;
  if constexpr (Count == 1) {
    std::array<Search, 1> searches{Search(polynomials[0], terms, lanes[0])};
    detail::search_all(searches, terms);
    return {{{searches[0].found, searches[0].at}}};
  } else {
    static_assert(Count == 2, "first_roots() searches one or two polynomials per lane");
    std::array<Search, 2> searches{Search(polynomials[0], terms, lanes[0]),
                                   Search(polynomials[1], terms, lanes[1])};
    detail::search_all(searches, terms);
    return {{{searches[0].found, searches[0].at}, {searches[1].found, searches[1].at}}};
  }
}

}  // namespace holdfast
