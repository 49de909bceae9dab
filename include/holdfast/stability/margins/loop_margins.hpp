#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/math/poly/routh_hurwitz.hpp"
#include "holdfast/plant/linear_plant.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/boundary/stable_intervals.hpp"
#include "holdfast/stability/margins/margins.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"
#include "holdfast/stability/polynomial/loop_polynomial.hpp"

namespace holdfast {

/// What the loop of the two masses can bear as a whole: its gain, its phase and a further delay,
/// one at a time.
///
/// The characteristic polynomial is a + x b, x = 1 being a common factor of both gains, so that the
/// loop opened at the drive is L = −b/a and closes where L = 1.
struct LoopMargins {
  MarginOutcome outcome;  ///< whether the loop is stable as it is; else all below but ρ is NaN
  double unit_circle;     ///< 1 − ρ, not positive where the loop is not stable
  double largest_factor =
      std::nan("");  ///< x > 1 of both gains up to which the loop is stable; ∞ without an end
  double least_factor = std::nan("");  ///< x < 1 down to which it is, −∞ without an end
  double phase =
      std::nan("");  ///< rad; the least |φ| that makes e^{iφ}L(e^{iθ}) = 1; ∞ where |L| = 1 nowhere
  MarginEnd delay = {};  ///< towards longer δ (s), τ kept
};

namespace detail {

/// The least |arg L| on the unit circle where |L| = 1. There w = iy in the half plane's variable,
/// and |a|² − |b|² is a polynomial in Y = y².
template <class Scalar>
Scalar phase_margin(const Polynomial<Scalar, 5>& constant_part,
                    const Polynomial<Scalar, 5>& slope_part) {
  const Scalar unit = mean_root_modulus(constant_part);
  const Polynomial<Scalar, 5> a = rescaled(constant_part, unit), b = rescaled(slope_part, unit);
  const auto squared = [](const Polynomial<Scalar, 5>& p) {
    const auto even = parity_part(p, 0), odd = parity_part(p, 1);
    Polynomial<Scalar, 5> sum = Polynomial<Scalar, 5>::Zero();
    sum.template head<5>() += multiply<Scalar, 3, 3>(even, even);
    sum.template tail<5>() += multiply<Scalar, 3, 3>(odd, odd);
    return sum;
  };
  Scalar least = std::numeric_limits<Scalar>::infinity();
  for (const std::complex<Scalar>& root : roots(Polynomial<Scalar, 5>(squared(a) - squared(b)))) {
    // A double root, |L| touching 1, leaves the axis by round-off of size √ε.
    if (!(root.real() > Scalar(0)) || std::abs(root.imag()) > Scalar(1e-6) * root.real()) continue;
    const std::complex<Scalar> w(Scalar(0), std::sqrt(root.real()));
    least = std::min(least, std::abs(std::arg(-evaluate(b, w) / evaluate(a, w))));
  }
  return least;
}

}  // namespace detail

/// The margins of the loop as a whole.
///
/// Gain: the stable interval of a common factor of both gains, from all crossings of the circle
/// (`stable_intervals`). Phase: all crossovers |L| = 1, roots of one polynomial. Delay: as of
/// `stability_margins` of a plant of any order, proved stretch by stretch, up to
/// ten samples, whole ones and more.
/// @tparam Plant    two masses
/// @param plant     within its ranges
/// @param sampling  τ (s) > 0, δ (s) 0 … τ
/// @param gains     P (N/m) and D (N s/m), finite
/// @param search    of the walk along δ
/// @throws InvalidParameter for a plant, sampling, gains or search outside their ranges
template <class Plant>
LoopMargins loop_margins(const Plant& plant, const Sampling<double>& sampling,
                         const PdGains<double>& gains, const MarginSearch& search = {}) {
  static_assert(has_closed_forms<Plant>, "of the two masses");
  validate(plant);
  validate(gains);
  validate(search);
  const auto loop = detail::loop_of(plant, sampling);
  const double reserve = -detail::loop_excess(loop, gains);
  const auto polynomial = in_half_plane(characteristic_polynomial(loop));
  const Polynomial<double, 5> slope =
      gains.proportional * polynomial.proportional + gains.differential * polynomial.differential;
  LoopMargins margins{MarginOutcome::not_stable, reserve};
  for (const Interval<double>& factors : stable_intervals(polynomial.base, slope)) {
    if (!(reserve > 0.0) || !factors.contains(1.0)) continue;
    margins = {MarginOutcome::stable,
               reserve,
               factors.upper,
               factors.lower,
               detail::phase_margin(polynomial.base, slope),
               detail::delay_margin(linear_plant(plant), sampling, gains, search).above};
  }
  return margins;
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template LoopMargins loop_margins(const TwoMass<double>&, const Sampling<double>&,
                                         const PdGains<double>&, const MarginSearch&);
#endif

}  // namespace holdfast
