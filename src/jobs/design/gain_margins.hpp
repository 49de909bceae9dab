#pragma once

#include "case/model/linear_loop.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/stability/margins/margins.hpp"
#include "holdfast/stability/margins/proved_margins.hpp"

namespace holdfast::program {

/// Margin that a recommended D keeps where nothing else is asked: half the way from the boundary of
/// stability to the D that decays fastest (`AmplitudeOptions::margin`).
inline constexpr double usual_margin = 0.5;

/// The margins of a case's loop with some gains, in the units of the program's tables; NaN where
/// the loop is not stable.
struct GainMargins {
  double spectral_radius;
  double gain_decibels;     ///< of both gains together, upwards; infinite without an end
  double phase_degrees;     ///< infinite where the loop's gain is 1 at no frequency
  double delay;             ///< s, further; as far as was looked where no end was met
  bool is_delay_of_search;  ///< the latter
};

/// @param gains  not finite: all is NaN
GainMargins gain_margins(const LinearLoop& loop, const PdGains<double>& gains);

/// Warns of gains on the boundary of stability itself, which are none to use.
void warn_of_edge(double spectral_radius, double sampling_period, bool quiet);

/// How far P, D, τ and δ of a case may go.
struct CaseMargins {
  StabilityMargins margins;
  /// Whether no instability between the value and the ends of τ and δ can have been passed over:
  /// where these are walked in steps, that is then proved if it takes no longer than a second or
  /// so.
  bool looked_everywhere;
};

/// As far as doubles find them, looked at everywhere where that is soon done.
CaseMargins stability_margins_of(const Case& the_case, const PdGains<double>& gains);

/// Proves those margins, of a case of which it may be asked (texts/support.toml). Throws what
/// proved_poles_of does, Interrupted, and NoAnswer where the loop is not proved to be stable.
/// @param found  how far to look; its ends of τ and δ that the walk has passed over are put right
ProvedMargins proved_margins_of(const Case& the_case, const PdGains<double>& gains,
                                StabilityMargins& found);

}  // namespace holdfast::program
