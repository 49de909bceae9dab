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
  int apart;     ///< number of single modes; bundles follow, each one mode for many faster ones
  int bars = 0;  ///< number of bars of a hanging cable; 0: no cable

  /// The frequency (Hz) of the last single mode.
  double highest_frequency() const;
};

/// Modes with which a case is computed: the lowest plant.modes modes if that key is given. Else at
/// least 60 single modes and bundles of all faster ones. More modes are single, up to 300 of a
/// string and 200 of a cable, while the nearer support returns over a tenth of a wave and up to
/// five times the larger of half the sampling rate and twice the force's frequency; on a string
/// also up to five times the absorber's frequency, as in `judged_modes_of`. Two masses and a string
/// without ends have one mode. Throws NoAnswer if a cable has no equilibrium or too few modes.
ConductorModes conductor_modes_of(const Case& the_case);

/// All modes of the conductor, about `apart` of them single and the faster ones in bundles.
ConductorModes all_conductor_modes_of(const Case& the_case, int apart);

/// Modes of the same conductor with half as many single modes, and for a cable with 0.7 times the
/// bars, to show how much a result depends on these numbers.
ConductorModes coarser_modes_of(const Case& the_case, const ConductorModes& conductor);

/// All modes of the string for a test of the loop's stability. Modes are single up to twice the
/// sampling rate, or until less than a twentieth of a wave returns from the supports: at most 2000,
/// at least the number that `conductor_modes_of` chooses.
ConductorModes judged_modes_of(const Case& the_case);

/// The modes of the string up to twice the sampling rate, at most 2000; faster modes are omitted.
ConductorModes cut_modes_of(const Case& the_case);

/// Whether a cable has too few bars for the waves at half the sampling rate.
bool lacks_bars(const Case& the_case);

}  // namespace holdfast::program
