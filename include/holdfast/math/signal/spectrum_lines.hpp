#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/math/signal/spectrum.hpp"

namespace holdfast {

/// The power of each spectral line, its part of the mean square of the signal: ½ a² for the
/// amplitude a, but a² at zero and at the Nyquist frequency.
/// @param lines    spectrum of amplitude_spectrum()
/// @param samples  number N of samples of the record; the spectrum has N/2 + 1 lines
/// @throws InvalidParameter where the numbers of samples and of lines disagree
inline std::vector<double> line_powers(const std::vector<SpectralLine>& lines,
                                       std::size_t samples) {
  if (samples < 2 || lines.size() != samples / 2 + 1) {
    throw InvalidParameter("number of lines", static_cast<double>(lines.size()), "",
                           "N/2 + 1 for N >= 2 samples");
  }
  std::vector<double> powers(lines.size());
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const bool counted_once = k == 0 || 2 * k == samples;
    powers[k] = (counted_once ? 1.0 : 0.5) * lines[k].amplitude * lines[k].amplitude;
  }
  return powers;
}

/// The shares of a record's power on the multiples of f/m, for m = 1, 2, …
struct SubharmonicShares {
  std::vector<double> shares;  ///< shares[m − 1]: share on the multiples of f/m; 1 without power
  int division = 0;            ///< smallest m with at least the required share, 0 without such m
};

/// The options of a search for subharmonic lines.
struct SubharmonicOptions {
  double base_frequency;      ///< base frequency f (Hz), > 0
  int largest_division = 16;  ///< largest division m, ≥ 1
  double share = 0.999;       ///< required share of the power, 0 < share ≤ 1
};

/// The shares of the power, without the mean, on the multiples of f/m, m = 1, 2, …
///
/// A line is on a multiple if the two are at most half the line spacing apart. The record should
/// contain whole periods of f/m, with a rectangular window, so that nothing leaks. Multiples less
/// than three line spacings apart would cover almost every line: for such m the share is 0.
///
/// Frequencies above the Nyquist frequency are aliased: with f τ = p/q, multiples of f appear on
/// those of f/p = 1/(q τ), the right base frequency. Work: one comparison per line and m.
/// @throws InvalidParameter where an option is out of range or the lines do not match N
inline SubharmonicShares subharmonic_shares(const std::vector<SpectralLine>& lines,
                                            std::size_t samples,
                                            const SubharmonicOptions& options) {
  require_positive("base frequency", options.base_frequency, "Hz");
  require_within("largest division", options.largest_division, "", 1.0, 1e5);
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

/// The smallest number of lines, without the mean, that together contain `share` of the power; 0
/// for a signal without power.
/// @param lines    spectrum of amplitude_spectrum()
/// @param samples  number N of samples of the record
/// @param share    required share of the power, 0 < share ≤ 1
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

/// The share of the power in a floor between the lines: the continuous part of the spectrum.
///
///     (1 / ln 2) Σ over bands of [median power of a line in the band · lines of the band] / total
///
/// with bands of 32 lines. The mean and the first line, into which a Hann window spreads the mean,
/// are left out. Powers of noise are distributed exponentially, with a median of ln 2 of their
/// mean; separate lines do not change a median. Use a Hann window: the leakage of a rectangular
/// window looks like a floor. Lines fewer than eight apart count as floor.
/// @return 0 … 1; 0 for a signal without power
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
