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
  quasi_periodic,         ///< two or more frequencies without a common period; neighbours stay near
  irregular_contracting,  ///< neighbours converge, yet no repetition was found
  chaotic,                ///< bounded as far as observed; neighbours separate exponentially
  diverges,               ///< exceeds every bound
  undecided,              ///< indicators are missing or contradict each other
};

/// The largest Lyapunov exponent and its 99 % interval, value ± half_width. A motion whose exponent
/// is 0 is taken for chaotic, or for contracting, in one case of two hundred each.
struct ExponentEstimate {
  double value;       ///< −∞ where every direction is a null direction
  double half_width;  ///< ≥ 0

  /// Whether the whole interval is above zero.
  bool positive() const { return value - half_width > 0.0; }
  /// Whether the whole interval is below zero.
  bool negative() const { return value + half_width < 0.0; }
};

/// The estimate from an exponent and its standard error by batch means. The half width is the
/// standard error times Student's 99 % quantile for the fewest batches of a series with more than
/// 64 steps (32), plus 10⁻¹² for the rounding of logarithms.
/// @param value           the exponent, natural logarithm per step
/// @param standard_error  ≥ 0, not NaN
/// @throws InvalidParameter where the standard error is out of its range
inline ExponentEstimate exponent_estimate(double value, double standard_error) {
  require_non_negative("standard error of the exponent", standard_error, "");
  constexpr double rounding = 1e-12, quantile = 2.7440419192942613;  // P(|T| ≤ quantile) = 99 %
  return {value, quantile * standard_error + rounding};
}

/// The measures of the lines in the spectrum of an observable.
struct SpectralIndicators {
  int division;               ///< smallest m such that the multiples of f/m contain the power, or 0
  double share;               ///< share of the power that these lines must contain
  std::size_t lines_holding;  ///< number of lines that contain 99 % of the power
  double continuous;          ///< share of the power between the lines
};

/// The indicators that decide the kind of a motion; those not computed stay empty.
struct ChaosIndicators {
  std::optional<std::int64_t> diverged_at;       ///< sample at which the motion exceeded all bounds
  std::optional<std::int64_t> certified_period;  ///< samples in a period of a proved orbit
  std::optional<RepeatSearch> repeat;            ///< repetition of the states, at least three times
  std::optional<ExponentEstimate> largest_exponent;  ///< natural logarithm per step
  std::optional<double> zero_one;                    ///< median K of the 0–1 test
  std::optional<SpectralIndicators> lines;           ///< spectral lines of the observable
  std::optional<double> extent_growth;   ///< extent of the last quarter over that of the first
  std::optional<double> neighbour;       ///< final distance of a neighbour (neighbour_distance())
  std::optional<double> closest_return;  ///< closest_return() of the last states
  std::optional<double> determinism;     ///< recurrence_determinism() of the last states
  std::optional<SwitchingComplexity> switching;  ///< complexity of the contacts, if known
  std::optional<double> forcing_periods;         ///< number of forcing periods in the series
  bool forcing_incommensurate = false;  ///< f τ is no fraction with a bounded denominator: no
                                        ///< forced response repeats
};

/// The kind of a motion with the numbers that it follows from.
struct Classification {
  AttractorType kind = AttractorType::undecided;  ///< kind of the motion
  std::int64_t period = 0;                        ///< samples; 0 unless periodic
  std::string rests_on;                           ///< reason, one or two English sentences
};

/// The name of a kind: `periodic(N)`, `quasi-periodic`, `irregular, exponent <= 0`, `chaotic`, …
inline std::string attractor_type_text(AttractorType kind, std::int64_t period = 0) {
  constexpr std::array<const char*, 6> words = {
      "periodic", "quasi-periodic", "irregular, exponent <= 0", "chaotic", "diverges", "undecided"};
  const std::string word = words[static_cast<std::size_t>(kind)];
  return kind == AttractorType::periodic ? word + "(" + std::to_string(period) + ")" : word;
}

/// The name of a classification's kind, with its period where it is periodic.
inline std::string attractor_type_text(const Classification& classification) {
  return attractor_type_text(classification.kind, classification.period);
}

