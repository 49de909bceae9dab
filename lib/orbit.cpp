// Explicit instantiations of orbit for double.
#include "holdfast/orbit/orbit_search.hpp"

namespace holdfast {

template OrbitResult find_periodic_orbit(const ForcedLoop<double>&, const Vector<double, 4>&,
                                         const OrbitLimits&);

}  // namespace holdfast
