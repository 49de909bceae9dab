#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "holdfast/core/rational.hpp"
#include "holdfast/orbit/orbit_search.hpp"

namespace holdfast::program {

/// A search for an orbit that ended without a certificate, as far as it is told to the user.
struct OrbitFailure {
  OrbitOutcome outcome;
  std::int64_t samples;           // of the motion that was looked at
  std::int64_t period_samples;    // of the orbit that is none; 0 where there is not even that
  std::optional<Rational> ratio;  // f τ
  double cycles_per_sample;       // f τ as a number
  std::int64_t largest_period;    // asked for, samples
};

/// What a search found; any result with an outcome, samples and an orbit that may be none.
template <class Result>
OrbitFailure failure_of(const Result& found, const std::optional<Rational>& ratio,
                        double cycles_per_sample, std::int64_t largest_period) {
  return {found.outcome, found.samples,     found.orbit ? found.orbit->period_samples() : 0,
          ratio,         cycles_per_sample, largest_period};
}

/// Why there is no certificate, as a sentence without its end.
std::string reason_for(const OrbitFailure& failure);

}  // namespace holdfast::program
