#pragma once

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <exception>
#include <limits>
#include <utility>
#include <vector>

#include "holdfast/ceres/device_placement_options.hpp"
#include "holdfast/core/errors.hpp"

/// Search for a device's best position and strength; this header needs the package Ceres Solver.
namespace holdfast::placement {

namespace detail {

/// A point of the unit cube: each device value scaled to 0 … 1 between its bounds.
using Place = std::vector<double>;

/// Evaluator of the levels at points of the unit cube; keeps the best point so far.
class LevelQuestions {
 public:
  LevelQuestions(const std::vector<MovableValue>& values, const Levels& levels,
                 const PlacementOptions& options)
      : values_(values), levels_(levels), watch_(options.watch) {}

  /// Device values at a point of the unit cube; coordinates outside 0 … 1 are replaced by 0 or 1.
  std::vector<double> values_at(const Place& place) const {
    std::vector<double> found;
    for (std::size_t k = 0; k < values_.size(); ++k) {
      const MovableValue& value = values_[k];
      const double share = std::clamp(place[k], 0.0, 1.0);
      const double between = value.by_ratio
                                 ? value.lower * std::pow(value.upper / value.lower, share)
                                 : value.lower + share * (value.upper - value.lower);
      found.push_back(std::clamp(between, value.lower, value.upper));
    }
    return found;
  }

  /// The levels at a point of the unit cube; empty for inadmissible device values.
  std::vector<double> at(const Place& place) {
    if (watch_) watch_();
    ++asked_;
    std::vector<double> found = levels_(values_at(place));
    for (const double level : found)
      if (!std::isfinite(level)) found.clear();
    if (found.empty()) return found;
    const double worst = *std::max_element(found.begin(), found.end());
    if (worst < least_) {
      least_ = worst;
      best_ = place;
      for (double& share : best_) share = std::clamp(share, 0.0, 1.0);
    }
    return found;
  }

  /// The largest level at a point of the unit cube; infinity for inadmissible device values.
  double worst(const Place& place) {
    const std::vector<double> found = at(place);
    return found.empty() ? std::numeric_limits<double>::infinity()
                         : *std::max_element(found.begin(), found.end());
  }

  const std::vector<MovableValue>& values() const { return values_; }  ///< values that vary
  const Place& best() const { return best_; }  ///< best point so far; empty: none
  int asked() const { return asked_; }

 private:
  const std::vector<MovableValue>& values_;
  const Levels& levels_;
  const std::function<void()>& watch_;
  double least_ = std::numeric_limits<double>::infinity();
  Place best_;
  int asked_ = 0;
};

/// The residuals (level/scale)^{p/2} for Ceres, with the largest level at the start as scale. The
/// sum of their squares is the p-th power of the p-norm of level/scale.
struct NormResiduals {
  LevelQuestions& questions;
  double power, scale;          // p, and the largest level at the start of the run
  std::size_t count;            // number of levels
  std::exception_ptr& failure;  // exception from the levels, not thrown through Ceres

