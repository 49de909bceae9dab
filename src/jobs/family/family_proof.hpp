#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "case/job_context.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/stability/chart/proved_chart.hpp"
#include "jobs/family/family.hpp"

namespace holdfast::program {

/// Result of a stability proof over all members of a case's family.
struct FamilyProof {
  ProvedStability verdict;
  double stable_share, undecided_share;  // shares of the box's volume
  std::size_t parts;                     // sub-boxes examined
  FamilyMember unstable;                 // member proved unstable; without values: none found
};

/// Proves that every member of [uncertain] is stable, or finds an unstable one, on the context's
/// threads. Admits two masses, or a taut string with plant.modes modes of one damping ratio, under
/// an ideal computer with a delay of at most a sample. A range of weather.temperature is converted
/// to tensions by the change-of-state equation. Throws Interrupted, and WrongInput for another loop
/// or a key whose range the proof does not admit.
/// @param parts  largest number of sub-boxes to examine
FamilyProof family_proof_of(const JobContext& context, std::size_t parts = 4000);

/// Interval of a gain in which every member of the family is proved stable: the given interval,
/// shortened at each end by 0.002 to 0.1 of its length. The gain of an unstable member that the
/// proof finds replaces the nearer end. nullopt where nothing is proved.
/// @param gain      "proportional_gain" or "differential_gain"
/// @param other     value of the other gain
/// @param interval  interval in which the drawn members are stable
std::optional<Interval<double>> proved_interval(JobContext context, const std::string& gain,
                                                double other, Interval<double> interval);

}  // namespace holdfast::program
