#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/loop_map.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/balancing.hpp"
#include "holdfast/math/linalg/elimination.hpp"
#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/stability/boundary/boundary_point.hpp"
#include "holdfast/stability/boundary/stable_intervals.hpp"
#include "holdfast/stability/response/loop_response.hpp"

namespace holdfast {

/// A value of P or D at which a characteristic root of the loop is on the unit circle.
struct GainCrossing {
  double gain;   ///< P (N/m) or D (N s/m), finite
  double angle;  ///< θ (rad) of the root e^{±iθ}, 0 … π
};

namespace detail {

/// Free gain x(θ) = (1 − y G_fixed)/G_free at which the loop has the root e^{iθ}; y is the fixed
/// gain. G is the transfer function G_z for the gain P and G_v for D (`LoopResponse`).
template <class Scalar>
class FreeGainOnCircle {
 public:
  FreeGainOnCircle(const LoopMap<Scalar>& map, FreeGain free, const PdGains<Scalar>& gains)
      : response_(map), free_(free), gains_(gains) {}

  /// The complex value x(θ). Roots cross the unit circle where its imaginary part is 0.
  std::complex<Scalar> at(const Scalar& angle) const {
    const CommandResponse<Scalar> g = response_.at_angle(angle);
    return free_ == FreeGain::differential
               ? (Scalar(1) - gains_.proportional * g.displacement) / g.velocity
               : (Scalar(1) - gains_.differential * g.velocity) / g.displacement;
  }

  /// The zero of Im x near an approximate angle by the secant method; that angle if it diverges.
  Scalar polished(const Scalar& angle) const {
    Scalar before = angle * (Scalar(1) - Scalar(1e-7)), here = angle;
    Scalar value_before = at(before).imag(), value = at(here).imag();
    for (int step = 0; step < 6 && value != value_before && value != Scalar(0); ++step) {
      const Scalar next = here - value * (here - before) / (value - value_before);
      if (!(std::abs(next - angle) < Scalar(1e-3) * angle)) return angle;
      before = here;
      value_before = value;
      here = next;
      value = at(here).imag();
    }
    return here;
  }

