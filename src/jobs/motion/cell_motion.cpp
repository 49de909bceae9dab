#include "jobs/motion/cell_motion.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>

#include "case/model/loop_of_case.hpp"
#include "case/model/modal/modal_plant_of_case.hpp"
#include "holdfast/chaos/event_lyapunov.hpp"
#include "holdfast/chaos/lyapunov_run.hpp"
#include "holdfast/chaos/modal_classification.hpp"
#include "holdfast/chaos/modal_lyapunov.hpp"
#include "holdfast/chaos/motion_classification.hpp"
#include "holdfast/control/late_controller.hpp"
#include "holdfast/motion/divergence.hpp"
#include "holdfast/sweep/event_metric_batch.hpp"
#include "holdfast/sweep/event_metrics.hpp"
#include "holdfast/sweep/metric_batch.hpp"
#include "holdfast/sweep/modal_metrics.hpp"
#include "jobs/motion/motion_run.hpp"
#include "kernels/pack_kernels.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program {
namespace {

/// Motions that are computed at once.
constexpr std::size_t motions_of_batch = 256;

/// The matrices of a batch's loops; lets it be interrupted.
class BatchSource final : public MotionSource {
 public:
  const detail::SweepMatrices::Matrices& of(const IdealLoop<double>& loop) override {
    return matrices_.of(loop);
  }
  void pause() override { throw_if_interrupted(); }

 private:
  detail::SweepMatrices matrices_;
};

/// Writes the metrics of some motions of the paper's model to their places.
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

/// Likewise of some motions with exact switching.
void batch_event_metrics(const std::vector<EventSweepMotion>& motions,
                         const std::vector<std::size_t>& places, double duration,
                         InstructionSet set, std::vector<MotionMetrics>& all) {
  const PackKernels& kernels = pack_kernels(set);
  std::vector<MotionMetrics> metrics(motions.size());
  BatchSource source;
  std::size_t lines = 1;
  for (const EventSweepMotion& motion : motions)
    lines = std::max(lines, motion.loop->digital.force.harmonics.size());
  // What is prepared at once, a table a motion with maps for each line, stays small.
  const std::size_t at_once = std::clamp<std::size_t>(4096 / lines, 8, motions_of_batch);
  for (std::size_t first = 0; first < motions.size(); first += at_once) {
    const std::size_t count = std::min(at_once, motions.size() - first);
    throw_if_interrupted();
    const detail::PreparedEventMotions prepared(motions.data() + first, count, duration);
    kernels.event_metrics(prepared.motions.data(), count, metrics.data() + first, source);
  }
  for (std::size_t k = 0; k < places.size(); ++k) all[places[k]] = metrics[k];
}

template <class Search>
std::int64_t certified_period(const Search& search) {
  return search.outcome == OrbitOutcome::certified ? search.orbit->period_samples() : 0;
}

LyapunovResult exponents_of_paper(const SweepMotion& cell, const LyapunovRun& run) {
  const auto blocks = std::make_shared<const ItineraryBlocks>(
      sampled_loop(cell.loop.plant, cell.loop.sampling), cell.loop.gains);
  auto motion = harmonically_forced_motion(cell.loop, cell.initial_state);
  return run_lyapunov(motion, blocks, run, throw_if_interrupted);
}

bool has_one_harmonic(const DigitalLoop& digital) {
  return digital.force.harmonics.size() == 1 && digital.force.record == nullptr &&
         digital.jitter.half_width == 0.0;
}

/// Time between samples (s) of a motion that no computer takes part in: 200 or more to a period of
/// the force; where these would be millions, fewer whose phases are spread over it evenly.
double period_that_shows(double frequency, double duration) {
  constexpr double samples_of_cycle = 200.0, samples_of_motion = 20000.0, most_samples = 4e6;
  const double longest = duration / samples_of_motion;
  const double fine = 1.0 / (samples_of_cycle * frequency);
  if (duration <= most_samples * fine) return duration > 0.0 ? std::min(longest, fine) : fine;
  constexpr double golden_section = 0.38196601125010515;
  return (std::floor(longest * frequency) + golden_section) / frequency;
}

ConductorMotion conductor_motion_of(const Case& the_case) {
  ModalLoop loop = modal_loop_of(the_case);
  loop.sampling = within_sample(loop.sampling);
  const auto modes = loop.modes;
  return {std::move(loop), conductor_with_absorber_of(the_case).poles,
          modal_state(modes, initial_state_of(the_case))};
}

double divergence_bound(const CellMotion& motion) {
  if (motion.built_conductor)
    return holdfast::divergence_bound(motion.built_conductor->loop, motion.built_conductor->state);
  if (motion.conductor)
    return holdfast::divergence_bound(motion.conductor->loop, motion.conductor->state);
  const auto& [loop, initial_state] = motion.of_paper;
  return holdfast::divergence_bound(motion.built ? *motion.built : implemented_loop(loop),
                                    initial_state);
}

}  // namespace

