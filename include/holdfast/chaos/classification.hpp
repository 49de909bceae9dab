#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string>

#include "holdfast/chaos/recurrence.hpp"
#include "holdfast/chaos/switching_complexity.hpp"
#include "holdfast/core/errors.hpp"

namespace holdfast {

/// The kinds of motion of a discrete system.
enum class AttractorType {
  periodic,               ///< repeats after N samples
  quasi_periodic,         ///< ≥ 2 frequencies without a common period; nearby motions stay near
  irregular_contracting,  ///< nearby motions converge, but no repetition was found
  chaotic,                ///< bounded as far as observed; nearby motions separate exponentially
  diverges,               ///< state grows without bound
  undecided,              ///< indicators are missing or contradict each other
};

/// The largest Lyapunov exponent and its 99 % interval, value ± half_width. A true exponent of 0 is
/// below the interval with probability 1/200, and above it with probability 1/200.
struct ExponentEstimate {
  double value;       ///< exponent (natural log per step); −∞ where all deviations become zero
  double half_width;  ///< half width of the interval, ≥ 0

  /// Whether the whole interval is above zero.
  bool positive() const { return value - half_width > 0.0; }
  /// Whether the whole interval is below zero.
  bool negative() const { return value + half_width < 0.0; }
};

/// Computes the 99 % interval of an exponent from its standard error by batch means. The half width
/// is 2.744 times the standard error, plus 10⁻¹² for the rounding of logarithms. 2.744 is the
/// two-sided 99 % quantile of Student's t for 32 batches, the fewest for a series of ≥ 64 steps.
/// @param value           the exponent, natural logarithm per step
/// @param standard_error  standard error of the exponent, finite and ≥ 0
/// @throws InvalidParameter where the standard error is out of its range
inline ExponentEstimate exponent_estimate(double value, double standard_error) {
  require_non_negative("standard error of the exponent", standard_error, "");
  constexpr double rounding = 1e-12, quantile = 2.7440419192942613;  // P(|T| ≤ quantile) = 99 %
  return {value, quantile * standard_error + rounding};
}

/// The measures of an observable's spectral lines. f is IndicatorOptions::base_frequency.
struct SpectralIndicators {
  int division;  ///< smallest m with at least `share` of the power on multiples of f/m; 0: none
  double share;  ///< required share of the power, 0 … 1, in the definition of `division`
  std::size_t lines_holding;  ///< smallest number of lines that contain 99 % of the power
  double continuous;          ///< share of the power between the lines, 0 … 1: continuous_share()
};

/// The indicators from which classify() decides the kind of a motion; empty where not computed.
struct ChaosIndicators {
  std::optional<std::int64_t> diverged_at;       ///< sample at which the motion diverged
  std::optional<std::int64_t> certified_period;  ///< period of a certified orbit (samples)
  std::optional<RepeatSearch> repeat;            ///< search for a lag at which the states repeat
  std::optional<ExponentEstimate> largest_exponent;  ///< largest exponent, natural log per step
  std::optional<double> zero_one;                    ///< result K of zero_one_test()
  std::optional<SpectralIndicators> lines;           ///< spectral lines of the observable
  std::optional<double> extent_growth;  ///< extent (max − min) of the observable in the last
                                        ///< quarter of the series, divided by that in the first
  std::optional<double> neighbour;      ///< neighbour_distance(): final distance of a nearby motion
  std::optional<double> closest_return;          ///< closest_return() of the last 1000 states
  std::optional<double> determinism;             ///< recurrence_determinism(), last 1000 states
  std::optional<SwitchingComplexity> switching;  ///< complexity of the sequence of contacts
  std::optional<double> forcing_periods;         ///< number of forcing periods in the series
  bool forcing_incommensurate = false;           ///< whether forcing and sampling have no
                                                 ///< common period: no response repeats
};

/// The kind of a motion, its period and the reason for this decision.
struct Classification {
  AttractorType kind = AttractorType::undecided;  ///< kind of the motion
  std::int64_t period = 0;                        ///< period in samples; 0 unless periodic
  std::string rests_on;                           ///< reason, in one or two English sentences
};

/// The name of a kind: `periodic(period)`, `quasi-periodic`, `irregular, exponent <= 0`, `chaotic`…
inline std::string attractor_type_text(AttractorType kind, std::int64_t period = 0) {
  constexpr std::array<const char*, 6> words = {
      "periodic", "quasi-periodic", "irregular, exponent <= 0", "chaotic", "diverges", "undecided"};
  const std::string word = words[static_cast<std::size_t>(kind)];
  return kind == AttractorType::periodic ? word + "(" + std::to_string(period) + ")" : word;
}

/// The name of the kind in a classification, with the period in samples if the motion is periodic.
inline std::string attractor_type_text(const Classification& classification) {
  return attractor_type_text(classification.kind, classification.period);
}

/// The smallest result K of the 0–1 test for which a series counts as chaotic.
inline constexpr double zero_one_high = 0.8;
/// The largest result K of the 0–1 test for which a series counts as regular. The test is
/// inconclusive for K between zero_one_low and zero_one_high.
inline constexpr double zero_one_low = 0.2;
/// The largest share of power between its lines for which a spectrum counts as a line spectrum.
inline constexpr double lines_only_share = 1e-3;
/// The smallest number of forcing periods for which a forced motion is classified.
inline constexpr double fewest_forcing_periods = 20.0;
/// The largest factor by which the extent (max − min) of a steady motion may grow or shrink from
/// the first to the last quarter of the series.
inline constexpr double steady_growth = 2.0;
/// The initial displacement of the nearby motion in neighbour_distance(), as a share of the extent.
inline constexpr double neighbour_start = 1e-9;
/// The smallest result of neighbour_distance() for which a nearby motion counts as separated.
inline constexpr double neighbour_parted = 1e-3;
/// The largest result of neighbour_distance() for which a nearby motion counts as staying near.
inline constexpr double neighbour_stays = 1e-7;

namespace detail {

/// A number as text with at most four significant digits.
inline std::string number_text(double value) {
  std::ostringstream text;
  text.precision(4);
  text << value;
  return text.str();
}

/// Applies the rules of classify() to the indicators and states the reasons in words.
class Classifier {
 public:
  explicit Classifier(const ChaosIndicators& indicators) : indicators_(indicators) {}

