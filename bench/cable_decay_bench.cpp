// Ten seconds of the continuous cable after a load is removed, over the number of elements.
// Peer: an explicit method (Heun) at its limit of stability, what a program without an implicit
// solver would do; it is run over a short stretch and compared by simulated seconds per second.
#include <benchmark/benchmark.h>

#include <Eigen/Core>

#include "holdfast/sundials/load_removal.hpp"

namespace {

using namespace holdfast;

CableElements cable_of(int elements) {
  return {kollar2022_conductor(),
          0.64,
          elements,
          {AbsorberReading::weight, 0.16},
          rayleigh_damping(0.02, 2.0, 7.0)};
}

void simulated(benchmark::State& state, double seconds) {
  state.counters["simulated_s_per_s"] = benchmark::Counter(
      seconds * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

void cvode_bdf(benchmark::State& state) {
  const CableElements cable = cable_of(static_cast<int>(state.range(0)));
  long steps = 0;
  for (auto _ : state) steps = cvode::load_removal(cable, 0.2, 10.0, 1e-3).cost.steps;
  state.counters["steps"] = static_cast<double>(steps);
  state.SetComplexityN(state.range(0));
  simulated(state, 10.0);
}

/// The stiffness-proportional damping limits the step: h < 2/(β ω²), ω = 2 √(EA/μ)/l.
double stable_step(const CableElements& cable) {
  const auto& conductor = cable.chain().conductor();
  const double length = cable.chain().length(0);
  const double omega_squared =
      4.0 * conductor.axial_stiffness() / conductor.mass_per_length / (length * length);
  return 1.8 / (rayleigh_damping(0.02, 2.0, 7.0).stiffness_factor * omega_squared);
}

void explicit_heun(benchmark::State& state) {
  const CableElements cable = cable_of(static_cast<int>(state.range(0)));
  const double step = stable_step(cable), stretch = 0.01;
  Eigen::VectorXd first(cable.states()), second(cable.states());
  for (auto _ : state) {
    Eigen::VectorXd motion = cable.held_by(0.2).state;
    for (double time = 0.0; time < stretch; time += step) {
      cable.rate(motion.data(), first.data());
      const Eigen::VectorXd predicted = motion + step * first;
      cable.rate(predicted.data(), second.data());
      motion += 0.5 * step * (first + second);
    }
    benchmark::DoNotOptimize(motion.data());
  }
  simulated(state, stretch);
}

}  // namespace

BENCHMARK(cvode_bdf)
    ->Arg(20)
    ->Arg(40)
    ->Arg(100)
    ->Arg(200)
    ->Arg(400)
    ->Unit(benchmark::kMillisecond)
    ->Complexity();
BENCHMARK(explicit_heun)->Arg(20)->Arg(40)->Arg(100)->Unit(benchmark::kMillisecond);
