#include "compiled_once/verdict.hpp"

#include "compiled_once/sampled_loop.hpp"

namespace holdfast {

template MotionVerdict classify_motion(const ForcedLoop<double>&, const Vector<double, 4>&,
                                       const OrbitLimits&);
template HybridVerdict classify_motion(const RealLoop&, const Vector<double, 4>&,
                                       const OrbitLimits&);

}  // namespace holdfast
