#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "case/job_context.hpp"
#include "host/received_table.hpp"

namespace holdfast::program {

/// A case of a family: a number for each key of [uncertain].
struct FamilyMember {
  std::vector<std::pair<std::string, double>> values;

  /// The number of a key; NaN where the member has none.
  double value_of(const std::string& key) const;
  /// The settings that make the case of it: {"stringing.tension=25e3", …}.
  std::vector<std::string> overrides() const;
  /// "stringing.tension=25e3;control.sampling_period=0.001".
  std::string text() const;
};

/// Members of a case's family: the middle of its box, its corners where these are few, and further
/// ones by a Latin hypercube; of a single range, values equally far apart, both ends among them.
/// Every call gives the same ones for the same case and number.
/// @param draws  of them in all, at least 2
/// Throws WrongInput for a case without [uncertain], and what uncertain_ranges() throws.
std::vector<FamilyMember> family_members(const Case& the_case, int draws);

/// A job's answer about one member.
using MemberAnswer = std::function<ReceivedTable(const FamilyMember&)>;

/// Writes a job's table over a family: of each row that of the member which is worst, and which
/// member that is. What is worst, texts/jobs.toml says of each job; stable intervals are
/// intersected. Says on standard error that members were drawn, and that nothing is proved between
/// them, unless intervals are to be proved, see proved_interval().
/// Throws WrongInput where the job has no worst, NoAnswer where members answer with other rows, and
/// what a member's answer throws, with the member named.
void write_worst_of_family(const JobContext& context, int draws, bool prove,
                           const MemberAnswer& answer);

}  // namespace holdfast::program