  Classification classify() const {
    if (indicators_.diverged_at) {
      return {AttractorType::diverges, 0,
              "The motion exceeded all bounds by sample " +
                  std::to_string(*indicators_.diverged_at) + "."};
    }
    if (indicators_.certified_period) {
      return {AttractorType::periodic, *indicators_.certified_period,
              "Certified orbit of " + std::to_string(*indicators_.certified_period) + " samples."};
    }
    if (is_short()) {
      return undecided("The record covers only " + number_text(*indicators_.forcing_periods) +
                       " periods of the forcing");
    }
    if (indicators_.repeat && indicators_.repeat->lag > 0) return repeating();
    if (!indicators_.largest_exponent) return undecided("The largest Lyapunov exponent is unknown");
    if (!is_steady()) {
      return undecided("The motion is not steady: the extent of its last quarter is " +
                       number_text(*indicators_.extent_growth) + " times that of the first");
    }
    if (indicators_.largest_exponent->positive()) return separating();
    return comes_together() ? contracting() : neutral();
  }

  /// Classifies a motion under a recorded force or with jittering samples. The spectrum, 0–1 test
  /// and repetitions reflect the forcing as much as the motion. So no motion is called
  /// quasi-periodic, and with jitter only rest is called periodic. Divergence and chaos (an
  /// exponent above zero) are still recognised. Otherwise a negative exponent decides: neighbouring
  /// motions converge under the same forcing, so that the forcing determines the motion.
  Classification classify_irregularly_forced(bool samples_jitter) const {
    const Classification regular = classify();
    const bool repeats = regular.kind == AttractorType::periodic;
    const bool stands = regular.kind == AttractorType::diverges ||
                        regular.kind == AttractorType::chaotic ||
                        (repeats && (!samples_jitter || regular.period == 1));
    if (stands || is_short()) return regular;
    if (comes_together())
      return irregular(
          "Neighbouring motions converge under a forcing or sampling that does not repeat");
    if (regular.kind == AttractorType::undecided) return regular;
    return undecided(
        "The forcing or sampling does not repeat, and the sign of the exponent is uncertain");
  }

