// My controller is not u = P z + D ż. What does the loop do under it?
#include <cmath>
#include <cstdio>

#include "holdfast/chaos/event_lyapunov.hpp"
#include "holdfast/chaos/motion_classification.hpp"
#include "holdfast/control/controlled_plant.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/plant/two_mass.hpp"

using namespace holdfast;

// A controller takes a sample in and gives a force out; the motion keeps its state. This one damps
// by a velocity that it has filtered, and has one.
struct FilteredPd {
  static constexpr int states = 1;
  PdGains<double> gains;
  double cutoff;  // Hz

  double command(const ControlSample& sample, Vector<double, 1>& filtered) const {
    const double kept = std::exp(-2.0 * pi<double> * cutoff * sample.elapsed);
    filtered[0] = kept * filtered[0] + (1.0 - kept) * sample.velocity;
    return gains.proportional * sample.displacement + gains.differential * filtered[0];
  }
};

// A linear one is four matrices. This one has no sensor of the velocity: a Kalman filter estimates
// all four states from the displacement, x̂⁺ = A x̂ + b u + L (z - x̂₁), and u = P x̂₁ + D x̂₂.
LinearController<4> observer_based(const SampledLoop<double>& loop, const PdGains<double>& gains) {
  const Matrix<double, 4>& a = loop.transition;
  Matrix<double, 4> covariance = Matrix<double, 4>::Identity();
  Vector<double, 4> correction;  // L
  for (int step = 0; step < 2000; ++step) {
    const Matrix<double, 4> predicted =
        a * covariance * a.transpose() + loop.held_excitation * loop.held_excitation.transpose();
    correction = predicted.col(0) / (predicted(0, 0) + 1e-10);  // noise of 1e-5 m against 1 N
    covariance = predicted - correction * predicted.row(0);
  }
  const RowVector<double, 4> feedback = gains.feedback_row();
  LinearController<4> controller;
  controller.transition = a + loop.present_force * feedback;
  controller.transition.col(0) -= a * correction;
  controller.input << a * correction, Vector<double, 4>::Zero();
  controller.output = feedback;
  return controller;
}

void show(const char* name, const ControlledPlant& plant, const Sampling<double>& sampling) {
  ImplementedLoopOf<ControlledPlant> loop;
  loop.plant = plant;
  loop.digital.sampling = sampling;
  loop.digital.force = multi_harmonic_force({0.5, 10.0});
  loop.backlash = {ContactLaw::play, 0.0005};
  loop.switching = Switching::exact;
  // Of plant and controller.
  const Vector<double, Eigen::Dynamic> rest = Vector<double, Eigen::Dynamic>::Zero(plant.order());

  auto motion = event_motion(loop, rest);
  double largest_force = 0.0;
  for (int j = 0; j < 2000; ++j, motion.advance())
    largest_force = std::fmax(largest_force, std::abs(motion.sense().control_force));
  const LyapunovResult exponents = run_event_lyapunov(motion, {20000, 1000});

  const auto found = classify_motion(loop, rest);
  std::printf("%s: %s\n", name, attractor_type_text(found.classification).c_str());
  std::printf("  force up to %.2f N, largest exponent %.4f a sample\n", largest_force,
              exponents.exponents[0]);
  if (!found.search.orbit) return;
  std::printf("  certified orbit of %.1f s, amplitude %.2f mm, largest multiplier %.3f of %zu\n",
              found.search.orbit->period(), 1e3 * found.search.orbit->largest_displacement,
              found.search.orbit->largest_multiplier(), found.search.orbit->multipliers.size());
}

int main() {
  const auto masses = kollar2022_plant();
  const Sampling<double> sampling{0.005};
  const PdGains<double> gains{-200.0, -5.0};
  show("P and D", with_controller(masses, gains), sampling);
  show("P and D behind a filter of 30 Hz", with_controller(masses, FilteredPd{gains, 30.0}),
       sampling);
  show("P and D of an estimate",
       with_controller(masses, observer_based(sampled_loop(masses, sampling), gains)), sampling);
}
