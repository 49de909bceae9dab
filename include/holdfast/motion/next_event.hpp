#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "holdfast/contact/contact_guard.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/roots/first_root.hpp"
#include "holdfast/math/roots/series.hpp"
#include "holdfast/motion/taylor_step.hpp"
#include "holdfast/plant/affine_dynamics.hpp"

namespace holdfast {

/// A time interval of a motion in one contact mode, short enough for one Taylor series.
/// @tparam States  N, the order of the plant
template <int States>
struct ModeStretch {
  Vector<double, States> state;  ///< state x at the beginning, N × 1
  double command;                ///< command u in force (N)
  Series force;   ///< coefficients F_k (N); force Σ F_k y^k at the time y h (s), 0 ≤ y ≤ 1
  double length;  ///< length h (s), ≥ 0
};

/// The first zero of a contact mode's guards within a ModeStretch.
/// @tparam States  N, the order of the plant
template <int States>
struct NextEvent {
  int guard = -1;                             ///< number of the guard; −1: no guard reaches zero
  FirstRoot root{RootOutcome::none, 1.0, 0};  ///< first zero; `at` = 0: beginning, 1: end
  std::array<double, 2> signs{};  ///< sign (±1) found for a guard of unknown sign; 0 for others
  Vector<double, States> state =
      {};  ///< state x at the zero, N × 1; without a zero, at the end of the stretch
};

namespace detail {

/// Zeroes leading coefficients of a guard's series that are rounding errors after a contact change.
template <int States>
void clear_rounding(const GuardOf<States>& guard, const ModeStretch<States>& stretch,
                    const TaylorStep<States>& motion, Series& series) {
  constexpr double rounding = 4.0 * std::numeric_limits<double>::epsilon();
  double known = std::abs(guard.command * stretch.command) + std::abs(guard.constant);
  for (Eigen::Index k = 0; k < series.size(); ++k, known = 0.0) {
    const double size = guard.state.cwiseAbs().dot(motion.coefficients().col(k).cwiseAbs()) +
                        std::abs(guard.force * stretch.force[k]) + known;
    if (std::abs(series[k]) > rounding * size) return;
    series[k] = 0.0;
  }
}

template <int States>
Series guard_series(const GuardOf<States>& guard, const ModeStretch<States>& stretch,
                    const TaylorStep<States>& motion) {
  Series series = (guard.state.transpose() * motion.coefficients()).transpose();
  if (guard.force != 0.0) series += guard.force * stretch.force;
  series[0] += guard.command * stretch.command + guard.constant;
  const Eigen::Index zeros = std::min<Eigen::Index>(guard.zeros, series.size());
  series.head(zeros).setZero();
  clear_rounding(guard, stretch, motion, series);
  return series;
}

/// The sign of the first nonzero coefficient of a series; 0 where all are zero. Leading
/// coefficients that are rounding errors, below 10⁻¹² of the sum of all moduli, are set to zero.
inline double first_sign(Series& series) {
  double size = 0.0;
  for (const double term : series) size += std::abs(term);
  const double rounding = 1e-12 * size;
  Eigen::Index leading = 0;
  while (leading < series.size() && std::abs(series[leading]) <= rounding) ++leading;
  series.head(leading).setZero();
  if (leading == series.size()) return 0.0;
  return series[leading] > 0.0 ? 1.0 : -1.0;
}

}  // namespace detail

/// Finds the earliest zero of a contact mode's guards within a ModeStretch, by Taylor series. No
/// zero is missed (math/roots/first_root.hpp). Without a zero, `guard` of the result is −1 and
/// `state` is at the end of the stretch. Work for a plant of order N: N² + 2 N multiply-adds for
/// each term of the series, 2 N for each guard and term, and the search for the zero.
/// @param dynamics  equations of motion in the mode
/// @param guards    guards of the mode, functions that are positive while the contact persists
/// @param stretch   time interval with its initial state, at most 1/‖A‖ (s) long; A: state matrix
template <int States>
NextEvent<States> next_event(const AffineDynamicsOf<States>& dynamics,
                             const GuardsOf<States>& guards, const ModeStretch<States>& stretch) {
  const TaylorStep<States> motion(dynamics, stretch.state, stretch.command, stretch.force,
                                  stretch.length);
  NextEvent<States> first;
  for (int g = 0; g < guards.count; ++g) {
    const GuardOf<States>& guard = guards.guard[static_cast<std::size_t>(g)];
    Series series = detail::guard_series(guard, stretch, motion);
    if (guard.unsigned_yet) {
      double& sign = first.signs[static_cast<std::size_t>(g)];
      sign = detail::first_sign(series);
      if (sign != 0.0) series *= sign;
    }
    const FirstRoot root = first_root(series);
    if (root.outcome == RootOutcome::none || (first.guard >= 0 && root.at >= first.root.at))
      continue;
    first.guard = g;
    first.root = root;
  }
  first.state = motion.state(first.guard < 0 ? 1.0 : first.root.at);
  return first;
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template NextEvent<4> next_event(const AffineDynamicsOf<4>&, const GuardsOf<4>&,
                                        const ModeStretch<4>&);
extern template NextEvent<Eigen::Dynamic> next_event(const AffineDynamicsOf<Eigen::Dynamic>&,
                                                     const GuardsOf<Eigen::Dynamic>&,
                                                     const ModeStretch<Eigen::Dynamic>&);
#endif

}  // namespace holdfast
