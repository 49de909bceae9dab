#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/core/interval_sets.hpp"
#include "holdfast/math/linalg/complex_exponential.hpp"
#include "holdfast/math/roots/bracketing_root.hpp"
#include "holdfast/plant/conductor_with_absorber.hpp"
#include "holdfast/stability/boundary/unit_circle_crossings.hpp"
#include "holdfast/stability/design/minimax_amplitude.hpp"
#include "holdfast/stability/design/minimum_amplitude.hpp"
#include "holdfast/stability/design/minimum_radius.hpp"
#include "holdfast/stability/response/modal_response.hpp"
#include "holdfast/stability/response/modal_steady_response.hpp"
#include "holdfast/stability/response/response.hpp"

namespace holdfast {

/// The open intervals of D (N s/m) in which all roots λ of a loop satisfy |λ| < radius. They are
/// computed by `UnitCircleCrossings` for a loop with the roots λ/radius.
/// @param response           response of the plant given by its poles
/// @param proportional_gain  P (N/m), finite
/// @param radius             upper limit of |λ|, > 0
/// @return the intervals; none if two poles nearly coincide (see ModalResponse::at_radius)
/// @throws InvalidParameter where P is not finite
template <class Scalar>
std::vector<Interval<Scalar>> differential_gains_within_radius(
    const ModalResponse<Scalar>& response, const detail::Undeduced<Scalar>& proportional_gain,
    const detail::Undeduced<Scalar>& radius) {
  const auto scaled = response.at_radius(radius - Scalar(1));
  if (!scaled) return {};
  return UnitCircleCrossings<Scalar>(*scaled).stable_gains(FreeGain::differential,
                                                           {proportional_gain, Scalar(0)});
}

namespace detail {

/// The least ρ(P, D) − 1 over an interval of D, and its D: the best of 25 values of D, refined by
/// golden section if its ρ − 1 is not above `known`.
template <class Scalar>
std::pair<Scalar, Scalar> least_excess(const ModalResponse<Scalar>& response, const Scalar& p,
                                       const Interval<Scalar>& gains, const Scalar& known) {
  constexpr int count = 24;
  std::pair<Scalar, Scalar> best{std::numeric_limits<Scalar>::infinity(), Scalar(0)};
  const auto excess = [&](const Scalar& d) {
    const Scalar here = loop_excess_or_turn(response, PdGains<Scalar>{p, d});
    best = std::min(best, {here, d});
    return here;
  };
  const Scalar step = (gains.upper - gains.lower) / Scalar(count);
  for (int k = 0; k <= count; ++k) excess(gains.lower + Scalar(k) * step);
  if (!(best.first > known)) narrow_to_minimum(best.second - step, best.second + step, 30, excess);
  return best;
}

}  // namespace detail

/// The D of minimum spectral radius ρ for a given P and a loop given by its poles; 1 − ρ has a
/// relative accuracy of 10⁻⁶. The search is that for a `LoopMap`, which may fail where a pole is
/// close to a circle |λ| = r. Therefore ρ is also computed at 25 values of D in each bounded stable
/// interval, and refined around the best of them. The smaller minimum is returned.
/// @param response           response of the plant given by its poles; none may nearly coincide
/// @param proportional_gain  P (N/m), finite
/// @param start              initial D (N s/m), finite
/// @throws InvalidParameter where a gain is not finite
template <class Scalar>
MinimumRadius minimum_radius(const ModalResponse<Scalar>& response, double proportional_gain,
                             double start = 0.0) {
  require_finite("proportional gain P", proportional_gain, "N/m");
  require_finite("differential gain D", start, "N s/m");
  const detail::RadiusLevels<ModalResponse<Scalar>> levels{response};
  MinimumRadius found = detail::MinimumRadiusSearch(levels, proportional_gain, 1e-6).from(start);
  for (const Interval<Scalar>& stable :
       differential_gains_within_radius(response, proportional_gain, Scalar(1))) {
    if (!std::isfinite(stable.upper - stable.lower)) continue;
    const auto [excess, d] =
        detail::least_excess(response, Scalar(proportional_gain), stable, Scalar(-found.margin));
    if (!(-excess <= found.margin))
      found = {MinimumRadiusOutcome::point, d, 1.0 + excess, -excess, 0.0, {d, d}};
  }
  return found;
}

namespace detail {

/// Modulus margin of a loop as a function of D: min |p(e^{iθ})| over θ, p = 1 − P G_z − D G_v. At
/// one angle |p|² is quadratic in D. Angles between the stored ones are tested where needed.
template <class Scalar>
class ModulusLevels {
 public:
  using Nearby = typename ModalResponse<Scalar>::Nearby;
  /// The series of G about places of `circle` that have been refined; they serve every P.
  using Series = std::map<std::size_t, Nearby>;

