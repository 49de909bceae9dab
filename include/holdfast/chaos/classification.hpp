#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string>

#include "holdfast/chaos/recurrence.hpp"
#include "holdfast/chaos/switching_complexity.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/math/stats/student_quantile.hpp"

namespace holdfast {

/// What a motion of a discrete system is.
enum class AttractorType {
  periodic,               ///< the same after N samples
  quasi_periodic,         ///< two or more frequencies without a common period, neighbours stay near
  irregular_contracting,  ///< neighbours come together, yet no repetition was found
  chaotic,                ///< bounded, and neighbours separate exponentially
  diverges,               ///< leaves every bound
  undecided,              ///< the indicators are missing or contradict each other
};

/// The largest Lyapunov exponent and its 95 % interval, value ± half_width.
struct ExponentEstimate {
  double value;                ///< −∞ where every direction is a null direction
  double half_width;           ///< ≥ 0
  std::string per = "sample";  ///< the step that the exponent is of

  /// The whole interval is above zero.
  bool positive() const { return value - half_width > 0.0; }
  /// The whole interval is below zero.
  bool negative() const { return value + half_width < 0.0; }
};

/// An estimate from an exponent and its standard error by batch means.
///
/// The half width is Student's 95 % quantile for the fewest batches that a series of more than 64
/// steps has (32) times the standard error, or the end effect where that is more; plus 10⁻¹² for
/// the rounding of logarithms, below which no exponent is told from zero.
/// @param value           the exponent, natural logarithm per step
/// @param standard_error  ≥ 0, not NaN
/// @param end_effect      ≥ 0: what a bounded sum can add to the mean, see LeadingExponent
/// @throws InvalidParameter for another standard error or end effect
inline ExponentEstimate exponent_estimate(double value, double standard_error,
                                          double end_effect = 0.0) {
  require_non_negative("standard error of the exponent", standard_error, "");
  require_non_negative("end effect of the exponent", end_effect, "");
  constexpr double rounding = 1e-12;
  return {value, std::fmax(student_quantile(0.95, 31) * standard_error, end_effect) + rounding};
}

/// A search for a repetition of the states, of three periods and more.
struct RepetitionIndicators {
  std::int64_t lag;          ///< smallest lag that repeats (samples), 0 for none
  std::int64_t largest_lag;  ///< how far was looked (samples)
  double tolerance;          ///< of a repeat, relative to the extent
};

/// The lines of the spectrum of an observable.
struct SpectralIndicators {
  int division;  ///< the smallest m for which the multiples of f/m hold the power, or 0
  double share;  ///< the share of the power that was asked for
  std::size_t lines_holding;  ///< how many lines hold 99 % of the power
  double continuous;          ///< share of the power between the lines
};

/// What is known of a motion; what was not looked at stays empty.
struct ChaosIndicators {
  std::optional<std::int64_t> diverged_at;       ///< sample at which the motion had left all bounds
  std::optional<std::int64_t> certified_period;  ///< of an orbit that was proved (samples)
  std::optional<RepetitionIndicators> repeat;    ///< of the states
  std::optional<ExponentEstimate> largest_exponent;  ///< natural logarithm per step
  std::optional<double> zero_one;                    ///< median K of the 0–1 test
  std::optional<SpectralIndicators> lines;           ///< of the observable
  std::optional<double> extent_growth;  ///< extent of the last quarter over that of the first
  std::optional<ClosestReturn> closest_return;   ///< among the last states
  std::optional<RecurrenceShares> recurrence;    ///< of the same states, at a given radius
  std::optional<SwitchingComplexity> switching;  ///< of the contacts, where they are known
  std::optional<double> forcing_periods;         ///< that the series covers
  bool forcing_incommensurate = false;  ///< f τ is no fraction with a denominator in reach: no
                                        ///< motion that answers the forcing repeats
};

/// A kind, and the numbers that it rests on.
struct Classification {
  AttractorType kind = AttractorType::undecided;  ///< what the motion is
  std::int64_t period = 0;                        ///< samples; 0 unless periodic
  std::string rests_on;                           ///< one or two English sentences
};

/// `periodic(N)`, `quasi-periodic`, `irregular, exponent <= 0`, `chaotic`, `diverges`, `undecided`.
inline std::string attractor_type_text(AttractorType kind, std::int64_t period = 0) {
  switch (kind) {
    case AttractorType::periodic:
      return "periodic(" + std::to_string(period) + ")";
    case AttractorType::quasi_periodic:
      return "quasi-periodic";
    case AttractorType::irregular_contracting:
      return "irregular, exponent <= 0";
    case AttractorType::chaotic:
      return "chaotic";
    case AttractorType::diverges:
      return "diverges";
    case AttractorType::undecided:
      break;
  }
  return "undecided";
}

/// The text of a classification's kind, with its period where it is periodic.
inline std::string attractor_type_text(const Classification& classification) {
  return attractor_type_text(classification.kind, classification.period);
}

/// From this K of the 0–1 test on a series counts as chaotic …
inline constexpr double zero_one_high = 0.8;
/// … and up to this one as regular; between them it says nothing.
inline constexpr double zero_one_low = 0.2;
/// Up to this share of the power between the lines a spectrum counts as one of lines alone.
inline constexpr double lines_only_share = 1e-3;
/// Fewer periods of the forcing than this tell nothing of a forced motion.
inline constexpr double fewest_forcing_periods = 20.0;
/// An extent that changes by more than this factor (or its inverse) from the first to the last
/// quarter of the series belongs to no steady motion.
inline constexpr double steady_growth = 2.0;

namespace detail {

/// The indicators in words, number by number.
class IndicatorText {
 public:
  explicit IndicatorText(const ChaosIndicators& indicators) : indicators_(indicators) {}

