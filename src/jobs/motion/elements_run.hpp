#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "case/case.hpp"
#include "holdfast/motion/sampled_motion.hpp"

namespace holdfast::program {

/// Options of a simulation of the nonlinear cable in finite elements.
struct ElementsQuestion {
  int elements = 200;
  bool controlled = true;
  std::int64_t samples = 0;  ///< number of samples; the motion ends at the last one
};

/// Simulates a case on the nonlinear cable and calls `visit` at each sample. Throws WrongInput for
/// a case outside the paper's model of computer and belt or without Rayleigh damping; NoAnswer if
/// the cable goes slack (with the time), CVODE fails, or the program was built without SUNDIALS.
void run_elements(const Case& the_case, const ElementsQuestion& question,
                  const std::function<void(const MotionSample<double>&)>& visit);

/// Warning that the bars are too long for the waves at half the sampling rate; empty if not.
std::string coarse_bars_warning(const Case& the_case, const ElementsQuestion& question);

}  // namespace holdfast::program
