#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/eigenvalues.hpp"
#include "holdfast/math/linalg/multipliers.hpp"
#include "holdfast/motion/event_motion.hpp"
#include "holdfast/motion/variational_flow.hpp"
#include "holdfast/orbit/event/repeating_motion.hpp"
#include "holdfast/orbit/scaling.hpp"
#include "holdfast/orbit/state_scale.hpp"

namespace holdfast {

/// The map X_0 → X_N of a motion, N a multiple of q, with its derivative, which includes the
/// saltation at every switch; X as in HybridTangent.
/// @tparam Contact  of the motion
/// @tparam Scalar   of X
template <class Contact, class Scalar = double>
class HybridReturn {
 public:
  /// X with the contact that goes with it.
  using Point = HybridPoint<Contact>;

  /// @param motion   any motion of the loop
  /// @param samples  N
  HybridReturn(const RepeatingMotion<Contact>& motion, std::int64_t samples)
      : motion_(motion), samples_(samples) {
    const auto& dynamics = motion_.motion().dynamics(0);
    units_ << plant_units(dynamics.state, dynamics.force), 1.0, 1.0;
  }

  /// A fixed point near a point, by Newton's method, (I − M) δX = X_N − X_0, until no more is
  /// gained.
  ///
  /// @param near       outside stick
  /// @param gap_opens  the drive leaves the gap that it may be in at `near`; else the gap is given
  /// @return nothing where 1 is a multiplier, or where X_N − X_0 does not become rounding
  std::optional<Point> fixed_point(Point near, bool gap_opens) {
    constexpr int most_iterations = 30, most_failures = 3;
    StateExtent extent;  // of all that was tried
    double least = std::numeric_limits<double>::infinity();
    std::optional<Point> best;
    for (int count = 0, failures = 0; count < most_iterations && failures < most_failures;
         ++count) {
      Matrix<Scalar, 7> map = Matrix<Scalar, 7>::Identity();
      const Point end = follow(near, [&](const auto& tangent) {
        map = in_units(tangent.map()) * map;
        extent.include(motion_.motion().state());
      });
      const Vector<Scalar, 7> open = detail::difference(near, end);
      if (end.contact.mode() != near.contact.mode() || !open.allFinite()) return std::nullopt;
      const Vector<Scalar, 4> gap(open[gap_row], 0.0, 0.0, 0.0);
      const double distance = std::max(extent.share_of(open), extent.share_of(gap));
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
  /// Of X only what the coming samples depend on counts: z; u_{j−1} with a processing delay; the
  /// displacement as last read where the velocity is its difference; the gap where the point lies
  /// in it and leaves it. The maps are multiplied up few at a time, from one sample at which the
  /// drive has forgotten its gap to another, so that multipliers_of_product() finds small moduli as
  /// well as large ones. Only where six numbers or seven count they are the eigenvalues of the
  /// whole product, and moduli some 10⁻¹⁴ below the largest are rounding.
  std::vector<Multiplier> multipliers(const Point& point, bool gap_opens) {
    const std::vector<int> counting = counting_coordinates(point, gap_opens);
    const bool in_blocks = counting.size() <= 5;
    const bool gap_counts = std::count(counting.begin(), counting.end(), gap_row) > 0;
    const int most = in_blocks ? most_maps_in_a_block(counting) : std::numeric_limits<int>::max();
    std::vector<Matrix<Scalar, 7>> blocks;
    int maps = most, rank = 7;
    bool may_cut = true;
    follow(point, [&](const auto& tangent) {
      if (maps >= most && may_cut) {
        blocks.emplace_back(Matrix<Scalar, 7>::Identity());
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
  static constexpr int gap_row = 5;

  Matrix<Scalar, 7> in_units(const Matrix<Scalar, 7>& map) const {
    return units_.cwiseInverse().asDiagonal() * map * units_.asDiagonal();
  }

  /// Follows the motion over N samples and shows its tangent after each. @return X_N
  template <class Visit>
  Point follow(const Point& point, Visit&& visit) {
    motion_.go_to(point);
    HybridTangent<Contact> tangent(motion_.motion());
    for (std::int64_t j = 0; j < samples_; ++j) {
      motion_.sense();
      tangent.begin_sample(motion_.motion());
      motion_.advance(tangent);
      visit(tangent);
    }
    return motion_.point();
  }

  static std::optional<Vector<Scalar, 7>> correction_of(const Matrix<Scalar, 7>& map,
                                                        Vector<Scalar, 7> open, bool gap_opens) {
    Matrix<Scalar, 7> closed = Matrix<Scalar, 7>::Identity() - map;
    if (!gap_opens) {
      closed.row(gap_row).setZero();
      closed.col(gap_row).setZero();
      closed(gap_row, gap_row) = 1.0;
      open[gap_row] = 0.0;
    }
    if (!closed.allFinite()) return std::nullopt;
    const Eigen::FullPivLU<Matrix<Scalar, 7>> factors(closed);
    if (!factors.isInvertible()) return std::nullopt;
    return Vector<Scalar, 7>(factors.solve(open));
  }

  std::vector<int> counting_coordinates(const Point& point, bool gap_opens) const {
    const DigitalLoop& loop = motion_.motion().loop();
    std::vector<int> counting{0, 1, 2, 3};
    if (loop.sampling.processing_delay > 0.0) counting.push_back(4);
    if (gap_opens && detail::remembers_gap(point.contact)) counting.push_back(gap_row);
    if (loop.limits.velocity == VelocitySensing::difference) counting.push_back(6);
    return counting;
  }

  /// So many that none of the directions that count is contracted to rounding against another: of
  /// z by the plant alone; what is remembered beside z may be forgotten within a few samples.
  int most_maps_in_a_block(const std::vector<int>& counting) const {
    if (counting.size() > 4) return 1;
    const HybridMotion<Contact>& motion = motion_.motion();
    const double decay = std::abs(motion.dynamics(0).state.trace());
    const double maps = 4.0 / (decay * motion.loop().sampling.period);  // infinite without damping
    return static_cast<int>(std::clamp(maps, 1.0, 16.0));
  }

  static std::vector<Matrix<Scalar, 5>> restricted(const std::vector<Matrix<Scalar, 7>>& blocks,
                                                   const std::vector<int>& counting) {
    std::vector<Matrix<Scalar, 5>> result;
    result.reserve(blocks.size());
    const auto size = static_cast<Eigen::Index>(counting.size());
    for (const Matrix<Scalar, 7>& block : blocks) {
      result.emplace_back(Matrix<Scalar, 5>::Zero());
      result.back().topLeftCorner(size, size) = block(counting, counting);
    }
    return result;
  }

  static std::vector<Multiplier> eigenvalues(const Matrix<Scalar, 7>& map,
                                             const std::vector<int>& counting) {
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
  Vector<Scalar, 7> units_;  // of X
};

}  // namespace holdfast
