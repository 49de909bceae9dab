#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "case/job_context.hpp"
#include "holdfast/stability/design/minimax_amplitude.hpp"
#include "jobs/family/family.hpp"

namespace holdfast::program {

/// Options of the search for the best gains of a whole family.
struct FamilyDesign {
  FrequencyBand band;  ///< frequency band (Hz); equal ends: one frequency
  std::optional<double> largest_radius, margin;
  std::optional<double> largest_ratio;  ///< upper limit of amplitude over amplitude without control
  bool both_gains = false;              ///< whether P is searched too; else only D
  bool prove = false;                   ///< whether stability of every member is to be proved
  std::string schedule;  ///< uncertain key over which gains are scheduled; "": one pair
  int draws = 100;
};

/// Function that gives the job context of the case with overrides, each "key=value".
using ContextWith = std::function<JobContext(const std::vector<std::string>& overrides)>;

/// Writes the gains that minimise the largest amplitude ratio over the drawn members, one row for
/// each piece of the schedule. The pieces are the fewest in each of which one pair of gains is
/// admissible for all members; adjacent pieces share the member at their border.
/// Throws WrongInput where gains are uncertain or the schedule's key is not, NoAnswer where no
/// gains are admissible, and what family_proof_of() throws.
void write_family_gains(const JobContext& context, const FamilyDesign& question,
                        const ContextWith& context_with);

}  // namespace holdfast::program
