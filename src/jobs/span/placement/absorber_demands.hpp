#pragma once

#include <vector>

#include "case/case.hpp"
#include "holdfast/control/gains.hpp"

namespace holdfast::program {

/// Demands on the drive of a case's absorber in the wind, by the energy balance with the pair of
/// laws that gives the largest amplitude at each frequency.
struct AbsorberDemands {
  double largest_force;   ///< N, amplitude of the command over the band, with all lags of the loop
  double largest_stroke;  ///< m, amplitude of the absorber relative to the conductor, over the band
  double drive_power;     ///< W, mean power delivered by the drive; negative: absorbed
};

/// @param frequencies  frequencies of the band, Hz
/// @param worst        frequency of the drive power, Hz
/// All NaN for a conductor whose diameter is not known.
AbsorberDemands absorber_demands(const Case& the_case, const std::vector<double>& frequencies,
                                 double worst);

/// Gains of `perfect_absorption` for a case's absorber, as if alone at its end of the span; NaN
/// where the absorber sits at a node.
/// @param frequency  Hz
PdGains<double> perfect_gains(const Case& the_case, double frequency);

}  // namespace holdfast::program
