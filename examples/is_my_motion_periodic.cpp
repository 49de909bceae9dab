// The motion looks irregular. Is it?
#include <cstdio>

#include "holdfast/chaos/motion_classification.hpp"
#include "holdfast/plant/two_mass.hpp"

using namespace holdfast;

template <class Found>
void print(const char* switching, const Found& found) {
  std::printf("%s: %s\n", switching, attractor_type_text(found.classification).c_str());
  if (!found.search.orbit) {
    std::printf("  %s\n", found.classification.rests_on.c_str());
    return;
  }
  const auto& orbit = *found.search.orbit;
  std::printf("  period %.4g s, %lld periods of the forcing, largest multiplier %.1g\n",
              orbit.period(), static_cast<long long>(orbit.forcing_periods()),
              orbit.largest_multiplier());
}

int main() {
  IdealLoop<double> loop;
  loop.plant = kollar2022_plant();
  loop.sampling = {0.011};
  loop.gains = {-557.0, -13.0};
  loop.excitation = {0.5, 10.0};
  loop.backlash_width = 0.002;
  const Vector<double, 4> rest = Vector<double, 4>::Zero();
  print("the drive switches at samples", classify_motion(loop, rest));

  ImplementedLoop real = implemented_loop(loop);
  real.switching = Switching::exact;
  print("the drive switches when it happens", classify_motion(real, rest));
}