  /// Whether the motion is undecided and neighbour_distance(), not computed yet, could decide.
  bool lacks_neighbour() const {
    return !indicators_.neighbour && searched_in_vain() && indicators_.largest_exponent &&
           !comes_together() && classify().kind == AttractorType::undecided;
  }

 private:
  Classification repeating() const {
    if (indicators_.largest_exponent && indicators_.largest_exponent->positive())
      return undecided("The motion repeats although neighbouring motions separate from it");
    return {AttractorType::periodic, static_cast<std::int64_t>(indicators_.repeat->lag),
            "There is no certificate, but the second half of the record " + repeat_text() +
                ", at least three times, within " + number_text(indicators_.repeat->tolerance) +
                " of its extent."};
  }

  Classification separating() const {
    if (has_parted()) return chaotic();
    if (!(indicators_.zero_one && *indicators_.zero_one >= zero_one_high))
      return undecided("Neighbouring motions separate, but the 0-1 test does not show chaos");
    if (has_lines_alone() || has_one_base())
      return undecided("Neighbouring motions separate, but the spectrum consists of lines");
    return chaotic();
  }

  Classification chaotic() const {
    return weighed(AttractorType::chaotic,
                   "Neighbouring motions separate exponentially, and the motion stayed bounded as "
                   "long as computed");
  }

  Classification neutral() const {
    if (!(is_regular() || stays_beside_neighbour()) || !searched_in_vain())
      return undecided("The largest exponent may be zero, and no other indicator is conclusive");
    if (!has_lines_alone() || has_one_base())
      return undecided(
          "The largest exponent may be zero, and the spectrum shows no second frequency");
    return weighed(
        AttractorType::quasi_periodic,
        "The largest exponent is zero within its error, and the spectral lines have no common "
        "base frequency");
  }

  Classification contracting() const {
    const bool floor = indicators_.lines && !has_lines_alone();
    if (indicators_.forcing_incommensurate && is_regular() && !floor) {
      return weighed(AttractorType::quasi_periodic,
                     "The state follows a forcing whose period has no common multiple with the "
                     "sampling period");
    }
    if (!searched_in_vain())
      return undecided("Neighbouring motions converge, but repetition was not searched for");
    if (has_one_base() || (is_regular() && has_lines_alone()))
      return undecided(
          "The motion is regular but does not repeat: it converges slowly or has a long period");
    return irregular(
        "Neighbouring motions converge, but the motion does not repeat; its period may be longer, "
        "or the order of contacts never repeats");
  }

  Classification weighed(AttractorType kind, const std::string& why,
                         const std::string& more = "") const {
    return {kind, 0,
            why + ": " + exponent_text() + "; " + zero_one_text() + "; " + repeat_text() + "; " +
                lines_text() + neighbour_text() + more + "."};
  }
  Classification undecided(const std::string& why) const {
    return weighed(AttractorType::undecided, why);
  }
  Classification irregular(const std::string& why) const {
    const std::string switching =
        indicators_.switching ? "; the sequence of contacts has an entropy of " +
                                    number_text(indicators_.switching->entropy) + " bit per sample"
                              : "";
    return weighed(AttractorType::irregular_contracting, why, switching);
  }

  std::string exponent_text() const {
    if (!indicators_.largest_exponent) return "the largest exponent is unknown";
    const ExponentEstimate& found = *indicators_.largest_exponent;
    return "largest exponent " + number_text(found.value) + " +- " + number_text(found.half_width) +
           " per sample (99 %)";
  }
  std::string zero_one_text() const {
    if (!indicators_.zero_one) return "the 0-1 test was not computed";
    return "0-1 test K = " + number_text(*indicators_.zero_one);
  }
  std::string repeat_text() const {
    if (!indicators_.repeat) return "repetition was not searched for";
    const RepeatSearch& found = *indicators_.repeat;
    if (found.lag > 0) return "repeats after " + std::to_string(found.lag) + " samples";
    return "no repetition within " + std::to_string(found.largest_lag) +
           " samples and a tolerance of " + number_text(found.tolerance) +
           " of the motion's extent";
  }
  std::string lines_text() const {
    if (!indicators_.lines) return "no spectrum was computed";
    const SpectralIndicators& found = *indicators_.lines;
    const std::string text = number_text(100.0 * found.continuous) +
                             " % of the power between the lines, " +
                             std::to_string(found.lines_holding) + " lines contain 99 %";
    if (found.division == 0) return text;
    return text + ", multiples of f/" + std::to_string(found.division) + " contain " +
           number_text(100.0 * found.share) + " %";
  }

