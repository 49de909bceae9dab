// Metrics of many motions whose backlash switches between the samples, on packs. Peers:
// EventMotion, one motion after the other, and the templates of the packs on one lane. The cells
// differ in the gain D and the width of the play, as those of a sweep, and then also in the phase
// of the force, so that they change their contacts at different samples. All sides alternate in one
// run; the medians and their ratios are printed.
#include <cstddef>
#include <cstdio>
#include <functional>
#include <vector>

#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/simd/pack.hpp"
#include "holdfast/sweep/event_metric_batch.hpp"
#include "holdfast/sweep/event_metrics.hpp"
#include "medians.hpp"

namespace {

using namespace holdfast;

constexpr std::size_t cells = 64;
constexpr double samples = 4000.0;

volatile double sink = 0.0;

const Vector<double, 4> rest = Vector<double, 4>::Zero();

/// @param turn  by which the force of each cell is ahead of that of the one before (rad)
std::vector<ImplementedLoop> loops_of(double period, ForceHold hold, double turn) {
  std::vector<ImplementedLoop> loops;
  for (std::size_t k = 0; k < cells; ++k) {
    const double share = static_cast<double>(k) / cells;
    const IdealLoop<double> loop{kollar2022_plant(),      {period, 0.0},
                                 {-557.0, -13.0 + share}, {0.5, 10.0},
                                 0.0005 + 0.0015 * share, hold};
    loops.push_back(implemented_loop(loop));
    loops.back().backlash.law = ContactLaw::play;
    loops.back().switching = Switching::exact;
    loops.back().digital.force.harmonics[0].phase = turn * static_cast<double>(k);
  }
  return loops;
}

void one_by_one(const std::vector<ImplementedLoop>& loops, double duration) {
  for (const ImplementedLoop& loop : loops) sink = event_metrics(loop, rest, duration).steady_peak;
}

template <class Scalar>
void batch(const std::vector<EventSweepMotion>& motions, double duration) {
  std::vector<MotionMetrics> metrics(motions.size());
  event_metrics<Scalar>(motions.data(), motions.size(), duration, metrics.data(), [] {});
  sink = metrics.back().steady_peak;
}

void measure(double period, ForceHold hold, double turn) {
  const auto loops = loops_of(period, hold, turn);
  std::vector<EventSweepMotion> motions;
  for (const ImplementedLoop& loop : loops) motions.push_back({&loop, rest});
  const double duration = period * samples;
  const std::vector<double> time = bench::medians(
      {[&] { one_by_one(loops, duration); }, [&] { batch<double>(motions, duration); },
       [&] { batch<simd::Pack<double>>(motions, duration); }});
  const double scale = 1e9 / (static_cast<double>(cells) * samples);
  std::printf("%5g  %-8s %8.1f %8.1f %8.1f %7.2f\n", period * 1e3,
              hold == ForceHold::exact ? "exact" : "sampled", time[0] * scale, time[1] * scale,
              time[2] * scale, time[0] / time[2]);
}

}  // namespace

int main() {
  std::printf(
      "medians of %d alternating repetitions, one core, %zu lanes, ns per motion and sample\n",
      bench::usual_repetitions, Lanes<simd::Pack<double>>::count);
  std::printf("  tau  force       alone one lane    packs   ratio\n   ms\n");
  constexpr double golden_angle = 2.399963;
  for (const double turn : {0.0, golden_angle}) {
    if (turn > 0.0) std::printf("phases of the force all over the turn\n");
    for (const ForceHold hold : {ForceHold::exact, ForceHold::sampled})
      for (const double period : {0.001, 0.002, 0.005, 0.011}) measure(period, hold, turn);
  }
}
