#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/math/signal/spectrum.hpp"

namespace holdfast {

/// The power of each spectral line of amplitude a: ½ a², but a² at frequency 0 and at the Nyquist
/// frequency. With a rectangular window the sum of all powers is the mean square of the signal.
/// @param lines    spectrum of amplitude_spectrum()
/// @param samples  number N of samples of the record; the spectrum has N/2 + 1 lines
/// @throws InvalidParameter where the numbers of samples and of lines disagree
inline std::vector<double> line_powers(const std::vector<SpectralLine>& lines,
                                       std::size_t samples) {
  if (samples < 2 || lines.size() != samples / 2 + 1) {
    throw InvalidParameter("number of lines", static_cast<double>(lines.size()), "",
                           "N/2 + 1, rounded down, with the number N >= 2 of samples");
  }
  std::vector<double> powers(lines.size());
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const bool counted_once = k == 0 || 2 * k == samples;
    powers[k] = (counted_once ? 1.0 : 0.5) * lines[k].amplitude * lines[k].amplitude;
  }
  return powers;
}

/// The shares 0 … 1 of a signal's power at the multiples of f/m, m = 1, 2, …; f: base frequency.
struct SubharmonicShares {
  std::vector<double> shares;  ///< shares[m − 1]: share at multiples of f/m; 1 if the power is 0
  int division = 0;            ///< smallest m with at least the required share; 0: none
};

/// The options of a search for subharmonic lines.
struct SubharmonicOptions {
  double base_frequency;      ///< base frequency f (Hz), > 0
  int largest_division = 16;  ///< largest division m, 1 … 10⁵
  double share = 0.999;       ///< required share of the power, 10⁻⁹ ≤ share ≤ 1
};

/// The shares of a signal's power at the multiples of f/m, m = 1, 2, …, with the base frequency f;
/// the signal's mean is left out. A line counts if it is within half a line spacing of a multiple.
/// To avoid leakage, use a rectangular window and a record of whole periods m/f. If f/m is less
/// than three line spacings, the share is set to 0, since almost every line would count.
///
/// Multiples of f above the Nyquist frequency are aliased: if f τ = p/q (τ: sampling period), to
/// multiples of f/p = 1/(q τ). Then use f/p as base frequency. Work: one comparison per line and m.
/// @throws InvalidParameter where an option is out of range, or the lines do not match `samples`
inline SubharmonicShares subharmonic_shares(const std::vector<SpectralLine>& lines,
                                            std::size_t samples,
                                            const SubharmonicOptions& options) {
  require_positive("base frequency", options.base_frequency, "Hz");
  require_within("largest divisor of the base frequency", options.largest_division, "", 1.0, 1e5);
  require_within("share of the power", options.share, "", 1e-9, 1.0);
  const std::vector<double> powers = line_powers(lines, samples);
  double total = 0.0;
  for (std::size_t k = 1; k < powers.size(); ++k) total += powers[k];

  SubharmonicShares result;
  for (int m = 1; m <= options.largest_division; ++m) {
    const double spacing = options.base_frequency / (m * lines[1].frequency);  // in lines
    double on_multiples = 0.0;
    for (std::size_t k = 1; k < powers.size() && spacing >= 3.0 - 1e-9; ++k) {
      const double place = static_cast<double>(k) / spacing;
      const double away = std::abs(place - std::round(place)) * spacing;
      if (std::round(place) >= 1.0 && away <= 0.5 + 1e-9) on_multiples += powers[k];
    }
    result.shares.push_back(total > 0.0 ? on_multiples / total : 1.0);
    if (result.division == 0 && result.shares.back() >= options.share) result.division = m;
  }
  return result;
}

/// The least number of spectral lines whose powers add up to at least a given share of the total
/// power. The line at frequency 0 is left out. The result is 0 if the total power is 0.
/// @param lines    spectrum of amplitude_spectrum()
/// @param samples  number N of samples of the record
/// @param share    required share of the power, 10⁻⁹ ≤ share ≤ 1
/// @throws InvalidParameter where the share is out of range or the lines do not match N
inline std::size_t lines_holding(const std::vector<SpectralLine>& lines, std::size_t samples,
                                 double share) {
  require_within("share of the power", share, "", 1e-9, 1.0);
  std::vector<double> powers = line_powers(lines, samples);
  powers.front() = 0.0;
  std::sort(powers.begin(), powers.end(), std::greater<>());
  double total = 0.0, held = 0.0;
  for (const double power : powers) total += power;
  std::size_t count = 0;
  while (count < powers.size() && held < share * total) held += powers[count++];
  return count;
}

/// The share of a signal's power in the continuous part of its spectrum, the noise floor:
///
///     Σ over bands of [median power of a line · number of lines] / (total power · ln 2)
///
/// with bands of 32 lines. Lines 0 and 1 are left out, since a Hann window spreads the mean into
/// line 1. The line powers of noise are distributed exponentially: their median is ln 2 times their
/// mean. Single peaks hardly change a median, but peaks less than eight lines apart count as noise.
/// Use a Hann window, since the leakage of a rectangular window is taken for noise.
/// @return share, 0 … 1; 0 for a signal of zero power
/// @throws InvalidParameter where the numbers of samples and of lines disagree
inline double continuous_share(const std::vector<SpectralLine>& lines, std::size_t samples) {
  constexpr std::size_t band = 32;
  std::vector<double> powers = line_powers(lines, samples);
  double total = 0.0, floor = 0.0;
  for (std::size_t k = 2; k < powers.size(); ++k) total += powers[k];
  for (std::size_t from = 2; from < powers.size(); from += band) {
    const std::size_t count = std::min(band, powers.size() - from);
    const auto begin = powers.begin() + static_cast<std::ptrdiff_t>(from);
    const auto middle = begin + static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(begin, middle, begin + static_cast<std::ptrdiff_t>(count));
    floor += *middle * static_cast<double>(count) / std::log(2.0);
  }
  return total > 0.0 ? std::min(1.0, floor / total) : 0.0;
}

}  // namespace holdfast
