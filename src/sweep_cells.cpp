#include "sweep_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>

#include "best_gains.hpp"
#include "errors.hpp"
#include "holdfast/attractor/lyapunov_run.hpp"
#include "holdfast/attractor/motion_verdict.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/sweep/metric_batch.hpp"
#include "interrupt.hpp"
#include "loop_of_case.hpp"
#include "motion_run.hpp"
#include "row_blocks.hpp"
#include "text.hpp"

namespace holdfast::program {
namespace {

/// Motions that are computed at once, between two looks whether the program shall end.
constexpr std::size_t motions_of_batch = 256;

/// The admissible cells of a tile as motions, and what is found of each.
class TileCells {
 public:
  TileCells(const SweepPlan& plan, std::int64_t tile)
      : plan_(plan), results_(static_cast<std::size_t>(plan.cells_of(tile))) {
    BestGains gains(plan.question().duration);
    for (std::size_t i = 0; i < results_.size(); ++i)
      add(i, plan.first_cell(tile) + static_cast<std::int64_t>(i), gains);
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
      tile.invalid += result.outcome == CellOutcome::invalid ? 1 : 0;
    }
    for (const SweepMetric metric : plan_.metrics())
      for (const CellResult& result : results_) tile.values.push_back(metric_value(metric, result));
    return tile;
  }

 private:
  void add(std::size_t place, std::int64_t cell, BestGains& gains) {
    try {
      const Case the_case = plan_.case_of(cell);
      SweepMotion motion{forced_loop_of(the_case), initial_state_of(the_case)};
      validate(motion.loop);
      samples_within(plan_.question().duration, motion.loop.sampling.period);
      if (plan_.question().best_gain)
        motion.loop.gains.differential = gains.differential_gain(motion.loop);
      motions_.push_back(motion);
      cells_.push_back(place);
    } catch (const WrongInput& fault) {
      note(fault);
    } catch (const InvalidParameter& fault) {
      note(fault);
    } catch (const NoAnswer& fault) {
      note(fault);
    }
  }

  void note(const std::exception& fault) {
    if (first_fault_.empty()) first_fault_ = fault.what();
  }

  std::vector<MotionMetrics> metrics_of(const std::vector<SweepMotion>& motions) const {
    std::vector<MotionMetrics> metrics(motions.size());
    for (std::size_t first = 0; first < motions.size(); first += motions_of_batch) {
      throw_if_interrupted();
      motion_metrics<ChartNumber>(motions.data() + first,
                                  std::min(motions_of_batch, motions.size() - first),
                                  plan_.question().duration, metrics.data() + first);
    }
    return metrics;
  }

  void find_motions() {
    const std::vector<MotionMetrics> metrics = metrics_of(motions_);
    for (std::size_t k = 0; k < motions_.size(); ++k) {
      CellResult& result = results_[cells_[k]];
      result.motion = metrics[k];
      result.outcome =
          metrics[k].end == MotionEnd::diverged ? CellOutcome::diverges : CellOutcome::computed;
    }
  }

  /// Of each distinct motion without control once: many cells share theirs.
  void find_uncontrolled_peaks() {
    std::vector<SweepMotion> distinct;
    std::map<std::array<double, 14>, std::size_t> known;
    std::vector<std::size_t> number_of(motions_.size());
    for (std::size_t k = 0; k < motions_.size(); ++k) {
      const SweepMotion motion = without_control(motions_[k]);
      const auto [entry, added] = known.try_emplace(numbers_of(motion), distinct.size());
      if (added) distinct.push_back(motion);
      number_of[k] = entry->second;
    }
    const std::vector<MotionMetrics> metrics = metrics_of(distinct);
    for (std::size_t k = 0; k < motions_.size(); ++k)
      results_[cells_[k]].uncontrolled_peak = metrics[number_of[k]].steady_peak;
  }

  static SweepMotion without_control(SweepMotion motion) {
    motion.loop.gains = {0.0, 0.0};
    motion.loop.backlash_width = 0.0;
    motion.loop.sampling.processing_delay = 0.0;  // of a force that is zero
    return motion;
  }

  static std::array<double, 14> numbers_of(const SweepMotion& motion) {
    const TwoDof<double>& plant = motion.loop.plant;
    const Vector<double, 4>& state = motion.initial_state;
    return {plant.conductor_mass,
            plant.conductor_stiffness,
            plant.conductor_damping,
            plant.absorber_mass,
            plant.absorber_stiffness,
            plant.absorber_damping,
            motion.loop.sampling.period,
            motion.loop.excitation.amplitude,
            motion.loop.excitation.frequency,
            motion.loop.hold == ForceHold::exact ? 1.0 : 0.0,
            state[0],
            state[1],
            state[2],
            state[3]};
  }

  void find_attractor(const SweepMotion& motion, CellResult& result) const {
    if (plan_.wants(SweepMetric::largest_exponent))
      result.largest_exponent = largest_exponent_of(motion);
    const OrbitLimits limits{plan_.question().largest_period, 0, throw_if_interrupted};
    if (plan_.wants(SweepMetric::verdict)) {
      const MotionVerdict found = classify_motion(motion.loop, motion.initial_state, limits);
      result.kind = found.verdict.kind;
      result.period = period_of(found.search);
    } else if (plan_.wants(SweepMetric::period_samples)) {
      result.period = period_of(find_periodic_orbit(motion.loop, motion.initial_state, limits));
    }
  }

  static std::int64_t period_of(const OrbitResult& search) {
    return search.outcome == OrbitOutcome::certified ? search.orbit->period_samples() : 0;
  }

  double largest_exponent_of(const SweepMotion& cell) const {
    const std::int64_t steps =
        samples_within(plan_.question().duration, cell.loop.sampling.period) - 1;
    if (steps < 1) return std::numeric_limits<double>::quiet_NaN();
    const auto words = std::make_shared<const ContactWords>(
        sampled_loop(cell.loop.plant, cell.loop.sampling), cell.loop.gains);
    InterruptibleMotion motion(harmonically_forced_motion(cell.loop, cell.initial_state));
    const LyapunovRun run{steps, 0, 0.0, LyapunovScope::largest, LyapunovScope::largest};
    const LyapunovResult result = run_lyapunov(motion, words, run);
    return result.outcome == LyapunovOutcome::diverged ? std::numeric_limits<double>::quiet_NaN()
                                                       : result.exponents[0];
  }

  const SweepPlan& plan_;
  std::vector<CellResult> results_;
  std::vector<SweepMotion> motions_;  // of the admissible cells
  std::vector<std::size_t> cells_;    // their places in the tile
  std::string first_fault_;
};

}  // namespace

TileResult compute_tile(const SweepPlan& plan, std::int64_t tile) {
  TileCells cells(plan, tile);
  cells.compute();
  return cells.tile_result();
}

std::string arithmetic() {
#ifdef HOLDFAST_HAS_SIMD
  return xsimd::default_arch::name();
#else
  return "scalar";
#endif
}

}  // namespace holdfast::program
