#pragma once

#include <vector>

#include "case/case.hpp"
#include "holdfast/control/gains.hpp"

namespace holdfast::program {

/// Demands on the drive of a case's absorber in the wind, by the energy balance with the pair of
/// laws that gives the largest amplitude at each frequency.
struct AbsorberDemands {
  double largest_force;   ///< largest command amplitude (N) over the band, with the loop's lags
  double largest_stroke;  ///< largest amplitude (m) of absorber against conductor in the band
  double drive_power;     ///< mean power (W) delivered by the drive; negative: absorbed
};

/// Demands of a case's absorber in a band; all NaN for a conductor whose diameter is not known.
/// @param frequencies  frequencies (Hz) of the band
/// @param worst        frequency (Hz) for which the drive power is computed
AbsorberDemands absorber_demands(const Case& the_case, const std::vector<double>& frequencies,
                                 double worst);

/// Gains of `perfect_absorption` for a case's absorber, as if alone at its end of the span; NaN
/// where the absorber sits at a node.
/// @param frequency  frequency (Hz) of the absorbed wave
PdGains<double> perfect_gains(const Case& the_case, double frequency);

}  // namespace holdfast::program
