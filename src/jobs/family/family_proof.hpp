#pragma once

#include <cstddef>
#include <string>

#include "case/job_context.hpp"
#include "holdfast/stability/chart/proved_chart.hpp"

namespace holdfast::program {

/// The proof about all members of a case's family.
struct FamilyProof {
  ProvedStability verdict;
  double stable_share, undecided_share;  // of the box's volume
  std::size_t parts;                     // boxes that were looked at
  std::string worst_member;              // one that is unstable, by its uncertain keys; "": none
};

/// Proves that every member of [uncertain] is stable, or finds one that is not: of two masses, or
/// of a taut string with plant.modes modes of one damping ratio, under an ideal computer with a
/// delay of at most a sample. Along weather.temperature the tension is that of the change of state.
/// On the threads of the context. Throws Interrupted, and WrongInput for another loop, and for a
/// key that has no range there.
FamilyProof family_proof_of(const JobContext& context);

}  // namespace holdfast::program
