// The motion whose backlash switches between the samples. Peers: the sampled motion, whose contact
// changes at samples alone, and CVODE of SUNDIALS (where it is installed) with root finding at a
// tolerance of 1e-10. The cost of a change of contact comes from the same motion with a gap so wide
// that it never leaves it. All sides alternate in one run; the medians and their ratios are
// printed.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <vector>

#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "medians.hpp"
#ifdef HOLDFAST_HAS_SUNDIALS
#include "support/reference/switching_reference.hpp"
#endif

namespace {

using namespace holdfast;

constexpr std::int64_t samples = 100000;
constexpr std::int64_t samples_of_sampled = 10 * samples;
constexpr std::int64_t samples_of_cvode = 4000;

volatile double sink = 0.0;

const Vector<double, 4> rest = Vector<double, 4>::Zero();

EventMotion<> exact_motion(const IdealLoop<double>& loop, double width) {
  return {implemented_loop(loop).digital,
          DriveContact<>(loop.plant, {ContactLaw::play, width}, Switching::exact, rest), rest};
}

template <class Motion>
void run(Motion motion, std::int64_t count) {
  double sum = 0.0;
  for (std::int64_t taken = 0; taken < count; ++taken) {
    sum += motion.sense().control_force;
    motion.advance();
  }
  sink = sum;
}

double changes_per_sample(const IdealLoop<double>& loop) {
  auto motion = exact_motion(loop, loop.backlash_width);
  for (std::int64_t taken = 0; taken < samples; ++taken) {
    motion.sense();
    motion.advance();
  }
  double changes = 0.0;
  for (const std::int64_t entered : motion.counts().entered)
    changes += static_cast<double>(entered);
  return changes / static_cast<double>(samples);
}

void measure(double period, double width, ForceHold hold) {
  const IdealLoop<double> loop{kollar2022_plant(), {period, 0.0}, {-557.0, -13.0},
                               {0.5, 10.0},        width,         hold};
  const double changes = changes_per_sample(loop);
  std::vector<std::function<void()>> sides{
      [&] { run(harmonically_forced_motion(loop, rest), samples_of_sampled); },
      [&] { run(exact_motion(loop, width), samples); },
      [&] { run(exact_motion(loop, 1e3), samples); }};
#ifdef HOLDFAST_HAS_SUNDIALS
  sides.emplace_back([&] {
    sink =
        cvode::switching_reference(loop, rest, samples_of_cvode, {1e-10, 1e-13}).states.back()[0];
  });
#endif
  const std::vector<double> time = bench::medians(sides);
  const auto nanoseconds = [](double seconds, std::int64_t count) {
    return seconds / static_cast<double>(count) * 1e9;
  };
  const double sampled = nanoseconds(time[0], samples_of_sampled);
  const double exact = nanoseconds(time[1], samples), quiet = nanoseconds(time[2], samples);
  std::printf("%5g %5g  %-8s %8.1f %8.1f %7.1f %9.4f %9.0f", period * 1e3, width * 1e3,
              hold == ForceHold::exact ? "exact" : "sampled", sampled, exact, exact / sampled,
              changes, (exact - quiet) / changes);
#ifdef HOLDFAST_HAS_SUNDIALS
  const double cvode = nanoseconds(time[3], samples_of_cvode);
  std::printf(" %9.0f %7.0f", cvode, cvode / exact);
#endif
  std::printf("\n");
}

}  // namespace

int main() {
  std::printf("medians of %d alternating repetitions, one core, ns per sample\n",
              holdfast::bench::usual_repetitions);
  std::printf("  tau    r0  force     sampled    exact   ratio   changes ns/change");
#ifdef HOLDFAST_HAS_SUNDIALS
  std::printf("     CVODE   ratio");
#endif
  std::printf("\n   ms    mm\n");
  for (const ForceHold hold : {ForceHold::exact, ForceHold::sampled}) {
    for (const double period : {0.001, 0.005, 0.011})
      for (const double width : {0.0005, 0.001, 0.002}) measure(period, width, hold);
  }
}
