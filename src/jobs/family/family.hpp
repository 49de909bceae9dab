#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "case/job_context.hpp"
#include "host/received_table.hpp"

namespace holdfast::program {

/// Member of a family of cases: one value for each key of [uncertain].
struct FamilyMember {
  std::vector<std::pair<std::string, double>> values;

  /// Value of a key; NaN where the member has no such key.
  double value_of(const std::string& key) const;
  /// Settings that turn the case into this member: {"stringing.tension=25e3", …}.
  std::vector<std::string> overrides() const;
  /// Settings as one text: "stringing.tension=25e3;control.sampling_period=0.001".
  std::string text() const;
};

/// Members of a case's family: the centre of the box of ranges, its corners if few, and further
/// members by Latin-hypercube sampling. A single range gives equally spaced values with both ends.
/// Deterministic: equal arguments give equal members.
/// @param draws  total number of members, at least 2
/// Throws WrongInput for a case without [uncertain], and what uncertain_ranges() throws.
std::vector<FamilyMember> family_members(const Case& the_case, int draws);

/// Function that computes a job's table for one member.
using MemberAnswer = std::function<ReceivedTable(const FamilyMember&)>;

/// Writes a job's table over a family: each row is that of the worst member, with its values added.
/// [worst] of texts/jobs.toml names the columns that decide; stable intervals are intersected.
/// Warns that members between the drawn ones are not checked, unless `prove`: proved_interval().
/// Throws WrongInput where [worst] has no column for the job, NoAnswer where members give different
/// numbers of rows, and what a member's answer throws, with the member named.
void write_worst_of_family(const JobContext& context, int draws, bool prove,
                           const MemberAnswer& answer);

}  // namespace holdfast::program
