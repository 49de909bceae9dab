#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/math/linalg/multipliers.hpp"
#include "holdfast/math/roots/bracketing_root.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/orbit/itinerary_maps.hpp"
#include "holdfast/orbit/periodic_orbit.hpp"
#include "holdfast/orbit/switching_borders.hpp"

namespace holdfast {

/// Why an orbit cannot be followed any further along a parameter.
enum class BranchEndOutcome {
  border_collision,  ///< a sample comes to lie on a switching surface: its decision would change
  unit_circle,       ///< a multiplier reaches modulus 1
  range_end,         ///< neither: the orbit is there, attracting, at the end of the range
};

/// Where and why an orbit ends.
struct BranchEnd {
  BranchEndOutcome outcome = BranchEndOutcome::range_end;  ///< why it is not followed any further
  double parameter = 0.0;                                  ///< its value at the end
  Border border;            ///< of a border collision: which surface at which sample of the orbit
  Multiplier multiplier{};  ///< the largest there; of `unit_circle`, angle 0: fold, π: flip, else a
                            ///< pair
  int solutions = 0;  ///< how often the sequence was solved
};

namespace detail {

/// An orbit's sequence of contacts solved at one value of a parameter: all that may end it, each
/// positive while the orbit lasts.
struct BranchPoint {
  bool solved = false;
  Borders borders;
  Multiplier multiplier{};
};

/// Continues an orbit along a family of loops by its itinerary.
template <class Family>
class OrbitContinuation {
 public:
  OrbitContinuation(const Family& family, const PeriodicOrbit& orbit, double width)
      : family_(family),
        orbit_(orbit),
        has_backlash_(width > 0.0),
        pattern_(switching_pattern(orbit.states, Backlash<double>(width, orbit.memory))),
        extent_(orbit.states) {}

  BranchPoint at(double parameter) {
    ++solutions_;
    const IdealLoop<double> loop = family_(parameter);
    require_ratio(loop);
    if (has_backlash_ != (loop.backlash_width > 0.0))
      throw InvalidParameter("backlash width along the path", loop.backlash_width, "m",
                             has_backlash_ ? "> 0: without backlash the rule is another one"
                                           : "0, as it is at the orbit");
    const ItineraryMaps<double> maps(loop, orbit_.ratio);
    const auto blocks = affine_blocks(maps, orbit_.itinerary);
    const auto solution = periodic_solution(maps, orbit_.itinerary, blocks);
    BranchPoint point;
    point.solved = solution.has_value();
    if (!point.solved) return point;
    point.borders = pattern_.stays_inside()
                        ? borders_in_best_gap(solution->states, loop.backlash_width)
                        : borders_of(pattern_, solution->states, loop.backlash_width);
    point.multiplier = multipliers_of_product(maps_of(blocks)).front();
    return point;
  }

  /// The smallest of the distances, each as a share of the orbit's own size; negative past the end.
  double margin(const BranchPoint& point) const {
    if (!point.solved) return -1.0;
    return std::min({point.borders.displacement.distance / extent_.displacement,
                     point.borders.velocity.distance / extent_.velocity,
                     -point.multiplier.log_modulus});
  }

  BranchEnd end(double parameter, const BranchPoint& point) const {
    BranchEnd result;
    result.parameter = parameter;
    result.multiplier = point.multiplier;
    result.solutions = solutions_;
    const double by_displacement = point.borders.displacement.distance / extent_.displacement;
    const double by_velocity = point.borders.velocity.distance / extent_.velocity;
    const bool by_multiplier =
        !point.solved || -point.multiplier.log_modulus <= std::min(by_displacement, by_velocity);
    result.outcome =
        by_multiplier ? BranchEndOutcome::unit_circle : BranchEndOutcome::border_collision;
    if (!by_multiplier)
      result.border =
          by_displacement < by_velocity ? point.borders.displacement : point.borders.velocity;
    return result;
  }

  int solutions() const { return solutions_; }

 private:
  /// Of an orbit that stays in the gap: it is there in every gap that holds it, so the one counts
  /// that holds it best.
  static Borders borders_in_best_gap(const std::vector<Vector<double, 5>>& states, double width) {
    std::size_t lowest = 0, highest = 0;
    const auto at = [&](std::size_t j) { return relative_displacement(states[j]); };
    for (std::size_t j = 1; j < states.size(); ++j) {
      if (at(j) < at(lowest)) lowest = j;
      if (at(j) > at(highest)) highest = j;
    }
    const double clearance = (width - (at(highest) - at(lowest))) / 2.0;
    return {{clearance, SwitchingSurface::gap_upper, static_cast<std::int64_t>(highest)}, {}};
  }

  void require_ratio(const IdealLoop<double>& loop) const {
    const double given = loop.excitation.frequency * loop.sampling.period;
    const double kept =
        static_cast<double>(orbit_.ratio.numerator) / static_cast<double>(orbit_.ratio.denominator);
    if (loop.excitation.amplitude > 0.0 && !(std::abs(given - kept) <= 1e-9 * kept))
      throw InvalidParameter("f tau along the path", given, "", "that of the orbit");
  }

  const Family& family_;
  const PeriodicOrbit& orbit_;
  bool has_backlash_;
  SwitchingPattern pattern_;
  StateScale extent_;
  int solutions_ = 0;
};

}  // namespace detail

/// Continues an orbit along one parameter by its itinerary, to where it ends.
///
/// At each value the sequence is solved again; the orbit lasts while every sample keeps its side of
/// the switching surface and every multiplier stays inside the unit circle. The first step at whose
/// end it does not is narrowed to the rounding of the parameter. An end that comes and goes within
/// one step is not seen.
///
///     const auto family = [&](double gain) { auto other = loop; other.gains.differential = gain;
///                                          return other; };
///     const BranchEnd end = continue_orbit(family, orbit, loop.gains.differential, -30.0);
///
/// @param family  parameter ↦ IdealLoop<double>, with the same f τ everywhere; path(from) is the
///                loop of the orbit
/// @param orbit   certified
/// @param from,to  finite; `to` may lie on either side
/// @param steps   ≥ 1
/// @throws InvalidParameter where the range is not finite, f τ is another one, or the backlash
///         vanishes or appears along the path: without it the rule is another one
template <class Family>
BranchEnd continue_orbit(const Family& family, const PeriodicOrbit& orbit, double from, double to,
                         int steps = 64) {
  require_finite("start of the path", from, "");
  require_finite("end of the path", to, "");
  require_within("number of steps", steps, "", 1.0, 1e6);
  detail::OrbitContinuation<Family> continuation(family, orbit, family(from).backlash_width);
  double last = from;
  for (int k = 1; k <= steps; ++k) {
    const double next = k == steps ? to : from + (to - from) * k / steps;
    const detail::BranchPoint point = continuation.at(next);
    if (continuation.margin(point) > 0.0) {
      last = next;
      continue;
    }
    const auto margin = [&continuation](double value) {
      return continuation.margin(continuation.at(value));
    };
    const SignChange<double> bracket{std::min(last, next), std::max(last, next),
                                     last < next ? 1.0 : -1.0, last < next ? -1.0 : 1.0};
    const double tolerance =
        4.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(last), std::abs(next));
    const auto found = bracketing_root(margin, bracket, tolerance);
    const double position = last < next ? found.upper : found.lower;
    return continuation.end(position, continuation.at(position));
  }
  BranchEnd end;
  end.parameter = to;
  end.multiplier = continuation.at(to).multiplier;
  end.solutions = continuation.solutions();
  return end;
}

}  // namespace holdfast
