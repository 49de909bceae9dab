#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "holdfast/core/types.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/orbit/itinerary_maps.hpp"
#include "holdfast/orbit/periodic_orbit.hpp"
#include "holdfast/orbit/switching_borders.hpp"

namespace holdfast {

/// A neighbourhood of one point of an orbit: every motion in it, at the same phase of the forcing,
/// follows the orbit's itinerary for ever and tends to the orbit.
///
/// Deviations are measured by
///
///     ‖e‖² = e_z₁² + (e_ż₁/ω)² + e_z₂² + (e_ż₂/ω)² + (e_u/k₁)² + e_gap²   (m²),
///
/// with ω that of the excitation (that of the conductor without one) and e_gap the deviation of the
/// gap that the drive is in. The drive must be inside or outside as on the orbit, and Δż of the
/// last sample of the same sign. An orbit that stays in the gap for ever does so in every gap that
/// holds it: there the radius counts for a metre of clearance between the orbit and the gap's ends.
struct AttractionBall {
  std::int64_t sample;            ///< on the orbit, a multiple of the forcing's q
  Vector<double, 5> state;        ///< z̃ = [z; u_{j−1}] there
  BacklashMemory<double> memory;  ///< of the drive before that sample
  bool stays_inside;              ///< the drive never leaves its gap
  double lowest,                  ///< least Δz of the orbit (m)
      highest;                    ///< largest Δz of the orbit (m)
  double radius;                  ///< m, or m a metre of clearance; > 0
};

namespace detail {

/// The number type of a loop such as IdealLoop.
template <class Loop>
using ScalarOf = std::decay_t<decltype(std::declval<const Loop&>().sampling.period)>;

}  // namespace detail

/// The weights by which deviations of an orbit are measured.
///
///     DeviationScale(loop).weights();
///
/// @tparam Loop  IdealLoop, or a loop with its members
template <class Loop>
struct DeviationScale {
  using Scalar = detail::ScalarOf<Loop>;  ///< the number type of the loop

  Scalar angular_frequency;  ///< ω (rad/s)
  Scalar stiffness;          ///< k₁ (N/m)

  /// ω is √(k₁/m₁) where the excitation has no amplitude.
  explicit DeviationScale(const Loop& loop)
      : angular_frequency(
            loop.excitation.amplitude > 0.0
                ? loop.excitation.angular_frequency()
                : std::sqrt(loop.plant.conductor_stiffness / loop.plant.conductor_mass)),
        stiffness(loop.plant.conductor_stiffness) {}

  /// Each in metres.
  Vector<Scalar, 6> weights() const {
    return {1.0, 1.0 / angular_frequency, 1.0, 1.0 / angular_frequency, 1.0 / stiffness, 1.0};
  }
};

namespace detail {

/// The deviation by DeviationScale; infinite where contact or direction of the drive differ.
template <class Memory>
double deviation_from(const AttractionBall& point, const Memory& motion,
                      const Vector<double, 6>& weights) {
  const BacklashMemory<double>& drive = motion.backlash;
  const bool same_direction = drive.previous_velocity * point.memory.previous_velocity > 0.0;
  const bool same_side = drive.inside == point.memory.inside && (drive.inside || same_direction);
  if (!same_side) return std::numeric_limits<double>::infinity();
  const bool gap_counts = drive.inside && !point.stays_inside;
  Vector<double, 6> deviation;
  deviation << motion.state - point.state.head<4>(), motion.previous_force - point.state[4],
      gap_counts ? drive.lower - point.memory.lower : 0.0;
  return deviation.cwiseProduct(weights).norm();
}

}  // namespace detail

/// The radius of the neighbourhood for a drive that remembers this (m); not positive where its gap
/// does not hold an orbit that stays inside.
inline double attraction_radius(const AttractionBall& point, const BacklashMemory<double>& drive) {
  if (!point.stays_inside) return point.radius;
  return point.radius * std::min(point.lowest - drive.lower, drive.upper - point.highest);
}

/// Whether a motion at a stroboscopic instant (sampling and forcing in phase) lies in a point's
/// neighbourhood.
/// @param point    the neighbourhood, at the same phase of the forcing
/// @param motion   its memory(), before the sample
/// @param weights  DeviationScale::weights()
template <class Memory>
bool attracts(const AttractionBall& point, const Memory& motion, const Vector<double, 6>& weights) {
  return detail::deviation_from(point, motion, weights) < attraction_radius(point, motion.backlash);
}

namespace detail {

/// What becomes of a deviation over some samples: the largest first deviation for which no decision
/// changes within them, and by how much it may have grown at their end.
struct DeviationSegment {
  double radius = std::numeric_limits<double>::infinity();  // m
  double growth = 1.0;                                      // Frobenius norm
};

/// Follows deviations e = [e_z; e_u; e_gap], scaled to metres, along an orbit.
template <class Scalar>
class DeviationFlow {
 public:
  template <class Loop>
  DeviationFlow(const Loop& loop, const ItineraryMaps<Scalar>& maps, const PeriodicOrbit& orbit)
      : orbit_(orbit),
        weights_(DeviationScale(loop).weights()),
        pattern_(
            switching_pattern(orbit.states, Backlash<Scalar>(loop.backlash_width, orbit.memory))),
        lower_(pattern_.memory.lower),
        width_(loop.backlash_width),
        stays_inside_(pattern_.stays_inside()) {
    for (const bool engaged : {false, true}) {
      Matrix<Scalar, 6>& map = maps_[engaged ? 1 : 0];
      map.setZero();
      map.template topLeftCorner<5, 5>() = maps.map(engaged);
      map = weights_.asDiagonal() * map * weights_.cwiseInverse().asDiagonal();
    }
  }

