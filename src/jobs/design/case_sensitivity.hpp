#pragma once

#include <string>
#include <vector>

#include "case/case.hpp"

namespace holdfast::program {

/// How an answer moves with a key of the case.
struct KeySensitivity {
  std::string key;
  double derivative;  ///< ∂answer/∂key, in their units; NaN: the answer has a corner there
};

/// One answer, and how it moves.
struct CaseSensitivity {
  std::string name, unit;
  double value;
  std::vector<KeySensitivity> keys;
};

/// How the answers of a case move with its keys: spectral radius, ends of the stable interval of D
/// about its own, D of least radius, D of least amplitude as `design` recommends it, and the
/// largest sampling periods where these are not walked to.
///
/// By differences of two steps, a part in 10⁴ and half of it, extrapolated (Richardson): of five
/// digits and more, and NaN where the two disagree by more than a hundredth. Where a
/// neighbour is not admissible, or of another kind of loop, the step is to one side.
/// @param tuned  P follows k2, m2 and the frequency by Eq. 6 instead of being held
std::vector<CaseSensitivity> case_sensitivities(const Case& the_case, bool tuned);

}  // namespace holdfast::program
