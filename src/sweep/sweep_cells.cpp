#include <map>
#include <tuple>
#include <utility>

#include "holdfast/core/errors.hpp"
#include "io/text/text.hpp"
#include "jobs/design/best_gains.hpp"
#include "jobs/motion/cell_motion.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"
#include "sweep/sweep_plan.hpp"

namespace holdfast::program {
namespace {

CellOutcome outcome_of(MotionEnd end) {
  if (end == MotionEnd::accumulates) return CellOutcome::accumulates;
  return end == MotionEnd::diverged ? CellOutcome::diverges : CellOutcome::computed;
}

CellOutcome outcome_of(MinimumAmplitudeOutcome outcome) {
  if (outcome == MinimumAmplitudeOutcome::none) return CellOutcome::no_gain;
  if (outcome == MinimumAmplitudeOutcome::aliased) return CellOutcome::aliased;
  return CellOutcome::computed;
}

/// The poles and their residues, by which two conductors with their absorbers are told apart.
std::vector<double> poles_of(const CellMotion& motion) {
  std::vector<double> places;
  if (!motion.conductor) return places;
  places.reserve(4 * motion.conductor->poles.size());
  for (const PlantPole& pole : motion.conductor->poles) {
    places.push_back(pole.s.real());
    places.push_back(pole.s.imag());
    places.push_back(pole.residue.real());
    places.push_back(pole.residue.imag());
  }
  return places;
}

/// What two motions without control must have in common to be one, to be compared.
auto all_numbers_of(const CellMotion& motion) {
  const IdealLoop<double>& loop = motion.of_paper.loop;
  const Vector<double, 4>& state = motion.of_paper.initial_state;
  return std::tuple(numbers_of(loop.plant), loop.sampling.period, loop.excitation.amplitude,
                    loop.excitation.frequency, loop.hold, state[0], state[1], state[2], state[3],
                    poles_of(motion));
}

/// The admissible cells of a tile as motions, and what is found of each.
class TileCells {
 public:
  TileCells(const SweepPlan& plan, std::int64_t tile)
      : plan_(plan), results_(static_cast<std::size_t>(plan.cells_of(tile))) {
    BestGains gains(plan.options().duration);
    for (std::size_t i = 0; i < results_.size(); ++i) {
      throw_if_interrupted();
      add(i, plan.first_cell(tile) + static_cast<std::int64_t>(i), gains);
    }
  }

  void compute() {
    find_motions();
    if (plan_.wants(SweepMetric::ratio_to_uncontrolled) || plan_.wants(SweepMetric::attenuates))
      find_uncontrolled_peaks();
    for (std::size_t k = 0; k < motions_.size(); ++k) {
      CellResult& result = results_[cells_[k]];
      if (result.outcome == CellOutcome::computed) find_attractor(motions_[k], result);
    }
  }

  TileResult tile_result() const {
    TileResult tile;
    tile.cells = static_cast<std::int64_t>(results_.size());
    tile.first_fault = first_fault_;
    for (const CellResult& result : results_) {
      tile.samples += result.motion.samples;
      tile.diverging += result.outcome == CellOutcome::diverges ? 1 : 0;
      tile.without_motion += has_motion(result.outcome) ? 0 : 1;
    }
    for (const SweepMetric metric : plan_.metrics())
      for (const CellResult& result : results_) tile.values.push_back(metric_value(metric, result));
    return tile;
  }

 private:
  void add(std::size_t place, std::int64_t cell, BestGains& gains) {
    try {
      const Case the_case = plan_.case_of(cell);
      CellMotion motion =
          cell_motion(the_case, plan_.options().switching, plan_.options().duration);
      if (plan_.options().best_gain && !take_best_gain(place, motion, gains)) return;
      results_[place].differential_gain = motion.of_paper.loop.gains.differential;
      motions_.push_back(motion);
      cells_.push_back(place);
    } catch (const Refusal& fault) {
      note(fault.what());
    } catch (const InvalidParameter& fault) {
      note(fault.what());
    }
  }

  /// False where there is no best gain, with the outcome that says why.
  bool take_best_gain(std::size_t place, CellMotion& motion, BestGains& gains) {
    const IdealLoop<double>& loop = motion.of_paper.loop;
    const MinimumAmplitude& best = gains.of(loop);
    set_differential_gain(motion, best.differential_gain);
    const CellOutcome outcome = outcome_of(best.outcome);
    if (has_motion(outcome)) return true;
    results_[place].outcome = outcome;
    const double half_rate = 0.5 / loop.sampling.period;
    note(outcome == CellOutcome::no_gain
             ? "no differential gain lets the motion settle within half the duration"
             : "the excitation of " + format_rounded(loop.excitation.frequency) +
                   " Hz is not below half the sampling rate, " + format_rounded(half_rate) + " Hz");
    return false;
  }

  void note(const std::string& fault) {
    if (first_fault_.empty()) first_fault_ = fault;
  }

  void find_motions() {
    const std::vector<MotionMetrics> metrics =
        metrics_of(motions_, plan_.options().duration, plan_.context().instructions);
    for (std::size_t k = 0; k < motions_.size(); ++k) {
      CellResult& result = results_[cells_[k]];
      result.motion = metrics[k];
      result.outcome = outcome_of(metrics[k].end);
      if (result.outcome == CellOutcome::accumulates) note("its changes of contact accumulate");
    }
  }

  /// Of each distinct motion without control once: many cells share theirs.
  void find_uncontrolled_peaks() {
    std::vector<CellMotion> distinct;
    std::map<decltype(all_numbers_of(motions_[0])), std::size_t> known;
    std::vector<std::size_t> number_of(motions_.size());
    for (std::size_t k = 0; k < motions_.size(); ++k) {
      const CellMotion motion = without_control(motions_[k], plan_.options().duration);
      const auto [entry, added] = motion.built
                                      ? std::pair(known.end(), true)
                                      : known.try_emplace(all_numbers_of(motion), distinct.size());
      number_of[k] = added ? distinct.size() : entry->second;
      if (added) distinct.push_back(motion);
    }
    const std::vector<MotionMetrics> metrics =
        metrics_of(distinct, plan_.options().duration, plan_.context().instructions);
    for (std::size_t k = 0; k < motions_.size(); ++k)
      results_[cells_[k]].uncontrolled_peak = metrics[number_of[k]].steady_peak;
  }

  void find_attractor(const CellMotion& motion, CellResult& result) const {
    if (plan_.wants(SweepMetric::largest_exponent))
      result.largest_exponent = largest_exponent_of(motion, plan_.options().duration);
    const OrbitLimits limits{plan_.options().largest_period, 0, throw_if_interrupted};
    if (plan_.wants(SweepMetric::verdict)) {
      const CellVerdict found = verdict_of(motion, limits);
      result.kind = found.kind;
      result.period = found.period;
      if (found.kind != AttractorType::diverges) return;
      result.outcome = CellOutcome::diverges;
      result.motion = diverging(result.motion);
    } else if (plan_.wants(SweepMetric::period_samples)) {
      result.period = period_of(motion, limits);
    }
  }

  const SweepPlan& plan_;
  std::vector<CellResult> results_;
  std::vector<CellMotion> motions_;  // of the admissible cells
  std::vector<std::size_t> cells_;   // their places in the tile
  std::string first_fault_;
};

}  // namespace

TileResult compute_tile(const SweepPlan& plan, std::int64_t tile) {
  TileCells cells(plan, tile);
  cells.compute();
  return cells.tile_result();
}

}  // namespace holdfast::program
