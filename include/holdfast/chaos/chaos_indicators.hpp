#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "holdfast/chaos/classification.hpp"
#include "holdfast/chaos/lyapunov_spectrum.hpp"
#include "holdfast/chaos/recurrence.hpp"
#include "holdfast/chaos/switching_complexity.hpp"
#include "holdfast/chaos/zero_one_test.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/reflections.hpp"
#include "holdfast/math/signal/spectrum.hpp"
#include "holdfast/math/signal/spectrum_lines.hpp"

namespace holdfast {

/// The options of chaos_indicators(). The defaults suit motions with periods of up to a few
/// thousand samples.
struct IndicatorOptions {
  std::int64_t transient = 5000;  ///< samples left out at the start, 0 … 10⁷
  std::int64_t samples = 20160;  ///< number of samples examined, 2000 … 100 000. If divisible by 2,
                                 ///< 3, 5 and 7, it is a multiple of most short periods
  double base_frequency = 1.0;  ///< frequency f of the forcing (cycles per sample), > 0; spectral
                                ///< lines are sought at the multiples of f/m, m = 1, 2, …
  std::int64_t zero_one_stride = 1;  ///< the 0–1 test uses every n-th sample, n = 1 … samples/500
  bool forcing_incommensurate = false;  ///< whether forcing and sampling have no common period
};

/// Validates `transient`, `samples` and `zero_one_stride`. @throws InvalidParameter out of range
inline void validate(const IndicatorOptions& options) {
  const auto samples = static_cast<double>(options.samples);
  require_within("transient", static_cast<double>(options.transient), "samples", 0.0, 1e7);
  require_within("number of samples", samples, "", 2000.0, 1e5);
  require_within("stride of the 0-1 test", static_cast<double>(options.zero_one_stride), "samples",
                 1.0, samples / 500.0);
}

namespace detail {

/// The largest exponent of a spectrum of at least 64 steps, with its 99 % interval.
template <int Size>
ExponentEstimate largest_exponent(const LyapunovSpectrum<double, Size>& spectrum) {
  const SettledMeans<Size> found = spectrum.settled();
  Eigen::Index which = 0;
  const double value = found.means.maxCoeff(&which);
  return exponent_estimate(value, found.standard_errors[which]);
}

/// Detector of divergence: |x_i| over 10³⁰ times the largest |x_i| of the first 100 samples.
template <int Size>
class DivergenceGuard {
 public:
  explicit DivergenceGuard(const Vector<double, Size>& initial)
      : largest_(initial.cwiseAbs()), reference_(largest_.maxCoeff()) {}

  /// Whether the next state is not finite or exceeds the bound; to be called once per sample.
  bool leaves(const Vector<double, Size>& state) {
    if (!state.allFinite()) return true;
    largest_ = largest_.cwiseMax(state.cwiseAbs());
    const double size = largest_.maxCoeff();
    if (++seen_ <= 100) reference_ = size;
    return reference_ > 0.0 && size / 1e30 > reference_;
  }

  /// The largest |x_i| so far, for each coordinate.
  const Vector<double, Size>& largest() const { return largest_; }

 private:
  Vector<double, Size> largest_;
  double reference_;
  int seen_ = 0;
};

inline double extent_of(const std::vector<double>& series, std::size_t from, std::size_t to) {
  const auto begin = series.begin();
  const auto [low, high] = std::minmax_element(begin + static_cast<std::ptrdiff_t>(from),
                                               begin + static_cast<std::ptrdiff_t>(to));
  return *high - *low;
}

/// The ratio of extents (max − min), last to first quarter of a series; empty if the first is 0.
inline std::optional<double> extent_growth(const std::vector<double>& series) {
  const std::size_t size = series.size(), quarter = size / 4;
  const double first = extent_of(series, 0, quarter);
  if (!(first > 0.0)) return std::nullopt;
  return extent_of(series, size - quarter, size) / first;
}

template <class Series>
SpectralIndicators spectral_indicators(const Series& series, double base_frequency) {
  const std::size_t size = series.size();
  const auto whole = amplitude_spectrum(series, 1.0, SpectralWindow::rectangular);
  const auto narrow = amplitude_spectrum(series, 1.0, SpectralWindow::hann);
  const SubharmonicOptions subharmonic{base_frequency, 128};
  return {subharmonic_shares(whole, size, subharmonic).division, subharmonic.share,
          lines_holding(whole, size, 0.99), continuous_share(narrow, size)};
}

inline std::vector<double> every(const std::vector<double>& series, std::int64_t stride) {
  std::vector<double> thinned;
  for (std::size_t n = 0; n < series.size(); n += static_cast<std::size_t>(stride))
    thinned.push_back(series[n]);
  return thinned;
}

/// Sets the indicators `repeat`, `closest_return` and `determinism` from the states of a motion.
/// @param sizes  largest |x_i| since the start, for each coordinate
template <int Size>
void classify_returns(const std::vector<Vector<double, Size>>& states,
                      const Vector<double, Size>& sizes, ChaosIndicators& indicators) {
  constexpr double repeat_tolerance = 1e-9, recurrence_radius = 0.05;
  indicators.repeat = repeats_after<Size>(states, repeat_tolerance, 3, sizes);
  const std::vector<Vector<double, Size>> last(states.end() - 1000, states.end());
  indicators.closest_return = closest_return<Size>(last);
  indicators.determinism = recurrence_determinism<Size>(last, recurrence_radius);
}

/// The Lyapunov exponents of a discrete system from its tangent maps; none without a map. Before
/// restart() only the basis is advanced; nothing is averaged.
template <int Size>
class TangentMaps {
 public:
  using OfState = std::function<Matrix<double, Size>(const Vector<double, Size>&)>;

