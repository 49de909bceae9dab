#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
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

/// The weights by which deviations of an orbit are measured, [1, 1/ω, 1, 1/ω, 1/k₁, 1], each in
/// metres; ω is √(k₁/m₁) where the excitation has no amplitude.
template <class Scalar>
Vector<Scalar, 6> deviation_weights(const IdealLoop<Scalar>& loop) {
  const Scalar stiffness = loop.plant.conductor_stiffness;
  const Scalar angular_frequency = loop.excitation.amplitude > 0.0
                                       ? loop.excitation.angular_frequency()
                                       : std::sqrt(stiffness / loop.plant.conductor_mass);
  return {1.0, 1.0 / angular_frequency, 1.0, 1.0 / angular_frequency, 1.0 / stiffness, 1.0};
}

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
/// @param weights  deviation_weights()
template <class Memory>
bool attracts(const AttractionBall& point, const Memory& motion, const Vector<double, 6>& weights) {
  const BacklashMemory<double>& drive = motion.backlash;
  const bool same_direction = drive.previous_velocity * point.memory.previous_velocity > 0.0;
  if (drive.inside != point.memory.inside || !(drive.inside || same_direction)) return false;
  const bool gap_counts = drive.inside && !point.stays_inside;
  Vector<double, 6> deviation;
  deviation << motion.state - point.state.head<4>(), motion.previous_force - point.state[4],
      gap_counts ? drive.lower - point.memory.lower : 0.0;
  return deviation.cwiseProduct(weights).norm() < attraction_radius(point, drive);
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
  DeviationFlow(const IdealLoop<Scalar>& loop, const ItineraryMaps<Scalar>& maps,
                const PeriodicOrbit& orbit)
      : pattern_(
            switching_pattern(orbit.states, Backlash<Scalar>(loop.backlash_width, orbit.memory))),
        stays_inside_(pattern_.stays_inside()),
        distances_(orbit.states.size()) {
    const Vector<Scalar, 6> weights = deviation_weights(loop);
    for (const bool engaged : {false, true}) {
      Matrix<Scalar, 6>& map = maps_[engaged ? 1 : 0];
      map.setZero();
      map.template topLeftCorner<5, 5>() = maps.map(engaged);
      map = weights.asDiagonal() * map * weights.cwiseInverse().asDiagonal();
    }
    relative_ = {Row::Unit(2) / weights[2] - Row::Unit(0) / weights[0],
                 Row::Unit(3) / weights[3] - Row::Unit(1) / weights[1]};
    for_each_border(pattern_, orbit.states, loop.backlash_width,
                    [this](std::size_t j, SwitchingSurface surface, double distance) {
                      Distances& here = distances_[j];
                      const bool reverses = surface == SwitchingSurface::reversal;
                      double& least = reverses ? here.velocity : here.displacement;
                      least = std::min(least, stays_inside_ ? 1.0 : distance);
                    });
  }

  /// The segment of the next `samples` samples.
  DeviationSegment next(std::int64_t samples) {
    DeviationSegment segment;
    segment.growth = follow(samples, segment).norm();
    return segment;
  }

  /// Φ over the next `samples` samples.
  Matrix<Scalar, 6> over(std::int64_t samples) {
    DeviationSegment segment;
    return follow(samples, segment);
  }

 private:
  using Row = RowVector<Scalar, 6>;

  /// Of a sample from the surfaces that its decision rests on (m, m/s); of an orbit that stays
  /// inside 1, for a metre of clearance.
  struct Distances {
    double displacement = std::numeric_limits<double>::infinity();
    double velocity = std::numeric_limits<double>::infinity();
  };

  Matrix<Scalar, 6> follow(std::int64_t samples, DeviationSegment& segment) {
    Matrix<Scalar, 6> flow = Matrix<Scalar, 6>::Identity();
    for (std::int64_t k = 0; k < samples; ++k) {
      take_sample(flow, segment);
      if (++sample_ == distances_.size()) sample_ = 0;
    }
    return flow;
  }

  void take_sample(Matrix<Scalar, 6>& flow, DeviationSegment& segment) {
    const ContactDecision& decision = pattern_.decisions[sample_];
    const auto limit = [&](const Row& row, double distance) {
      segment.radius = std::min(segment.radius, distance / (row * flow).norm());
    };
    if (decision.velocity_sign != 0) limit(relative_[1], distances_[sample_].velocity);
    if (decision.was_inside) {
      Row from_gap = relative_[0];
      if (!stays_inside_) from_gap[5] = -1.0;
      limit(from_gap, distances_[sample_].displacement);
    }
    Matrix<Scalar, 6> map = maps_[decision.engaged ? 1 : 0];
    if (!decision.was_inside && !decision.engaged) map.row(5) = relative_[0];
    if (decision.was_inside && !decision.engaged && !stays_inside_) map(5, 5) = 1.0;
    flow = map * flow;
  }

  SwitchingPattern pattern_;
  bool stays_inside_;
  std::vector<Distances> distances_;
  std::array<Matrix<Scalar, 6>, 2> maps_;
  std::array<Row, 2> relative_;  // Δz and Δż of scaled deviations
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

/// The segments of one period, each of `length` common periods of q samples but perhaps a shorter
/// last one; or one segment of several whole periods.
/// @param flow  from the first sample on
template <class Scalar>
std::vector<DeviationSegment> deviation_segments(DeviationFlow<Scalar> flow,
                                                 const PeriodicOrbit& orbit, std::int64_t length) {
  const std::int64_t step = orbit.ratio.denominator;
  const std::int64_t whole = std::max(orbit.period_samples() / step, length);
  std::vector<DeviationSegment> segments;
  for (std::int64_t done = 0; done < whole; done += length)
    segments.push_back(flow.next(step * std::min(length, whole - done)));
  return segments;
}

/// The neighbourhoods at the starts of the segments.
template <class Scalar>
std::vector<AttractionBall> balls_with_radii(const IdealLoop<Scalar>& loop,
                                             const PeriodicOrbit& orbit,
                                             std::int64_t samples_of_segment,
                                             const std::vector<double>& radii) {
  AttractionBall ball{};
  ball.stays_inside = orbit.memory.inside && orbit.engaged_fraction() == 0.0;
  ball.lowest = std::numeric_limits<double>::infinity();
  ball.highest = -ball.lowest;
  for (const auto& state : orbit.states) {
    ball.lowest = std::min(ball.lowest, relative_displacement(state));
    ball.highest = std::max(ball.highest, relative_displacement(state));
  }
  std::vector<AttractionBall> balls;
  Backlash<Scalar> law(loop.backlash_width, orbit.memory);
  for (; ball.sample < orbit.period_samples(); ++ball.sample) {
    ball.state = orbit.states[static_cast<std::size_t>(ball.sample)];
    ball.memory = law.memory();
    ball.radius = radii[static_cast<std::size_t>(ball.sample / samples_of_segment)];
    if (ball.sample % samples_of_segment == 0 && ball.radius > 0.0) balls.push_back(ball);
    law.step(relative_displacement(ball.state), relative_velocity(ball.state));
  }
  return balls;
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
/// Work: about 300 multiply-adds a sample for every length of segment below a period that is tried,
/// and for the shortest one above that contracts.
/// @tparam Scalar  `double`; a template so that only who calls it compiles it
template <class Scalar>
std::vector<AttractionBall> attraction_balls(const IdealLoop<Scalar>& loop,
                                             const PeriodicOrbit& orbit) {
  const detail::DeviationFlow<Scalar> flow(loop, ItineraryMaps<Scalar>(loop, orbit.ratio), orbit);
  const std::int64_t step = orbit.ratio.denominator;
  const std::int64_t common_periods = orbit.period_samples() / step;
  // Segments of more than one period hold whole ones, to begin where they are used again; Φ over
  // them says without another walk whether they contract.
  Matrix<Scalar, 6> whole = Matrix<Scalar, 6>::Zero();
  std::int64_t length = 1;
  const std::int64_t longest = std::max(64 * common_periods, 1'000'000 / step);
  while (length <= longest) {
    if (length == common_periods) {
      whole = detail::DeviationFlow<Scalar>(flow).over(step * length);
    } else if (length > common_periods) {
      whole = whole * whole;
    }
    if (length == 1 || whole.norm() < 1.0) {
      const std::vector<double> radii =
          detail::attraction_radii(detail::deviation_segments(flow, orbit, length));
      if (!radii.empty()) return detail::balls_with_radii(loop, orbit, step * length, radii);
    }
    length = length < common_periods ? std::min(2 * length, common_periods) : 2 * length;
  }
  return {};
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template std::vector<AttractionBall> attraction_balls(const IdealLoop<double>&,
                                                             const PeriodicOrbit&);
#endif

}  // namespace holdfast
