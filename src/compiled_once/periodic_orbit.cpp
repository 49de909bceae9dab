#include "compiled_once/periodic_orbit.hpp"

#include "compiled_once/sampled_loop.hpp"

namespace holdfast {

template std::vector<Multiplier> multipliers_of_product(const std::vector<Matrix<double, 5>>&);

template OrbitResult find_periodic_orbit(const ForcedLoop<double>&, const Vector<double, 4>&,
                                         const OrbitLimits&);

}  // namespace holdfast
