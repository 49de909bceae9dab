#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>
#include <vector>

#include "holdfast/control/controller.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/multipliers.hpp"
#include "holdfast/motion/event_motion.hpp"
#include "holdfast/motion/variational_flow.hpp"
#include "holdfast/orbit/cyclic_system.hpp"
#include "holdfast/orbit/state_scale.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// The complete state of an EventMotion before a sample j; it determines the motion from then on.
/// At stroboscopic instants, every q samples (f τ = p/q), sampling and forcing are in phase.
template <class Contact>
struct StroboscopicState {
  std::int64_t phase;  ///< samples since the last stroboscopic instant, 0 … q − 1
  typename EventMotion<Contact>::State state;  ///< plant state x_j, N × 1 (two masses: m, m/s)
  double previous_command;                     ///< command of the last sample, u_{j−1} (N)
  double previous_reading;                     ///< displacement measured at t_{j−1} (m)
  Contact contact;  ///< contact before sample j, with its memory, such as the gap's position
};

namespace detail {

/// A deviation of X = [x; u_{j−1}; gap position; last measured displacement], x with N entries.
template <class Contact>
using PointDeviation = Vector<double, larger_size(EventMotion<Contact>::states, 3)>;

/// The deviation X(`to`) − X(`from`) of two states; its gap entry is 0 unless both remember a gap.
template <class Contact>
PointDeviation<Contact> difference(const StroboscopicState<Contact>& from,
                                   const StroboscopicState<Contact>& to) {
  PointDeviation<Contact> apart(from.state.size() + 3);
  apart << to.state - from.state, to.previous_command - from.previous_command, 0.0,
      to.previous_reading - from.previous_reading;
  if (from.contact.remembers_gap() && to.contact.remembers_gap())
    apart[from.state.size() + 1] = to.contact.lower() - from.contact.lower();
  return apart;
}

template <class Contact>
StroboscopicState<Contact> shifted(StroboscopicState<Contact> point,
                                   const PointDeviation<Contact>& by) {
  const Eigen::Index order = point.state.size();
  point.state += by.head(order);
  point.previous_command += by[order];
  point.previous_reading += by[order + 2];
  if (point.contact.remembers_gap()) point.contact.shift_gap(by[order + 1]);
  return point;
}

}  // namespace detail

/// An EventMotion whose forcing repeats exactly every q samples. Its sample index restarts at 0 at
/// each repetition: rounding of large times then cannot shift the sampling relative to the forcing.
template <class Contact>
class RepeatingMotion {
 public:
  /// @param motion  motion at any sample; sampling and forcing are in phase (stroboscopic instant)
  ///                whenever the sample's index is a multiple of q
  /// @param period  denominator q ≥ 1 of f τ = p/q, from forcing_ratio()
  RepeatingMotion(const EventMotion<Contact>& motion, std::int64_t period)
      : motion_(motion), period_(period) {
    turn_to(motion.index() % period);
  }

  /// Takes the present sample and computes the command; to be called before each `advance()`.
  typename EventMotion<Contact>::Sample sense() { return motion_.sense(); }
  /// Advances the motion to the next sample.
  void advance() { advance(IgnoreFlow()); }
  /// Advances to the next sample and calls an observer at each event; see EventMotion::advance.
  template <class Observer>
  void advance(Observer&& observer) {
    motion_.advance(observer);
    if (motion_.index() == period_) turn_to(0);
  }

  /// The state at the present sample before the controller processes it; call before `sense()`.
  StroboscopicState<Contact> point() const {
    double reading = 0.0;
    if constexpr (!own_controller) reading = motion_.controller().memory().previous_displacement;
    return {motion_.index(), motion_.state(), motion_.previous_command(), reading,
            motion_.contact()};
  }

  /// Sets the motion to a given state and sets its counts of contact changes to zero.
  void go_to(const StroboscopicState<Contact>& point) {
    if constexpr (!own_controller) {
      if (motion_.loop().limits.velocity == VelocitySensing::difference)
        motion_.remember_reading(point.previous_reading);
    }
    motion_.restore(point.phase, point.state, point.previous_command, point.contact);
    motion_.restart_counts();
  }

