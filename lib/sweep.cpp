// Explicit instantiations of sweep for double.

#include "holdfast/sweep/event_metrics.hpp"

namespace holdfast {

template MotionMetrics event_metrics(const ImplementedLoop&, const Vector<double, 4>&, double,
                                     const std::function<void()>&);

}  // namespace holdfast
