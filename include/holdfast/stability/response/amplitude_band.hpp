#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/loop_input.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/math/linalg/resolvent.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"
#include "holdfast/stability/response/response.hpp"

namespace holdfast {

/// A range of excitation frequencies, Hz.
struct FrequencyBand {
  double lower;  ///< Hz, > 0
  double upper;  ///< Hz, > lower, ≤ 1/(2τ)
};

/// @throws InvalidParameter unless 0 < lower < upper ≤ 1/(2τ), so that the samples show the
/// vibration
inline void validate(const FrequencyBand& band, double sampling_period) {
  require_positive("lower frequency", band.lower, "Hz");
  require_positive("width of the frequency band", band.upper - band.lower, "Hz");
  require_within("upper frequency", band.upper, "Hz", 0.0, 0.5 / sampling_period);
}

/// The squared amplitude ratio to no control at one frequency, as a function of D.
struct RatioAtFrequency {
  double frequency;                   ///< Hz
  RatioOfQuadratics<double> squared;  ///< N(D)/M(D), D in N s/m, at the P of the band
};

/// A frequency at which the amplitude ratio is largest.
struct WorstFrequency {
  double frequency;  ///< Hz
  double ratio;  ///< |Z₁| over that without control; ∞ where a root of the loop is e^{2πifτ}
};

/// The amplitude ratio to no control over a band of frequencies at a fixed P.
///
/// Peaks over the frequency belong to two things: roots of the loop close to the unit circle, where
/// the controlled amplitude is large, and zeros of the uncontrolled amplitude close to it. Both are
/// known in advance with their widths, so that the grid over the band is fine where it has to be:
/// uniform, refined about the zeros, and for each D about the loop's roots. The highest points of
/// the grid are then refined by golden-section search.
/// @tparam Plant  anything with `state_matrix()`, `control_input()` and `excitation_input()`
template <class Plant>
class AmplitudeBand {
 public:
  /// Solves for the steady response at each frequency of the grid, 401 and those about the zeros.
  /// @param plant              that of the loop
  /// @param loop               of `sampled_loop`
  /// @param hold               how the excitation enters a sample
  /// @param proportional_gain  P (N/m), finite
  /// @param band               within its range (`validate`), which is not checked here
  AmplitudeBand(const Plant& plant, const SampledLoop<double>& loop, ForceHold hold,
                double proportional_gain, const FrequencyBand& band);

  /// The squared ratio at one frequency of the band.
  RatioAtFrequency at(double frequency) const;

  /// Where in the band the ratio is largest at one D.
  WorstFrequency worst(double differential_gain) const;

 private:
  static constexpr int uniform_ = 400;

  static double value(const RatioAtFrequency& point, double differential_gain) {
    const double value = point.squared.at(differential_gain);
    // With a root of the loop on the circle, or no motion without control, the denominator is zero.
    return value >= 0.0 ? value : std::numeric_limits<double>::infinity();
  }

  /// Zeros of the uncontrolled amplitude to the held force, in powers of λ − 1.
  std::vector<std::complex<double>> uncontrolled_zeros() const;

  /// Frequencies about those of roots near the unit circle, spaced by their distance from it.
  void append_about(const std::vector<std::complex<double>>& from_one,
                    std::vector<double>& frequencies) const;

  /// The highest point between two neighbours of a grid point that is higher than both.
  WorstFrequency refined(double left, double middle, double right, double differential_gain) const;