  bool operator()(double const* const* shifted, double* residuals) const {
    constexpr double largest = 1e100;
    if (failure) return false;
    try {
      Place place(shifted[0], shifted[0] + questions.values().size());
      for (double& share : place) share -= 1.0;
      const std::vector<double> levels = questions.at(place);
      if (levels.size() != count) return false;
      bool bounded = true;
      for (std::size_t k = 0; k < count; ++k) {
        residuals[k] = std::pow(levels[k] / scale, 0.5 * power);
        bounded = bounded && residuals[k] < largest;
      }
      return bounded;
    } catch (...) {
      failure = std::current_exception();
      return false;
    }
  }
};

/// Minimises the p-norm of the levels within the bounds by one run of Ceres. Its unknowns are the
/// coordinates plus 1, since Ceres' difference quotients have steps relative to the unknowns.
inline Place run_on_norm(LevelQuestions& questions, const Place& start, double power) {
  const std::vector<double> levels = questions.at(start);
  if (levels.empty()) return start;
  const auto size = static_cast<int>(start.size());
  const double scale = *std::max_element(levels.begin(), levels.end());
  if (!(scale > 0.0)) return start;
  std::exception_ptr failure;
  Place shifted = start;
  for (double& share : shifted) share += 1.0;
  using Cost = ::ceres::DynamicNumericDiffCostFunction<NormResiduals, ::ceres::CENTRAL>;
  auto* cost = new Cost(new NormResiduals{questions, power, scale, levels.size(), failure});
  cost->AddParameterBlock(size);
  cost->SetNumResiduals(static_cast<int>(levels.size()));
  ::ceres::Problem problem;
  problem.AddResidualBlock(cost, nullptr, shifted.data());
  for (int k = 0; k < size; ++k) {
    problem.SetParameterLowerBound(shifted.data(), k, 1.0);
    problem.SetParameterUpperBound(shifted.data(), k, 2.0);
  }
  ::ceres::Solver::Options options;
  options.logging_type = ::ceres::SILENT;
  options.linear_solver_type = ::ceres::DENSE_QR;
  options.max_num_iterations = 12;
  options.function_tolerance = 1e-4;
  options.parameter_tolerance = 1e-5;
  ::ceres::Solver::Summary summary;
  ::ceres::Solve(options, &problem, &summary);
  if (failure) std::rethrow_exception(failure);
  for (double& share : shifted) share -= 1.0;
  return shifted;
}

/// The k-th number of Halton's sequence of a base, within 0 … 1.
inline double halton(int k, int base) {
  double sum = 0.0, share = 1.0;
  for (; k > 0; k /= base) {
    share /= base;
    sum += share * (k % base);
  }
  return sum;
}

/// An orthonormal basis for one turn of the direct search: the columns of I − 2 q qᵀ with a unit
/// vector q from Halton's sequence that differs from turn to turn.
inline std::vector<Place> poll_basis(int turn, std::size_t size) {
  constexpr int bases[] = {2, 3, 5, 7, 11, 13};
  Place q(size);
  double norm = 0.0;
  for (std::size_t k = 0; k < size; ++k) {
    q[k] = 2.0 * halton(turn + 1, bases[k]) - 1.0;
    norm += q[k] * q[k];
  }
  if (!(norm > 0.0)) norm = q[0] = 1.0;
  std::vector<Place> basis(size, Place(size, 0.0));
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t k = 0; k < size; ++k)
      basis[i][k] = (i == k ? 1.0 : 0.0) - 2.0 * q[i] * q[k] / norm;
  return basis;
}

/// Minimises the largest level from a point by direct search, since its derivative jumps where the
/// largest level changes. Each turn tries steps along another basis; two turns without improvement
/// halve the step (OrthoMADS: Abramson, Audet, Dennis & Le Digabel, SIAM J. Optim. 20 (2009)).
inline void refine(LevelQuestions& questions, Place place, double step, double resolution) {
  constexpr int most_turns = 120, patience = 2;
  int failed = 0;
  const double widest = step;
  double here = questions.worst(place);
  for (int turn = 0; turn < most_turns && step > resolution; ++turn) {
    Place better;
    for (const Place& direction : poll_basis(turn, place.size()))
      for (const double way : {step, -step}) {
        Place there = place;
        for (std::size_t k = 0; k < there.size(); ++k)
          there[k] = std::clamp(there[k] + way * direction[k], 0.0, 1.0);
        const double level = there == place ? here : questions.worst(there);
        if (!(level < here)) continue;
        here = level;
        better = there;
      }
    if (!better.empty()) {
      place = better;
      step = std::min(2.0 * step, widest);
      failed = 0;
    } else if (++failed == patience || place.size() == 1) {
      step *= 0.5;
      failed = 0;
    }
  }
}

/// Grid over the unit cube and its local minima: points without a better neighbour on any axis.
class GridOfStarts {
 public:
  explicit GridOfStarts(LevelQuestions& questions) : values_(questions.values()) {
    std::size_t count = 1;
    for (const MovableValue& value : values_) count *= static_cast<std::size_t>(value.places);
    for (std::size_t k = 0; k < count; ++k) worst_.push_back(questions.worst(place_of(k)));
  }

  std::vector<Place> best(int most) const {
    std::vector<std::pair<double, std::size_t>> minima;
    for (std::size_t k = 0; k < worst_.size(); ++k)
      if (std::isfinite(worst_[k]) && is_minimum(k)) minima.emplace_back(worst_[k], k);
    std::sort(minima.begin(), minima.end());
    std::vector<Place> found;
    for (const auto& [level, k] : minima)
      if (static_cast<int>(found.size()) < most) found.push_back(place_of(k));
    return found;
  }

 private:
  Place place_of(std::size_t number) const {
    Place place;
    for (const MovableValue& value : values_) {
      const auto places = static_cast<std::size_t>(value.places);
      place.push_back(static_cast<double>(number % places) / static_cast<double>(places - 1));
      number /= places;
    }
    return place;
  }

  bool is_minimum(std::size_t number) const {
    std::size_t stride = 1;
    for (const MovableValue& value : values_) {
      const auto places = static_cast<std::size_t>(value.places);
      const std::size_t along = number / stride % places;
      if (along > 0 && worst_[number - stride] < worst_[number]) return false;
      if (along + 1 < places && worst_[number + stride] < worst_[number]) return false;
      stride *= places;
    }
    return true;
  }

