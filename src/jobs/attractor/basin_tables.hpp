#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "holdfast/motion/implemented_loop.hpp"
#include "process/job_context.hpp"

namespace holdfast::program {

/// What the job `basins` was asked.
struct BasinOptions {
  std::vector<std::string> axes;          ///< KEY=MIN:MAX:COUNT, two of initial.*
  std::int64_t largest_period = 100'000;  ///< samples
  bool fractions = false;  ///< a row for each attractor instead of one for each state
  Switching switching = Switching::sampled;
};

/// Writes which attractor every initial state of a grid comes to: its number from 1 on in the order
/// of the rows, 0 where the motion diverges, −1 where no orbit is found; and its period.
/// Throws WrongInput for other axes, NoAnswer where sampling and excitation never coincide.
void write_basins(const JobContext& context, const BasinOptions& options);

}  // namespace holdfast::program
