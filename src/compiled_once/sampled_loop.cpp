#include "compiled_once/sampled_loop.hpp"

namespace holdfast {

template SampledLoop<double> sampled_loop(const TwoDof<double>&, const Sampling<double>&);

}  // namespace holdfast

namespace holdfast::detail {

template Matrix<double, 6> balanced_exponential(const Matrix<double, 6>&);

}  // namespace holdfast::detail
