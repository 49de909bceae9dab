#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <type_traits>
#include <vector>

#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/eigenvalues.hpp"
#include "holdfast/math/linalg/multipliers.hpp"
#include "holdfast/motion/event_motion.hpp"
#include "holdfast/motion/variational_flow.hpp"
#include "holdfast/orbit/event/repeating_motion.hpp"
#include "holdfast/orbit/state_scale.hpp"
#include "holdfast/orbit/state_scaling.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

namespace detail {

/// Units of X = [x; u_{j−1}; the gap; the displacement as last read] for what is solved on it,
/// powers of two: of the two masses those of plant_scaling() and 1 m, of another plant the size of
/// what a motion shows, or 1.
/// @param seen    the states of the motion
/// @param forces  of the drive (N)
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

/// The map X_0 → X_N of a motion, N a multiple of q, with its derivative, which includes the
/// saltation at every switch; X as in VariationalFlow.
/// @tparam Contact  of the motion
/// @tparam Scalar   of X
template <class Contact, class Scalar = double>
class ReturnMap {
 public:
  /// The motion that returns.
  using Motion = EventMotion<Contact>;
  /// Of X: the order of the plant and three.
  static constexpr int size = larger_size(Motion::states, 3);
  /// A deviation of X, and its map.
  using Deviation = Vector<Scalar, size>;
  using Map = Matrix<Scalar, size>;  ///< (N + 3) × (N + 3)
  /// X with the contact that goes with it.
  using Point = StroboscopicState<Contact>;

  /// @param motion   any motion of the loop
  /// @param samples  N
  /// @param units    of X, powers of two
  ReturnMap(const RepeatingMotion<Contact>& motion, std::int64_t samples, const Deviation& units)
      : motion_(motion), samples_(samples), units_(units) {}

  /// The same in units that know of no motion.
  ReturnMap(const RepeatingMotion<Contact>& motion, std::int64_t samples)
      : ReturnMap(motion, samples,
                  detail::return_units(motion.motion(), Extent(motion.motion().readings()), {})) {}

  /// A fixed point near a point, by Newton's method, (I − M) δX = X_N − X_0, until no more is
  /// gained.
  ///
  /// @param near       outside stick
  /// @param gap_opens  the drive leaves the gap that it may be in at `near`; else the gap is given
  /// @return nothing where 1 is a multiplier, or where X_N − X_0 does not become rounding
  std::optional<Point> fixed_point(Point near, bool gap_opens) {
    constexpr int most_iterations = 30, most_failures = 3;
    Extent extent(motion_.motion().readings());  // of all that was tried
    double least = std::numeric_limits<double>::infinity();
    std::optional<Point> best;
    for (int count = 0, failures = 0; count < most_iterations && failures < most_failures;
         ++count) {
      Map map = identity();
      const Point end = follow(near, [&](const auto& tangent) {
        map = in_units(tangent.map()) * map;
        extent.include(motion_.motion().state());
      });
      const Deviation open = detail::difference(near, end);
      if (end.contact.mode() != near.contact.mode() || !open.allFinite()) return std::nullopt;
      const double gap = extent.sides().share_of_displacement(std::abs(open[gap_row()]));
      const double distance = std::max(extent.share_of(open.head(order())), gap);
      failures = distance < 0.5 * least ? 0 : failures + 1;
      if (distance < least) best = near;
      least = std::min(least, distance);
      if (distance == 0.0) break;
      const auto correction = correction_of(map, open.cwiseQuotient(units_), gap_opens);
      if (!correction) return std::nullopt;
      near = detail::shifted(near, correction->cwiseProduct(units_));
    }
    return least <= 1e-10 ? best : std::nullopt;
  }

  /// The multipliers of a fixed point, largest first; at least five.
  ///
  /// Of X only what the coming samples depend on counts: x; u_{j−1} with a processing delay; the
  /// displacement as last read where the velocity is its difference; the gap where the point lies
  /// in it and leaves it. The maps are multiplied up few at a time, from one sample at which the
  /// drive has forgotten its gap to another, so that multipliers_of_product() finds small moduli as
  /// well as large ones. Only where more than five numbers count they are the eigenvalues of
  /// the whole product, and moduli some 10⁻¹⁴ below the largest are rounding.
  std::vector<Multiplier> multipliers(const Point& point, bool gap_opens) {
    const std::vector<int> counting = counting_coordinates(point, gap_opens);
    const bool in_blocks = counting.size() <= 5;
    const bool gap_counts = std::count(counting.begin(), counting.end(), gap_index()) > 0;
    const int most = in_blocks ? most_maps_in_a_block(counting) : std::numeric_limits<int>::max();
    std::vector<Map> blocks;
    int maps = most, rank = static_cast<int>(units_.size());
    bool may_cut = true;
    follow(point, [&](const auto& tangent) {
      if (maps >= most && may_cut) {
        blocks.push_back(identity());
        maps = 0;
      }
      blocks.back() = in_units(tangent.map()) * blocks.back();
      ++maps;
      rank = tangent.rank_of_product();
      const Contact& contact = motion_.motion().contact();
      may_cut = gap_counts || !gap_opens || !is_anchored(contact, contact.mode());
    });
    auto found = in_blocks ? multipliers_of_product(restricted(blocks, counting))
                           : eigenvalues(blocks.front(), counting);
    for (std::size_t i = static_cast<std::size_t>(rank); i < found.size(); ++i)
      found[i] = {-std::numeric_limits<double>::infinity(), 0.0};
    return found;
  }

