#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/loop_input.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/math/linalg/resolvent.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/math/roots/bracketing_root.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/design/minimum_amplitude.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"
#include "holdfast/stability/polynomial/loop_polynomial.hpp"
#include "holdfast/stability/response/response.hpp"

namespace holdfast {

/// Band of excitation frequencies (Hz).
struct FrequencyBand {
  double lower;  ///< lower end (Hz), > 0
  double upper;  ///< upper end (Hz), > lower, ≤ 1/(2τ)
};

/// Validates a band. @throws InvalidParameter unless 0 < lower < upper ≤ 1/(2τ), the Nyquist limit
inline void validate(const FrequencyBand& band, double sampling_period) {
  require_positive("lower frequency", band.lower, "Hz");
  require_positive("upper minus lower frequency of the band", band.upper - band.lower, "Hz");
  require_within("upper frequency", band.upper, "Hz", 0.0, 0.5 / sampling_period);
}

/// Squared amplitude ratio (with control to without) at one frequency, as a function of D.
struct RatioAtFrequency {
  double frequency;                   ///< excitation frequency (Hz)
  RatioOfQuadratics<double> squared;  ///< squared ratio as a function of D (N s/m) for a given P
};

/// Frequency f at which the amplitude ratio is largest, with this ratio.
struct WorstFrequency {
  double frequency;  ///< frequency f (Hz)
  double ratio;  ///< amplitude ratio (with control to without); ∞ if e^{2πifτ} is a loop root
};

/// Model of a plant for AmplitudeBand: its loop, the loop's steady response and roots, and the
/// zeros of the amplitude without control.
/// @tparam Plant  type with `state_matrix()`, `control_input()` and `excitation_input()`; 4 states
template <class Plant>
struct PlantOverBand {
  Plant plant;               ///< plant of the loop
  AmplitudeOptions options;  ///< τ, δ, the hold of the force and the reference of the ratios
  SampledLoop<double> loop = sampled_loop(plant, options.sampling);          ///< sampled loop
  AffinePolynomial<double, 5> polynomial = characteristic_polynomial(loop);  ///< that of the loop

  /// The steady response of the loop at the angular frequency ω (rad/s).
  SteadyResponse<double> response(double angular_frequency) const {
    return detail::response_of_loop(plant, loop, options.hold, angular_frequency,
                                    options.relative_to_true_force);
  }
  /// The offsets λ − 1 of all roots λ of the loop.
  std::vector<std::complex<double>> loop_roots(const PdGains<double>& gains) const {
    return roots(polynomial.at(gains));
  }
  /// The offsets λ − 1 of the zeros λ of the response without control to the held force.
  std::vector<std::complex<double>> uncontrolled_zeros() const {
    const auto open_loop = resolvent<double, 4>(loop.increment);
    return roots(open_loop.between(RowVector<double, 4>::Unit(0), loop.held_excitation), 1e-14);
  }
};

/// Amplitude ratio (with control to without) over a band of frequencies.
///
/// The ratio has peaks near the frequencies of roots of the loop and of zeros of the uncontrolled
/// amplitude, if they are close to the unit circle. The width of a peak is about the distance of
/// the root or zero from the circle. So the uniform grid of frequencies is refined around the zeros
/// and, for each D, around the roots. Golden-section search then refines the highest peaks.
/// @tparam Model  PlantOverBand, or ConductorOverBand of modal_design.hpp
template <class Model>
class AmplitudeBand {
 public:
  /// Computes the steady response at 401 equidistant frequencies and at others near the zeros.
  /// @param model  model of the plant with its loop
  /// @param band   band (unchecked), 0 < lower ≤ upper ≤ 1/(2τ); one frequency if lower = upper
  AmplitudeBand(Model model, const FrequencyBand& band) : model_(std::move(model)), band_(band) {
    const int uniform = band.lower < band.upper ? 400 : 0;
    std::vector<double> frequencies(static_cast<std::size_t>(uniform) + 1, band.upper);
    for (std::size_t k = 0; k + 1 < frequencies.size(); ++k)
      frequencies[k] = band.lower + (band.upper - band.lower) * static_cast<double>(k) / uniform;
    append_about(model_.uncontrolled_zeros(), frequencies);
    std::sort(frequencies.begin(), frequencies.end());
    for (const double frequency : frequencies)
      grid_.emplace_back(frequency, model_.response(2.0 * pi<double> * frequency));
  }

