#include "jobs/motion/cell_motion.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <variant>

#include "case/model/modal/modal_plant_of_case.hpp"
#include "holdfast/chaos/event_lyapunov.hpp"
#include "holdfast/chaos/modal_classification.hpp"
#include "holdfast/chaos/modal_lyapunov.hpp"
#include "holdfast/chaos/motion_classification.hpp"
#include "holdfast/sweep/event_metric_batch.hpp"
#include "holdfast/sweep/event_metrics.hpp"
#include "holdfast/sweep/metric_batch.hpp"
#include "holdfast/sweep/modal_metrics.hpp"
#include "jobs/orbit/certified_orbit.hpp"
#include "kernels/pack_kernels.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program {
namespace {

/// Number of motions that are computed together.
constexpr std::size_t motions_of_batch = 256;

/// Source of the loops' matrices for a batch of motions; a signal interrupts the computation.
class BatchSource final : public MotionSource {
 public:
  const detail::SweepMatrices::Matrices& of(const IdealLoop<double>& loop) override {
    return matrices_.of(loop);
  }
  void pause() override { throw_if_interrupted(); }

 private:
  detail::SweepMatrices matrices_;
};

/// Computes the metrics of motions with switching at samples; those of motion k go to `places[k]`.
void batch_metrics(const std::vector<SweepMotion>& motions, const std::vector<std::size_t>& places,
                   double duration, InstructionSet set, std::vector<MotionMetrics>& all) {
  const PackKernels& kernels = pack_kernels(set);
  std::vector<MotionMetrics> metrics(motions.size());
  for (std::size_t first = 0; first < motions.size(); first += motions_of_batch) {
    const std::size_t count = std::min(motions_of_batch, motions.size() - first);
    const auto spans = detail::ordered_spans(motions.data() + first, count, duration);
    BatchSource source;
    kernels.metrics(motions.data() + first, spans.data(), count, metrics.data() + first, source);
  }
  for (std::size_t k = 0; k < places.size(); ++k) all[places[k]] = metrics[k];
}

/// Computes the metrics of motions with exact switching; those of motion k go to `places[k]`.
void batch_event_metrics(const std::vector<EventSweepMotion>& motions,
                         const std::vector<std::size_t>& places, double duration,
                         InstructionSet set, std::vector<MotionMetrics>& all) {
  const PackKernels& kernels = pack_kernels(set);
  std::vector<MotionMetrics> metrics(motions.size());
  BatchSource source;
  std::size_t lines = 1;
  for (const EventSweepMotion& motion : motions)
    lines = std::max(lines, motion.loop->digital.force.harmonics.size());
  // Tables prepared at once, one a motion with maps for each line, stay small.
  const std::size_t at_once = std::clamp<std::size_t>(4096 / lines, 8, motions_of_batch);
  for (std::size_t first = 0; first < motions.size(); first += at_once) {
    const std::size_t count = std::min(at_once, motions.size() - first);
    throw_if_interrupted();
    const detail::PreparedEventMotions prepared(motions.data() + first, count, duration);
    kernels.event_metrics(prepared.motions.data(), count, metrics.data() + first, source);
  }
  for (std::size_t k = 0; k < places.size(); ++k) all[places[k]] = metrics[k];
}

/// Lyapunov exponents by the maps S and S* with the sampling `tangents`, else that of the motion.
ExponentsOfMotion exponents_along(const SampledMasses& moving, const LyapunovRun& run,
                                  const std::optional<Sampling<double>>& tangents) {
  const auto blocks = std::make_shared<const ItineraryBlocks>(
      sampled_loop(moving.loop.plant, tangents.value_or(moving.loop.sampling)), moving.loop.gains);
  auto motion = motion_of(moving);
  const LyapunovResult result = run_lyapunov(motion, blocks, run, throw_if_interrupted);
  return {result, {motion.time(), 0.0, {}}};
}
ExponentsOfMotion exponents_along(const SampledModes& moving, const LyapunovRun& run,
                                  const std::optional<Sampling<double>>&) {
  auto motion = motion_of(moving);
  const LyapunovResult result = run_lyapunov(motion, moving.loop, run, throw_if_interrupted);
  return {result, {motion.time(), 0.0, {}}};
}
/// Lyapunov exponents of a motion with exact switching, with saltation at the contact changes.
template <class Moving>
ExponentsOfMotion exponents_along(const Moving& moving, const LyapunovRun& run,
                                  const std::optional<Sampling<double>>&) {
  auto motion = motion_of(moving);
  const LyapunovResult result = run_event_lyapunov(motion, run, throw_if_interrupted);
  return {result, end_of(motion)};
}

}  // namespace

