// Explicit instantiations of stability/chart for double.

#include "holdfast/stability/chart/chart.hpp"

namespace holdfast {

template class StabilityRows<4>;
template class StabilityRows<5>;

}  // namespace holdfast