  /// The motion at the present sample; its index is the phase, 0 … q − 1.
  const EventMotion<Contact>& motion() const { return motion_; }
  /// The number of samples q after which the forcing repeats.
  std::int64_t period() const { return period_; }

 private:
  static constexpr bool own_controller =
      detail::HasController<typename EventMotion<Contact>::Plant>::value;

  void turn_to(std::int64_t phase) {
    motion_.restore(phase, motion_.state(), motion_.previous_command(), motion_.contact());
  }

  EventMotion<Contact> motion_;
  std::int64_t period_;
};

namespace detail {

/// The units of the state X of VariationalFlow, powers of two. For two masses: plant_scaling() and
/// 1 m. For other plants: just below the motion's largest values, or 1 if these are 0.
/// @param seen    extent of the motion's states
/// @param forces  forces of the drive in the motion (N)
template <class Contact>
PointDeviation<Contact> return_units(
    const EventMotion<Contact>& motion,
    [[maybe_unused]] const StateScaleOf<typename EventMotion<Contact>::Plant>& seen,
    [[maybe_unused]] const std::vector<double>& forces) {
  const Eigen::Index order = motion.state().size();
  PointDeviation<Contact> units(order + 3);
  if constexpr (std::is_same_v<typename EventMotion<Contact>::Plant, TwoMass<double>>) {
    const auto& dynamics = motion.dynamics(0);
    units << plant_scaling(dynamics.state, dynamics.force), 1.0, 1.0;
  } else {
    double force = 0.0;
    for (const double one : forces) force = std::max(force, std::abs(one));
    const double displacement = power_of_two_below(seen.sides().displacement);
    for (Eigen::Index i = 0; i < order; ++i)
      units[i] = i < seen.largest().size() ? power_of_two_below(seen.largest()[i]) : 1.0;
    units.tail(3) << power_of_two_below(force), displacement, displacement;
  }
  return units;
}

}  // namespace detail

/// The return map X_0 ↦ X_N of a motion over N samples, N a multiple of q (f τ = p/q), with its
/// derivative. The state is X = [x; u_{j−1}; gap position; last measured displacement], with the
/// plant state x and the last command u_{j−1}. The derivative includes saltation at every switch.
/// @tparam Contact  contact of the motion
template <class Contact>
class ReturnMap {
 public:
  /// The type of the motion whose states are mapped.
  using Motion = EventMotion<Contact>;
  /// A deviation of X; it has three entries more than the plant state x.
  using Deviation = detail::PointDeviation<Contact>;
  /// The state X together with the contact of the drive and the phase of the forcing.
  using Point = StroboscopicState<Contact>;

  /// @param motion     any motion of the loop
  /// @param samples    number N of samples, a multiple of q
  /// @param units      units by which the entries of X are divided for scaling, powers of two
  /// @param gap_opens  whether the drive changes its contact during the N samples; if not, the
  ///                   gap's position counts as constant
  ReturnMap(const RepeatingMotion<Contact>& motion, std::int64_t samples, const Deviation& units,
            bool gap_opens)
      : motion_(motion), samples_(samples), units_(units), gap_opens_(gap_opens) {}