  /// The squared amplitude ratio at a frequency (Hz) of the band and a P (N/m), as a function of D.
  RatioAtFrequency at(double frequency, double proportional_gain) const {
    const auto response = model_.response(2.0 * pi<double> * frequency);
    return {frequency, response.squared_ratio(proportional_gain)};
  }

  /// The frequency of the band with the largest amplitude ratio for the given P and D.
  WorstFrequency worst(const PdGains<double>& gains) const {
    const std::vector<RatioAtFrequency> points = points_for(gains);
    std::vector<double> values;
    values.reserve(points.size());
    for (const RatioAtFrequency& point : points) values.push_back(value(point, gains.differential));
    const double highest = *std::max_element(values.begin(), values.end());
    WorstFrequency worst{band_.lower, -1.0};
    for (std::size_t k = 0; k < points.size(); ++k) {
      const std::size_t left = k == 0 ? 0 : k - 1, right = std::min(k + 1, points.size() - 1);
      if (!(values[k] >= 0.5 * highest && values[k] >= values[left] && values[k] >= values[right]))
        continue;
      const auto peak =
          refined(points[left].frequency, points[k].frequency, points[right].frequency, gains);
      if (peak.ratio > worst.ratio) worst = peak;
    }
    worst.ratio = std::sqrt(worst.ratio);
    return worst;
  }

 private:
  static double value(const RatioAtFrequency& point, double differential_gain) {
    const double value = point.squared.at(differential_gain);
    // With a root of the loop on the circle, or no motion without control, the denominator is zero.
    return value >= 0.0 ? value : std::numeric_limits<double>::infinity();
  }

  /// The grid of frequencies, refined about the loop's roots.
  std::vector<RatioAtFrequency> points_for(const PdGains<double>& gains) const {
    std::vector<RatioAtFrequency> points;
    for (const auto& [frequency, response] : grid_)
      points.push_back({frequency, response.squared_ratio(gains.proportional)});
    std::vector<double> near_roots;
    append_about(model_.loop_roots(gains), near_roots);
    for (const double frequency : near_roots) points.push_back(at(frequency, gains.proportional));
    std::sort(points.begin(), points.end(),
              [](const auto& a, const auto& b) { return a.frequency < b.frequency; });
    // Only one of two points an ulp apart is a local maximum, and looks to one side alone.
    const auto same = [this](const auto& a, const auto& b) {
      return b.frequency - a.frequency < 1e-12 * band_.upper;
    };
    points.erase(std::unique(points.begin(), points.end(), same), points.end());
    return points;
  }

  /// Adds frequencies at and about the roots 1 + `from_one`, denser for roots nearer the circle.
  void append_about(const std::vector<std::complex<double>>& from_one,
                    std::vector<double>& frequencies) const {
    const double unit = 2.0 * pi<double> * model_.options.sampling.period;
    for (const std::complex<double>& mu : from_one) {
      if (mu.imag() < 0.0) continue;  // its conjugate has the same frequency
      const double centre = std::abs(std::arg(1.0 + mu)) / unit;
      const double width = std::max(std::abs(std::abs(1.0 + mu) - 1.0) / unit, 1e-9 * band_.upper);
      for (const double step : {0.0, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0}) {
        for (const double frequency : {centre - step * width, centre + step * width}) {
          if (frequency > band_.lower && frequency < band_.upper) frequencies.push_back(frequency);
        }
      }
    }
  }

  /// The largest squared ratio near `middle`, a point with a higher ratio than its two neighbours.
  WorstFrequency refined(double left, double middle, double right,
                         const PdGains<double>& gains) const {
    WorstFrequency best{middle, 0.0};
    const auto negative_value = [&](double frequency) {
      const double here = value(at(frequency, gains.proportional), gains.differential);
      if (here > best.ratio) best = {frequency, here};
      return -here;
    };
    negative_value(middle);
    const double halvings = std::log2(std::max((right - left) / (1e-9 * band_.upper), 1.0));
    detail::narrow_to_minimum(left, right, static_cast<int>(std::ceil(1.45 * halvings)),
                              negative_value);
    return best;
  }

