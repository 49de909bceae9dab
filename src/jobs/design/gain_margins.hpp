#pragma once

#include "case/model/linear_loop.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/stability/margins/margins.hpp"
#include "holdfast/stability/margins/proved_margins.hpp"

namespace holdfast::program {

/// Default of `AmplitudeOptions::margin` for a recommended D: half of the distance from the
/// stability boundary, and half of the decay rate, that the D of fastest decay has.
inline constexpr double usual_margin = 0.5;

/// Stability margins of a loop with given gains, in the tables' units; NaN where it is not stable.
struct GainMargins {
  double spectral_radius;
  double gain_decibels;     ///< gain margin (dB) of both gains; ∞: any increase is stable
  double phase_degrees;     ///< phase margin; ∞ where the open-loop gain is never 1
  double delay;             ///< delay margin (s) in addition to δ; or the end of the search
  bool is_delay_of_search;  ///< whether `delay` is the end of the search
};

/// Margins of a loop. @param gains  P (N/m), D (N s/m); all margins are NaN if one is not finite
GainMargins gain_margins(const LinearLoop& loop, const PdGains<double>& gains);

/// Warns that gains lie on the stability boundary and have no margin.
void warn_of_edge(double spectral_radius, double sampling_period, bool quiet);

/// Stable ranges of the gains P, D, the sampling period τ and the delay δ around those of a case.
struct CaseMargins {
  StabilityMargins margins;
  /// Whether the ranges of τ and δ are known to contain no unstable interval: by formula, or by a
  /// proof that takes about a second at most.
  bool looked_everywhere;
};

/// Stability margins in floating point. If τ and δ are searched in steps, a proof of about a second
/// checks for unstable intervals between steps. @param of_delay  whether δ is searched, too
CaseMargins stability_margins_of(const Case& the_case, const PdGains<double>& gains,
                                 bool of_delay = true);

/// Proves stability margins by interval arithmetic, for the cases that texts/support.toml admits.
/// Throws what proved_poles_of throws, Interrupted, and NoAnswer if the loop is not proved stable.
/// @param found  margins to prove; ends of τ and δ beyond a missed unstable interval are corrected
ProvedMargins proved_margins_of(const Case& the_case, const PdGains<double>& gains,
                                StabilityMargins& found);

}  // namespace holdfast::program