  std::string exponent() const {
    if (!indicators_.largest_exponent) return "no exponent is known";
    const ExponentEstimate& found = *indicators_.largest_exponent;
    std::ostringstream text;
    text << "largest exponent " << found.value << " +- " << found.half_width << " per " << found.per
         << " (95 %)";
    return text.str();
  }
  std::string zero_one() const {
    if (!indicators_.zero_one) return "no 0-1 test was made";
    return "0-1 test K = " + number(*indicators_.zero_one);
  }
  std::string repeat() const {
    if (!indicators_.repeat) return "no repetition was looked for";
    const RepetitionIndicators& found = *indicators_.repeat;
    if (found.lag > 0) return "repeats after " + std::to_string(found.lag) + " samples";
    return "no repetition to " + number(found.tolerance) + " of the extent within " +
           std::to_string(found.largest_lag) + " samples";
  }
  std::string lines() const {
    if (!indicators_.lines) return "no spectrum was looked at";
    const SpectralIndicators& found = *indicators_.lines;
    std::string text = number(100.0 * found.continuous) + " % of the power between the lines, " +
                       std::to_string(found.lines_holding) + " lines hold 99 %";
    if (found.division > 0) {
      text += ", multiples of f/" + std::to_string(found.division) + " hold " +
              number(100.0 * found.share) + " %";
    }
    return text;
  }
  std::string growth() const {
    return "the extent of the last quarter is " + number(*indicators_.extent_growth) +
           " times that of the first";
  }
  std::string switching() const {
    if (!indicators_.switching) return "";
    return "; contacts carry " + number(indicators_.switching->entropy) + " bit per sample";
  }
  std::string all() const {
    return exponent() + "; " + zero_one() + "; " + repeat() + "; " + lines();
  }

  static std::string number(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
  }