  /// @param circle  crossings of the loop; must outlive this object
  /// @param nearby  series of that circle, extended here; must outlive this object
  ModulusLevels(const UnitCircleCrossings<Scalar>& circle, const Scalar& proportional_gain,
                Series& nearby)
      : response_(circle.response()),
        nearby_(nearby),
        proportional_gain_(proportional_gain),
        stable_(circle.stable_gains(FreeGain::differential, {proportional_gain, Scalar(0)})) {
    for (const auto& place : circle.places()) places_.push_back(at(place.angle, place.g));
  }

  /// The intervals of stable D with a modulus margin above `modulus`: |p| > modulus at all angles.
  std::vector<Interval<Scalar>> beyond(const Scalar& modulus) {
    std::vector<Nearer> nearer = nearer_than(modulus);
    for (;;) {
      std::vector<Interval<Scalar>> kept;
      std::vector<std::pair<Nearer*, bool>> ends;  // bounds of `kept`; true: a Nearer's upper end
      std::sort(nearer.begin(), nearer.end(), [](const auto& one, const auto& other) {
        return one.gains.lower < other.gains.lower;
      });
      for (const Interval<Scalar>& interval : stable_) {
        Scalar from = interval.lower;
        Nearer* before = nullptr;
        const auto keep_to = [&](const Scalar& end, Nearer* after) {
          if (!(from < end)) return;
          kept.push_back({from, end});
          if (before) ends.emplace_back(before, true);
          if (after) ends.emplace_back(after, false);
        };
        for (Nearer& gap : nearer) {
          if (gap.gains.lower >= interval.upper) break;
          keep_to(gap.gains.lower, &gap);
          if (gap.gains.upper > from) std::tie(from, before) = std::pair(gap.gains.upper, &gap);
        }
        keep_to(interval.upper, nullptr);
      }
      bool is_sharp = true;
      for (const auto& [of, upper] : ends)
        if (sharpen(*of, upper, modulus)) is_sharp = false;
      if (is_sharp) return kept;
    }
  }

  /// The largest modulus margin over D, to ten digits, and its D; 0 and NaN where no D is stable.
  std::pair<Scalar, Scalar> largest() {
    std::pair found{Scalar(0), std::numeric_limits<Scalar>::quiet_NaN()};
    if (stable_.empty()) return found;
    Scalar none(4);
    while (none - found.first > Scalar(1e-10) * none) {
      const Scalar middle = (found.first + none) / Scalar(2);
      const auto left = beyond(middle);
      if (left.empty())
        none = middle;
      else
        found = {middle, left.front().representative()};
    }
    return found;
  }

  /// The intervals of stable D.
  const std::vector<Interval<Scalar>>& stable() const { return stable_; }

 private:
  struct Place {
    Scalar angle, slope, along, rest;  // |p|² = rest − 2 along D + slope D²

    /// The interval of D with |p| < modulus at this angle.
    std::optional<Interval<Scalar>> nearer_than(const Scalar& modulus) const {
      const Scalar root = along * along - slope * (rest - modulus * modulus);
      if (!(root > Scalar(0))) return std::nullopt;
      const Scalar half = std::sqrt(root);
      return Interval<Scalar>{(along - half) / slope, (along + half) / slope};
    }
    /// The least |p|² over D.
    Scalar floor() const { return rest - along * along / slope; }
  };

  /// Interval of D with |p| below a given modulus at a tabulated angle (`Place`) or near it.
  struct Nearer {
    Interval<Scalar> gains;
    std::size_t place;
    bool lower_is_sharp = false, upper_is_sharp = false;
  };

  Place at(const Scalar& angle, const CommandResponse<Scalar>& g) const {
    const std::complex<Scalar> rest = Scalar(1) - proportional_gain_ * g.displacement;
    return {angle, std::norm(g.velocity), (rest * std::conj(g.velocity)).real(), std::norm(rest)};
  }
  /// The coefficients of |p|² at an angle near the tabulated `place`, from a series that is stored.
  Place near(std::size_t place, const Scalar& angle) {
    Nearby& nearby = nearby_.try_emplace(place, response_, circle_increment(angle)).first->second;
    return at(angle, nearby.read(angle).first);
  }

  /// The angle at which `value` is largest, between the neighbours of the tabulated `place`.
  template <class Value>
  Scalar best_about(std::size_t place, const Value& value) const {
    return narrow_to_minimum(places_[place == 0 ? 0 : place - 1].angle,
                             places_[std::min(place + 1, places_.size() - 1)].angle, 30,
                             [&](const Scalar& angle) { return -value(angle); });
  }

