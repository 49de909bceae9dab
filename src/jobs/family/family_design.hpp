#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "case/job_context.hpp"
#include "holdfast/stability/design/minimax_amplitude.hpp"
#include "jobs/family/family.hpp"

namespace holdfast::program {

/// The question which gains serve a whole family best.
struct FamilyDesign {
  FrequencyBand band;  ///< Hz; both ends alike: one frequency
  std::optional<double> largest_radius, margin;
  std::optional<double> largest_ratio;  ///< amplitude that may be left, over that without control
  bool both_gains = false;              ///< P too, else D alone
  bool prove = false;                   ///< that every member of the box is stable with them
  std::string schedule;  ///< uncertain key along which the gains may change; "": one pair
  int draws = 100;
};

/// The context of the case with some overrides, "key=value", ready to be asked.
using ContextWith = std::function<JobContext(const std::vector<std::string>& overrides)>;

/// Writes the gains of least worst amplitude over the members that are drawn, a row for each piece
/// of the schedule: the fewest pieces in each of which one pair serves all. Neighbours share the
/// members at their border.
/// Throws WrongInput where gains are uncertain or the schedule's key is not, NoAnswer where no
/// gains serve, and what family_proof_of() throws.
void write_family_gains(const JobContext& context, const FamilyDesign& question,
                        const ContextWith& context_with);

}  // namespace holdfast::program