 private:
  const ChaosIndicators& indicators_;
};

inline bool is_low(const std::optional<double>& zero_one) {
  return zero_one && *zero_one <= zero_one_low;
}
inline bool is_high(const std::optional<double>& zero_one) {
  return zero_one && *zero_one >= zero_one_high;
}
inline bool is_steady(const ChaosIndicators& indicators) {
  return !indicators.extent_growth || (*indicators.extent_growth <= steady_growth &&
                                       *indicators.extent_growth * steady_growth >= 1.0);
}
inline bool searched_in_vain(const ChaosIndicators& indicators) {
  return indicators.repeat && indicators.repeat->lag == 0;
}
/// Nothing but separate lines; false where no spectrum is known.
inline bool lines_alone(const ChaosIndicators& indicators) {
  return indicators.lines && indicators.lines->continuous <= lines_only_share;
}
/// The power lies on the multiples of one frequency; false where no spectrum is known.
inline bool one_base(const ChaosIndicators& indicators) {
  return indicators.lines && indicators.lines->division > 0;
}

inline Classification undecided(const std::string& why, const IndicatorText& words) {
  return {AttractorType::undecided, 0, why + ": " + words.all() + "."};
}

inline Classification classify_repeating(const ChaosIndicators& indicators,
                                         const IndicatorText& words) {
  if (indicators.largest_exponent && indicators.largest_exponent->positive())
    return undecided("The motion repeats although its neighbours leave it", words);
  return {AttractorType::periodic, indicators.repeat->lag,
          "Recurrence, no certificate: the second half of the series " + words.repeat() +
              ", three times and more, to " + IndicatorText::number(indicators.repeat->tolerance) +
              " of its extent."};
}

inline Classification classify_separating(const ChaosIndicators& indicators,
                                          const IndicatorText& words) {
  if (!is_high(indicators.zero_one))
    return undecided("Neighbours separate, but the 0-1 test does not show chaos", words);
  if (lines_alone(indicators) || one_base(indicators))
    return undecided("Neighbours separate, but the spectrum is one of lines", words);
  return {AttractorType::chaotic, 0,
          "Neighbours separate exponentially in a bounded motion: " + words.all() + "."};
}

inline Classification classify_neutral(const ChaosIndicators& indicators,
                                       const IndicatorText& words) {
  if (!is_low(indicators.zero_one) || !searched_in_vain(indicators))
    return undecided("The exponent is not told from zero, and the rest does not decide", words);
  if (!lines_alone(indicators) || one_base(indicators))
    return undecided("The exponent is not told from zero, and the lines show no second frequency",
                     words);
  return {
      AttractorType::quasi_periodic, 0,
      "The exponent is zero within its error and the spectrum has lines without a common base: " +
          words.all() + "."};
}

inline Classification classify_contracting(const ChaosIndicators& indicators,
                                           const IndicatorText& words) {
  const bool floor = indicators.lines && !lines_alone(indicators);
  if (indicators.forcing_incommensurate && is_low(indicators.zero_one) && !floor) {
    return {AttractorType::quasi_periodic, 0,
            "The state follows its forcing, whose period and the sampling period have no common "
            "multiple: " +
                words.all() + "."};
  }
  if (!searched_in_vain(indicators))
    return undecided("Neighbours come together, but no repetition was looked for", words);
  if (one_base(indicators) || (is_low(indicators.zero_one) && lines_alone(indicators)))
    return undecided("A regular series that does not repeat, slowly settling or of a long period",
                     words);
  return {AttractorType::irregular_contracting, 0,
          "Neighbours come together, yet the motion does not repeat; its period may be longer, or "
          "the contacts never settle: " +
              words.all() + words.switching() + "."};
}

}  // namespace detail

/// Classifies a motion by its indicators. The first rule that applies decides:
///
///  1. left all bounds → diverges;
///  2. a certified orbit → periodic; else a record of fewer than `fewest_forcing_periods` →
///     undecided;
///  3. repeats to a tolerance, three times and more → periodic, resting on recurrence; undecided
///     where the largest exponent is above zero: then an unstable orbit or round-off repeats;
///  4. no exponent, or an extent that still changes by `steady_growth` → undecided;
///  5. exponent above zero by its 95 % interval: chaotic if K ≥ `zero_one_high` and the spectrum,
///     if known, is not one of lines alone; else undecided;
///  6. exponent not told from zero: quasi-periodic if K ≤ `zero_one_low`, a repetition was looked
///     for in vain, and the spectrum has lines alone with no common base; else undecided;
///  7. exponent below zero: where forcing and sampling are incommensurate and K ≤ `zero_one_low`
///     and the spectrum, if known, has lines alone → quasi-periodic. Else, if a repetition was
///     looked for in vain → irregular, exponent <= 0: a piecewise affine loop can go on switching
///     without a pattern while its neighbours come together. Undecided where the series is regular
///     all the same (lines of one base, or K ≤ `zero_one_low` and lines alone): it may still be
///     settling, or its period may be longer than the search.
///
/// No statistic claims chaos alone: it takes a positive exponent and a high K that nothing
/// contradicts. The classification is of the series that the indicators are of.
inline Classification classify(const ChaosIndicators& indicators) {
  const detail::IndicatorText words(indicators);
  if (indicators.diverged_at) {
    return {AttractorType::diverges, 0,
            "The motion has left all bounds by sample " + std::to_string(*indicators.diverged_at) +
                "."};
  }
  if (indicators.certified_period) {
    return {AttractorType::periodic, *indicators.certified_period,
            "Certified orbit of " + std::to_string(*indicators.certified_period) + " samples."};
  }
  if (indicators.forcing_periods && *indicators.forcing_periods < fewest_forcing_periods) {
    return detail::undecided("The record covers only " +
                                 detail::IndicatorText::number(*indicators.forcing_periods) +
                                 " periods of the forcing",
                             words);
  }
  if (indicators.repeat && indicators.repeat->lag > 0)
    return detail::classify_repeating(indicators, words);
  if (!indicators.largest_exponent) return detail::undecided("No exponent is known", words);
  if (!detail::is_steady(indicators))
    return detail::undecided("The motion is not steady, " + words.growth(), words);
  if (indicators.largest_exponent->positive())
    return detail::classify_separating(indicators, words);
  if (indicators.largest_exponent->negative())
    return detail::classify_contracting(indicators, words);
  return detail::classify_neutral(indicators, words);
}

namespace detail {

/// Classifies a motion under a recorded force, or with samples that jitter.
///
/// Its spectrum, its 0–1 test and its repetitions are those of the forcing as much as its own, and
/// a forcing that does not repeat is no sum of incommensurate harmonics. So nothing is called
/// quasi-periodic. Divergence stands, and so does chaos, by an exponent above zero. Where the
/// samples jitter nothing is called periodic but rest; a recurrence under a recorded force is one
/// of the series. Else an exponent below zero decides, whatever the rest: neighbours come together
/// under one and the same forcing, so that the motion follows it.
inline Classification classify_irregularly_forced(const ChaosIndicators& indicators,
                                                  bool samples_jitter) {
  Classification classification = classify(indicators);
  const bool repeats = classification.kind == AttractorType::periodic;
  if (classification.kind == AttractorType::diverges ||
      classification.kind == AttractorType::chaotic)
    return classification;
  if (repeats && (!samples_jitter || classification.period == 1)) return classification;
  if (indicators.forcing_periods && *indicators.forcing_periods < fewest_forcing_periods)
    return classification;
  const IndicatorText words(indicators);
  if (indicators.largest_exponent && indicators.largest_exponent->negative()) {
    return {AttractorType::irregular_contracting, 0,
            "Neighbours come together and follow a forcing or samples that do not repeat: " +
                words.all() + words.switching() + "."};
  }
  if (classification.kind == AttractorType::undecided) return classification;
  return undecided("The forcing or the samples do not repeat, and the exponent does not decide",
                   words);
}

}  // namespace detail
}  // namespace holdfast