  /// Moves an end of an interval of D outward, to its extreme between the neighbouring angles.
  /// @return false where this end had been moved before
  bool sharpen(Nearer& of, bool upper, const Scalar& modulus) {
    bool& done = upper ? of.upper_is_sharp : of.lower_is_sharp;
    if (done) return false;
    const auto out = [&](const Scalar& angle) {
      const auto there = near(of.place, angle).nearer_than(modulus);
      const Scalar nowhere = -std::numeric_limits<Scalar>::infinity();
      return !there ? nowhere : upper ? there->upper : -there->lower;
    };
    const Scalar end = out(best_about(of.place, out));
    if (upper) of.gains.upper = std::max(of.gains.upper, end);
    if (!upper) of.gains.lower = std::min(of.gains.lower, -end);
    return done = true;
  }

  std::vector<Nearer> nearer_than(const Scalar& modulus) {
    std::vector<Nearer> nearer;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      auto gains = places_[i].nearer_than(modulus);
      const Scalar floor = places_[i].floor();
      if (!gains && floor < Scalar(4) * modulus * modulus && i > 0 && i + 1 < places_.size() &&
          floor <= places_[i - 1].floor() && floor <= places_[i + 1].floor()) {
        const Scalar least =
            best_about(i, [&](const Scalar& angle) { return -near(i, angle).floor(); });
        gains = near(i, least).nearer_than(modulus);
      }
      if (gains) nearer.push_back({*gains, i});
    }
    return nearer;
  }

  const ModalResponse<Scalar>& response_;
  Series& nearby_;
  Scalar proportional_gain_;
  std::vector<Interval<Scalar>> stable_;
  std::vector<Place> places_;
};

}  // namespace detail

/// The open intervals of D (N s/m) that the options admit for a given P and a loop given by its
/// poles. Without margin (m = 0) or with `by_decay` they are those of minimum_amplitude.hpp.
/// Otherwise each D in them stabilises the loop, has ρ < `largest_radius`, and satisfies
///
///     M(D) > m M(D*)   and   D = D* + (1 − m)(D_s − D*)
///
/// M(D) = min |1 − P G_z − D G_v| over the unit circle is the modulus margin, with the transfer
/// functions G_z and G_v of `LoopResponse`. D* maximises M, and D_s is some D in the stable
/// interval around D*. The D of minimum spectral radius ρ is unsuitable as D* for a conductor,
/// since the slowest mode alone determines its ρ.
/// Source of the modulus margin: K. J. Åström and R. M. Murray, Feedback Systems (2008), 9.3.
/// @tparam Scalar            double
/// @param response           response of the plant given by its poles
/// @param proportional_gain  P (N/m), finite
/// @param options            options within their ranges, which are not checked here
template <class Scalar>
std::vector<Interval<Scalar>> admissible_differential_gains(const ModalResponse<Scalar>& response,
                                                            double proportional_gain,
                                                            const AmplitudeOptions& options) {
  if (options.by_decay || !(options.margin > 0.0))
    return detail::gains_that_decay(response, proportional_gain, options);
  const UnitCircleCrossings<Scalar> circle(response);
  typename detail::ModulusLevels<Scalar>::Series nearby;
  detail::ModulusLevels<Scalar> levels(circle, proportional_gain, nearby);
  const auto [modulus, gain] = levels.largest();
  if (!(modulus > Scalar(0))) return {};
  const Scalar margin(options.margin);
  const auto away = intersection(levels.beyond(margin * modulus),
                                 detail::within_share(levels.stable(), gain, Scalar(1) - margin));
  if (!(options.largest_radius < 1.0)) return away;
  return intersection(away, differential_gains_within_radius(response, proportional_gain,
                                                             Scalar(options.largest_radius)));
}

/// The admissible D of least steady amplitude at one frequency, for a loop given by its poles.
/// @param loop               loop of the plant given by its poles, with the sampling of the options
/// @param options            options within their ranges; `relative_to_true_force` is not used
/// @param frequency          excitation frequency f (Hz), > 0
/// @param proportional_gain  P (N/m), finite
/// @param response           `steady_response` of the loop at f, with the reference amplitude of
///                           the ratio
/// @throws InvalidParameter where an argument is outside its admissible range
template <class Scalar>
MinimumAmplitude minimum_amplitude(const ModalResponse<Scalar>& loop,
                                   const AmplitudeOptions& options, double frequency,
                                   double proportional_gain,
                                   const SteadyResponse<Scalar>& response) {
  validate(options);
  require_positive("frequency", frequency, "Hz");
  require_finite("proportional gain P", proportional_gain, "N/m");
  return detail::minimum_amplitude_of(loop, options, frequency, proportional_gain,
                                      [&] { return response; });
}