  /// @param map  tangent map of a state; it must outlive this object
  TangentMaps(Eigen::Index size, const OfState& map)
      : map_(map), basis_(Matrix<double, Size>::Identity(size, size)), spectrum_(basis_) {}

  void push(const Vector<double, Size>& before) {
    if (!map_) return;
    if (counts_) return spectrum_.push(map_(before));
    Matrix<double, Size> stretched = map_(before) * basis_;
    basis_ = orthogonal_factor(stretched);
  }
  void restart() {
    counts_ = true;
    spectrum_ = LyapunovSpectrum<double, Size>(basis_);
  }
  const LyapunovSpectrum<double, Size>& spectrum() const { return spectrum_; }

 private:
  const OfState& map_;
  Matrix<double, Size> basis_;
  LyapunovSpectrum<double, Size> spectrum_;
  bool counts_ = false;
};

/// Runs a discrete system and computes all indicators of chaos_indicators() except the exponent.
/// @param tangents  tangent vectors: push(before) is called after each step with the state before
///                  it, restart() before the first step after the transient
template <int Size, class Tangents>
ChaosIndicators indicators_of_system(
    const Vector<double, Size>& initial, const std::function<void(Vector<double, Size>&)>& advance,
    const std::function<double(const Vector<double, Size>&)>& observable,
    const IndicatorOptions& options, Tangents& tangents, const std::function<bool()>& contact) {
  validate(options);
  for (const double entry : initial) require_finite("initial state", entry, "");
  ChaosIndicators indicators;
  indicators.forcing_incommensurate = options.forcing_incommensurate;
  DivergenceGuard<Size> guard(initial);
  std::vector<Vector<double, Size>> states;
  std::vector<double> observed;
  std::vector<bool> itinerary;
  Vector<double, Size> state = initial;
  for (std::int64_t index = 0; index < options.transient + options.samples; ++index) {
    const bool is_looked_at = index >= options.transient;
    const Vector<double, Size> before = state;
    advance(state);
    if (guard.leaves(state)) {
      indicators.diverged_at = index + 1;
      return indicators;
    }
    if (index == options.transient) tangents.restart();
    tangents.push(before);
    if (!is_looked_at) continue;
    states.push_back(before);
    observed.push_back(observable(before));
    if (contact) itinerary.push_back(contact());
  }
  classify_returns<Size>(states, guard.largest(), indicators);
  indicators.zero_one = zero_one_test(every(observed, options.zero_one_stride));
  indicators.lines = spectral_indicators(observed, options.base_frequency);
  indicators.extent_growth = extent_growth(observed);
  if (contact) indicators.switching = switching_complexity(itinerary);
  return indicators;
}

}  // namespace detail

/// Runs a discrete system and computes the indicators from which `classify` classifies its motion.
///
///     auto logistic = [](Vector<double, 1>& x) { x[0] = 4 * x[0] * (1 - x[0]); };
///     auto value = [](const Vector<double, 1>& x) { return x[0]; };
///     auto slope = [](const Vector<double, 1>& x) { return Matrix<double, 1>(4 - 8 * x[0]); };
///     classify(chaos_indicators<1>({0.3}, logistic, value, {}, slope)).kind;  // chaotic
///
/// The functions may have internal state, for example the index of a forcing. Each step calls
/// `advance(state)`, then `tangent` with the state before the step. Only steps after the transient
/// count in the exponents; they also call `contact()`.
///
/// A motion diverges if a state is not finite or exceeds 10³⁰ times the largest coordinate of the
/// first 100 samples; then only `diverged_at` is set. Otherwise `repeat` holds the smallest lag n ≤
/// samples/6 for which every state x_j of the second half is within 10⁻⁹ of x_{j−n}.
/// `closest_return` and `determinism` (radius 0.05) are computed from the last 1000 states. All
/// distances are those of `RelativeDistance`. `lines` uses the multiples of f/m for m = 1 … 128.
/// Work: transient + samples steps, the 0–1 test, two spectra, a search for repetition (at most
/// samples²/12 distances), and 10⁶ distances.
/// @param initial     the state at sample 0
/// @param advance     function that replaces a state by the next one
/// @param observable  scalar function of a state, for spectrum, 0–1 test and `extent_growth`
/// @param options     numbers of samples, base frequency and stride of the 0–1 test
/// @param tangent     Jacobian ∂(next state)/∂(state), Size × Size; empty: no exponents
/// @param contact     whether the drive transmits a force in the last step; empty: no contacts
/// @throws InvalidParameter for options out of their ranges or an initial state that is not finite
template <int Size>
ChaosIndicators chaos_indicators(
    const Vector<double, Size>& initial, const std::function<void(Vector<double, Size>&)>& advance,
    const std::function<double(const Vector<double, Size>&)>& observable,
    const IndicatorOptions& options = {},
    const std::function<Matrix<double, Size>(const Vector<double, Size>&)>& tangent = {},
    const std::function<bool()>& contact = {}) {
  detail::TangentMaps<Size> tangents(initial.size(), tangent);
  ChaosIndicators indicators =
      detail::indicators_of_system<Size>(initial, advance, observable, options, tangents, contact);
  if (tangent && !indicators.diverged_at)
    indicators.largest_exponent = detail::largest_exponent(tangents.spectrum());
  return indicators;
}

}  // namespace holdfast
