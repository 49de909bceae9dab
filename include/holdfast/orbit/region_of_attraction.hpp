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

/// A ball around one state of an orbit. Every motion that starts in the ball, at the same phase of
/// the forcing, has the orbit's itinerary for ever and tends to the orbit.
///
/// The norm of a motion's deviation e from the orbit is
///
///     ‖e‖² = e_z₁² + (e_ż₁/ω)² + e_z₂² + (e_ż₂/ω)² + (e_u/k₁)² + e_gap²   (m²),
///
/// with the excitation's angular frequency ω (without excitation √(k₁/m₁)) and the conductor's
/// stiffness k₁ and mass m₁. In a gap, e_gap is the deviation of the gap's position. The motion
/// must have the orbit's contact and, if engaged, the orbit's sign of Δż at the last sample. An
/// orbit that never leaves its gap exists in every gap that contains its range of Δz. The radius of
/// the ball is then `radius` × clearance from the gap's ends.
struct AttractionBall {
  std::int64_t sample;            ///< index of the orbit's sample: a multiple of q, f τ = p/q
  Vector<double, 5> state;        ///< state z̃ = [z; u_{j−1}] at sample j = `sample`
  BacklashMemory<double> memory;  ///< memory of the backlash law before sample j = `sample`
  bool stays_inside;              ///< whether the drive never leaves its gap
  double lowest,                  ///< least Δz of the orbit (m)
      highest;                    ///< largest Δz of the orbit (m)
  double radius;                  ///< radius (m), > 0; if stays_inside, m per metre of clearance
};

/// The weights [1, 1/ω, 1, 1/ω, 1/k₁, 1] that convert a deviation of [z₁, ż₁, z₂, ż₂, u, gap] to
/// metres; ω is the excitation's angular frequency, or √(k₁/m₁) without excitation. The conductor
/// has the stiffness k₁ and the mass m₁.
template <class Scalar>
Vector<Scalar, 6> deviation_weights(const IdealLoop<Scalar>& loop) {
  const Scalar stiffness = loop.plant.conductor_stiffness;
  const Scalar angular_frequency = loop.excitation.amplitude > 0.0
                                       ? loop.excitation.angular_frequency()
                                       : std::sqrt(stiffness / loop.plant.conductor_mass);
  return {1.0, 1.0 / angular_frequency, 1.0, 1.0 / angular_frequency, 1.0 / stiffness, 1.0};
}

/// The radius (m) of an AttractionBall or a ModalAttraction for a motion with the backlash memory
/// `drive`. It is ≤ 0 where an orbit that stays in its gap does not fit into the motion's gap.
template <class Neighbourhood>
double attraction_radius(const Neighbourhood& point, const BacklashMemory<double>& drive) {
  if (!point.stays_inside) return point.radius;
  return point.radius * std::min(point.lowest - drive.lower, drive.upper - point.highest);
}

/// Whether a motion at a stroboscopic instant (sampling and forcing in phase) lies in a ball of
/// attraction. @param point  the ball
/// @param motion   memory() of the motion, before the sample
/// @param weights  deviation_weights() of the loop
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

/// Bounds for a deviation over a segment of samples: the largest initial deviation that changes no
/// contact decision, and the largest growth of a deviation up to the end of the segment.
struct DeviationSegment {
  double radius = std::numeric_limits<double>::infinity();  // m
  double growth = 1.0;                                      // Frobenius norm
};

/// The deviations of an IdealLoop's z̃, in metres, one per column; the maps S and S* advance them.
template <class Scalar>
class SampledDeviations {
 public:
  using Columns = Matrix<Scalar, 6>;               ///< six deviations e
  using Deviations = Eigen::Matrix<Scalar, 5, 6>;  ///< deviations of z̃, without the gap
  using Readings = Eigen::Matrix<Scalar, 2, 6>;    ///< readings of Δz and Δż, one per row
  static constexpr int block = 1;                  ///< most samples between two take_readings()

  SampledDeviations(const IdealLoop<Scalar>& loop, const ItineraryMaps<Scalar>& maps) {
    const Vector<Scalar, 5> weights = deviation_weights(loop).template head<5>();
    for (const bool engaged : {false, true})
      maps_[engaged ? 1 : 0] =
          weights.asDiagonal() * maps.map(engaged) * weights.cwiseInverse().asDiagonal();
    relative_ = {Read::Unit(2) / weights[2] - Read::Unit(0) / weights[0],
                 Read::Unit(3) / weights[3] - Read::Unit(1) / weights[1]};
  }