/// Conductor given by its modes, as a model for AmplitudeBand. Amplitude ratios refer to the plant
/// without control under the true force.
template <class Scalar>
struct ConductorOverBand {
  ConductorWithAbsorber conductor;  ///< conductor with all its poles
  AmplitudeOptions options;         ///< options, of which τ, δ and the force's hold are used
  /// The zero-order-hold transfer functions G_z and G_v from the command to the readings.
  ModalResponse<Scalar> loop = modal_response<Scalar>(conductor, options.sampling);

  /// The steady response at ω (rad/s), relative to that without control under the true force.
  SteadyResponse<Scalar> response(double angular_frequency) const {
    return steady_response<Scalar>(conductor, options.sampling, options.hold, angular_frequency)
        .relative_to(true_amplitude_per_force(conductor, angular_frequency));
  }
  /// The offsets λ − 1 of the loop's roots λ; of those near the unit circle, if not all are found.
  std::vector<std::complex<double>> loop_roots(const PdGains<double>& gains) const {
    auto found = holdfast::loop_roots(loop, gains);
    if (found.empty()) return UnitCircleCrossings<Scalar>(loop).roots_nearby(gains);
    for (std::complex<double>& root : found) root -= 1.0;
    return found;
  }
  /// The step H/H′ (1/s) of Newton's method s ← s − H/H′ for zeros s (1/s) of a receptance H. With
  /// devices on the span H is the sum over the poles, else the receptance of the bare conductor.
  std::complex<double> receptance_step(const std::complex<double>& s) const {
    if (!conductor.has_devices)
      return receptance(conductor.modes, s) / detail::receptance_slope(conductor.modes, s);
    std::complex<double> sum(0.0), slope(0.0);
    for (const PlantPole& pole : conductor.poles) {
      const std::complex<double> part = pole.residue / (s - pole.s);
      sum += part;
      slope -= part / (s - pole.s);
    }
    return sum / slope;
  }
  /// The offsets e^{sτ} − 1 for the zeros s (1/s) of the amplitude without control: zeros of the
  /// receptance between neighbouring modes, and a pole of the absorber on a fixed conductor.
  std::vector<std::complex<double>> uncontrolled_zeros() const {
    const auto& modes = conductor.modes;
    const auto& absorber = conductor.absorber;
    std::vector<std::complex<double>> found;
    for (std::size_t n = 0; n + 1 < modes.size(); ++n) {
      std::complex<double> s(0.0,
                             0.5 * (modes[n].angular_frequency + modes[n + 1].angular_frequency));
      for (int step = 0; step < 30; ++step) s -= receptance_step(s);
      if (std::isfinite(std::abs(s))) found.push_back(complex_expm1(s * options.sampling.period));
    }
    const double decay = absorber.damping / (2.0 * absorber.mass);
    const std::complex<double> turn =
        std::sqrt(std::complex<double>(decay * decay - absorber.stiffness / absorber.mass));
    found.push_back(complex_expm1((turn - decay) * options.sampling.period));
    return found;
  }
};

/// The D that minimises the largest amplitude ratio (with control to without) over a band, for a
/// given P and a conductor given by its modes. For the accuracy see `minimax_amplitude`.
/// @param conductor          conductor with all its poles
/// @param options            options within their ranges; `relative_to_true_force` is not used
/// @param proportional_gain  P (N/m), finite
/// @param band               band of frequencies (Hz), 0 < lower < upper ≤ 1/(2τ)
/// @throws InvalidParameter where an argument is outside its admissible range
template <class Scalar = double>
MinimaxAmplitude modal_minimax_amplitude(const ConductorWithAbsorber& conductor,
                                         const AmplitudeOptions& options, double proportional_gain,
                                         const FrequencyBand& band) {
  validate(conductor.modes, conductor.absorber);
  return detail::minimax_over_band<ConductorOverBand<Scalar>>(conductor, options, proportional_gain,
                                                              band);
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template MinimumRadius minimum_radius(const ModalResponse<double>&, double, double);
extern template MinimumAmplitude minimum_amplitude(const ModalResponse<double>&,
                                                   const AmplitudeOptions&, double, double,
                                                   const SteadyResponse<double>&);
extern template MinimaxAmplitude modal_minimax_amplitude<double>(const ConductorWithAbsorber&,
                                                                 const AmplitudeOptions&, double,
                                                                 const FrequencyBand&);
#endif

}  // namespace holdfast