  Model model_;
  FrequencyBand band_;
  std::vector<std::pair<double, SteadyResponse<double>>> grid_;  // frequency, response there
};

/// The outcome of the search for one D for a whole band of frequencies.
enum class MinimaxOutcome {
  found,          ///< `worst_ratio` and `lower_bound` agree to a relative 1e−8
  not_converged,  ///< they differ by more; `differential_gain` is the best D that was found
  none,           ///< no D is admissible: the numbers are NaN
};

/// Minimax design over a band: the D that, for a given P, minimises the largest amplitude ratio.
struct MinimaxAmplitude {
  MinimaxOutcome outcome;  ///< whether a D is admissible and the bounds agree
  /// The differential gain D (N s/m). It may be an end of an open interval of admissible D.
  double differential_gain = std::nan("");
  /// The largest amplitude ratio (with control to without) over the band with this D.
  double worst_ratio = std::nan("");
  double worst_frequency = std::nan("");  ///< frequency of `worst_ratio` (Hz)
  double lower_bound = std::nan("");      ///< lower bound of `worst_ratio` over all admissible D
  double attenuation = std::nan("");      ///< −20 log₁₀ of `worst_ratio` (dB)
  std::size_t worst_member = 0;  ///< index of the loop with `worst_ratio`, see FamilyOverBand
};

namespace detail {

/// Minimum over D of the largest of finitely many quotients of quadratics.
///
/// The minimum is at an end of an admissible interval, at a stationary point of one quotient (root
/// of a quadratic), or where two quotients are equal (root of a quartic). `add` finds these roots.
class WorstOfFrequencies {
 public:
  explicit WorstOfFrequencies(const std::vector<Interval<double>>& admissible)
      : admissible_(admissible) {
    for (const Interval<double>& interval : admissible) {
      for (const double end : {interval.lower, interval.upper, interval.representative()})
        if (std::isfinite(end)) candidates_.push_back(end);
    }
  }

  void add(const RatioAtFrequency& ratio) {
    consider_roots(ratio.squared.slope_numerator());
    for (const RatioAtFrequency& other : ratios_) {
      consider_roots(Vector<double, 5>(
          multiply<double, 3, 3>(ratio.squared.numerator, other.squared.denominator) -
          multiply<double, 3, 3>(other.squared.numerator, ratio.squared.denominator)));
    }
    ratios_.push_back(ratio);
  }

  /// D (N s/m) and the largest of its amplitude ratios at the collected frequencies.
  struct Least {
    double differential_gain;
    double ratio;
  };
  Least least() const {
    Least best{candidates_.front(), std::numeric_limits<double>::infinity()};
    for (const double d : candidates_) {
      double worst = 0.0;
      for (const RatioAtFrequency& ratio : ratios_) worst = std::max(worst, ratio.squared.at(d));
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
  std::vector<RatioAtFrequency> ratios_;
  std::vector<double> candidates_;
};

}  // namespace detail

/// Family of loops over one band of frequencies, with gains common to all loops.
///
/// An exchange algorithm extends a list of pairs (loop, frequency). The D with the least largest
/// ratio on the list gives a lower bound. The largest ratio of this D over all loops and the band
/// is an upper bound; its pair is added. A search at another P starts with the latest pairs.
/// @tparam Model  model of each loop, see AmplitudeBand
template <class Model>
class FamilyOverBand {
 public:
  /// @param models  models of the loops, at least one
  /// @param band    band (unchecked), 0 < lower ≤ upper ≤ 1/(2τ); one frequency if lower = upper
  FamilyOverBand(const std::vector<Model>& models, const FrequencyBand& band) {
    for (const Model& model : models) loops_.emplace_back(model, band);
    worst_.push_back({0, band.lower});
    if (band.lower < band.upper) worst_.push_back({0, band.upper});
  }

