#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "holdfast/orbit/switching_borders.hpp"

namespace holdfast {

/// A strict inequality that must be true for the contact at sample j to be as assumed,
///
///     sign · Δż_j > 0   or   sign · (Δz_j − Δz_k) + widths · r₀ > 0.
///
/// r₀ is the backlash width. The drive is in a gap before sample j and entered it at sample k.
struct SwitchingTest {
  std::int64_t sample;       ///< sample j, counted from the first sample of the period
  std::int64_t entry;        ///< sample k; < 0: in the previous period; unused for a reversal
  SwitchingSurface surface;  ///< switching surface whose distance is tested
  int sign;                  ///< sign of the inequality: 1 or −1
  int widths;                ///< coefficient of r₀ in the inequality: −1, 0 or 1

  /// Whether the inequality tests Δż; otherwise it tests Δz.
  bool is_of_velocity() const { return surface == SwitchingSurface::reversal; }
};

namespace detail {

/// Appends the tests of a sample in a gap that was entered at sample k. The gap is [Δz_k − r₀,
/// Δz_k] if Δż > 0 at sample k − 1, and [Δz_k, Δz_k + r₀] if Δż < 0.
inline void append_gap_tests(const ContactDecision& decision, std::int64_t sample,
                             std::int64_t entry, bool from_positive,
                             std::vector<SwitchingTest>& tests) {
  const int inward = decision.engaged ? -1 : 1;
  const int below = from_positive ? 1 : 0;  // widths from the lower end up to Δz_k
  if (decision.exit_side <= 0)
    tests.push_back({sample, entry, SwitchingSurface::gap_lower, inward, inward * below});
  if (decision.exit_side > 0 || !decision.engaged)
    tests.push_back({sample, entry, SwitchingSurface::gap_upper, -inward, inward * (1 - below)});
}

}  // namespace detail

/// Whether a pattern obeys the reversal rule: an engaged drive enters a gap at a sample if and only
/// if Δż has changed its sign since the previous sample.
inline bool enters_at_reversals(const SwitchingPattern& pattern) {
  const auto& all = pattern.decisions;
  for (std::size_t j = 0; j < all.size(); ++j) {
    const ContactDecision& before = all[j == 0 ? all.size() - 1 : j - 1];
    const bool reverses = all[j].velocity_sign != before.velocity_sign;
    if (!all[j].was_inside && all[j].engaged == reverses) return false;
  }
  return true;
}

/// The inequalities for the contacts of one period, in the order of the samples. If all are true, a
/// periodic motion with these Δz and Δż has the pattern's contacts for ever.
/// @param pattern  pattern with `repeats`, not stays_inside(), and with enters_at_reversals()
inline std::vector<SwitchingTest> switching_tests(const SwitchingPattern& pattern) {
  std::vector<SwitchingTest> tests;
  const auto samples = static_cast<std::int64_t>(pattern.decisions.size());
  std::int64_t entry = 0;
  bool from_positive = false;
  // The first turn finds the gap in which the drive begins.
  for (std::int64_t j = -samples; j < samples; ++j) {
    const ContactDecision& decision =
        pattern.decisions[static_cast<std::size_t>((j + samples) % samples)];
    if (!decision.was_inside && !decision.engaged) {
      entry = j;
      from_positive = pattern.decisions[static_cast<std::size_t>((j + 2 * samples - 1) % samples)]
                          .velocity_sign > 0;
    }
    if (j < 0) continue;
    if (decision.velocity_sign != 0)
      tests.push_back({j, j, SwitchingSurface::reversal, decision.velocity_sign, 0});
    if (decision.was_inside) detail::append_gap_tests(decision, j, entry, from_positive, tests);
  }
  return tests;
}

}  // namespace holdfast
