// My sensor has a filter and my motor lags. What is left of the loop?
#include <cstdio>

#include "holdfast/control/loop_map.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/orbit/event/event_orbit_search.hpp"
#include "holdfast/plant/linear_plant.hpp"
#include "holdfast/stability/boundary/circle_crossings.hpp"

using namespace holdfast;

template <class Plant>
void print_stable_gains(const char* name, const Plant& plant, const Sampling<double>& sampling) {
  for (const auto& d :
       stable_gains(loop_map(plant, sampling), FreeGain::differential, {-200.0, 0.0}))
    std::printf("%s: at P = -200 N/m stable for D from %.2f to %.2f N s/m\n", name, d.lower,
                d.upper);
}

int main() {
  const Sampling<double> sampling{0.005, 0.001};  // s, of which 1 ms for the computer

  // Two masses, four states; a filter of 80 Hz before the computer, one more; a motor of 60 Hz and
  // a damping ratio of 0.7 behind it, two more.
  const auto masses = linear_plant(kollar2022_plant());
  const auto plant = with_drive_lag(with_measurement_filter(masses, 80.0), 60.0, 0.7);
  print_stable_gains("two masses", masses, sampling);
  print_stable_gains("seven states", plant, sampling);

  // The same plant under 0.5 N at 10 Hz, with 0.5 mm of play that the drive enters and leaves when
  // it happens, from rest.
  ImplementedLoopOf<LinearPlant<double, 7>> loop;
  loop.plant = plant;
  loop.digital.sampling = sampling;
  loop.digital.gains = {-200.0, -5.0};
  loop.digital.force = multi_harmonic_force({0.5, 10.0});
  loop.backlash = {ContactLaw::play, 0.0005};
  loop.switching = Switching::exact;
  auto motion = event_motion(loop, Vector<double, 7>::Zero());
  for (int j = 0; j < 2000; ++j, motion.advance()) motion.sense();
  std::printf(
      "after %.0f s the drive has entered its gap %lld times\n", motion.time(),
      static_cast<long long>(motion.counts().entered[static_cast<std::size_t>(ContactMode::gap)]));

  const auto found = find_event_orbit(motion);
  if (found.outcome != OrbitOutcome::certified) return 1;
  std::printf("orbit of %.2f s, amplitude %.2f mm, engaged %.0f %% of the time\n",
              found.orbit->period(), 1e3 * found.orbit->largest_displacement,
              100.0 * found.orbit->time_share[0]);
  std::printf("largest multiplier %.4f, %zu of them\n", found.orbit->largest_multiplier(),
              found.orbit->multipliers.size());
}