  /// Computes the fixed point X_N = X_0 near a given state by Newton's method; CyclicSystem solves
  /// for each step. The iteration ends when further steps bring no improvement.
  /// @param near  initial guess, a state that is not in stick
  /// @return nullopt where 1 is a multiplier, the motion touches a switching surface or ends in
  ///         another contact mode, or X_N − X_0 does not decrease to rounding
  std::optional<Point> fixed_point(Point near) {
    constexpr int most_iterations = 30, most_failures = 3;
    constexpr std::size_t samples_of_block = 64;  // directions contracted more do not affect a step
    Extent extent(motion_.motion().readings());   // of all states tried
    double least = std::numeric_limits<double>::infinity();
    std::optional<Point> best;
    for (int count = 0, failures = 0; count < most_iterations && failures < most_failures;
         ++count) {
      const Linearised flow = linearised(near, samples_of_block, extent);
      Deviation open = detail::difference(near, flow.end);
      if (flow.end.contact.mode() != near.contact.mode() || !open.allFinite()) return std::nullopt;
      const double gap = extent.sides().share_of_displacement(std::abs(open[gap_row()]));
      const double distance = std::max(extent.share_of(open.head(order())), gap);
      failures = distance < 0.5 * least ? 0 : failures + 1;
      if (distance < least) best = near;
      least = std::min(least, distance);
      if (distance == 0.0) break;
      const CyclicSystem<double, Eigen::Dynamic> system(flow.blocks);
      if (system.is_singular()) return std::nullopt;
      if (!gap_opens_) open[gap_row()] = 0.0;
      const Deviation correction = system.correction(open.cwiseQuotient(units_));
      if (!correction.allFinite()) return std::nullopt;
      near = detail::shifted(near, correction.cwiseProduct(units_));
    }
    return least <= 1e-10 ? best : std::nullopt;
  }

  /// The index, in the plant state x, of the largest entry of a neutral deviation. A deviation is
  /// neutral if it is unchanged after N samples. Entries are compared in the units of X. If state
  /// variables of a user-defined controller deviate, only they are compared.
  /// @return nullopt without a neutral deviation or where other deviations grow
  std::optional<Eigen::Index> neutral_coordinate(const Point& point) {
    Extent unused(motion_.motion().readings());
    const Blocks blocks = linearised(point, 64, unused).blocks;
    Eigen::MatrixXd map = blocks.front();
    for (std::size_t k = 1; k < blocks.size(); ++k) map = (blocks[k] * map).eval();
    Eigen::MatrixXd power = map;
    for (int doubling = 0; doubling < 12; ++doubling) power = (power * power).eval();
    Eigen::Index which = 0;
    if (!(power.colwise().norm().maxCoeff(&which) > 0.0) || !power.allFinite()) return std::nullopt;
    Eigen::VectorXd stays = power.col(which);
    constexpr double of_differences = 1e-8;  // controllers may be known by difference quotients
    if (!((map * stays - stays).norm() <= of_differences * stays.norm()) ||
        stays.head(order()).norm() <= 1e-6 * stays.norm())
      return std::nullopt;
    if constexpr (detail::HasController<typename Motion::Plant>::value) {
      const Eigen::Index own = motion_.motion().contact().plant().controller.states();
      if (stays.segment(order() - own, own).norm() > 1e-6 * stays.norm())
        stays.head(order() - own).setZero();
    }
    stays.head(order()).cwiseAbs().maxCoeff(&which);
    return which;
  }

  /// The Floquet multipliers of a fixed point, largest modulus first: one for each entry of X that
  /// affects later samples. If fewer than five, zeros (log_modulus −∞) are added.
  std::vector<Multiplier> multipliers(const Point& point) {
    Extent unused(motion_.motion().readings());
    const Linearised flow = linearised(point, samples_that_keep_digits(), unused);
    const std::vector<int> counting = counting_coordinates(flow.blocks);
    auto found = counting.size() <= 5
                     ? multipliers_of_product(restricted<5>(flow.blocks, counting))
                     : multipliers_of_product(restricted<Eigen::Dynamic>(flow.blocks, counting));
    found.resize(std::min(found.size(), static_cast<std::size_t>(flow.rank)));
    found.resize(std::max<std::size_t>(memory_of(point), 5),
                 {-std::numeric_limits<double>::infinity(), 0.0});
    return found;
  }

 private:
  using Extent = StateScaleOf<typename Motion::Plant>;
  using Map = typename VariationalFlow<Contact>::Map;
  using Blocks = std::vector<Eigen::MatrixXd>;