CellMotion cell_motion(const Case& the_case, Switching switching, double duration) {
  require_absorber(the_case);
  CellMotion motion{
      {ideal_loop_of(the_case), initial_state_of(the_case)}, std::nullopt, nullptr, nullptr};
  samples_of(the_case, duration);
  IdealLoop<double>& loop = motion.of_paper.loop;
  if (loop.sampling.processing_delay > loop.sampling.period)
    loop.sampling = within_sample(loop.sampling);
  validate(loop);
  if (is_modal(the_case)) {
    motion.conductor = std::make_shared<ConductorMotion>(conductor_motion_of(the_case));
    if (!is_of_the_paper(the_case, switching))
      motion.built_conductor = std::make_shared<BuiltConductor>(
          BuiltConductor{conductor_loop_of(the_case, {switching, true}), modal_state_of(the_case)});
    return motion;
  }
  if (is_of_the_paper(the_case, switching)) return motion;
  motion.built = implemented_loop_of(the_case, switching);
  event_motion(*motion.built, motion.of_paper.initial_state);  // refuses what is not admissible
  return motion;
}

void set_differential_gain(CellMotion& motion, double gain) {
  if (motion.conductor)
    throw WrongInput("--best-gain is of the two masses under an ideal drive alone");
  motion.of_paper.loop.gains.differential = gain;
  if (motion.built) motion.built->digital.gains.differential = gain;
}

CellMotion without_control(const CellMotion& motion, double duration) {
  CellMotion free = motion;
  IdealLoop<double>& loop = free.of_paper.loop;
  loop = uncontrolled(loop);
  loop.hold = ForceHold::exact;
  loop.sampling = {period_that_shows(loop.excitation.frequency, duration)};
  if (motion.conductor) {
    ConductorMotion alone = *motion.conductor;
    alone.loop = uncontrolled(alone.loop);
    alone.loop.hold = loop.hold;
    alone.loop.sampling = loop.sampling;
    free.conductor = std::make_shared<ConductorMotion>(std::move(alone));
    free.built_conductor = nullptr;
    if (!motion.built_conductor || has_one_harmonic(motion.built_conductor->loop.digital))
      return free;
    BuiltConductor idle = *motion.built_conductor;
    const LateController nothing{{0.0, 0.0}, {}, idle.loop.plant.controller.states()};
    idle.loop.plant.controller = OwnController(nothing);
    idle.loop.backlash = {ContactLaw::none};
    idle.loop.digital.hold = loop.hold;
    idle.loop.digital.sampling = loop.sampling;
    idle.loop.digital.jitter = {};
    free.built_conductor = std::make_shared<BuiltConductor>(std::move(idle));
    return free;
  }
  if (!motion.built || has_one_harmonic(motion.built->digital)) {
    free.built = std::nullopt;
  } else {
    free.built = uncontrolled(*motion.built);
    free.built->digital.hold = loop.hold;
    free.built->digital.sampling = loop.sampling;
    free.built->digital.jitter = {};
  }
  return free;
}

