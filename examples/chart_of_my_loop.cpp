// Which gains P and D keep my loop stable, and where exactly does that end?
#include <cstdint>
#include <cstdio>
#include <vector>

#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/boundary/stable_intervals.hpp"
#include "holdfast/stability/chart/chart.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"

int main() {
  using namespace holdfast;
  TwoMass<double> plant;
  plant.conductor_mass = 0.12;                    // kg
  plant.conductor_stiffness = 80.0;               // N/m
  plant.conductor_damping = 0.1;                  // N s/m
  plant.absorber_mass = 0.2;                      // kg
  plant.absorber_stiffness = 150.0;               // N/m
  plant.absorber_damping = 3.0;                   // N s/m
  const Sampling<double> sampling{0.008, 0.002};  // τ and δ (s)
  const auto polynomial = characteristic_polynomial(sampled_loop(plant, sampling));

  const GainGrid grid{{-1500.0, 500.0, 11}, {-30.0, 15.0, 46}};
  const std::vector<std::uint8_t> stable = stability_chart(polynomial, grid);

  std::printf("P (N/m)    D = -30 to 15 N s/m, # stable\n");
  for (std::int64_t row = 0; row < grid.proportional.count; ++row) {
    const double p = grid.proportional.at(row);
    std::printf("%7.0f   |", p);
    for (std::int64_t column = 0; column < grid.differential.count; ++column)
      std::putchar(stable[static_cast<std::size_t>(row * grid.differential.count + column)] ? '#'
                                                                                            : '.');
    std::putchar('|');
    // The chart has the width of a character; these ends are exact.
    for (const Interval<double>& d : stable_differential_gains(polynomial, p))
      std::printf("  %.2f ... %.2f", d.lower, d.upper);
    std::putchar('\n');
  }
}
