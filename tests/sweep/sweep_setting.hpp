#pragma once

#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/motion/observers.hpp"
#include "holdfast/motion/trajectory.hpp"
#include "holdfast/sweep/metric_batch.hpp"
#include "holdfast/sweep/motion_metrics.hpp"
#include "holdfast/sweep/sweep_motion.hpp"
#include "support/kollar_case.hpp"
#include "support/random_loop.hpp"

namespace holdfast::test {

/// A motion that differs from any other in every parameter, with and without delay and backlash,
/// under either hold of the force.
/// @param gain_share  of the gains at which sampling begins to matter: with 0.006 most motions are
///                    stable, and rounding does not grow; with 1 many are not
inline SweepMotion random_sweep_motion(Random& random, double gain_share) {
  IdealLoop<double> loop;
  loop.plant = random_plant(random);
  loop.sampling = random_sampling(loop.plant, random);
  loop.gains = random_gains(loop.plant, loop.sampling.period, random);
  loop.gains.proportional *= gain_share;
  loop.gains.differential *= gain_share;
  loop.excitation = {random.log_uniform(1e-2, 10.0), random.log_uniform(0.5, 50.0)};
  const double size = loop.excitation.amplitude / loop.plant.conductor_stiffness;
  loop.backlash_width = random.unit() < 0.1 ? 0.0 : size * random.log_uniform(1e-3, 3.0);
  loop.hold = random.unit() < 0.5 ? ForceHold::sampled : ForceHold::exact;
  Vector<double, 4> state = Vector<double, 4>::Zero();
  if (random.unit() < 0.7) state = size * random.matrix<Vector<double, 4>>();
  return {loop, state};
}

inline std::vector<SweepMotion> random_sweep_motions(std::size_t count, std::uint64_t seed,
                                                     double gain_share) {
  Random random(seed);
  std::vector<SweepMotion> motions;
  motions.reserve(count);
  for (std::size_t k = 0; k < count; ++k)
    motions.push_back(random_sweep_motion(random, gain_share));
  return motions;
}

inline SweepMotion kollar_motion(double sampling_period = 0.001, double width = 0.0005,
                                 ForceHold hold = ForceHold::sampled) {
  SweepMotion motion{kollar_loop(sampling_period, width), Vector<double, 4>::Zero()};
  motion.loop.hold = hold;
  return motion;
}

inline std::vector<MotionMetrics> metrics_of(const std::vector<SweepMotion>& motions,
                                             double duration) {
  std::vector<MotionMetrics> results(motions.size());
  motion_metrics<double>(motions.data(), motions.size(), duration, results.data());
  return results;
}

/// The samples of a motion by the plain stepper.
struct RecordedMotion {
  TrajectoryOutcome outcome;
  std::vector<MotionSample<double>> samples;
};

inline RecordedMotion record(const SweepMotion& motion, double duration) {
  auto stepper = harmonically_forced_motion(motion.loop, motion.initial_state);
  const std::int64_t count = samples_within(duration, motion.loop.sampling.period);
  Recorder recorder(count);
  const auto outcome = run_trajectory(stepper, count, std::nullopt, recorder);
  return {outcome, recorder.samples()};
}

/// |z₁| at the first sample that is larger or smaller than both its neighbours.
inline double first_peak_of(const std::vector<MotionSample<double>>& samples) {
  const auto z1 = [&](std::size_t j) { return samples[j].state[0]; };
  for (std::size_t j = 1; j + 1 < samples.size(); ++j) {
    const bool maximum = z1(j) > z1(j - 1) && z1(j) > z1(j + 1);
    const bool minimum = z1(j) < z1(j - 1) && z1(j) < z1(j + 1);
    if (maximum || minimum) return std::abs(z1(j));
  }
  return std::numeric_limits<double>::quiet_NaN();
}

/// What the metrics of the steady samples are by definition.
inline void add_steady_metrics(const std::vector<MotionSample<double>>& samples,
                               MotionMetrics& metrics) {
  const auto count = static_cast<double>(samples.size());
  double squares = 0.0, force_squares = 0.0, engaged = 0.0, reversals = 0.0, peak = 0.0;
  for (std::size_t j = 0; j < samples.size(); ++j) {
    const auto& sample = samples[j];
    peak = std::max(peak, std::abs(sample.state[0]));
    squares += sample.state[0] * sample.state[0];
    force_squares += sample.control_force * sample.control_force;
    engaged += sample.engaged ? 1.0 : 0.0;
    if (j == 0) continue;
    const double now = sample.state[3] - sample.state[1];
    const double before = samples[j - 1].state[3] - samples[j - 1].state[1];
    if (before != 0.0 && (now == 0.0 || std::signbit(before) != std::signbit(now))) ++reversals;
  }
  if (samples.empty()) return;
  metrics.steady_peak = peak;
  metrics.steady_rms = std::sqrt(squares / count);
  metrics.engaged_fraction = engaged / count;
  metrics.force_rms = std::sqrt(force_squares / count);
  const double time = samples.back().time - samples.front().time;
  if (time > 0.0) metrics.reversals_per_s = reversals / time;
}

/// The metrics by their definitions, from the whole trajectory.
inline MotionMetrics metrics_by_definition(const RecordedMotion& motion, double duration) {
  const auto& samples = motion.samples;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const auto count = static_cast<std::int64_t>(samples.size());
  const double first_peak = first_peak_of(samples);
  if (motion.outcome == TrajectoryOutcome::diverged) {
    return {MotionEnd::diverged,
            count,
            first_peak,
            infinity,
            infinity,
            nan,
            infinity,
            infinity,
            nan,
            infinity};
  }
  double force = 0.0, lowest = infinity, highest = -infinity;
  std::vector<MotionSample<double>> steady;
  for (const auto& sample : samples) {
    force = std::max(force, std::abs(sample.control_force));
    lowest = std::min(lowest, sample.state[2] - sample.state[0]);
    highest = std::max(highest, sample.state[2] - sample.state[0]);
    if (not_before(sample.time, duration / 2)) steady.push_back(sample);
  }
  MotionMetrics metrics{MotionEnd::completed, count, first_peak, nan, nan, nan, force, nan, nan,
                        highest - lowest};
  add_steady_metrics(steady, metrics);
  return metrics;
}

/// Numbers that differ by at most `tolerance` of their size, or are the same infinity, or are both
/// not a number.
inline bool agree(double a, double b, double tolerance) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
  return a == b || std::abs(a - b) <= tolerance * std::max(std::abs(a), std::abs(b));
}