  /// The segment of the next `samples` samples.
  DeviationSegment next(std::int64_t samples) {
    DeviationSegment segment;
    Matrix<Scalar, 6> flow = Matrix<Scalar, 6>::Identity();
    for (std::int64_t k = 0; k < samples; ++k) {
      take_sample(flow, segment);
      if (++sample_ == orbit_.states.size()) sample_ = 0;
    }
    segment.growth = flow.norm();
    return segment;
  }

 private:
  /// Δz and Δż of a deviation as rows for scaled ones.
  RowVector<Scalar, 6> relative(int first) const {
    RowVector<Scalar, 6> row = RowVector<Scalar, 6>::Zero();
    row[first] = -1.0 / weights_[first];
    row[first + 2] = 1.0 / weights_[first + 2];
    return row;
  }

  void take_sample(Matrix<Scalar, 6>& flow, DeviationSegment& segment) {
    const ContactDecision& decision = pattern_.decisions[sample_];
    const Vector<Scalar, 5>& state = orbit_.states[sample_];
    const auto limit = [&](const RowVector<Scalar, 6>& row, double distance) {
      segment.radius = std::min(segment.radius, distance / (row * flow).norm());
    };
    if (decision.velocity_sign != 0) limit(relative(1), std::abs(relative_velocity(state)));
    const RowVector<Scalar, 6> displacement = relative(0);
    if (decision.was_inside) limit(from_gap(displacement), distance_to_end(decision, state));
    const bool enters = !decision.was_inside && !decision.engaged;
    if (enters) enter(state);
    Matrix<Scalar, 6> map = maps_[decision.engaged ? 1 : 0];
    if (enters) map.row(5) = displacement;
    if (decision.was_inside && !decision.engaged && !stays_inside_) map(5, 5) = 1.0;
    flow = map * flow;
  }

  RowVector<Scalar, 6> from_gap(RowVector<Scalar, 6> displacement) const {
    displacement[5] = stays_inside_ ? 0.0 : -1.0;
    return displacement;
  }

  double distance_to_end(const ContactDecision& decision, const Vector<Scalar, 5>& state) const {
    if (stays_inside_) return 1.0;
    const double above = relative_displacement(state) - lower_;
    if (decision.exit_side < 0) return -above;
    if (decision.exit_side > 0) return above - width_;
    return std::min(above, width_ - above);
  }

  void enter(const Vector<Scalar, 5>& state) {
    const std::size_t before = (sample_ + orbit_.states.size() - 1) % orbit_.states.size();
    const bool from_positive = pattern_.decisions[before].velocity_sign > 0;
    lower_ = relative_displacement(state) - (from_positive ? width_ : 0.0);
  }