  Plant plant_;
  SampledLoop<double> loop_;
  ForceHold hold_;
  double proportional_gain_;
  FrequencyBand band_;
  AffinePolynomial<double, 5> polynomial_;
  std::vector<RatioAtFrequency> grid_;
};

template <class Plant>
AmplitudeBand<Plant>::AmplitudeBand(const Plant& plant, const SampledLoop<double>& loop,
                                    ForceHold hold, double proportional_gain,
                                    const FrequencyBand& band)
    : plant_(plant),
      loop_(loop),
      hold_(hold),
      proportional_gain_(proportional_gain),
      band_(band),
      polynomial_(characteristic_polynomial(loop)) {
  std::vector<double> frequencies;
  for (int k = 0; k <= uniform_; ++k)
    frequencies.push_back(band.lower + (band.upper - band.lower) * k / uniform_);
  append_about(uncontrolled_zeros(), frequencies);
  std::sort(frequencies.begin(), frequencies.end());
  for (const double frequency : frequencies) grid_.push_back(at(frequency));
}

template <class Plant>
RatioAtFrequency AmplitudeBand<Plant>::at(double frequency) const {
  const double omega = 2.0 * pi<double> * frequency;
  const SteadyResponse<double> response(loop_, harmonic_input(plant_, loop_, hold_, omega), omega);
  return {frequency, response.squared_ratio(proportional_gain_)};
}

template <class Plant>
WorstFrequency AmplitudeBand<Plant>::worst(double differential_gain) const {
  std::vector<RatioAtFrequency> points = grid_;
  std::vector<double> near_roots;
  append_about(roots(polynomial_.at({proportional_gain_, differential_gain})), near_roots);
  for (const double frequency : near_roots) points.push_back(at(frequency));
  std::sort(points.begin(), points.end(),
            [](const auto& a, const auto& b) { return a.frequency < b.frequency; });
  // Of two points an ulp apart only one is a local maximum, and looks to one side alone.
  const auto same = [this](const auto& a, const auto& b) {
    return b.frequency - a.frequency < 1e-12 * band_.upper;
  };
  points.erase(std::unique(points.begin(), points.end(), same), points.end());
  std::vector<double> values;
  values.reserve(points.size());
  for (const RatioAtFrequency& point : points) values.push_back(value(point, differential_gain));
  const double highest = *std::max_element(values.begin(), values.end());
  WorstFrequency worst{band_.lower, -1.0};
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::size_t left = k == 0 ? 0 : k - 1, right = std::min(k + 1, points.size() - 1);
    if (!(values[k] >= 0.5 * highest && values[k] >= values[left] && values[k] >= values[right]))
      continue;
    const auto peak = refined(points[left].frequency, points[k].frequency, points[right].frequency,
                              differential_gain);
    if (peak.ratio > worst.ratio) worst = peak;
  }
  worst.ratio = std::sqrt(worst.ratio);
  return worst;
}

template <class Plant>
std::vector<std::complex<double>> AmplitudeBand<Plant>::uncontrolled_zeros() const {
  const auto open_loop = resolvent<double, 4>(loop_.increment);
  return roots(open_loop.between(RowVector<double, 4>::Unit(0), loop_.held_excitation), 1e-14);
}

template <class Plant>
void AmplitudeBand<Plant>::append_about(const std::vector<std::complex<double>>& from_one,
                                        std::vector<double>& frequencies) const {
  const double unit = 2.0 * pi<double> * loop_.sampling.period;
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

template <class Plant>
WorstFrequency AmplitudeBand<Plant>::refined(double left, double middle, double right,
                                             double differential_gain) const {
  constexpr double golden = 0.61803398874989485;
  WorstFrequency best{middle, value(at(middle), differential_gain)};
  double low = left, high = right;
  while (high - low > 1e-9 * band_.upper) {
    const double inner = high - golden * (high - low), outer = low + golden * (high - low);
    const double at_inner = value(at(inner), differential_gain);
    const double at_outer = value(at(outer), differential_gain);
    if (at_inner > best.ratio) best = {inner, at_inner};
    if (at_outer > best.ratio) best = {outer, at_outer};
    (at_inner > at_outer ? high : low) = at_inner > at_outer ? outer : inner;
  }
  return best;
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template class AmplitudeBand<TwoMass<double>>;
#endif

}  // namespace holdfast
