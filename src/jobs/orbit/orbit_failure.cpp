#include "jobs/orbit/orbit_failure.hpp"

#include "io/text/text.hpp"

namespace holdfast::program {
namespace {

std::string never_coincide(const OrbitFailure& failure) {
  return "sampling and excitation never coincide: f tau = " +
         format_number(failure.cycles_per_sample) +
         " is no fraction p/q with q up to 1000000, or the force is a record, or the samples "
         "jitter; "
         "so no motion repeats, and the job verdict says what it is";
}

std::string none_found(const OrbitFailure& failure) {
  if (failure.samples == 0) {
    return "sampling and excitation coincide only every " +
           std::to_string(failure.ratio->denominator) +
           " samples; give --max-period at least as many";
  }
  return "no periodic orbit of up to " + std::to_string(failure.largest_period) + " samples in " +
         std::to_string(failure.samples) +
         " samples of the motion; a larger --max-period looks further, the job verdict weighs "
         "the evidence";
}

}  // namespace

std::string reason_for(const OrbitFailure& failure) {
  switch (failure.outcome) {
    case OrbitOutcome::incommensurate:
      return never_coincide(failure);
    case OrbitOutcome::diverges:
      return "the motion diverges, so it comes to no orbit";
    case OrbitOutcome::on_surface:
      return "the motion repeats after " + std::to_string(failure.period_samples) +
             " sample(s) but touches a switching surface, so that rounding decides its contacts: "
             "there is no certificate";
    case OrbitOutcome::approaching:
      return "the motion comes near a certified orbit of " +
             std::to_string(failure.period_samples) + " sample(s), but in " +
             std::to_string(failure.samples) +
             " samples not within its radius of capture; a larger --max-period looks longer";
    case OrbitOutcome::not_reproduced:
      return "the contacts repeat, but their exact solution switches otherwise: no orbit in " +
             std::to_string(failure.samples) + " samples; the job verdict says more";
    default:
      return none_found(failure);
  }
}

}  // namespace holdfast::program
