#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "holdfast/chaos/classification.hpp"
#include "holdfast/chaos/leading_exponent.hpp"
#include "holdfast/chaos/recurrence.hpp"
#include "holdfast/chaos/switching_complexity.hpp"
#include "holdfast/chaos/zero_one_test.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/signal/spectrum.hpp"
#include "holdfast/math/signal/spectrum_lines.hpp"

namespace holdfast {

/// How much of a motion to look at, and how closely. The defaults fit motions of up to a few
/// thousand samples a period.
struct IndicatorOptions {
  std::int64_t transient = 5000;  ///< samples left out first, 0 … 10⁷
  std::int64_t samples = 20160;  ///< samples looked at, 2000 … 100 000; divisible by 2, 3, 5, 7 so
                                 ///< that many periods fit whole
  double repeat_tolerance = 1e-9;  ///< of a repeat, relative to the extent
  std::int64_t repeats = 3;  ///< how often a period has to repeat in half of the samples, ≥ 1
  double recurrence_radius = 0.05;        ///< relative to the extent
  std::int64_t recurrence_states = 1000;  ///< the last so many for closest return and recurrence,
                                          ///< 2 … 5000
  double base_frequency = 1.0;       ///< cycles per sample whose divisions the lines are asked for
  int largest_division = 128;        ///< of the base frequency
  std::int64_t zero_one_stride = 1;  ///< every so many samples for the 0–1 test, 1 … samples/500
  double divergence_growth = 1e30;   ///< growth of the state over its size in the first 100 samples
                                     ///< that counts as divergence
  bool forcing_incommensurate = false;  ///< see ChaosIndicators
};

/// @throws InvalidParameter for a member outside its range
inline void validate(const IndicatorOptions& options) {
  require_within("transient", static_cast<double>(options.transient), "samples", 0.0, 1e7);
  require_within("number of samples", static_cast<double>(options.samples), "", 2000.0, 1e5);
  require_within("recurrence states", static_cast<double>(options.recurrence_states), "", 2.0,
                 5000.0);
  const double most_stride = static_cast<double>(options.samples) / 500.0;
  require_within("stride of the 0-1 test", static_cast<double>(options.zero_one_stride), "samples",
                 1.0, most_stride);
  require_within("growth that counts as divergence", options.divergence_growth, "", 1e3, 1e200);
}

/// Stands for a tangent map that is not known: no exponents are found.
struct NoTangent {};

/// Stands for a system without contacts.
struct NoContact {};

namespace detail {

/// Notes when a state has grown beyond all measure.
template <int Size>
class DivergenceGuard {
 public:
  DivergenceGuard(double growth, const Vector<double, Size>& initial)
      : growth_(growth), largest_(initial.cwiseAbs()), reference_(largest_.maxCoeff()) {}

  /// True where the state is not finite or has left the bounds.
  bool leaves(const Vector<double, Size>& state) {
    if (!state.allFinite()) return true;
    largest_ = largest_.cwiseMax(state.cwiseAbs());
    const double size = largest_.maxCoeff();
    if (++seen_ <= 100) reference_ = size;
    return reference_ > 0.0 && size / growth_ > reference_;
  }

  /// Largest |x_i| so far, coordinate by coordinate.
  const Vector<double, Size>& largest() const { return largest_; }

