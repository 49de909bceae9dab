#include "jobs/family/family_design.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "case/model/linear_loop.hpp"
#include "case/model/plant_of_case.hpp"
#include "case/uncertain.hpp"
#include "jobs/charts/names.hpp"
#include "jobs/columns.hpp"
#include "jobs/design/best_gains.hpp"
#include "jobs/design/gain_margins.hpp"
#include "jobs/family/family_proof.hpp"
#include "output/table.hpp"
#include "process/errors.hpp"
#include "process/exit.hpp"
#include "process/interrupt.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

/// The members of a family, sorted by the key of the schedule, with their loops.
class DesignedFamily {
 public:
  DesignedFamily(const JobContext& context, const FamilyDesign& question,
                 const ContextWith& context_with)
      : question_(question), members_(family_members(context.case_data, question.draws)) {
    for (const UncertainRange& range : uncertain_ranges(context.case_data)) {
      if (range.key == "control.proportional_gain" || range.key == "control.differential_gain")
        throw WrongInput("uncertain." + range.key +
                         ": design --family chooses the gains itself; remove this range");
      if (range.key == question.schedule) whole_ = range;
    }
    if (!question.schedule.empty() && whole_.key.empty())
      throw WrongInput("--schedule " + question.schedule +
                       ": [uncertain] gives no range for this key; add one");
    std::stable_sort(members_.begin(), members_.end(), [this](const auto& one, const auto& other) {
      return one.value_of(whole_.key) < other.value_of(whole_.key);
    });
    cases_.reserve(members_.size());  // loops refer to them
    for (const FamilyMember& member : members_) {
      cases_.push_back(context_with(member.overrides()).case_data);
      loops_.emplace_back(cases_.back());
      options_.push_back(
          amplitude_options_of(cases_.back(), question.largest_radius, question.margin));
      if (question.band.lower < question.band.upper)
        validate(question.band, options_.back().sampling.period);
    }
    if (!question.both_gains) p_ = gains_of(context.case_data).proportional;
  }

  /// A range of members, both ends included, for which one pair of gains is used.
  struct Piece {
    std::size_t first, last;
    MinimaxGains gains;
  };

  /// The pieces of the schedule, as few as possible; one piece without a schedule.
  std::vector<Piece> pieces() const {
    const std::size_t last = members_.size() - 1;
    std::vector<Piece> pieces;
    do {
      const std::size_t first = pieces.empty() ? 0 : pieces.back().last;
      std::optional<Piece> longest;
      std::size_t served = first, unserved = last + 1;
      for (std::size_t end = last; served < last && unserved > served + 1;) {
        if (const MinimaxGains gains = gains_for(first, end); serve(gains)) {
          served = end;
          longest = {first, end, gains};
        } else {
          unserved = end;
          if (whole_.key.empty()) break;
        }
        end = (served + unserved) / 2;
      }
      if (!longest) throw NoAnswer(why_none(first));
      pieces.push_back(*longest);
    } while (pieces.back().last < last);
    return pieces;
  }

  /// Writes the row of one piece to the table.
  void write(Table& table, const Piece& piece, const ContextWith& context_with,
             double& largest_radius) const {
    const auto& [first, last, found] = piece;
    const auto& [p, quietest] = found;
    const PdGains<double> gains{p, quietest.differential_gain};
    GainMargins least{0.0, unbounded, unbounded, unbounded, false};
    double lowest = unbounded, highest = 0.0;
    for (std::size_t k = first; k <= last; ++k) {
      const LinearLoop& loop = loops_[k];
      const GainMargins here = gain_margins(loop, gains);
      least.spectral_radius = std::max(least.spectral_radius, here.spectral_radius);
      least.gain_decibels = std::min(least.gain_decibels, here.gain_decibels);
      least.phase_degrees = std::min(least.phase_degrees, here.phase_degrees);
      least.delay = std::min(least.delay, here.delay);
      lowest = std::min(lowest, loop.first_frequency());
      highest = std::max(highest, loop.first_frequency());
    }
    largest_radius = std::max(largest_radius, least.spectral_radius);
    double begin = std::nan(""), end = begin;
    if (!whole_.key.empty()) {
      begin = first == 0 ? whole_.lowest : members_[first].value_of(whole_.key);
      end = last + 1 == members_.size() ? whole_.highest : members_[last].value_of(whole_.key);
    }
    std::string proved = "compared";
    if (question_.prove) {
      const FamilyMember with_gains{
          {{"control.proportional_gain", p}, {"control.differential_gain", gains.differential}}};
      std::vector<std::string> overrides = with_gains.overrides();
      if (!whole_.key.empty())
        overrides.push_back("uncertain." + whole_.key + "=[" + format_number(begin) + ", " +
                            format_number(end) + "]");
      proved = name_in(proved_names, family_proof_of(context_with(overrides)).verdict);
    }
    table.row(begin, end, lowest, highest, question_.band.lower, question_.band.upper, p,
              gains.differential, quietest.worst_ratio, quietest.worst_frequency,
              quietest.attenuation, quietest.lower_bound, least.spectral_radius,
              least.gain_decibels, least.phase_degrees, least.delay, proved,
              members_[first + quietest.worst_member].text());
  }

 private:
  MinimaxGains gains_for(std::size_t first, std::size_t last) const {
    throw_if_interrupted();
    const auto from = static_cast<std::ptrdiff_t>(first),
               to = static_cast<std::ptrdiff_t>(last) + 1;
    return LinearLoop::quietest_for_all({loops_.begin() + from, loops_.begin() + to},
                                        {options_.begin() + from, options_.begin() + to},
                                        question_.band, p_);
  }

  bool serve(const MinimaxGains& gains) const {
    return gains.quietest.outcome != MinimaxOutcome::none &&
           gains.quietest.worst_ratio <= question_.largest_ratio.value_or(unbounded);
  }

  std::string why_none(std::size_t first) const {
    const bool alone = !whole_.key.empty() && !serve(gains_for(first, first));
    const std::string whom = whole_.key.empty() ? "all members of the family"
                             : alone
                                 ? members_[first].text()
                                 : members_[first].text() + " and " + members_[first + 1].text();
    std::string remedy = p_ ? "; give --both-gains to search for P too" : "";
    if (!alone)
      remedy += whole_.key.empty() ? "; give --schedule KEY to divide the range of KEY"
                                   : "; give more --draws, so that successive members differ less";
    return "design --family: no " +
           std::string(p_ ? "D at the case's P" : "P and D that were tried") +
           " satisfies --margin and --largest-ratio for " + whom + remedy;
  }

  FamilyDesign question_;
  UncertainRange whole_{};  // of the schedule's key; "": one pair of gains
  std::vector<FamilyMember> members_;
  std::vector<Case> cases_;
  std::vector<LinearLoop> loops_;
  std::vector<AmplitudeOptions> options_;
  std::optional<double> p_;  // none: P is looked for too
};

}  // namespace

void write_family_gains(const JobContext& context, const FamilyDesign& question,
                        const ContextWith& context_with) {
  const DesignedFamily family(context, question, context_with);
  Table table(context, columns_of("family gains"));
  double largest_radius = 0.0;
  for (const auto& piece : family.pieces())
    family.write(table, piece, context_with, largest_radius);
  report_warning("the gains are the best for the " + std::to_string(question.draws) +
                     " computed members of the family; other members may have a larger amplitude",
                 context.quiet);
  warn_of_edge(largest_radius, context.case_data.control.sampling_period, context.quiet);
  table.commit();
}

}  // namespace holdfast::program