 private:
  LoopResponse<Scalar> response_;
  FreeGain free_;
  PdGains<Scalar> gains_;
};

/// Angles θ, 0 < θ < π, of the eigenvalues of a pencil M − λ L on the unit circle. Eigenvalues
/// within 10⁻⁴ of the circle in the variable w of λ = (w + a)/(1 + a w) are included.
///
/// The map from λ to w maps the circle onto itself. The w are eigenvalues of the matrix
/// (L − a M)⁻¹(M − a L). λ = 0 and ∞ become w = −a and −1/a, both finite. With a near 1 the
/// eigenvalues near λ = 1 are moved apart.
/// @param spread  (1 − a)/(1 + a), 0 … 1
template <class Scalar>
std::vector<Scalar> angles_on_circle(const Matrix<Scalar, Eigen::Dynamic>& m,
                                     const Matrix<Scalar, Eigen::Dynamic>& l, Scalar spread) {
  using Square = Matrix<Scalar, Eigen::Dynamic>;
  const Scalar a = (Scalar(1) - spread) / (Scalar(1) + spread);
  const Square turned = eliminated(Square(l - a * m), Square(m - a * l));
  std::vector<Scalar> angles;
  for (const std::complex<Scalar>& w : balanced_eigenvalues<Scalar, Eigen::Dynamic>(turned)) {
    if (w.imag() > Scalar(0) && std::abs(std::abs(w) - Scalar(1)) < Scalar(1e-4))
      angles.push_back(std::arg((w + a) / (Scalar(1) + a * w)));
  }
  return angles;
}

/// The pencil M − λ L of `circle_crossings`. Its eigenvalues on the unit circle give the crossings.
/// @param s, b, h  balanced loop's map, input column and row of the free gain; b, h at any scale
template <class Scalar>
std::pair<Matrix<Scalar, Eigen::Dynamic>, Matrix<Scalar, Eigen::Dynamic>> crossing_pencil(
    const Matrix<Scalar, Eigen::Dynamic>& s, const Vector<Scalar, Eigen::Dynamic>& b,
    const RowVector<Scalar, Eigen::Dynamic>& h) {
  using Square = Matrix<Scalar, Eigen::Dynamic>;
  const Eigen::Index n = s.rows();
  const Vector<Scalar, Eigen::Dynamic> command = b / b.norm();
  const RowVector<Scalar, Eigen::Dynamic> row = h / h.norm();
  Square m = Square::Zero(2 * n + 1, 2 * n + 1), l = m;
  m.topLeftCorner(n, n) = s;
  m.col(2 * n).head(n) = command;
  m.block(n, n, n, n).setIdentity();
  m.row(2 * n).head(n) = row;
  m.row(2 * n).segment(n, n) = -row;
  l.topLeftCorner(n, n).setIdentity();
  l.block(n, n, n, n) = s;
  l.col(2 * n).segment(n, n) = command;
  return {m, l};
}

}  // namespace detail

/// All values, finite and ascending, of one gain at which a loop of any order has a root on the
/// unit circle, for a fixed value of the other gain.
///
/// Let S be the n × n map of the loop with only the fixed gain, s its input column and h the output
/// row that the free gain x multiplies (`LoopMap`). The number λ is a root if x g(λ) = 1 with g(λ)
/// = h (λI − S)⁻¹ s. At a root on the unit circle g is real, hence g(λ) = g(1/λ). Each such λ is an
/// eigenvalue, with the eigenvector (y₁, y₂, w), of a matrix pencil of size 2n + 1:
///
///     λ y₁ = S y₁ + s w,   y₂ = λ (S y₂ + s w),   h (y₁ − y₂) = 0
///
/// No crossing is missed. Eigenvalues near the circle are included, since round-off ε moves a
/// double eigenvalue off the circle by about √ε. Some returned gains may therefore have no root on
/// the circle; `stable_gains` stays correct. Cost: about 10 (2n + 1)³ multiply-adds.
/// @param map    the loop
/// @param free   the gain that varies
/// @param gains  the fixed gain, finite (unchecked); the value of the free gain is not used
template <class Scalar>
std::vector<GainCrossing> circle_crossings(const LoopMap<Scalar>& map, FreeGain free,
                                           const PdGains<Scalar>& gains) {
  const bool by_d = free == FreeGain::differential;
  const BalancedMatrix<Scalar, Eigen::Dynamic> similar(
      map.closed_map(detail::with_gain(gains, free, Scalar(0))));
  const auto pencil = detail::crossing_pencil<Scalar>(
      similar.balanced, similar.factors.cwiseInverse().cwiseProduct(map.command),
      (by_d ? map.velocity : map.displacement).cwiseProduct(similar.factors.transpose()));

  const detail::FreeGainOnCircle<Scalar> on_circle(map, free, gains);
  std::vector<GainCrossing> crossings;
  const auto add = [&](Scalar angle) {
    const Scalar gain = on_circle.at(angle).real();
    if (std::isfinite(gain)) crossings.push_back({gain, angle});
  };
  add(Scalar(0));
  add(pi<Scalar>);
  const Scalar speed = map.increment.diagonal().cwiseAbs().maxCoeff();
  for (const Scalar& angle : detail::angles_on_circle<Scalar>(
           pencil.first, pencil.second, std::clamp(speed / Scalar(4), Scalar(1e-4), Scalar(0.5))))
    add(on_circle.polished(angle));
  std::sort(crossings.begin(), crossings.end(),
            [](const GainCrossing& a, const GainCrossing& b) { return a.gain < b.gain; });
  return crossings;
}

/// The open intervals, ascending, of one gain (N/m or N s/m) in which the loop is stable; the other
/// gain is fixed. `circle_crossings` divides the axis into intervals; the spectral radius is tested
/// once in each. Adjacent stable intervals are joined if the loop is stable at their common end.
/// @param map    the loop, of any order
/// @param free   the gain that varies
/// @param gains  the fixed gain; the value of the free gain is not used
/// @throws InvalidParameter where the fixed gain is not finite
template <class Scalar>
std::vector<Interval<Scalar>> stable_gains(const LoopMap<Scalar>& map, FreeGain free,
                                           const PdGains<Scalar>& gains) {
  detail::require_held(gains, free);
  const auto stable_at = [&](Scalar x) {
    return spectral_radius(map.closed_map(detail::with_gain(gains, free, x))) < Scalar(1);
  };
  std::vector<Scalar> ends;
  for (const GainCrossing& crossing : circle_crossings(map, free, gains))
    if (ends.empty() || crossing.gain > ends.back()) ends.push_back(crossing.gain);
  Scalar reach(1e-300);
  for (const Scalar& end : ends) reach = std::max(reach, std::abs(end));
  const auto inside = [&](const Interval<Scalar>& gap) {
    if (std::isinf(gap.lower)) return std::isinf(gap.upper) ? Scalar(0) : gap.upper - reach;
    if (std::isinf(gap.upper)) return gap.lower + reach;
    return gap.lower + (gap.upper - gap.lower) / Scalar(2);
  };
  return detail::stable_gaps(ends, inside, stable_at);
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template std::vector<GainCrossing> circle_crossings(const LoopMap<double>&, FreeGain,
                                                           const PdGains<double>&);
extern template std::vector<Interval<double>> stable_gains(const LoopMap<double>&, FreeGain,
                                                           const PdGains<double>&);
#endif

}  // namespace holdfast