 private:
  double growth_;
  Vector<double, Size> largest_;
  double reference_;
  int seen_ = 0;
};

/// What a run has collected.
template <int Size>
struct CollectedMotion {
  std::optional<std::int64_t> diverged_at;
  std::vector<Vector<double, Size>> states;
  std::vector<double> observed;
  std::vector<bool> itinerary;
  Vector<double, Size> largest;  // |x_i| since the start
  std::optional<ExponentEstimate> largest_exponent;
};

/// Runs transient and samples.
template <int Size, class Advance, class Observable, class Tangent, class Contact>
CollectedMotion<Size> collected_motion(const Vector<double, Size>& initial, Advance& advance,
                                       Observable& observable, Tangent& tangent, Contact& contact,
                                       const IndicatorOptions& options) {
  CollectedMotion<Size> motion;
  DivergenceGuard<Size> guard(options.divergence_growth, initial);
  LeadingExponent<Size> exponent(options.samples, initial.size());
  Vector<double, Size> state = initial, previous = initial;
  std::int64_t index = 0;
  // One step; false where the motion has diverged.
  const auto step = [&] {
    previous = state;
    advance(state);
    ++index;
    if (!guard.leaves(state)) return true;
    motion.diverged_at = index;
    return false;
  };
  while (index < options.transient) {
    if (!step()) return motion;
    if constexpr (!std::is_same_v<Tangent, NoTangent>) exponent.settle(tangent(previous));
  }
  motion.states.reserve(static_cast<std::size_t>(options.samples));
  motion.observed.reserve(static_cast<std::size_t>(options.samples));
  for (std::int64_t taken = 0; taken < options.samples; ++taken) {
    motion.states.push_back(state);
    motion.observed.push_back(observable(state));
    if (!step()) return motion;
    if constexpr (!std::is_same_v<Tangent, NoTangent>) exponent.push(tangent(previous));
    if constexpr (!std::is_same_v<Contact, NoContact>) motion.itinerary.push_back(contact());
  }
  motion.largest = guard.largest();
  if constexpr (!std::is_same_v<Tangent, NoTangent>)
    motion.largest_exponent = exponent.indicators();
  return motion;
}

inline double extent_of(const std::vector<double>& series, std::size_t from, std::size_t to) {
  const auto begin = series.begin();
  const auto [low, high] = std::minmax_element(begin + static_cast<std::ptrdiff_t>(from),
                                               begin + static_cast<std::ptrdiff_t>(to));
  return *high - *low;
}

/// Extent of the last quarter over that of the first; nothing for a series that rests in the first.
inline std::optional<double> extent_growth(const std::vector<double>& series) {
  const std::size_t size = series.size(), quarter = size / 4;
  const double first = extent_of(series, 0, quarter);
  if (!(first > 0.0)) return std::nullopt;
  return extent_of(series, size - quarter, size) / first;
}

template <class Series>
SpectralIndicators spectral_indicators(const Series& series, const IndicatorOptions& options) {
  const std::size_t size = series.size();
  const auto whole = amplitude_spectrum(series, 1.0, SpectralWindow::rectangular);
  const auto narrow = amplitude_spectrum(series, 1.0, SpectralWindow::hann);
  const SubharmonicOptions subharmonic{options.base_frequency, options.largest_division};
  return {subharmonic_shares(whole, size, subharmonic).division, subharmonic.share,
          lines_holding(whole, size, 0.99), continuous_share(narrow, size)};
}

inline std::vector<double> every(const std::vector<double>& series, std::int64_t stride) {
  std::vector<double> thinned;
  for (std::size_t n = 0; n < series.size(); n += static_cast<std::size_t>(stride))
    thinned.push_back(series[n]);
  return thinned;
}

/// What the collected series show.
template <int Size>
ChaosIndicators weighed(const CollectedMotion<Size>& motion, const IndicatorOptions& options) {
  ChaosIndicators indicators;
  indicators.forcing_incommensurate = options.forcing_incommensurate;
  indicators.largest_exponent = motion.largest_exponent;
  const RepeatSearch repeat =
      repeats_after<Size>(motion.states, options.repeat_tolerance,
                          static_cast<std::size_t>(options.repeats), motion.largest);
  indicators.repeat =
      RepetitionIndicators{static_cast<std::int64_t>(repeat.lag),
                           static_cast<std::int64_t>(repeat.largest_lag), options.repeat_tolerance};
  const auto kept = std::min(options.recurrence_states, static_cast<std::int64_t>(options.samples));
  const std::vector<Vector<double, Size>> last(motion.states.end() - kept, motion.states.end());
  indicators.closest_return = closest_return<Size>(last);
  indicators.recurrence = recurrence_shares<Size>(last, options.recurrence_radius);
  indicators.zero_one = zero_one_test(every(motion.observed, options.zero_one_stride)).median;
  indicators.lines = spectral_indicators(motion.observed, options);
  indicators.extent_growth = extent_growth(motion.observed);
  if (!motion.itinerary.empty()) indicators.switching = switching_complexity(motion.itinerary);
  return indicators;
}

}  // namespace detail

/// Runs a discrete system and computes the indicators that `classify` weighs.
///
///     auto logistic = [](Vector<double, 1>& x) { x[0] = 4 * x[0] * (1 - x[0]); };
///     auto value = [](const Vector<double, 1>& x) { return x[0]; };
///     auto slope = [](const Vector<double, 1>& x) { return Matrix<double, 1>(4 - 8 * x[0]); };
///     classify(chaos_indicators<1>({0.3}, logistic, value, {}, slope)).kind;  // chaotic
///
/// Each callable may keep a state of its own, as a forcing does its index. A step first calls
/// `advance(state)`, which replaces the state by the next one, then `tangent(before)` and
/// `contact()`, both of the step just taken. The basis of the exponents turns through the whole
/// transient before their means begin.
///
/// A motion diverges when its state is not finite or has grown by `divergence_growth` over the
/// largest coordinate of its first 100 samples; nothing else is then looked at. Bounded work:
/// transient + samples steps, the 0–1 test, one search for repetition (at worst samples²/12
/// distances), two spectra, and recurrence_states² distances.
/// @param initial     the state at sample 0
/// @param advance     void(Vector<double, Size>&)
/// @param observable  double(const Vector<double, Size>&), the number that spectrum and 0–1 test
///                    see
/// @param options     how much of the motion to look at, and how closely
/// @param tangent     Matrix<double, Size>(const Vector<double, Size>&), or NoTangent
/// @param contact     bool(), true where the drive transmits, or NoContact
/// @throws InvalidParameter for a plan out of its ranges or an initial state that is not finite
template <int Size, class Advance, class Observable, class Tangent = NoTangent,
          class Contact = NoContact>
ChaosIndicators chaos_indicators(const Vector<double, Size>& initial, Advance advance,
                                 Observable observable, const IndicatorOptions& options = {},
                                 Tangent tangent = {}, Contact contact = {}) {
  validate(options);
  for (Eigen::Index i = 0; i < initial.size(); ++i) require_finite("initial state", initial[i], "");
  const auto motion =
      detail::collected_motion<Size>(initial, advance, observable, tangent, contact, options);
  if (!motion.diverged_at) return detail::weighed<Size>(motion, options);
  ChaosIndicators indicators;
  indicators.forcing_incommensurate = options.forcing_incommensurate;
  indicators.diverged_at = motion.diverged_at;
  return indicators;
}

}  // namespace holdfast
