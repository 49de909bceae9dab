#include "best_gains.hpp"

#include <array>
#include <cmath>

#include "errors.hpp"

namespace holdfast::program {
namespace {

/// What the answer depends on beside the hold.
std::array<double, 10> numbers_of(const ForcedLoop<double>& loop) {
  const TwoDof<double>& plant = loop.plant;
  return {plant.conductor_mass,     plant.conductor_stiffness,      plant.conductor_damping,
          plant.absorber_mass,      plant.absorber_stiffness,       plant.absorber_damping,
          loop.sampling.period,     loop.sampling.processing_delay, loop.gains.proportional,
          loop.excitation.frequency};
}

bool have_one_answer(const ForcedLoop<double>& one, const ForcedLoop<double>& other) {
  return numbers_of(one) == numbers_of(other) && one.hold == other.hold;
}

}  // namespace

double BestGains::differential_gain(const ForcedLoop<double>& loop) {
  // Neighbours in a sweep often differ in nothing that the gain depends on.
  if (!known_ || !have_one_answer(*known_, loop)) {
    const double radius = std::exp(-10.0 * loop.sampling.period / duration_);
    answer_ = least_amplitude(loop.plant, {loop.sampling, loop.hold, radius},
                              loop.excitation.frequency, loop.gains.proportional);
    known_ = loop;
  }
  if (!std::isfinite(answer_.differential_gain))
    throw NoAnswer("no differential gain lets the motion settle within the duration");
  return answer_.differential_gain;
}

}  // namespace holdfast::program
