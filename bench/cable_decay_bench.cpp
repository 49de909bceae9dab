// Ten seconds of the continuous cable after a load is removed, over the number of elements.
// Peer: an explicit method (Heun) at its limit of stability, what a program without an implicit
// solver would do; it is run over a short stretch and compared by simulated seconds per second.
#include <Eigen/Core>
#include <cstdio>

#include "holdfast/sundials/load_removal.hpp"
#include "medians.hpp"

namespace {

using namespace holdfast;

CableElements cable_of(int elements) {
  return {kollar2022_conductor(),
          0.64,
          elements,
          {AbsorberReading::weight, 0.16},
          rayleigh_damping(0.02, 2.0, 7.0)};
}

/// The stiffness-proportional damping limits the step: h < 2/(β ω²), ω = 2 √(EA/μ)/l.
double stable_step(const CableElements& cable) {
  const auto& conductor = cable.chain().conductor();
  const double length = cable.chain().length(0);
  const double omega_squared =
      4.0 * conductor.axial_stiffness() / conductor.mass_per_length / (length * length);
  return 1.8 / (rayleigh_damping(0.02, 2.0, 7.0).stiffness_factor * omega_squared);
}

/// A stretch of time by steps of that length.
void explicit_heun(const CableElements& cable, double stretch) {
  const double step = stable_step(cable);
  Eigen::VectorXd motion = cable.held_by(0.2).state;
  Eigen::VectorXd first(cable.states()), second(cable.states());
  for (double time = 0.0; time < stretch; time += step) {
    cable.rate(motion.data(), first.data());
    const Eigen::VectorXd predicted = motion + step * first;
    cable.rate(predicted.data(), second.data());
    motion += 0.5 * step * (first + second);
  }
  if (!motion.allFinite()) std::puts("  Heun's step was too long");
}

}  // namespace

int main() {
  constexpr double duration = 10.0, stretch = 0.01;  // s
  std::printf("elements   CVODE, 10 s (s)    steps   simulated s per s   Heun   ratio\n");
  for (const int elements : {20, 40, 100, 200, 400}) {
    const CableElements cable = cable_of(elements);
    long steps = 0;
    const auto cvode_bdf = [&] {
      steps = cvode::load_removal(cable, 0.2, duration, 1e-3).cost.steps;
    };
    const bool both = elements <= 100;  // beyond, Heun takes hours
    const auto time =
        bench::medians({cvode_bdf, [&] { both ? explicit_heun(cable, stretch) : void(); }}, 5);
    std::printf("%8d %17.3f %8ld %19.2f", elements, time[0], steps, duration / time[0]);
    if (both)
      std::printf(" %6.3f %7.1f", stretch / time[1], duration / time[0] / (stretch / time[1]));
    std::printf("\n");
  }
}
