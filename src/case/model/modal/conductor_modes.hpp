#pragma once

#include <vector>

#include "case/case.hpp"
#include "holdfast/cable/taut_string.hpp"
#include "holdfast/plant/modal_plant.hpp"

namespace holdfast::program {

/// The conductor as a taut string, with the given tension or the one computed from the sag.
TautString<double> string_of(const Case& the_case);

/// The damping ratio ζ of a bare conductor's mode at ω (rad/s): constant, or Rayleigh damping.
double bare_damping_of(const Case& the_case, double angular_frequency);

/// The modes of the conductor at the absorber's place.
struct ConductorModes {
  std::vector<PlaceMode<double>> modes;  ///< modes by ascending frequency
  int apart;     ///< number of single modes; bundles of faster modes follow them
  int bars = 0;  ///< number of bars of a hanging cable; 0: no cable

  /// The frequency (Hz) of the last single mode.
  double highest_frequency() const;
};

/// The modes with which a case is computed: plant.modes alone if given. Otherwise at least 60
/// single modes, at most 300 of a string and 200 of a cable, and bundles of all faster modes.
/// Beyond 60, modes are single while the nearer support returns more than a tenth of their waves,
/// up to five times the larger of half the sampling rate and twice the force's frequency. A string
/// also has the single modes of `judged_modes_of` up to five times the absorber's frequency. Throws
/// NoAnswer if a cable has no equilibrium, or too few modes for plant.modes.
ConductorModes conductor_modes_of(const Case& the_case);

/// All modes of the conductor, about `apart` of them single and the faster ones in bundles.
ConductorModes all_conductor_modes_of(const Case& the_case, int apart);

/// Modes of the same conductor with half as many single modes, and fewer bars for a cable, to show
/// how far a result depends on these numbers.
ConductorModes coarser_modes_of(const Case& the_case, const ConductorModes& conductor);

/// All modes of the string for the test of its stability. Modes are single up to twice the sampling
/// rate, or until less than a twentieth of a wave returns from the supports: at most 2000 and at
/// least as many as in `conductor_modes_of`.
ConductorModes judged_modes_of(const Case& the_case);

/// The modes of the string up to twice the sampling rate, at most 2000; faster modes are omitted.
ConductorModes cut_modes_of(const Case& the_case);

/// Whether a cable has too few bars for the waves at half the sampling rate.
bool lacks_bars(const Case& the_case);

}  // namespace holdfast::program