  Eigen::Index order() const { return 5; }
  void begin(const Deviations& deviations) { deviations_ = deviations; }
  const Deviations& columns() const { return deviations_; }
  void read_displacement() { readings_.row(read_++) = relative_[0] * deviations_; }
  void read_velocity() { readings_.row(read_++) = relative_[1] * deviations_; }
  const Readings& take_readings() {
    read_ = 0;
    return readings_;
  }
  void advance(bool engaged) { deviations_ = maps_[engaged ? 1 : 0] * deviations_; }

 private:
  using Read = RowVector<Scalar, 5>;

  std::array<Matrix<Scalar, 5>, 2> maps_;
  std::array<Read, 2> relative_;  // Δz and Δż
  Deviations deviations_ = Deviations::Zero();
  Readings readings_;
  int read_ = 0;
};

/// The propagation of deviations e = [e_x; e_gap] from an orbit, in metres, along that orbit.
/// @tparam Deviations  SampledDeviations or ModalDeviations: order(), begin(columns), columns(),
///                     read_displacement(), read_velocity(), take_readings(), advance(engaged)
template <class Deviations>
class DeviationFlow {
 public:
  using Columns = typename Deviations::Columns;
  using Row = Eigen::Matrix<typename Columns::Scalar, 1, Columns::ColsAtCompileTime>;

  DeviationFlow(const Deviations& deviations, double width, const PeriodicOrbit& orbit)
      : deviations_(deviations),
        pattern_(switching_pattern(orbit.states, Backlash<double>(width, orbit.memory))),
        stays_inside_(pattern_.stays_inside()),
        distances_(orbit.states.size()) {
    for_each_border(pattern_, orbit.states, width,
                    [this](std::size_t j, SwitchingSurface surface, double distance) {
                      Distances& here = distances_[j];
                      const bool reverses = surface == SwitchingSurface::reversal;
                      double& least = reverses ? here.velocity : here.displacement;
                      least = std::min(least, stays_inside_ ? 1.0 : distance);
                    });
  }

  Eigen::Index order() const { return deviations_.order() + 1; }

  /// The bounds for deviations over the next `samples` samples.
  DeviationSegment next(std::int64_t samples) {
    DeviationSegment segment;
    segment.growth = follow(unit(), samples, &segment).norm();
    return segment;
  }

  /// The flow matrix Φ over the next `samples` samples.
  Columns over(std::int64_t samples) { return follow(unit(), samples, nullptr); }

  /// Propagates given deviations over the next `samples` samples.
  /// @param segment  if given, its radius is lowered to the least norm that may change a contact
  Columns follow(const Columns& deviations, std::int64_t samples, DeviationSegment* segment) {
    deviations_.begin(deviations.topRows(deviations.rows() - 1));
    gap_ = deviations.row(deviations.rows() - 1);
    for (std::int64_t k = 0; k < samples; k += Deviations::block)
      take_block(std::min<std::int64_t>(Deviations::block, samples - k), segment);
    Columns all(order(), gap_.size());
    all << deviations_.columns(), gap_;
    return all;
  }

 private:
  /// The distances of a sample's Δz (m) and Δż (m/s) from the switching surfaces. If the orbit
  /// stays inside its gap, `displacement` is 1, and radii are per metre of clearance.
  struct Distances {
    double displacement = std::numeric_limits<double>::infinity();
    double velocity = std::numeric_limits<double>::infinity();
  };

  Columns unit() const { return Columns::Identity(order(), order()); }

  void take_block(std::int64_t samples, DeviationSegment* segment) {
    const auto moves = [&](std::int64_t k) -> const ContactDecision& {
      return pattern_.decisions[(sample_ + static_cast<std::size_t>(k)) % distances_.size()];
    };
    const auto reads_velocity = [&](const ContactDecision& of) {
      return segment && of.velocity_sign != 0;
    };
    const auto reads_displacement = [&](const ContactDecision& of) {
      return of.was_inside ? segment != nullptr : !of.engaged;
    };
    for (std::int64_t k = 0; k < samples; ++k) {
      if (reads_velocity(moves(k))) deviations_.read_velocity();
      if (reads_displacement(moves(k))) deviations_.read_displacement();
      deviations_.advance(moves(k).engaged);
    }
    const typename Deviations::Readings& readings = deviations_.take_readings();
    Eigen::Index row = 0;
    const auto limit = [&](const Row& deviation, double distance) {
      segment->radius = std::min(segment->radius, distance / deviation.norm());
    };
    for (; samples > 0; --samples) {
      const ContactDecision& decision = moves(0);
      const Distances& distance = distances_[sample_];
      if (reads_velocity(decision)) limit(readings.row(row++), distance.velocity);
      const Row displacement = reads_displacement(decision) ? Row(readings.row(row++)) : gap_;
      if (segment && decision.was_inside)
        limit(stays_inside_ ? displacement : Row(displacement - gap_), distance.displacement);
      if (decision.engaged || stays_inside_) {
        gap_.setZero();
      } else if (!decision.was_inside) {
        gap_ = displacement;
      }
      if (++sample_ == distances_.size()) sample_ = 0;
    }
  }

