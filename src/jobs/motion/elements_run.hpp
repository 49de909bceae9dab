#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "case/case.hpp"
#include "holdfast/motion/sampled_motion.hpp"

namespace holdfast::program {

/// The motion of a case on the nonlinear cable in elements.
struct ElementsQuestion {
  int elements = 200;
  bool controlled = true;
  std::int64_t samples = 0;  ///< the last of them is taken and not left
};

/// Calls `visit` at each sample.
/// Throws WrongInput for a case that is not of the paper's model of computer and belt, or not
/// damped by Rayleigh; NoAnswer where the cable goes slack, in words that say when, where CVODE
/// gives up, or where the program was built without SUNDIALS.
void run_elements(const Case& the_case, const ElementsQuestion& question,
                  const std::function<void(const MotionSample<double>&)>& visit);

/// That the bars are longer than the waves at half the sampling rate; empty where they are not.
std::string coarse_bars_warning(const Case& the_case, const ElementsQuestion& question);

}  // namespace holdfast::program
