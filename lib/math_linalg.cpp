// Explicit instantiations of math/linalg for double.

#include "holdfast/math/linalg/multipliers.hpp"

namespace holdfast {

template std::vector<Multiplier> multipliers_of_product(const std::vector<Matrix<double, 5>>&);

}  // namespace holdfast
