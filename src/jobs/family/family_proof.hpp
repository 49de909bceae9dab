#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "case/job_context.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/stability/chart/proved_chart.hpp"
#include "jobs/family/family.hpp"

namespace holdfast::program {

/// The proof about all members of a case's family.
struct FamilyProof {
  ProvedStability verdict;
  double stable_share, undecided_share;  // of the box's volume
  std::size_t parts;                     // boxes that were looked at
  FamilyMember unstable;                 // one that is; without values: none found
};

/// Proves that every member of [uncertain] is stable, or finds one that is not: of two masses, or
/// of a taut string with plant.modes modes of one damping ratio, under an ideal computer with a
/// delay of at most a sample. Along weather.temperature the tension is that of the change of state.
/// On the threads of the context. Throws Interrupted, and WrongInput for another loop, and for a
/// key that has no range there.
/// @param parts  most boxes that are looked at
FamilyProof family_proof_of(const JobContext& context, std::size_t parts = 4000);

/// An interval of a gain in which every member of the family is proved stable: the given one but
/// for a small share at each end, 0.002 where that can be proved, and at most 0.1. None where less
/// is.
/// @param gain      "proportional_gain" or "differential_gain"
/// @param other     the value of the other gain
/// @param interval  in which members that were drawn are stable
std::optional<Interval<double>> proved_interval(JobContext context, const std::string& gain,
                                                double other, Interval<double> interval);

}  // namespace holdfast::program
