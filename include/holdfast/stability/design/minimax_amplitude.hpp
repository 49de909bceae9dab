#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "holdfast/core/interval.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/design/minimum_amplitude.hpp"
#include "holdfast/stability/polynomial/loop_polynomial.hpp"
#include "holdfast/stability/response/amplitude_band.hpp"

namespace holdfast {

/// How the search for one D for a whole band of frequencies ended.
enum class MinimaxOutcome {
  found,          ///< `worst_ratio` and `lower_bound` agree to 1e−8
  not_converged,  ///< they do not; the D is still one that gives `worst_ratio`
  none,           ///< no D is admissible: the numbers are NaN
};

/// One D, at a fixed P, for all frequencies of a band.
struct MinimaxAmplitude {
  MinimaxOutcome outcome;    ///< whether a D is admissible, and whether the two bounds agree
  double differential_gain;  ///< D (N s/m); at the edge of the admissible ones a limit
  double worst_ratio;        ///< the largest amplitude ratio to no control over the band at this D
  double worst_frequency;    ///< Hz, where
  double lower_bound;        ///< no admissible D has a smaller worst ratio than this
  double attenuation;        ///< −20 log₁₀ of `worst_ratio` (dB)
};

namespace detail {

/// min over D of the largest of finitely many quotients of quadratics.
///
/// The minimum lies at an end of an admissible interval, where one quotient is stationary, or where
/// two of them cross: roots of quadratics and quartics, collected as frequencies are added.
/// @tparam Ratio  with `squared`, a quotient of quadratics in `double`, as `RatioAtFrequency`
template <class Ratio>
class WorstOfFrequencies {
 public:
  explicit WorstOfFrequencies(const std::vector<Interval<double>>& admissible)
      : admissible_(admissible) {
    for (const Interval<double>& interval : admissible) {
      for (const double end : {interval.lower, interval.upper, interval.representative()})
        if (std::isfinite(end)) candidates_.push_back(end);
    }
  }

  void add(const Ratio& ratio) {
    consider_roots(ratio.squared.slope_numerator());
    for (const Ratio& other : ratios_) {
      consider_roots(Vector<double, 5>(
          multiply<double, 3, 3>(ratio.squared.numerator, other.squared.denominator) -
          multiply<double, 3, 3>(other.squared.numerator, ratio.squared.denominator)));
    }
    ratios_.push_back(ratio);
  }

  /// D and the ratio there.
  struct Least {
    double differential_gain;
    double ratio;
  };
  Least least() const {
    Least best{candidates_.front(), std::numeric_limits<double>::infinity()};
    for (const double d : candidates_) {
      double worst = 0.0;
      for (const Ratio& ratio : ratios_) worst = std::max(worst, ratio.squared.at(d));
      if (worst < best.ratio) best = {d, worst};
    }
    best.ratio = std::sqrt(best.ratio);
    return best;
  }

 private:
  template <class Coefficients>
  void consider_roots(const Eigen::MatrixBase<Coefficients>& polynomial) {
    for (const auto& root : roots(polynomial)) {
      // Round-off parts a double root by √ε; a candidate too many does no harm.
      if (std::abs(root.imag()) > 1e-4 * std::abs(root)) continue;
      for (const Interval<double>& interval : admissible_) {
        if (interval.contains(root.real())) candidates_.push_back(root.real());
      }
    }
  }

  std::vector<Interval<double>> admissible_;
  std::vector<Ratio> ratios_;
  std::vector<double> candidates_;
};

}  // namespace detail

/// The D that minimises the largest amplitude ratio to no control over a band, at a fixed P.
///
/// Exchange of frequencies: the minimax over the few frequencies collected so far is solved
/// exactly and bounds the answer from below; the worst frequency of the whole band at that D
/// bounds it from above and is added. Both bounds are returned: their gap is the error, up to what
/// the search over frequencies misses (`AmplitudeBand`; peaks are resolved to 1e−9 of the band).
/// @tparam Plant             anything with `state_matrix()`, `control_input()` and
///                           `excitation_input()` that `validate` checks
/// @param plant              within its ranges
/// @param options            τ, δ, the hold of the force and the largest spectral radius admitted
/// @param proportional_gain  P (N/m), finite
/// @param band               Hz, 0 < lower < upper ≤ 1/(2τ)
/// @throws InvalidParameter outside the admissible ranges
template <class Plant>
MinimaxAmplitude minimax_amplitude(const Plant& plant, const AmplitudeOptions& options,
                                   double proportional_gain, const FrequencyBand& band) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  validate(plant);
  validate(options);
  require_finite("proportional gain P", proportional_gain, "N/m");
  validate(band, options.sampling.period);
  const auto loop = sampled_loop(plant, options.sampling);
  const auto admissible =
      differential_gains_within_radius(loop, proportional_gain, options.largest_radius);
  if (admissible.empty()) return {MinimaxOutcome::none, none, none, none, none, none};
  const AmplitudeBand amplitudes(plant, loop, options.hold, proportional_gain, band);
  detail::WorstOfFrequencies<RatioAtFrequency> chosen(admissible);
  for (const double frequency : {band.lower, band.upper}) chosen.add(amplitudes.at(frequency));
  MinimaxAmplitude result{MinimaxOutcome::not_converged,
                          none,
                          std::numeric_limits<double>::infinity(),
                          none,
                          0.0,
                          none};
  for (int exchange = 0; exchange < 60; ++exchange) {
    const auto model = chosen.least();
    const WorstFrequency worst = amplitudes.worst(model.differential_gain);
    result.lower_bound = std::max(result.lower_bound, model.ratio);
    if (worst.ratio < result.worst_ratio) {
      result.differential_gain = model.differential_gain;
      result.worst_ratio = worst.ratio;
      result.worst_frequency = worst.frequency;
    }
    if (std::abs(result.worst_ratio - result.lower_bound) <= 1e-8 * result.lower_bound) {
      result.outcome = MinimaxOutcome::found;
      break;
    }
    chosen.add(amplitudes.at(worst.frequency));
  }
  result.attenuation = attenuation(result.worst_ratio);
  return result;
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template MinimaxAmplitude minimax_amplitude(const TwoMass<double>&, const AmplitudeOptions&,
                                                   double, const FrequencyBand&);
#endif

}  // namespace holdfast