  /// The D that minimises the largest amplitude ratio over all loops and the band, at a given P.
  /// @param proportional_gain  P (N/m), finite
  /// @param admissible         open intervals of admissible D (N s/m), ascending; may be none
  /// @param enough             ratio; if `lower_bound` reaches it, the search stops unconverged
  MinimaxAmplitude least(double proportional_gain, const std::vector<Interval<double>>& admissible,
                         double enough = std::numeric_limits<double>::infinity()) {
    if (admissible.empty()) return {MinimaxOutcome::none};
    detail::WorstOfFrequencies chosen(admissible);
    for (const Worst& one : worst_)
      chosen.add(loops_[one.loop].at(one.frequency, proportional_gain));
    MinimaxAmplitude result{MinimaxOutcome::not_converged};
    result.worst_ratio = std::numeric_limits<double>::infinity();
    result.lower_bound = 0.0;
    for (int exchange = 0; exchange < 60; ++exchange) {
      const auto least = chosen.least();
      result.lower_bound = std::max(result.lower_bound, least.ratio);
      if (result.lower_bound >= enough) break;
      const auto [worst, ratio] = worst_at({proportional_gain, least.differential_gain});
      if (ratio < result.worst_ratio) {
        result.differential_gain = least.differential_gain;
        result.worst_ratio = ratio;
        result.worst_frequency = worst.frequency;
        result.worst_member = worst.loop;
      }
      if (std::abs(result.worst_ratio - result.lower_bound) <= 1e-8 * result.lower_bound) {
        result.outcome = MinimaxOutcome::found;
        break;
      }
      chosen.add(loops_[worst.loop].at(worst.frequency, proportional_gain));
      if (worst_.size() == most_kept) worst_.erase(worst_.begin());
      worst_.push_back(worst);
    }
    result.attenuation = attenuation(result.worst_ratio);
    return result;
  }

 private:
  static constexpr std::size_t most_kept = 30;  // each adds its meetings with all others

  struct Worst {
    std::size_t loop;
    double frequency;  // Hz
  };

  std::pair<Worst, double> worst_at(const PdGains<double>& gains) const {
    std::pair<Worst, double> found{{0, 0.0}, -1.0};
    for (std::size_t k = 0; k < loops_.size(); ++k) {
      const WorstFrequency here = loops_[k].worst(gains);
      if (here.ratio > found.second) found = {{k, here.frequency}, here.ratio};
    }
    return found;
  }

  std::vector<AmplitudeBand<Model>> loops_;
  std::vector<Worst> worst_;
};

namespace detail {

/// The result of `minimax_amplitude` for a model of AmplitudeBand.
template <class Model, class Plant>
MinimaxAmplitude minimax_over_band(const Plant& plant, const AmplitudeOptions& options,
                                   double proportional_gain, const FrequencyBand& band) {
  validate(options);
  require_finite("proportional gain P", proportional_gain, "N/m");
  validate(band, options.sampling.period);
  const Model model{plant, options};
  return FamilyOverBand<Model>({model}, band)
      .least(proportional_gain,
             admissible_differential_gains(model.loop, proportional_gain, options));
}

}  // namespace detail

/// The D that minimises the largest amplitude ratio (with control to without) over a band, given P.
///
/// The error is at most the gap between `worst_ratio` and `lower_bound`, unless a peak over the
/// frequencies is missed (`AmplitudeBand`). Peaks are located to 1e−9 of the upper frequency.
/// @tparam Plant             two masses, or a type with the same members and a `validate` function
/// @param plant              plant within its ranges
/// @param options            τ, δ, the hold of the force and the limits of admissible D
/// @param proportional_gain  P (N/m), finite
/// @param band               band of frequencies (Hz), 0 < lower < upper ≤ 1/(2τ)
/// @throws InvalidParameter where an argument is outside its admissible range
template <class Plant>
MinimaxAmplitude minimax_amplitude(const Plant& plant, const AmplitudeOptions& options,
                                   double proportional_gain, const FrequencyBand& band) {
  validate(plant);
  return detail::minimax_over_band<PlantOverBand<Plant>>(plant, options, proportional_gain, band);
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template MinimaxAmplitude minimax_amplitude(const TwoMass<double>&, const AmplitudeOptions&,
                                                   double, const FrequencyBand&);
#endif

}  // namespace holdfast