  const std::vector<MovableValue>& values_;
  std::vector<double> worst_;
};

inline void validate(const std::vector<MovableValue>& values, const PlacementOptions& options) {
  require_within("number of varied values", static_cast<double>(values.size()), "", 1, 6);
  for (const MovableValue& value : values) {
    require_finite("upper minus lower bound of a varied value", value.upper - value.lower, "");
    require_positive("upper minus lower bound of a varied value", value.upper - value.lower, "");
    if (value.by_ratio) require_positive("lower bound of a varied value", value.lower, "");
    require_within("grid points along a varied value", value.places, "", 2, 1000);
    if (!std::isnan(value.present))
      require_within("present value of a varied quantity", value.present, "", value.lower,
                     value.upper);
  }
  require_within("number of search runs", options.runs, "", 1, 1000);
  for (const double power : options.norms) require_within("exponent of a norm", power, "", 2, 1000);
  require_within("smallest step as a share of a value's range", options.resolution, "", 1e-14, 0.5);
}

/// Point of the unit cube for the present values; empty where a present value is NaN.
inline Place present_place(const std::vector<MovableValue>& values) {
  Place place;
  for (const MovableValue& value : values) {
    if (std::isnan(value.present)) return {};
    place.push_back(value.by_ratio ? std::log(value.present / value.lower) /
                                         std::log(value.upper / value.lower)
                                   : (value.present - value.lower) / (value.upper - value.lower));
  }
  return place;
}

/// Step of the grid along the value with the most grid points, in the coordinates of the unit cube.
inline double grid_step(const std::vector<MovableValue>& values) {
  int most = 2;
  for (const MovableValue& value : values) most = std::max(most, value.places);
  return 1.0 / (most - 1);
}

inline Placement answer_of(LevelQuestions& questions) {
  Placement answer{{}, std::numeric_limits<double>::infinity(), 0, {}, 0};
  const Place best = questions.best();
  if (best.empty()) {
    answer.questions = questions.asked();
    return answer;
  }
  constexpr double close = 1e-4;
  const std::vector<double> levels = questions.at(best);
  const auto worst = std::max_element(levels.begin(), levels.end());
  answer.values = questions.values_at(best);
  answer.worst = *worst;
  answer.worst_at = static_cast<std::size_t>(worst - levels.begin());
  for (const double share : best)
    answer.bounds.push_back(share < close         ? PlacementBound::lower
                            : share > 1.0 - close ? PlacementBound::upper
                                                  : PlacementBound::none);
  answer.questions = questions.asked();
  return answer;
}

}  // namespace detail

/// Minimax search: finds the values of a device that minimise the largest of several levels,
///
///     min over the values of  max_k level_k(values)
///
/// The levels are quantities to be kept low, such as the vibration amplitudes of several modes. The
/// search starts from the best local minima of a grid and from the present values. From each start,
/// Ceres minimises p-norms of the levels one after the other, within the bounds and by central
/// differences. Then a direct search minimises the largest level, which is not smooth. The result
/// is the best of all points evaluated, hence at least as good as the present values. A minimum
/// narrower than the grid spacing may be missed.
/// @param values   1 … 6 device values to be varied, with their bounds
/// @param levels   function that computes the levels from the device values; it is called at each
///                 grid point and up to some thousand times more
/// @param options  options of the search
/// @throws InvalidParameter for values or options outside the ranges stated at their members.
///         Exceptions of `levels` and `options.watch` end the search and are passed on.
inline Placement best_placement(const std::vector<MovableValue>& values, const Levels& levels,
                                const PlacementOptions& options = {}) {
  detail::validate(values, options);
  detail::LevelQuestions questions(values, levels, options);
  std::vector<detail::Place> starts = detail::GridOfStarts(questions).best(options.runs);
  const detail::Place present = detail::present_place(values);
  if (!present.empty() && std::isfinite(questions.worst(present))) starts.push_back(present);
  for (const detail::Place& start : starts) {
    detail::Place place = start;
    for (const double power : options.norms) {
      const detail::Place next = detail::run_on_norm(questions, place, power);
      if (std::isfinite(questions.worst(next))) place = next;
    }
    const bool is_better = questions.worst(place) < questions.worst(start);
    detail::refine(questions, is_better ? place : start, 0.5 * detail::grid_step(values),
                   options.resolution);
  }
  return detail::answer_of(questions);
}

}  // namespace holdfast::placement
