#include <cstdio>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/loop_input.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/boundary/stable_intervals.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"
#include "holdfast/stability/response/response.hpp"

int main() {
  using namespace holdfast;
  const TwoMass<double> plant = kollar2022_plant();
  const SampledLoop<double> loop = sampled_loop(plant, Sampling<double>{0.010});
  const double frequency = 10.0, omega = 2.0 * pi<double> * frequency;
  const double p =
      tuned_proportional_gain(plant.absorber_stiffness, plant.absorber_mass, frequency);

  const auto stable = stable_differential_gains(characteristic_polynomial(loop), p);
  if (stable.empty()) {
    std::puts("no D is stable");
    return 1;
  }
  const SteadyResponse<double> response(loop, held_harmonic(loop), omega);
  const PdGains<double> gains{p, -13.0};

  std::printf("P = %.2f N/m is stable for D from %.2f to %.2f N s/m\n", p, stable.front().lower,
              stable.front().upper);
  std::printf("D = %.0f N s/m leaves %.0f %% of the amplitude without control\n",
              gains.differential, 100.0 * response.ratio_to_uncontrolled(gains));
}
