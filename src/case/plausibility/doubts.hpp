#pragma once

#include <string>
#include <vector>

#include "case/case_keys.hpp"
#include "case/plausibility/quantities.hpp"

namespace holdfast::program {

/// Keys that the user probably gave in another unit.
struct UnitGuess {
  std::vector<std::string> keys;  // none: no unit makes the case more plausible
  std::string text;               // "; is it in mm2, 0.000546 m2?"
  Case corrected;                 // with the values in that unit
};

/// Which of the keys, of those that the user gave, makes the case most plausible if its value is
/// read in another unit: one key alone, or all of its table that bear its unit.
UnitGuess guessed_unit(const Case& the_case, const std::vector<std::string>& keys,
                       const std::vector<PlausibleQuantity>& quantities);

/// A quantity that no cable has, nor its wind nor its drive: the part of first_fault() about it.
CaseFault impossible_fault(const Case& the_case);

/// Quantities about what the case has: none of the two masses' conductor where the plant is the
/// conductor itself, none of an absorber that does not count.
std::vector<PlausibleQuantity> in_question(const Case& the_case,
                                           const std::vector<PlausibleQuantity>& quantities);

/// Doubts about what lies beyond the usual, a line each: where the key was given, the quantity, the
/// usual range and why, and the likely unit. All that one mistaken unit explains is said once; a
/// quantity that follows from no key of the user's is not said.
std::vector<std::string> doubts_about(const Case& the_case,
                                      const std::vector<PlausibleQuantity>& quantities);

/// That the plant which the user gave is not that of the conductor beside it: k1, m2 or a natural
/// frequency, the four numbers of which a reduction makes a plant, differ by more than 5 %.
/// (m1 and k2 follow from them, near a double solution with thirty times their error; readings of
/// k1 from the paper's own conductor lie within 3 % of its Table 1.) Empty otherwise.
std::string contradicted_conductor_text(const Case& the_case);

/// That values given beside conductor.name are not its: those that differ by more than a tenth from
/// the library's, with both and their ratio, and the unit whose mistake that ratio is. Empty
/// otherwise.
std::string contradicted_name_text(const Case& the_case);

/// That the damping ratio of a named conductor is the built-in cable's. Empty otherwise.
std::string borrowed_damping_text(const Case& the_case);

/// That the gains are those of the built-in case while the plant is far from its: by the impedance
/// √(k2 m2), the scale of a differential gain, more than three times off. Empty otherwise, and
/// where the user gave either gain.
std::string borrowed_gains_text(const Case& the_case);

/// The keys of gains, sampling period and play that a case with a plant or conductor of its own
/// leaves to the built-in one: "control.sampling_period, backlash.width". Empty without such.
std::string borrowed_control(const Case& the_case);

}  // namespace holdfast::program
