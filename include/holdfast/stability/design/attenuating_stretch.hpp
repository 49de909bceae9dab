#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/loop_input.hpp"
#include "holdfast/control/loop_map.hpp"
#include "holdfast/math/linalg/balancing.hpp"
#include "holdfast/math/linalg/complex_exponential.hpp"
#include "holdfast/math/linalg/moving_spectrum.hpp"
#include "holdfast/math/roots/first_crossing.hpp"
#include "holdfast/stability/margins/sampling_family.hpp"

namespace holdfast::detail {

/// Bound of Σ a_j, j > `order`, for a_j > 0, a_{j+1}/a_j ≤ `rate`/(j + 1) and first term `next`.
inline double tail_beyond(double next, double rate, std::size_t order) {
  const double ratio = rate / static_cast<double>(order + 2);
  return ratio < 1.0 ? next / (1.0 - ratio) : std::numeric_limits<double>::infinity();
}

/// The Taylor series of e^{iωτ} − 1 within `radius` of a period τ, with `terms` terms.
inline TaylorNumber moving_phase(double omega, double period, double radius, std::size_t terms) {
  const double angle = omega * period;
  TaylorNumber result{{circle_increment(angle)}, 0.0};
  std::complex<double> term = std::polar(1.0, angle);
  for (std::size_t j = 1; j <= terms; ++j) {
    term *= std::complex<double>(0.0, omega * radius / static_cast<double>(j));
    if (j < terms) result.terms.push_back(term);
  }
  result.remainder = tail_beyond(std::abs(term), omega * radius, terms - 1);
  return result;
}

/// The Taylor series, in the sampling period τ, of the harmonic input's phasor g = cosine − i sine
/// within `radius` (s) of the map's τ. dg/dτ = A_d c + iωg for the exact force, A_d c for the held
/// force, and dA_d/dτ = A A_d, with c the plant's `excitation_input()`.
///
/// In the coordinates that balance A, let p_j and γ_j be the norms of the terms of A_d c and g and
/// r = max(‖A‖, ω) radius. Then max(γ_j r, p_j radius) grows by a factor ≤ 2 r/(j + 1) per term.
template <class Plant>
MovingVector moving_input(const Plant& plant, const LoopMap<double>& map, ForceHold hold,
                          double omega, double radius, std::size_t terms) {
  const Eigen::Index size = map.size(), n = size - map.held_commands;
  const auto input = harmonic_input(plant, map, hold, omega);
  const Eigen::MatrixXd a = plant.state_matrix();
  const BalancedMatrix<double, Eigen::Dynamic> similar(a);
  Eigen::VectorXd late = map.open_map.topLeftCorner(n, n) * plant.excitation_input();
  Eigen::VectorXcd g =
      input.cosine.template cast<std::complex<double>>() -
      std::complex<double>(0, 1) * input.sine.template cast<std::complex<double>>();
  const std::complex<double> turn(0.0, hold == ForceHold::exact ? omega : 0.0);
  MovingVector result{{g}, Eigen::VectorXd::Zero(size)};
  for (std::size_t j = 1; j <= terms; ++j) {
    const double share = radius / static_cast<double>(j);
    g *= turn * share;
    g.head(n) += share * late.template cast<std::complex<double>>();
    late = share * (a * late).eval();
    if (j < terms) result.terms.push_back(g);
  }
  const double rate = std::max(similar.balanced.cwiseAbs().rowwise().sum().maxCoeff(), omega);
  const auto norm = [&](const Eigen::VectorXd& entries) {
    return entries.cwiseQuotient(similar.factors).maxCoeff();
  };
  const double next = std::max(norm(g.head(n).cwiseAbs()), norm(late.cwiseAbs()) / rate);
  result.remainder.head(n) = tail_beyond(next, 2.0 * rate * radius, terms - 1) * similar.factors;
  return result;
}

/// The verdict on an interval of periods: `holds` if a difference of squares is proved positive.
inline Stretch stretch_of(const SquaresDifference& gap) {
  return gap.least > 0.0 ? Stretch::holds : gap.at_centre > 0.0 ? Stretch::open : Stretch::fails;
}

/// The verdict on all periods within `radius` (s) of `period`: whether the loop is proved stable
/// and the conductor's steady amplitude is proved to be below its value without control.
///
/// The closed loop's response is y = (λI − S)⁻¹ g to the excitation and Y = (λI − S)⁻¹ s to the
/// command, λ = e^{iωτ}. With the row K of gains and the row c of the conductor's displacement
///
///     Z/Z₀ = n/(n − (c Y)(K y)),   n = (c y)(1 + K Y)
///
/// so that the poles of the plant without control do not matter; Z = c y is the amplitude with
/// control, Z₀ without. Truncation of the series is bounded, round-off of its sums is not.
/// @param reference  strict upper limit of |c y| (m/N); NaN selects the limit |Z₀|
template <class Plant>
Stretch attenuation(const Plant& plant, const SamplingFamily<Plant>& family,
                    const PdGains<double>& gains, ForceHold hold, double omega, double period,
                    double radius, double reference) {
  const LoopMap<double> map = family.map_at(period);
  const TaylorMatrix closed = family.moving(map, gains, radius);
  const MovingSpectrum roots(closed);
  if (!roots.inside()) return roots.inside_at_centre() ? Stretch::open : Stretch::fails;
  const std::size_t terms = closed.terms.size();
  const TaylorNumber phase = moving_phase(omega, period, radius, terms);
  Eigen::MatrixXd rows(2, map.size());
  rows << map.conductor, gains.proportional * map.displacement + gains.differential * map.velocity;
  const auto y = roots.responses(phase, moving_input(plant, map, hold, omega, radius, terms), rows);
  if (std::isfinite(reference)) {
    TaylorNumber held{std::vector<std::complex<double>>(y[0].terms.size()), 0.0};
    held.terms[0] = reference;
    return stretch_of(squares_difference(held, y[0]));
  }
  auto by_command = roots.responses(phase, family.moving_command(map, radius), rows);
  by_command[1].terms[0] += 1.0;
  const TaylorNumber controlled = y[0] * by_command[1];
  const TaylorNumber free = sum_of(controlled, by_command[0] * y[1], -1.0);
  return stretch_of(squares_difference(free, controlled));
}

}  // namespace holdfast::detail
