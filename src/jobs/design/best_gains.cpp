#include "jobs/design/best_gains.hpp"

#include <cmath>

#include "holdfast/sweep/sweep_motion.hpp"

namespace holdfast::program {
namespace {

bool have_one_answer(const IdealLoop<double>& one, const IdealLoop<double>& other) {
  return numbers_of(one.plant) == numbers_of(other.plant) &&
         one.sampling.period == other.sampling.period &&
         one.sampling.processing_delay == other.sampling.processing_delay &&
         one.gains.proportional == other.gains.proportional &&
         one.excitation.frequency == other.excitation.frequency && one.hold == other.hold;
}

}  // namespace

const MinimumAmplitude& BestGains::of(const IdealLoop<double>& loop) {
  // Neighbours in a sweep often differ in nothing that the gain depends on.
  if (!known_ || !have_one_answer(*known_, loop)) {
    const double radius = std::exp(-10.0 * loop.sampling.period / duration_);
    answer_ = minimum_amplitude(loop.plant, {loop.sampling, loop.hold, radius},
                                loop.excitation.frequency, loop.gains.proportional);
    known_ = loop;
  }
  return answer_;
}

}  // namespace holdfast::program
