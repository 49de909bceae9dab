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

/// Motions that are computed at once.
constexpr std::size_t motions_of_batch = 256;

/// Lets a batch be interrupted.
struct LookForInterrupt : IgnoreSwitching {
  void pause() const { throw_if_interrupted(); }
};

CellOutcome outcome_of(LeastAmplitudeOutcome outcome) {
  if (outcome == LeastAmplitudeOutcome::none) return CellOutcome::no_gain;
  if (outcome == LeastAmplitudeOutcome::aliased) return CellOutcome::aliased;
  return CellOutcome::computed;
}

/// The admissible cells of a tile as motions, and what is found of each.
class TileCells {
 public:
  TileCells(const SweepPlan& plan, std::int64_t tile)
      : plan_(plan), results_(static_cast<std::size_t>(plan.cells_of(tile))) {
    BestGains gains(plan.question().duration);
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
      SweepMotion motion{forced_loop_of(the_case), initial_state_of(the_case)};
      validate(motion.loop);
      samples_within(plan_.question().duration, motion.loop.sampling.period);
      if (plan_.question().best_gain && !take_best_gain(place, motion, gains)) return;
      results_[place].differential_gain = motion.loop.gains.differential;
      motions_.push_back(motion);
      cells_.push_back(place);
    } catch (const WrongInput& fault) {
      note(fault.what());
    } catch (const InvalidParameter& fault) {
      note(fault.what());
    } catch (const NoAnswer& fault) {
      note(fault.what());
    }
  }

  /// False where there is no best gain, with the outcome that says why.
  bool take_best_gain(std::size_t place, SweepMotion& motion, BestGains& gains) {
    const LeastAmplitude& best = gains.of(motion.loop);
    motion.loop.gains.differential = best.differential_gain;
    const CellOutcome outcome = outcome_of(best.outcome);
    if (has_motion(outcome)) return true;
    results_[place].outcome = outcome;
    const double half_rate = 0.5 / motion.loop.sampling.period;
    note(outcome == CellOutcome::no_gain
             ? "no differential gain lets the motion settle within half the duration"
             : "the excitation of " + format_rounded(motion.loop.excitation.frequency) +
                   " Hz is not below half the sampling rate, " + format_rounded(half_rate) + " Hz");
    return false;
  }

  void note(const std::string& fault) {
    if (first_fault_.empty()) first_fault_ = fault;
  }

  std::vector<MotionMetrics> metrics_of(const std::vector<SweepMotion>& motions) const {
    std::vector<MotionMetrics> metrics(motions.size());
    for (std::size_t first = 0; first < motions.size(); first += motions_of_batch) {
      motion_metrics<ChartNumber>(
          motions.data() + first, std::min(motions_of_batch, motions.size() - first),
          plan_.question().duration, metrics.data() + first, LookForInterrupt());
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
      const auto [entry, added] = known.try_emplace(all_numbers_of(motion), distinct.size());
      if (added) distinct.push_back(motion);
      number_of[k] = entry->second;
    }
    const std::vector<MotionMetrics> metrics = metrics_of(distinct);
    for (std::size_t k = 0; k < motions_.size(); ++k)
      results_[cells_[k]].uncontrolled_peak = metrics[number_of[k]].steady_peak;
  }

  static SweepMotion without_control(SweepMotion motion) {
    motion.loop = uncontrolled(motion.loop);
    motion.loop.sampling.processing_delay = 0.0;  // of a force that is zero
    return motion;
  }

  static std::array<double, 14> all_numbers_of(const SweepMotion& motion) {
    const auto plant = numbers_of(motion.loop.plant);
    const Vector<double, 4>& state = motion.initial_state;
    return {plant[0],
            plant[1],
            plant[2],
            plant[3],
            plant[4],
            plant[5],
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
