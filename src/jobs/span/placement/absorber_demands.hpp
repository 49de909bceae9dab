#pragma once

#include <vector>

#include "case/case.hpp"
#include "holdfast/control/gains.hpp"

namespace holdfast::program {

/// Demands on the drive of a case's absorber in the wind, by the energy balance with the pair of
/// laws that gives the largest amplitude at each frequency.
struct AbsorberDemands {
  double largest_force;   ///< N, amplitude of the command over the band, lags of the loop included
  double largest_stroke;  ///< m, amplitude of the absorber against the conductor, over the band
  double drive_power;     ///< W, mean, that the drive gives; negative: that it takes
};

/// @param frequencies  Hz, of the band
/// @param worst        Hz, at which the power is asked
/// All NaN for a conductor whose diameter is not known.
AbsorberDemands absorber_demands(const Case& the_case, const std::vector<double>& frequencies,
                                 double worst);

/// The gains of `perfect_absorption` of a case's absorber, alone at its end; NaN where its place is
/// a node.
/// @param frequency  Hz
PdGains<double> perfect_gains(const Case& the_case, double frequency);

}  // namespace holdfast::program