  struct Linearised {
    Point end;      // X_N
    Blocks blocks;  // of deviations, in the units
    int rank;       // structural rank of their product
  };

  Eigen::Index order() const { return units_.size() - 3; }
  Eigen::Index gap_row() const { return order() + 1; }

  /// Follows the motion over N samples; multiplies its maps in blocks of up to `most` samples.
  Linearised linearised(const Point& point, std::size_t most, Extent& extent) {
    motion_.go_to(point);
    VariationalFlow<Contact> tangent(motion_.motion());
    BlockProducts<Eigen::MatrixXd> products(most);
    for (std::int64_t j = 0; j < samples_; ++j) {
      motion_.sense();
      tangent.begin_sample(motion_.motion());
      motion_.advance(tangent);
      extent.include(motion_.motion().state());
      Map map = units_.cwiseInverse().asDiagonal() * tangent.map() * units_.asDiagonal();
      if (!gap_opens_) {
        map.row(gap_row()).setZero();
        map.col(gap_row()).setZero();
      }
      products.append(map);
    }
    return {motion_.point(), products.blocks(), tangent.rank_of_product()};
  }

  /// The number of state variables, memory included, that the motion from a state depends on.
  std::size_t memory_of(const Point& point) const {
    const DigitalLoop& loop = motion_.motion().loop();
    auto size = static_cast<std::size_t>(order());
    if (loop.sampling.processing_delay > 0.0) ++size;
    if (loop.limits.velocity == VelocitySensing::difference) ++size;
    if (gap_opens_ && point.contact.is_anchored(point.contact.mode())) ++size;
    return size;
  }

  /// The coordinates of X on which the map of at least one block depends.
  std::vector<int> counting_coordinates(const Blocks& blocks) const {
    std::vector<int> counting;
    for (int i = 0; i < static_cast<int>(units_.size()); ++i)
      if (std::any_of(blocks.begin(), blocks.end(),
                      [i](const auto& block) { return !block.col(i).isZero(0.0); }))
        counting.push_back(i);
    return counting;
  }

  /// The blocks restricted to the coordinates `counting`, filled up with zeros to at least 5 × 5.
  template <int Size>
  static std::vector<Matrix<double, Size>> restricted(const Blocks& blocks,
                                                      const std::vector<int>& counting) {
    const auto count = static_cast<Eigen::Index>(counting.size());
    const Eigen::Index size = std::max<Eigen::Index>(count, 5);
    std::vector<Matrix<double, Size>> maps(blocks.size(), Matrix<double, Size>::Zero(size, size));
    for (std::size_t k = 0; k < blocks.size(); ++k)
      maps[k].topLeftCorner(count, count) = blocks[k](counting, counting);
    return maps;
  }

  /// The number of samples whose maps may be multiplied without loss of digits in any direction of
  /// x. It is 1 for a loop with memory besides x, since that memory may decay within few samples.
  std::size_t samples_that_keep_digits() const {
    const EventMotion<Contact>& motion = motion_.motion();
    const DigitalLoop& loop = motion.loop();
    const bool remembers = loop.sampling.processing_delay > 0.0 ||
                           loop.limits.velocity == VelocitySensing::difference ||
                           detail::HasController<typename Motion::Plant>::value;
    if (remembers) return 1;
    const auto& engaged = motion.dynamics(0);
    const double free = engaged.state.trace();
    const double controlled =
        free + loop.gains.differential * motion.readings().measured_velocity(engaged.command) +
        loop.gains.proportional * motion.readings().measured_displacement(engaged.command);
    const double decay = std::max(std::abs(free), std::abs(controlled));
    const double samples = 4.0 / (decay * loop.sampling.period);  // infinite without damping
    return static_cast<std::size_t>(std::clamp(samples, 1.0, 16.0));
  }

  RepeatingMotion<Contact> motion_;
  std::int64_t samples_;
  Deviation units_;  // of X
  bool gap_opens_;
};

}  // namespace holdfast