std::vector<MotionMetrics> metrics_of(const std::vector<CellMotion>& motions, double duration,
                                      InstructionSet set) {
  std::vector<MotionMetrics> all(motions.size());
  std::vector<SweepMotion> of_paper;
  std::vector<EventSweepMotion> of_events;
  std::vector<std::size_t> places, places_of_events;
  for (std::size_t k = 0; k < motions.size(); ++k) {
    const CellMotion& motion = motions[k];
    if (motion.built_conductor) {
      const BuiltConductor& conductor = *motion.built_conductor;
      all[k] = event_metrics(conductor.loop, conductor.state, duration, throw_if_interrupted);
    } else if (motion.conductor) {
      const ConductorMotion& conductor = *motion.conductor;
      all[k] = modal_metrics(conductor.loop, conductor.poles, conductor.state, duration,
                             throw_if_interrupted);
    } else if (motion.built && has_event_pack(*motion.built)) {
      of_events.push_back({&*motion.built, motion.of_paper.initial_state});
      places_of_events.push_back(k);
    } else if (motion.built) {
      all[k] = event_metrics(*motion.built, motion.of_paper.initial_state, duration,
                             throw_if_interrupted);
    } else {
      of_paper.push_back(motion.of_paper);
      places.push_back(k);
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

std::optional<LyapunovResult> run_largest_exponent(const CellMotion& motion, std::int64_t samples) {
  if (samples < 1) return std::nullopt;
  const SweepMotion& cell = motion.of_paper;
  const LyapunovRun run{samples, 0, 0.0, LyapunovScope::largest};
  const auto exponents_of_modes = [&] {
    const ConductorMotion& conductor = *motion.conductor;
    ModalLyapunov modes(conductor.loop,
                        ModalMotion(conductor.loop, conductor.poles, conductor.state));
    return run_lyapunov(modes, run, throw_if_interrupted);
  };
  const auto exponents_between_samples = [&](const auto& loop, const auto& state) {
    auto built = event_motion(loop, state);
    return run_event_lyapunov(built, run, throw_if_interrupted);
  };
  const BuiltConductor* const own = motion.built_conductor.get();
  const LyapunovResult result = own != nullptr ? exponents_between_samples(own->loop, own->state)
                                : motion.conductor ? exponents_of_modes()
                                : motion.built
                                    ? exponents_between_samples(*motion.built, cell.initial_state)
                                    : exponents_of_paper(cell, run);
  if (result.outcome == LyapunovOutcome::diverged) return std::nullopt;
  return result;
}

double largest_exponent_of(const CellMotion& motion, double duration) {
  const double period = motion.of_paper.loop.sampling.period;
  const auto result = run_largest_exponent(motion, samples_within(duration, period) - 1);
  return result ? result->exponents[0] : std::numeric_limits<double>::quiet_NaN();
}

std::int64_t period_of(const CellMotion& motion, const OrbitLimits& limits) {
  const SweepMotion& cell = motion.of_paper;
  if (motion.built_conductor)
    return certified_period(find_event_orbit(
        event_motion(motion.built_conductor->loop, motion.built_conductor->state), limits));
  if (motion.conductor)
    return certified_period(
        find_periodic_orbit(motion.conductor->loop, motion.conductor->state, limits));
  if (!motion.built)
    return certified_period(find_periodic_orbit(cell.loop, cell.initial_state, limits));
  return certified_period(
      find_event_orbit(event_motion(*motion.built, cell.initial_state), limits));
}

CellVerdict verdict_of(const CellMotion& motion, const OrbitLimits& limits) {
  const auto verdict = [](const auto& found) -> CellVerdict {
    return {found.classification.kind, found.indicators.certified_period.value_or(0)};
  };
  const SweepMotion& cell = motion.of_paper;
  if (motion.built_conductor)
    return verdict(
        classify_motion(motion.built_conductor->loop, motion.built_conductor->state, limits));
  if (motion.conductor)
    return verdict(classify_motion(motion.conductor->loop, motion.conductor->state, limits));
  return motion.built ? verdict(classify_motion(*motion.built, cell.initial_state, limits))
                      : verdict(classify_motion(cell.loop, cell.initial_state, limits));
}

}  // namespace holdfast::program
