#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/math/linalg/multipliers.hpp"
#include "holdfast/math/roots/bracketing_root.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/orbit/itinerary_maps.hpp"
#include "holdfast/orbit/periodic_orbit.hpp"
#include "holdfast/orbit/switching_borders.hpp"

namespace holdfast {

/// The cause that ends the continuation of an orbit along a parameter.
enum class BranchEndOutcome {
  border_collision,  ///< Δz or Δż at a sample reaches a switching surface (SwitchingSurface)
  unit_circle,       ///< a multiplier reaches modulus 1
  range_end,         ///< no end: the orbit exists and attracts up to the end of the range
};

/// The value of a parameter at which an orbit ends, and the cause of the end.
struct BranchEnd {
  BranchEndOutcome outcome = BranchEndOutcome::range_end;  ///< cause of the end
  double parameter = 0.0;                                  ///< value of the parameter at the end
  Border border;  ///< surface and sample of a border collision; unused for other outcomes
  /// Multiplier of largest modulus at the end. For `unit_circle` its angle is 0 at a fold, π at a
  /// flip (period doubling), and another angle for a complex pair.
  Multiplier multiplier{};
  int solutions = 0;  ///< number of parameter values at which the orbit was computed
};

namespace detail {

/// The solution for an orbit at one parameter value, with its margins: least distances from the
/// switching surfaces, as shares of the orbit's size, and −ln |λ| of the largest multiplier λ. All
/// margins are positive while the orbit exists and attracts, and −1 without a solution.
struct BranchPoint {
  Borders borders;
  Multiplier multiplier{};
  double by_displacement = -1.0, by_velocity = -1.0, by_multiplier = -1.0;

  double margin() const { return std::min({by_displacement, by_velocity, by_multiplier}); }

  BranchEnd end(double parameter) const {
    BranchEnd end{BranchEndOutcome::unit_circle, parameter, {}, multiplier, 0};
    if (by_multiplier == margin()) return end;
    end.outcome = BranchEndOutcome::border_collision;
    end.border = by_displacement < by_velocity ? borders.displacement : borders.velocity;
    return end;
  }
};

/// The continuation of an orbit with a fixed itinerary over loops that depend on parameters.
template <class Family>
class OrbitContinuation {
 public:
  OrbitContinuation(const Family& family, const PeriodicOrbit& orbit, double width)
      : family_(family),
        orbit_(orbit),
        has_backlash_(width > 0.0),
        pattern_(switching_pattern(orbit.states, Backlash<double>(width, orbit.memory))),
        extent_(orbit.states) {}

  template <class... Parameters>
  BranchPoint at(Parameters... parameters) {
    ++solutions_;
    const IdealLoop<double> loop = family_(parameters...);
    require_same_rule(loop);
    const ItineraryMaps<double> maps(loop, orbit_.ratio);
    const auto blocks = maps_of_blocks(maps, orbit_.itinerary);
    const auto solution = periodic_solution(maps, orbit_.itinerary, blocks);
    BranchPoint point;
    if (!solution) return point;
    point.borders = pattern_.stays_inside()
                        ? borders_in_best_gap(solution->states, loop.backlash_width)
                        : borders_of(pattern_, solution->states, loop.backlash_width);
    point.multiplier = multipliers_of_product(blocks).front();
    point.by_displacement = point.borders.displacement.distance / extent_.displacement;
    point.by_velocity = point.borders.velocity.distance / extent_.velocity;
    point.by_multiplier = -point.multiplier.log_modulus;
    return point;
  }

  int solutions() const { return solutions_; }

 private:
  /// The borders of an orbit that stays in its gap, for the gap position with the most clearance:
  /// such an orbit exists in every gap that contains it.
  static Borders borders_in_best_gap(const std::vector<Vector<double, 5>>& states, double width) {
    const auto less = [](const auto& a, const auto& b) {
      return relative_displacement(a) < relative_displacement(b);
    };
    const auto lowest = std::min_element(states.begin(), states.end(), less);
    const auto highest = std::max_element(states.begin(), states.end(), less);
    const double reach = relative_displacement(*highest) - relative_displacement(*lowest);
    return {{(width - reach) / 2.0, SwitchingSurface::gap_upper, highest - states.begin()}, {}};
  }

  void require_same_rule(const IdealLoop<double>& loop) const {
    const double given = loop.excitation.frequency * loop.sampling.period;
    const double kept =
        static_cast<double>(orbit_.ratio.numerator) / static_cast<double>(orbit_.ratio.denominator);
    if (loop.excitation.amplitude > 0.0 && !(std::abs(given - kept) <= 1e-9 * kept))
      throw InvalidParameter("frequency times sampling period (f tau)", given, "",
                             "equal to f tau of the orbit");
    if (has_backlash_ != (loop.backlash_width > 0.0))
      throw InvalidParameter("backlash width", loop.backlash_width, "m",
                             has_backlash_ ? "> 0, like the orbit's backlash width"
                                           : "0, like the orbit's backlash width");
  }

  const Family& family_;
  const PeriodicOrbit& orbit_;
  bool has_backlash_;
  SwitchingPattern pattern_;
  StateScale extent_;
  int solutions_ = 0;
};

}  // namespace detail

/// Continues an orbit with a fixed itinerary along one parameter until the orbit ends.
///
/// The orbit is recomputed at equidistant values. It ends where a sample reaches a switching
/// surface or a multiplier reaches the unit circle. Bracketing locates the first end to rounding.
/// An end is missed if the orbit reappears within the same step.
///
///     const auto family = [&](double gain) { auto other = loop; other.gains.differential = gain;
///                                          return other; };
///     const BranchEnd end = continue_orbit(family, orbit, loop.gains.differential, -30.0);
///
/// @param family  function: parameter ↦ IdealLoop<double>; f τ, the orbit's `ratio`, is constant
/// @param orbit   certified orbit of the loop family(from)
/// @param from,to  first and last value of the parameter, finite; `to` may be below `from`
/// @param steps   number of steps, 1 … 10⁶
/// @throws InvalidParameter where an argument is out of its range, f τ changes, or the backlash
/// width becomes zero or nonzero along the path
template <class Family>
BranchEnd continue_orbit(const Family& family, const PeriodicOrbit& orbit, double from, double to,
                         int steps = 64) {
  require_finite("start of the path", from, "");
  require_finite("end of the path", to, "");
  require_within("number of steps", steps, "", 1.0, 1e6);
  detail::OrbitContinuation<Family> continuation(family, orbit, family(from).backlash_width);
  const auto margin = [&](double value) { return continuation.at(value).margin(); };
  BranchEnd end;
  end.parameter = to;
  double last = from;
  for (int k = 1; k <= steps; ++k) {
    const double next = k == steps ? to : from + (to - from) * k / steps;
    if (margin(next) > 0.0) {
      last = next;
      continue;
    }
    const SignChange<double> bracket{std::min(last, next), std::max(last, next),
                                     last < next ? 1.0 : -1.0, last < next ? -1.0 : 1.0};
    const double tolerance =
        4.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(last), std::abs(next));
    const auto found = bracketing_root(margin, bracket, tolerance);
    const double position = last < next ? found.upper : found.lower;
    end = continuation.at(position).end(position);
    end.solutions = continuation.solutions();
    return end;
  }
  end.multiplier = continuation.at(to).multiplier;
  end.solutions = continuation.solutions();
  return end;
}

}  // namespace holdfast
