#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "holdfast/core/errors.hpp"

namespace holdfast {

/// A record of the displacement of one point over time.
struct DecayRecord {
  std::vector<double> times;          ///< instants (s), ascending
  std::vector<double> displacements;  ///< displacements (m) from the equilibrium, downward positive
};

/// Peak, period and decrement of a free decay after removal of a load. A measure is NaN if the
/// record is too short for it.
struct DecayMeasures {
  double first_peak;             ///< extremum (m) between crossings 1 and 2 of the equilibrium
  double first_peak_time;        ///< time (s) from the start of the record to first_peak
  double period;                 ///< period (s): mean of the two cycles after the first crossing
  double logarithmic_decrement;  ///< decrement per cycle, from the four extrema after crossing 1
};

/// An extremum of the displacement between two successive crossings of the equilibrium.
struct DecayPeak {
  double time;   ///< instant (s)
  double value;  ///< displacement (m), downward positive
};

/// The crossings of the equilibrium in a record, interpolated linearly between samples, and the
/// extrema between successive crossings, found by a parabola through three samples.
///
/// A crossing is accepted once the displacement on the new side reaches 5 % of the last extremum.
/// If noise causes several sign changes before, the mean of the first and the last of their times
/// is used. Noise of standard deviation σ raises the modulus of each extremum by about 2σ.
struct DecayEvents {
  std::vector<double> crossings;  ///< times of crossing (s), ascending
  std::vector<DecayPeak> peaks;   ///< peaks[k] is between crossings[k] and crossings[k + 1]
};

namespace detail {

/// Validates instants (s). @throws InvalidParameter unless they are finite and ascending
inline void require_ascending(const std::vector<double>& times) {
  for (std::size_t k = 0; k < times.size(); ++k) {
    require_finite("time", times[k], "s");
    if (k > 0 && !(times[k] > times[k - 1]))
      throw InvalidParameter("time", times[k], "s", "later than the previous instant");
  }
}

/// The vertex of the parabola through the samples k − 1, k, k + 1.
inline DecayPeak vertex(const DecayRecord& record, std::size_t k) {
  const auto& t = record.times;
  const auto& z = record.displacements;
  const double before = t[k - 1] - t[k], after = t[k + 1] - t[k];
  const double left = (z[k - 1] - z[k]) / before, right = (z[k + 1] - z[k]) / after;
  const double curvature = (right - left) / (after - before);
  if (curvature == 0.0) return {t[k], z[k]};
  const double slope = left - curvature * before;
  const double shift = -0.5 * slope / curvature;
  return {t[k] + shift, z[k] + 0.5 * slope * shift};
}

}  // namespace detail

/// Finds the crossings and the extrema of a record. @throws InvalidParameter if the numbers of
/// times and displacements differ, or a value is not finite, or the times are not ascending
inline DecayEvents decay_events(const DecayRecord& record) {
  const auto& t = record.times;
  const auto& z = record.displacements;
  if (t.size() != z.size())
    throw InvalidParameter("number of displacements", static_cast<double>(z.size()), "",
                           "equal to the number of instants");
  detail::require_ascending(t);
  for (const double displacement : z) require_finite("displacement", displacement, "m");
  constexpr double smallest_swing = 0.05;
  DecayEvents events;
  std::size_t extreme = 0;  // index of the current swing's extremum
  double first = 0.0, last = 0.0;
  bool crossing = false;  // whether the record has crossed since that swing's last sample
  for (std::size_t k = 1; k < t.size(); ++k) {
    if ((z[k - 1] < 0.0) != (z[k] < 0.0)) {
      last = t[k - 1] + (t[k] - t[k - 1]) * z[k - 1] / (z[k - 1] - z[k]);
      if (!crossing) first = last;
      crossing = true;
    }
    const bool other_side = (z[k] < 0.0) != (z[extreme] < 0.0);
    const bool swings = std::abs(z[k]) >= smallest_swing * std::abs(z[extreme]);
    if (other_side && swings) {
      if (!events.crossings.empty()) events.peaks.push_back(detail::vertex(record, extreme));
      events.crossings.push_back(0.5 * (first + last));
    }
    if (swings) crossing = false;
    if ((other_side && swings) || (!other_side && std::abs(z[k]) > std::abs(z[extreme])))
      extreme = k;
  }
  return events;
}

/// The logarithmic decrement per cycle from four successive extrema ≠ 0 of alternating sign. With
/// l_k = ln |peaks[k − 1]| it is (3 (l₁ − l₄) + l₂ − l₃)/5, minus twice the slope of the
/// least-squares line through the points (k, l_k), since a cycle has two extrema.
template <class Scalar>
Scalar logarithmic_decrement(const std::array<Scalar, 4>& peaks) {
  using std::abs;
  using std::log;
  const Scalar outer = log(abs(peaks[0] / peaks[3])), inner = log(abs(peaks[1] / peaks[2]));
  return (Scalar(3) * outer + inner) / Scalar(5);
}

/// The measures of a free decay. The record must begin at the instant when the load is removed.
/// @throws InvalidParameter under the conditions of decay_events()
inline DecayMeasures decay_measures(const DecayRecord& record) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const DecayEvents events = decay_events(record);
  const auto& peaks = events.peaks;
  DecayMeasures measures{none, none, none, none};
  if (!peaks.empty()) {
    measures.first_peak = peaks[0].value;
    measures.first_peak_time = peaks[0].time - record.times.front();
  }
  if (events.crossings.size() >= 5)
    measures.period = 0.5 * (events.crossings[4] - events.crossings[0]);
  if (peaks.size() >= 4)
    measures.logarithmic_decrement = logarithmic_decrement<double>(
        {peaks[0].value, peaks[1].value, peaks[2].value, peaks[3].value});
  return measures;
}

}  // namespace holdfast
