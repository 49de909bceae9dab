#include <algorithm>
#include <map>
#include <utility>

#include "case/model/loop_of_case.hpp"
#include "case/model/moving_loop.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/core/errors.hpp"
#include "jobs/design/best_gains.hpp"
#include "jobs/motion/cell_motion.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"
#include "sweep/sweep_plan.hpp"
#include "text/text.hpp"

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

/// Motions and results of consecutive cells of a sweep; inadmissible cells have no motion.
class SweepCells {
 public:
  SweepCells(const SweepPlan& plan, std::int64_t first, std::int64_t count)
      : plan_(plan), results_(static_cast<std::size_t>(count)) {
    BestGains gains(plan.options().duration);
    for (std::size_t i = 0; i < results_.size(); ++i) {
      throw_if_interrupted();
      add(i, first + static_cast<std::int64_t>(i), gains);
    }
  }

  void compute() {
    find_motions();
    if (needs_uncontrolled()) find_uncontrolled_peaks();
    for (std::size_t k = 0; k < motions_.size(); ++k) {
      CellResult& result = results_[cells_[k]];
      if (result.outcome == CellOutcome::computed) find_attractor(motions_[k], result);
    }
  }

  /// Appends the results to the columns of the plan's store.
  void append_to(ChunkResult& chunk) const {
    chunk.values.resize(plan_.metrics().size() + (plan_.wants(SweepMetric::outcome) ? 0 : 1));
    for (std::size_t k = 0; k < chunk.values.size(); ++k) {
      const SweepMetric metric =
          k < plan_.metrics().size() ? plan_.metrics()[k] : SweepMetric::outcome;
      for (const CellResult& result : results_)
        chunk.values[k].push_back(metric_value(metric, result));
    }
    for (const CellResult& result : results_) chunk.samples += result.motion.samples;
  }

  const std::string& first_fault() const { return first_fault_; }

 private:
  void add(std::size_t place, std::int64_t cell, BestGains& gains) {
    try {
      Case the_case = plan_.case_of(cell);
      if (plan_.options().best_gain && !take_best_gain(place, the_case, gains)) return;
      MovingLoop motion =
          cell_motion(the_case, plan_.options().switching, plan_.options().duration);
      if (needs_uncontrolled()) add_uncontrolled(the_case, cell);
      motions_.push_back(std::move(motion));
      results_[place].differential_gain = gains_of(the_case).differential;
      cells_.push_back(place);
    } catch (const Refusal& fault) {
      note(fault.what());
    } catch (const InvalidParameter& fault) {
      note(fault.what());
    }
  }

  bool needs_uncontrolled() const {
    return plan_.wants(SweepMetric::ratio_to_uncontrolled) || plan_.wants(SweepMetric::attenuates);
  }

  /// Adds the motion without control of a cell, unless an earlier cell has the same.
  void add_uncontrolled(const Case& the_case, std::int64_t cell) {
    std::vector<double> values;  // on the axes that change this motion
    for (std::size_t k = 0; k < plan_.layout().axes.size(); ++k) {
      const std::string& key = plan_.layout().axes[k].column.name;
      const bool is_of_control = key.rfind("backlash.", 0) == 0 || key.rfind("control.", 0) == 0;
      if (!is_of_control || key == "control.sampling_period")
        values.push_back(plan_.axis_value(k, cell));
    }
    if (known_.find(values) == known_.end()) {
      uncontrolled_.push_back(motion_without_control(the_case, plan_.options().duration));
      known_[values] = uncontrolled_.size() - 1;
    }
    number_of_.push_back(known_[values]);
  }

  /// Sets D to the best gain. False if there is none; the outcome then has the reason.
  bool take_best_gain(std::size_t place, Case& the_case, BestGains& gains) {
    if (!has_closed_forms(the_case))
      throw WrongInput(
          "--best-gain needs plant.model = \"two_masses\", a measured velocity, no filter, no "
          "drive lag and a delay up to one sampling period");
    const IdealLoop<double> loop = ideal_loop_of(the_case);
    validate(loop);
    const MinimumAmplitude& best = gains.of(loop);
    the_case.control.differential_gain = best.differential_gain;
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
      if (result.outcome == CellOutcome::accumulates)
        note("the contact changes too often within one sampling period to be computed");
    }
  }

  void find_uncontrolled_peaks() {
    const std::vector<MotionMetrics> metrics =
        metrics_of(uncontrolled_, plan_.options().duration, plan_.context().instructions);
    for (std::size_t k = 0; k < motions_.size(); ++k)
      results_[cells_[k]].uncontrolled_peak = metrics[number_of_[k]].steady_peak;
  }

  void find_attractor(const MovingLoop& motion, CellResult& result) const {
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
  std::vector<MovingLoop> motions_;  // of the admissible cells
  std::vector<std::size_t> cells_;   // their places in the run
  // Distinct motions without control, their index by values of axes, and the index for each cell.
  std::vector<MovingLoop> uncontrolled_;
  std::map<std::vector<double>, std::size_t> known_;
  std::vector<std::size_t> number_of_;
  std::string first_fault_;
};

}  // namespace

ChunkResult compute_cells(const SweepPlan& plan, std::int64_t first, std::int64_t count) {
  constexpr std::int64_t most_at_once = 4096;  // bounds the memory for motions
  ChunkResult chunk;
  for (std::int64_t done = 0; done < count; done += most_at_once) {
    SweepCells cells(plan, first + done, std::min(most_at_once, count - done));
    cells.compute();
    cells.append_to(chunk);
  }
  return chunk;
}

std::string fault_of_cell(const SweepPlan& plan, std::int64_t cell) {
  SweepCells cells(plan, cell, 1);
  cells.compute();
  return cells.first_fault();
}

}  // namespace holdfast::program