  Deviations deviations_;
  Row gap_;
  SwitchingPattern pattern_;
  bool stays_inside_;
  std::vector<Distances> distances_;
  std::size_t sample_ = 0;
};

/// The radii of attraction at the starts of a period's segments. A deviation that starts within one
/// radius ends the segment within the next radius. The list is empty if some segment has a finite
/// radius but the segments together do not contract.
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
  // The second turn takes the radius of the first segment into account at the end of the last one.
  for (int turn = 0; turn < 2; ++turn) {
    for (std::size_t k = segments.size(); k-- > 0;) {
      following = std::min(segments[k].radius, following / segments[k].growth);
      radii[k] = following;
    }
  }
  return radii;
}

/// The segments of one period, each of `length` times q samples (the last may be shorter). If this
/// length exceeds the period, there is one segment of several whole periods.
template <class Deviations>
std::vector<DeviationSegment> deviation_segments(DeviationFlow<Deviations> flow,
                                                 const PeriodicOrbit& orbit, std::int64_t length) {
  const std::int64_t step = orbit.ratio.denominator;
  const std::int64_t whole = std::max(orbit.period_samples() / step, length);
  std::vector<DeviationSegment> segments;
  for (std::int64_t done = 0; done < whole; done += length)
    segments.push_back(flow.next(step * std::min(length, whole - done)));
  return segments;
}

/// Sets the range of Δz of an orbit, and whether the orbit stays inside its gap.
template <class Neighbourhood>
void set_extent(Neighbourhood& of, const PeriodicOrbit& orbit) {
  of.stays_inside = orbit.memory.inside && orbit.engaged_fraction() == 0.0;
  of.lowest = std::numeric_limits<double>::infinity();
  of.highest = -of.lowest;
  for (const auto& state : orbit.states) {
    of.lowest = std::min(of.lowest, relative_displacement(state));
    of.highest = std::max(of.highest, relative_displacement(state));
  }
}

/// The neighbourhoods of an orbit at the starts of the segments of its period.
template <class Scalar>
std::vector<AttractionBall> balls_with_radii(const IdealLoop<Scalar>& loop,
                                             const PeriodicOrbit& orbit,
                                             std::int64_t samples_of_segment,
                                             const std::vector<double>& radii) {
  AttractionBall ball{};
  set_extent(ball, orbit);
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

/// Computes balls of attraction of an orbit, at its stroboscopic instants (sampling and forcing in
/// phase, every q samples). Every motion that starts in a ball tends to the orbit.
///
/// The period is cut into segments of q samples, then of 2 q, 4 q, … samples, until the segments
/// together contract. Φ propagates a deviation e from the start of a segment. No contact changes
/// while |h Φ e| is below the orbit's distance from the switching surface with normal h. Over the
/// segment, e grows by at most the factor ‖Φ‖. By induction both bounds are valid for all time.
/// @param loop   the loop that has the orbit
/// @param orbit  attracting and certified orbit
/// @return balls in the order of the samples; empty where no segments contract, up to a length of
///         64 periods or 10⁶ samples, whichever is longer
/// Work: about 300 multiply-adds per sample for each segment length up to one period. At most one
/// longer length is computed in full.
template <class Scalar>
std::vector<AttractionBall> attraction_balls(const IdealLoop<Scalar>& loop,
                                             const PeriodicOrbit& orbit) {
  using Deviations = detail::SampledDeviations<Scalar>;
  const detail::DeviationFlow<Deviations> flow(
      Deviations(loop, ItineraryMaps<Scalar>(loop, orbit.ratio)), loop.backlash_width, orbit);
  const std::int64_t step = orbit.ratio.denominator;
  const std::int64_t common_periods = orbit.period_samples() / step;
  // Segments longer than a period are whole periods; the norm of Φ shows whether they contract.
  Matrix<Scalar, 6> whole = Matrix<Scalar, 6>::Zero();
  std::int64_t length = 1;
  const std::int64_t longest = std::max(64 * common_periods, 1'000'000 / step);
  while (length <= longest) {
    if (length == common_periods) {
      whole = detail::DeviationFlow<Deviations>(flow).over(step * length);
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
