#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "holdfast/core/errors.hpp"

namespace holdfast {

/// How a straight line is laid through the force-displacement relationship of the cable (Eq. 2).
enum class StiffnessReading {
  tangent,        ///< slope at the equilibrium with the absorber's weight
  secant,         ///< (F(below) − F(−above)) / (below + above)
  least_squares,  ///< slope of the line nearest to F(w) over −above … below
};

/// Displacements (m) from the equilibrium with the absorber's weight over which k₁ is read.
struct ReadingRange {
  double below;  ///< downward, ≥ 0
  double above;  ///< upward, ≥ 0
};

/// k₁ = ΔP/Δw (N/m), Eq. (2), read from the statics at the absorber's place.
///
/// The least-squares line need not pass through the equilibrium; its integrals are taken over the
/// whole range, not over chosen points.
/// @throws InvalidParameter, but for the tangent, which needs no range, for a negative or empty
/// range and where it reaches beyond what the statics are valid for
template <class Statics>
double conductor_stiffness(const Statics& statics, StiffnessReading reading,
                           const ReadingRange& range);

// ---------------------------------------------------------------------------------------------

namespace detail {

/// Slope of the straight line nearest to F(w) over `middle` ± `half`: ∫ (w − w̄) F dw/∫ (w − w̄)² dw
/// by 16-point Gauss–Legendre, whose nodes lie in pairs about the middle.
template <class Statics>
double least_squares_slope(const Statics& statics, double middle, double half) {
  static constexpr std::array<double, 8> nodes{
      0.0950125098376374, 0.2816035507792589, 0.4580167776572274, 0.6178762444026438,
      0.7554044083550030, 0.8656312023878318, 0.9445750230732326, 0.9894009349916499};
  static constexpr std::array<double, 8> weights{
      0.1894506104550685, 0.1826034150449236, 0.1691565193950025, 0.1495959888165767,
      0.1246289712555339, 0.0951585116824928, 0.0622535239386479, 0.0271524594117541};
  double moment = 0.0;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const double offset = half * nodes[k];
    moment +=
        weights[k] * nodes[k] * (statics.force(middle + offset) - statics.force(middle - offset));
  }
  return 1.5 * moment / half;
}

}  // namespace detail

template <class Statics>
double conductor_stiffness(const Statics& statics, StiffnessReading reading,
                           const ReadingRange& range) {
  if (reading == StiffnessReading::tangent) return statics.stiffness(0.0);
  require_non_negative("reading range below", range.below, "m");
  require_non_negative("reading range above", range.above, "m");
  require_positive("width of the reading range", range.below + range.above, "m");
  const double width = range.below + range.above;
  if (reading == StiffnessReading::secant)
    return (statics.force(range.below) - statics.force(-range.above)) / width;
  return detail::least_squares_slope(statics, 0.5 * (range.below - range.above), 0.5 * width);
}

}  // namespace holdfast
