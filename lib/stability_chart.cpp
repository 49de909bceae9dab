// Explicit instantiations of stability/chart for double.

#include "holdfast/stability/chart/chart.hpp"
#include "holdfast/stability/chart/circle_chart.hpp"

namespace holdfast {

template class StabilityRows<4>;
template class StabilityRows<5>;
template std::vector<std::uint8_t> stability_chart(const ResolvedCircle<double>&, const GainGrid&);

}  // namespace holdfast