MovingLoop cell_motion(const Case& the_case, Switching switching, double duration) {
  require_absorber(the_case);
  samples_of(the_case, duration);
  MovingLoop moving = moving_loop_of(the_case, {switching});
  std::visit([](const auto& one) { validate(one.loop); }, moving);
  return moving;
}

std::vector<MotionMetrics> metrics_of(const std::vector<MovingLoop>& motions, double duration,
                                      InstructionSet set) {
  std::vector<MotionMetrics> all(motions.size());
  std::vector<SweepMotion> of_paper;
  std::vector<EventSweepMotion> of_events;
  std::vector<std::size_t> places, places_of_events;
  for (std::size_t k = 0; k < motions.size(); ++k) {
    if (const auto* masses = std::get_if<SampledMasses>(&motions[k])) {
      of_paper.push_back({masses->loop, masses->state});
      places.push_back(k);
    } else if (const auto* modes = std::get_if<SampledModes>(&motions[k])) {
      all[k] =
          modal_metrics(modes->loop, modes->poles, modes->state, duration, throw_if_interrupted);
    } else if (const auto* plant = std::get_if<BuiltPlant>(&motions[k])) {
      all[k] = event_metrics(plant->loop, plant->state, duration, throw_if_interrupted);
    } else {
      const auto& built = std::get<BuiltMasses>(motions[k]);
      if (!has_event_pack(built.loop)) {
        all[k] = event_metrics(built.loop, built.state, duration, throw_if_interrupted);
        continue;
      }
      of_events.push_back({&built.loop, built.state});
      places_of_events.push_back(k);
    }
  }
  batch_metrics(of_paper, places, duration, set, all);
  batch_event_metrics(of_events, places_of_events, duration, set, all);
  for (std::size_t k = 0; k < motions.size(); ++k)
    if (all[k].steady_peak > divergence_bound(motions[k])) all[k] = diverging(all[k]);
  return all;
}

MotionMetrics diverging(const MotionMetrics& metrics) {
  MetricObserver<double> seen;
  seen.first_peak = metrics.first_peak;
  return detail::diverged_metrics(seen, metrics.samples);
}

ExponentsOfMotion exponents_of(const MovingLoop& motion, const LyapunovRun& run,
                               const std::optional<Sampling<double>>& tangents) {
  return std::visit([&](const auto& moving) { return exponents_along(moving, run, tangents); },
                    motion);
}

std::optional<LyapunovResult> run_largest_exponent(const MovingLoop& motion, std::int64_t samples) {
  if (samples < 1) return std::nullopt;
  const LyapunovRun run{samples, 0, LyapunovScope::largest};
  const LyapunovResult result = exponents_of(motion, run).result;
  if (result.diverged) return std::nullopt;
  return result;
}

double largest_exponent_of(const MovingLoop& motion, double duration) {
  const auto result = run_largest_exponent(motion, samples_within(duration, period_of(motion)) - 1);
  return result ? result->exponents[0] : std::numeric_limits<double>::quiet_NaN();
}

std::int64_t period_of(const MovingLoop& motion, const OrbitLimits& limits) {
  return std::visit(
      [&](const auto& moving) -> std::int64_t {
        const auto found = orbit_of(moving, limits);
        return found.outcome == OrbitOutcome::certified ? found.orbit->period_samples() : 0;
      },
      motion);
}

CellVerdict verdict_of(const MovingLoop& motion, const OrbitLimits& limits) {
  return std::visit(
      [&](const auto& moving) -> CellVerdict {
        const auto found = classify_motion(moving.loop, moving.state, limits);
        return {found.classification.kind, found.indicators.certified_period.value_or(0)};
      },
      motion);
}

}  // namespace holdfast::program
