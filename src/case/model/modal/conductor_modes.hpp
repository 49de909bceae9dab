#pragma once

#include <vector>

#include "case/case.hpp"
#include "holdfast/cable/taut_string.hpp"
#include "holdfast/plant/modal_plant.hpp"

namespace holdfast::program {

/// The conductor as a taut string, with the tension of the case or the one that its sag leaves.
TautString<double> string_of(const Case& the_case);

/// ζ of a mode of the conductor alone, ω in rad/s: conductor.damping_ratio, or by Rayleigh's
/// damping.
double bare_damping_of(const Case& the_case, double angular_frequency);

/// The conductor as the absorber's place sees it.
struct ConductorModes {
  std::vector<PlaceMode<double>> modes;  ///< ascending frequency
  int apart;                             ///< so many are modes, those behind bundles of modes
  int bars = 0;                          ///< of a cable, how many stand for it

  /// Hz, of the last mode that is kept apart.
  double highest_frequency() const;
};

/// Modes that a modal case is computed with: plant.modes and no more; or 60, and up to 300 of a
/// string and 200 of a cable, the faster ones bundled. Beyond 60 those are kept whose waves the
/// nearer end sends back by more than a tenth, up to five times what half the sampling rate and
/// twice the force's frequency reach; and of a string as many more as `judged_modes_of` has up to
/// five times the absorber's frequency. Throws NoAnswer where a cable has no equilibrium, or not so
/// many modes for its bars.
ConductorModes conductor_modes_of(const Case& the_case);

/// All modes of the conductor, about so many of them kept apart.
ConductorModes all_conductor_modes_of(const Case& the_case, int apart);

/// Modes of the same conductor with half as many kept apart, of a cable also by fewer bars: how far
/// an answer depends on them.
ConductorModes coarser_modes_of(const Case& the_case, const ConductorModes& conductor);

/// All modes of the string by which its stability is judged: kept apart up to twice the sampling
/// rate, or to where less than a twentieth of a wave comes back from the supports, 2000 at most and
/// never fewer than it is computed with.
ConductorModes judged_modes_of(const Case& the_case);

/// The modes of the string up to twice the sampling rate, 2000 at most, and none beyond.
ConductorModes cut_modes_of(const Case& the_case);

/// Whether a cable would need more bars than it has for the waves that sampling shows.
bool lacks_bars(const Case& the_case);

}  // namespace holdfast::program
