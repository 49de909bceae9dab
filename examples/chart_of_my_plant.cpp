// My plant has six states. Which gains are stable, and how slow may the computer be?
#include <cstdint>
#include <cstdio>

#include "holdfast/plant/linear_plant.hpp"
#include "holdfast/stability/boundary/unit_circle_crossings.hpp"
#include "holdfast/stability/chart/circle_chart.hpp"
#include "holdfast/stability/design/max_delay.hpp"
#include "holdfast/stability/margins/margins.hpp"
#include "holdfast/stability/response/modal_response.hpp"

using namespace holdfast;

// A conductor in two masses and an absorber that hangs from the first one; its motor pushes between
// the two. x = [z1, z2, z3, v1, v2, v3].
LinearPlant<double> three_masses() {
  const Vector<double, 3> mass(0.05, 0.08, 0.16);  // kg
  Matrix<double, 3> stiffness;                     // N/m
  stiffness << 190.0, -70.0, -74.4, -70.0, 110.0, 0.0, -74.4, 0.0, 74.4;
  const Matrix<double, 3> damping = 0.02 * stiffness;  // N s/m
  const auto unit = [](int k) { return RowVector<double, 6>(RowVector<double, 6>::Unit(k)); };

  LinearPlant<double> plant;
  plant.released_matrix.setZero(6, 6);
  plant.released_matrix.topRightCorner<3, 3>().setIdentity();
  plant.released_matrix.bottomLeftCorner<3, 3>() = (-mass.cwiseInverse()).asDiagonal() * stiffness;
  plant.released_matrix.bottomRightCorner<3, 3>() = (-mass.cwiseInverse()).asDiagonal() * damping;
  plant.force_input = (unit(3) / mass[0] - unit(5) / mass[2]).transpose();  // motor
  plant.excitation = unit(3).transpose() / mass[0];                         // wind
  plant.command_input.setZero(6);  // an ideal drive: its force is the command
  plant.drive_force.setZero(6);

  Ports<double, Eigen::Dynamic>& ports = plant.connections;
  ports.displacement = ports.measured_displacement = unit(0);
  ports.velocity = ports.measured_velocity = unit(3);
  ports.relative_displacement = unit(2) - unit(0);  // what the gap of the drive sees
  ports.relative_velocity = unit(5) - unit(3);
  ports.displacement_lift = unit(2).transpose();  // moves that by 1 m, and nothing else
  ports.velocity_lift = unit(5).transpose();
  return plant;
}

int main() {
  const LinearPlant<double> plant = three_masses();
  const Sampling<double> sampling{0.005, 0.001};  // τ and δ (s)
  const GainGrid grid{{-300.0, 100.0, 9}, {-12.0, 6.0, 37}};
  const UnitCircleCrossings<double> circle(ModalResponse<double>(plant, sampling));
  const auto stable = stability_chart(circle, grid);

  std::printf("P (N/m)   D = -12 to 6 N s/m, # stable\n");
  for (std::int64_t cell = 0; cell < grid.cells(); ++cell) {
    const std::int64_t column = cell % grid.differential.count;
    if (column == 0) std::printf("%7.0f   ", grid.proportional.at(cell / grid.differential.count));
    std::putchar(stable[static_cast<std::size_t>(cell)] != 0 ? '#' : '.');
    if (column + 1 == grid.differential.count) std::putchar('\n');
  }

  const StabilityMargins margins = stability_margins(plant, sampling, {-50.0, -2.0});
  std::printf("at P = -50, D = -2: D from %.2f to %.2f N s/m\n",
              margins.differential_gain.below.position, margins.differential_gain.above.position);

  MaxDelayOptions options{8.0, -150.0};  // f (Hz), P (N/m)
  options.delay_fraction = 0.2;          // δ/τ
  const MaxDelay slowest = max_sampling_period(plant, options);
  if (slowest.outcome == MaxDelayOutcome::found)
    std::printf("at 8 Hz some D attenuates up to a period of %.1f ms\n",
                1e3 * slowest.sampling_period);
}