  std::string neighbour_text() const {
    if (!indicators_.neighbour) return "";
    return "; the distance of a neighbouring motion went from " + number_text(neighbour_start) +
           " to " + number_text(*indicators_.neighbour) + " of the extent";
  }

  bool is_short() const {
    return indicators_.forcing_periods && *indicators_.forcing_periods < fewest_forcing_periods;
  }
  bool is_steady() const {
    return !indicators_.extent_growth || (*indicators_.extent_growth <= steady_growth &&
                                          *indicators_.extent_growth * steady_growth >= 1.0);
  }
  bool comes_together() const {
    return indicators_.largest_exponent && indicators_.largest_exponent->negative();
  }
  bool is_regular() const { return indicators_.zero_one && *indicators_.zero_one <= zero_one_low; }
  bool has_parted() const { return indicators_.neighbour.value_or(0.0) >= neighbour_parted; }
  /// Whether a neighbouring motion stays near and the 0–1 test does not show chaos.
  bool stays_beside_neighbour() const {
    return indicators_.neighbour.value_or(1.0) <= neighbour_stays &&
           indicators_.zero_one.value_or(0.0) < zero_one_high;
  }
  bool searched_in_vain() const { return indicators_.repeat && indicators_.repeat->lag == 0; }
  /// Whether the spectrum consists of separate lines only; false without a spectrum.
  bool has_lines_alone() const {
    return indicators_.lines && indicators_.lines->continuous <= lines_only_share;
  }
  /// Whether the power is on the multiples of one frequency; false without a spectrum.
  bool has_one_base() const { return indicators_.lines && indicators_.lines->division > 0; }

  const ChaosIndicators& indicators_;
};

}  // namespace detail

/// Classifies a motion by its indicators. The first rule that applies decides. K is the result of
/// the 0–1 test. The exponent is the largest one; it is above or below zero if its whole 99 %
/// interval is. A *line spectrum* has `continuous` ≤ `lines_only_share`. A spectrum has a *base*
/// frequency if `division` > 0.
///
///  1. The motion diverged → diverges.
///  2. An orbit is certified → periodic. Else if the series has fewer forcing periods than
///     `fewest_forcing_periods` → undecided.
///  3. The series repeats (`repeat`) → periodic; but undecided if the exponent is above zero, as on
///     an unstable orbit.
///  4. The exponent is unknown, or the extent changes by a factor over `steady_growth` → undecided.
///  5. The exponent is above zero → chaotic if a nearby motion separates (`neighbour_parted`), or
///     if K ≥ `zero_one_high` and the spectrum, if known, has no base and is no line spectrum. Else
///     undecided.
///  6. The interval of the exponent contains zero → quasi-periodic if a search found no repetition,
///     there is a line spectrum without base, and K ≤ `zero_one_low`. If a nearby motion stays near
///     (`neighbour_stays`), K < `zero_one_high` or an unknown K suffices. Else undecided.
///  7. The exponent is below zero → quasi-periodic if forcing and sampling are incommensurate, K ≤
///     `zero_one_low` and the spectrum, if known, is a line spectrum. Else undecided if repetition
///     was not searched for, the spectrum has a base, or K ≤ `zero_one_low` with a line spectrum:
///     the motion may settle or repeat later. Else irregular_contracting: contacts can change
///     without a pattern although nearby motions converge.
///
/// No single indicator suffices for `chaotic`. The result holds only for the length of the series.
inline Classification classify(const ChaosIndicators& indicators) {
  return detail::Classifier(indicators).classify();
}

}  // namespace holdfast
