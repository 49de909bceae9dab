#pragma once

#include <string>

#include "holdfast/motion/implemented_loop.hpp"
#include "process/job_context.hpp"

namespace holdfast::program {

/// What the job `lyapunov` was asked.
struct LyapunovOptions {
  double duration = 100.0;             ///< s, the longest
  double discard = 0.0;                ///< s, left out at the start
  double standard_error = 0.0;         ///< per sample, at which to stop; 0: go on to the end
  std::string tangent = "consistent";  ///< or "printed"
  bool largest = false;                ///< the largest exponent alone
  Switching switching = Switching::sampled;
};

/// One row for each exponent: per sample, per second, standard error.
/// Throws WrongInput for a duration of less than a sampling period, NoAnswer where the motion
/// diverges.
void write_exponents(const JobContext& context, const LyapunovOptions& options);

/// The exponents after every sample.
void write_exponent_history(const JobContext& context, const LyapunovOptions& options);

}  // namespace holdfast::program