  const PeriodicOrbit& orbit_;
  Vector<Scalar, 6> weights_;
  SwitchingPattern pattern_;
  double lower_;
  double width_;
  bool stays_inside_;
  std::array<Matrix<Scalar, 6>, 2> maps_;
  std::size_t sample_ = 0;
};

/// Radii at the starts of the segments of one period, or nothing where there are surfaces and the
/// segments together do not contract. A deviation within a segment's radius stays within the next
/// one's.
inline std::vector<double> attraction_radii(const std::vector<DeviationSegment>& segments) {
  constexpr double everywhere = std::numeric_limits<double>::infinity();
  double logarithm = 0.0, smallest = everywhere;
  for (const DeviationSegment& segment : segments) {
    logarithm += std::log(segment.growth);
    smallest = std::min(smallest, segment.radius);
  }
  std::vector<double> radii(segments.size(), everywhere);
  if (smallest == everywhere) return radii;
  if (!(logarithm < 0.0)) return {};
  double following = everywhere;
  // The second turn knows what the first segment allows the last one to leave.
  for (int turn = 0; turn < 2; ++turn) {
    for (std::size_t k = segments.size(); k-- > 0;) {
      following = std::min(segments[k].radius, following / segments[k].growth);
      radii[k] = following;
    }
  }
  return radii;
}

/// The segments of one period, each of `length` common periods but perhaps a shorter last one; or
/// one segment of several whole periods.
template <class Loop, class Scalar>
std::vector<DeviationSegment> deviation_segments(const Loop& loop,
                                                 const ItineraryMaps<Scalar>& maps,
                                                 const PeriodicOrbit& orbit, std::int64_t length) {
  const std::int64_t step = orbit.ratio.denominator;
  const std::int64_t whole = std::max(orbit.period_samples() / step, length);
  DeviationFlow<Scalar> flow(loop, maps, orbit);
  std::vector<DeviationSegment> segments;
  for (std::int64_t done = 0; done < whole; done += length)
    segments.push_back(flow.next(step * std::min(length, whole - done)));
  return segments;
}

template <class Loop>
std::vector<AttractionBall> points_with_radii(const Loop& loop, const PeriodicOrbit& orbit,
                                              std::int64_t samples_of_segment,
                                              const std::vector<double>& radii) {
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (const auto& state : orbit.states) {
    lowest = std::min(lowest, relative_displacement(state));
    highest = std::max(highest, relative_displacement(state));
  }
  const bool stays_inside = orbit.memory.inside && orbit.engaged_fraction() == 0.0;
  std::vector<AttractionBall> points;
  Backlash<ScalarOf<Loop>> law(loop.backlash_width, orbit.memory);
  for (std::int64_t j = 0; j < orbit.period_samples(); ++j) {
    const auto& state = orbit.states[static_cast<std::size_t>(j)];
    if (j % samples_of_segment == 0) {
      const double radius = radii[static_cast<std::size_t>(j / samples_of_segment)];
      if (radius > 0.0)
        points.push_back({j, state, law.memory(), stays_inside, lowest, highest, radius});
    }
    law.step(relative_displacement(state), relative_velocity(state));
  }
  return points;
}

}  // namespace detail

/// Neighbourhoods of an orbit from which every motion tends to it, at the stroboscopic instants,
/// sampling and forcing in phase.
///
/// The period is cut into segments of one common period, or of twice as many until the segments
/// together contract. Along each, a deviation changes no decision while |h Φ e| stays below the
/// distance from the surface, h being the surface's normal and Φ the flow of deviations; at its end
/// it has grown by at most ‖Φ‖. Both bounds together are an induction over all time.
/// @param loop   the loop that the orbit is of
/// @param orbit  attracting and certified
/// @return in the order of the orbit; empty where no segments of up to 64 periods, or 10⁶ samples,
///         contract
/// Work: about 300 multiply-adds a sample for every length of segment that is tried.
/// @tparam Loop  IdealLoop<double>; a template so that only who calls it compiles it
template <class Loop>
std::vector<AttractionBall> attraction_balls(const Loop& loop, const PeriodicOrbit& orbit) {
  const ItineraryMaps<detail::ScalarOf<Loop>> maps(loop, orbit.ratio);
  const std::int64_t step = orbit.ratio.denominator;
  const std::int64_t common_periods = orbit.period_samples() / step;
  // Segments of more than one period hold whole ones, to begin where they are used again.
  std::int64_t length = 1;
  const std::int64_t longest = std::max(64 * common_periods, 1'000'000 / step);
  while (length <= longest) {
    const auto segments = detail::deviation_segments(loop, maps, orbit, length);
    const std::vector<double> radii = detail::attraction_radii(segments);
    if (!radii.empty()) return detail::points_with_radii(loop, orbit, step * length, radii);
    length = length < common_periods ? std::min(2 * length, common_periods) : 2 * length;
  }
  return {};
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template std::vector<AttractionBall> attraction_balls(const IdealLoop<double>&,
                                                             const PeriodicOrbit&);
#endif

}  // namespace holdfast
