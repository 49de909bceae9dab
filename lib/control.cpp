// Explicit instantiations of control for double.
#include "holdfast/control/sampled_loop.hpp"

namespace holdfast {

template SampledLoop<double> sampled_loop(const TwoDof<double>&, const Sampling<double>&);

}  // namespace holdfast
