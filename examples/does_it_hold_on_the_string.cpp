// Two masses promise that a gain is stable. Does the promise hold on the conductor itself?
#include <cstdio>

#include "holdfast/cable/taut_string.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/boundary/stable_intervals.hpp"
#include "holdfast/stability/boundary/unit_circle_crossings.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"

using namespace holdfast;

// The conductor as a taut string, with the absorber at a tenth of its span and a clamp (kg) that
// moves with it. Of its modes so many are kept apart; faster ones are bundled, or cut off.
UnitCircleCrossings<double> loop_on_string(const Sampling<double>& sampling, double clamp_mass,
                                           int modes, bool bundled) {
  const double highest = bundled ? 100.0 / sampling.period : 0.0;  // rad/s
  const auto places =
      bundled_string_modes(taut_string(kollar2022_conductor()), 0.64, modes, highest);
  const TwoMass<double> masses = kollar2022_plant();
  return UnitCircleCrossings<double>(modal_response(
      places,
      {masses.absorber_mass, masses.absorber_stiffness, masses.absorber_damping, clamp_mass},
      sampling));
}

// The lowest stable D (N s/m); "none" where no D is.
void print_lowest(const std::vector<Interval<double>>& stable) {
  stable.empty() ? std::printf("    none") : std::printf(" %7.2f", stable.front().lower);
}

int main() {
  const double proportional = -557.0;
  std::printf("lowest stable D (N s/m) at P = %.0f N/m\n", proportional);
  std::printf(
      "                  two     string, cut off behind     string, all modes, of them apart\n");
  std::printf("period  clamp  masses      20      40      80          20      40      80\n");
  for (const double clamp : {0.0, 0.010}) {
    for (const double period : {0.001, 0.003, 0.010}) {
      const Sampling<double> sampling{period};
      std::printf("%3.0f ms %4.0f g", 1e3 * period, 1e3 * clamp);
      print_lowest(stable_differential_gains(
          characteristic_polynomial(sampled_loop(kollar2022_plant(), sampling)), proportional));
      for (const bool bundled : {false, true}) {
        if (bundled) std::printf("    ");
        for (const int modes : {20, 40, 80})
          print_lowest(loop_on_string(sampling, clamp, modes, bundled)
                           .stable_gains(FreeGain::differential, {proportional, 0.0}));
      }
      std::printf("\n");
    }
  }

  // In one sample the clamp feels only the waves that it sends out, and its own mass.
  const UnitCircleCrossings<double> loop = loop_on_string({0.001}, 0.0, 80, true);
  std::printf("\nD = -13 at 1 ms without a clamp: %d root(s) outside the unit circle\n",
              loop.roots_outside({proportional, -13.0}));
}