/// The same motion and, to `tolerance`, the same metrics. Lengths and forces below a tenth of the
/// largest one of the motion count as that: what is left of a decayed motion bears the rounding of
/// what it was, and so does a difference.
/// @param reach  m, the largest displacement
inline bool agree(const MotionMetrics& a, const MotionMetrics& b, double tolerance, double reach) {
  const auto close = [=](double x, double y, double size) {
    return agree(x, y, tolerance) || std::abs(x - y) <= 0.1 * tolerance * size;
  };
  return a.end == b.end && a.samples == b.samples && close(a.first_peak, b.first_peak, reach) &&
         close(a.steady_peak, b.steady_peak, reach) && close(a.steady_rms, b.steady_rms, reach) &&
         close(a.force_peak, b.force_peak, 0.0) && close(a.force_rms, b.force_rms, a.force_peak) &&
         close(a.absorber_stroke, b.absorber_stroke, reach) &&
         agree(a.engaged_fraction, b.engaged_fraction, tolerance) &&
         agree(a.reversals_per_s, b.reversals_per_s, tolerance);
}

/// max |z₁| + |z₂| (m) of the samples.
inline double reach_of(const RecordedMotion& motion) {
  double reach = 0.0;
  for (const auto& sample : motion.samples)
    reach = std::max(reach, std::abs(sample.state[0]) + std::abs(sample.state[2]));
  return reach;
}

/// To the last bit.
inline bool same_bits(const MotionMetrics& a, const MotionMetrics& b) {
  const auto numbers_of = [](const MotionMetrics& of) {
    return std::array<double, 8>{of.first_peak,      of.steady_peak,    of.steady_rms,
                                 of.force_peak,      of.force_rms,      of.engaged_fraction,
                                 of.reversals_per_s, of.absorber_stroke};
  };
  const auto of_a = numbers_of(a), of_b = numbers_of(b);
  return a.end == b.end && a.samples == b.samples &&
         std::memcmp(of_a.data(), of_b.data(), sizeof(of_a)) == 0;
}

}  // namespace holdfast::test