 private:
  using Extent = StateScaleOf<typename Motion::Plant>;

  Eigen::Index order() const { return units_.size() - 3; }
  Eigen::Index gap_row() const { return order() + 1; }
  int gap_index() const { return static_cast<int>(gap_row()); }
  Map identity() const { return Map::Identity(units_.size(), units_.size()); }

  Map in_units(const Map& map) const {
    return units_.cwiseInverse().asDiagonal() * map * units_.asDiagonal();
  }

  /// Follows the motion over N samples and shows its tangent after each. @return X_N
  template <class Visit>
  Point follow(const Point& point, Visit&& visit) {
    motion_.go_to(point);
    VariationalFlow<Contact> tangent(motion_.motion());
    for (std::int64_t j = 0; j < samples_; ++j) {
      motion_.sense();
      tangent.begin_sample(motion_.motion());
      motion_.advance(tangent);
      visit(tangent);
    }
    return motion_.point();
  }

  std::optional<Deviation> correction_of(const Map& map, Deviation open, bool gap_opens) const {
    const Eigen::Index gap = gap_row();
    Map closed = identity() - map;
    if (!gap_opens) {
      closed.row(gap).setZero();
      closed.col(gap).setZero();
      closed(gap, gap) = 1.0;
      open[gap] = 0.0;
    }
    if (!closed.allFinite()) return std::nullopt;
    const Eigen::FullPivLU<Map> factors(closed);
    if (!factors.isInvertible()) return std::nullopt;
    return Deviation(factors.solve(open));
  }

  std::vector<int> counting_coordinates(const Point& point, bool gap_opens) const {
    const DigitalLoop& loop = motion_.motion().loop();
    const int n = static_cast<int>(order());
    std::vector<int> counting(static_cast<std::size_t>(n));
    std::iota(counting.begin(), counting.end(), 0);
    if (loop.sampling.processing_delay > 0.0) counting.push_back(n);
    if (gap_opens && detail::remembers_gap(point.contact)) counting.push_back(n + 1);
    if (loop.limits.velocity == VelocitySensing::difference) counting.push_back(n + 2);
    return counting;
  }

  /// So many that none of the directions that count is contracted to rounding against another: of
  /// x by the plant alone; what is remembered beside x may be forgotten within a few samples.
  int most_maps_in_a_block(const std::vector<int>& counting) const {
    if (counting.size() > 4) return 1;
    const EventMotion<Contact>& motion = motion_.motion();
    const double decay = std::abs(motion.dynamics(0).state.trace());
    const double maps = 4.0 / (decay * motion.loop().sampling.period);  // infinite without damping
    return static_cast<int>(std::clamp(maps, 1.0, 16.0));
  }

  static std::vector<Matrix<Scalar, 5>> restricted(const std::vector<Map>& blocks,
                                                   const std::vector<int>& counting) {
    std::vector<Matrix<Scalar, 5>> result;
    result.reserve(blocks.size());
    const auto count = static_cast<Eigen::Index>(counting.size());
    for (const Map& block : blocks) {
      result.emplace_back(Matrix<Scalar, 5>::Zero());
      result.back().topLeftCorner(count, count) = block(counting, counting);
    }
    return result;
  }

  static std::vector<Multiplier> eigenvalues(const Map& map, const std::vector<int>& counting) {
    std::vector<Multiplier> found;
    for (const std::complex<double>& value :
         holdfast::eigenvalues(Eigen::MatrixXd(map(counting, counting))))
      found.push_back({std::log(std::abs(value)), std::arg(value)});
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.log_modulus > b.log_modulus; });
    return found;
  }

  RepeatingMotion<Contact> motion_;
  std::int64_t samples_;
  Deviation units_;  // of X
};

}  // namespace holdfast
