#pragma once

#include <string>
#include <vector>

#include "case/case_keys.hpp"
#include "case/plausibility/quantities.hpp"

namespace holdfast::program {

/// Keys that the user probably gave in another unit.
struct UnitGuess {
  std::vector<std::string> keys;  // none: no unit makes the case more plausible
  std::string text;               // "; did you mean mm2, that is 0.000546 m2?"
  Case corrected;                 // the case with the values read in that unit
};

/// The given keys that make the case most plausible if their values are read in another unit: one
/// of `keys` alone, or all given keys of its table with its unit.
UnitGuess guessed_unit(const Case& the_case, const std::vector<std::string>& keys,
                       const std::vector<PlausibleQuantity>& quantities);

/// Fault of the first quantity impossible for any cable, wind or drive; part of first_fault().
CaseFault impossible_fault(const Case& the_case);

/// The quantities that concern the case: without plant.conductor_* unless the plant is two masses,
/// and without the absorber if the case has no active one.
std::vector<PlausibleQuantity> in_question(const Case& the_case,
                                           const std::vector<PlausibleQuantity>& quantities);

/// Doubts about quantities outside their usual ranges, a line each: place of the key in the input,
/// quantity, usual range, reason and likely unit. One mistaken unit gives one line even if it
/// explains several quantities. Quantities that depend on no given key are skipped.
std::vector<std::string> doubts_about(const Case& the_case,
                                      const std::vector<PlausibleQuantity>& quantities);

/// Warning that a plant given in full contradicts the given conductor: k1, m2 or one of the two
/// natural frequencies, the inputs of a reduction, differs by more than 5 %. m1 and k2 are not
/// compared: near a double solution they may differ 30 times as much. Empty otherwise.
std::string contradicted_conductor_text(const Case& the_case);

/// Warning about values given together with conductor.name that differ by more than a tenth from
/// the library: both values, their ratio, and a unit that explains the ratio. Empty otherwise.
std::string contradicted_name_text(const Case& the_case);

/// A warning that a named conductor has the built-in cable's damping ratio. Empty otherwise.
std::string borrowed_damping_text(const Case& the_case);

/// A warning that the gains are built-in although the absorber's impedance √(k2 m2) (N s/m), the
/// scale of a differential gain, differs from the built-in one by a factor of 3 or more. Empty
/// otherwise, and if the user gave either gain.
std::string borrowed_gains_text(const Case& the_case);

/// The keys of gains, sampling period and play left at built-in values although the user gives a
/// plant or conductor: "control.sampling_period, backlash.width". Empty if there are none.
std::string borrowed_control(const Case& the_case);

}  // namespace holdfast::program