/// The least K of the 0–1 test with which a series counts as chaotic.
inline constexpr double zero_one_high = 0.8;
/// The largest K of the 0–1 test with which a series counts as regular; in between it is undecided.
inline constexpr double zero_one_low = 0.2;
/// The largest share of the power between the lines with which a spectrum counts as pure lines.
inline constexpr double lines_only_share = 1e-3;
/// The fewest periods of the forcing from which a forced motion can be classified.
inline constexpr double fewest_forcing_periods = 20.0;
/// The factor of steady motion: an extent that changes by more than this factor (or its inverse)
/// from the first to the last quarter of the series is not steady.
inline constexpr double steady_growth = 2.0;
/// The initial distance of a neighbour, as a share of the extent.
inline constexpr double neighbour_start = 1e-9;
/// The least final distance of a neighbour that has separated from the motion.
inline constexpr double neighbour_parted = 1e-3;
/// The largest final distance of a neighbour that has stayed; in between nothing is decided.
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
              "The motion has left all bounds by sample " +
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
    if (!indicators_.largest_exponent) return undecided("No exponent is known");
    if (!is_steady()) {
      return undecided("The motion is not steady, the extent of the last quarter is " +
                       number_text(*indicators_.extent_growth) + " times that of the first");
    }
    if (indicators_.largest_exponent->positive()) return separating();
    return comes_together() ? contracting() : neutral();
  }

  /// Classifies a motion under a recorded force or with jittering samples. Its spectrum, 0–1 test
  /// and repetitions reflect the forcing as much as the motion. So nothing is called
  /// quasi-periodic, and with jitter nothing periodic but rest. Divergence and chaos (an exponent
  /// above zero) are still recognised. Else a negative exponent decides: neighbours converge under
  /// the same forcing, and the motion follows it.
  Classification classify_irregularly_forced(bool samples_jitter) const {
    const Classification regular = classify();
    const bool repeats = regular.kind == AttractorType::periodic;
    const bool stands = regular.kind == AttractorType::diverges ||
                        regular.kind == AttractorType::chaotic ||
                        (repeats && (!samples_jitter || regular.period == 1));
    if (stands || is_short()) return regular;
    if (comes_together())
      return irregular(
          "Neighbours come together and follow a forcing or samples that do not repeat");
    if (regular.kind == AttractorType::undecided) return regular;
    return undecided("The forcing or the samples do not repeat, and the exponent does not decide");
  }

  /// Whether the missing neighbour distance could decide an undecided case.
  bool lacks_neighbour() const {
    return !indicators_.neighbour && searched_in_vain() && indicators_.largest_exponent &&
           !comes_together() && classify().kind == AttractorType::undecided;
  }

 private:
  Classification repeating() const {
    if (indicators_.largest_exponent && indicators_.largest_exponent->positive())
      return undecided("The motion repeats although its neighbours leave it");
    return {AttractorType::periodic, static_cast<std::int64_t>(indicators_.repeat->lag),
            "Recurrence, no certificate: the second half of the series " + repeat_text() +
                ", three times and more, to " + number_text(indicators_.repeat->tolerance) +
                " of its extent."};
  }

  Classification separating() const {
    if (has_parted()) return chaotic();
    if (!(indicators_.zero_one && *indicators_.zero_one >= zero_one_high))
      return undecided("Neighbours separate, but the 0-1 test does not show chaos");
    if (has_lines_alone() || has_one_base())
      return undecided("Neighbours separate, but the spectrum is one of lines");
    return chaotic();
  }

  Classification chaotic() const {
    return weighed(AttractorType::chaotic,
                   "Neighbours separate exponentially in a motion that stayed bounded as far as it "
                   "was followed");
  }

  Classification neutral() const {
    if (!(is_regular() || stays_beside_neighbour()) || !searched_in_vain())
      return undecided("The exponent is not told from zero, and the rest does not decide");
    if (!has_lines_alone() || has_one_base())
      return undecided(
          "The exponent is not told from zero, and the lines show no second frequency");
    return weighed(AttractorType::quasi_periodic,
                   "The exponent is zero within its error and the spectrum has lines without a "
                   "common base");
  }

  Classification contracting() const {
    const bool floor = indicators_.lines && !has_lines_alone();
    if (indicators_.forcing_incommensurate && is_regular() && !floor) {
      return weighed(AttractorType::quasi_periodic,
                     "The state follows its forcing, whose period and the sampling period have no "
                     "common multiple");
    }
    if (!searched_in_vain())
      return undecided("Neighbours come together, but no repetition was looked for");
    if (has_one_base() || (is_regular() && has_lines_alone()))
      return undecided(
          "A regular series that does not repeat, slowly settling or of a long period");
    return irregular(
        "Neighbours come together, yet the motion does not repeat; its period may be longer, or "
        "the contacts never settle");
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
        indicators_.switching
            ? "; contacts carry " + number_text(indicators_.switching->entropy) + " bit per sample"
            : "";
    return weighed(AttractorType::irregular_contracting, why, switching);
  }

  std::string exponent_text() const {
    if (!indicators_.largest_exponent) return "no exponent is known";
    const ExponentEstimate& found = *indicators_.largest_exponent;
    return "largest exponent " + number_text(found.value) + " +- " + number_text(found.half_width) +
           " per sample (99 %)";
  }
  std::string zero_one_text() const {
    if (!indicators_.zero_one) return "no 0-1 test was made";
    return "0-1 test K = " + number_text(*indicators_.zero_one);
  }
  std::string repeat_text() const {
    if (!indicators_.repeat) return "no repetition was looked for";
    const RepeatSearch& found = *indicators_.repeat;
    if (found.lag > 0) return "repeats after " + std::to_string(found.lag) + " samples";
    return "no repetition to " + number_text(found.tolerance) + " of the extent within " +
           std::to_string(found.largest_lag) + " samples";
  }
  std::string lines_text() const {
    if (!indicators_.lines) return "no spectrum was looked at";
    const SpectralIndicators& found = *indicators_.lines;
    const std::string text = number_text(100.0 * found.continuous) +
                             " % of the power between the lines, " +
                             std::to_string(found.lines_holding) + " lines hold 99 %";
    if (found.division == 0) return text;
    return text + ", multiples of f/" + std::to_string(found.division) + " hold " +
           number_text(100.0 * found.share) + " %";
  }

  std::string neighbour_text() const {
    if (!indicators_.neighbour) return "";
    return "; a neighbour " + number_text(neighbour_start) + " of the extent away came to " +
           number_text(*indicators_.neighbour) + " of it";
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
  /// Whether a neighbour stays near and the 0–1 test does not contradict.
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

/// Classifies a motion by its indicators. The first rule that applies decides:
///
///  1. left all bounds → diverges;
///  2. a certified orbit → periodic; else fewer than `fewest_forcing_periods` → undecided;
///  3. repeats to a tolerance, three times and more → periodic, resting on recurrence; undecided
///     where the largest exponent is above zero: then an unstable orbit or round-off repeats;
///  4. no exponent, or an extent that still changes by `steady_growth` → undecided;
///  5. exponent above zero by its 99 % interval: chaotic if a neighbour has parted, or if K ≥
///     `zero_one_high` and the spectrum, if known, is not one of lines alone; else undecided;
///  6. exponent not told from zero: quasi-periodic if K ≤ `zero_one_low`, or below `zero_one_high`
///     and a neighbour stays, and a repetition was looked for in vain, and the spectrum has lines
///     alone with no common base; else undecided;
///  7. exponent below zero: where forcing and sampling are incommensurate and K ≤ `zero_one_low`
///     and the spectrum, if known, has lines alone → quasi-periodic. Else, if a repetition was
///     looked for in vain → irregular, exponent <= 0: a piecewise affine loop can go on switching
///     without a pattern while its neighbours come together. Undecided where the series has lines
///     of one base, or K ≤ `zero_one_low` and lines alone: it may still settle, or repeat later.
///
/// No statistic claims chaos alone. The classification is of the series of the indicators.
inline Classification classify(const ChaosIndicators& indicators) {
  return detail::Classifier(indicators).classify();
}

}  // namespace holdfast
