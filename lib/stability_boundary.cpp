// Explicit instantiations of stability/boundary for double.

#include "holdfast/stability/boundary/boundary.hpp"
#include "holdfast/stability/boundary/boundary_features.hpp"
#include "holdfast/stability/boundary/circle_boundary.hpp"
#include "holdfast/stability/boundary/circle_crossings.hpp"
#include "holdfast/stability/boundary/stable_intervals.hpp"
#include "holdfast/stability/boundary/unit_circle_crossings.hpp"

namespace holdfast {

template std::vector<BoundaryPoint<double>> stability_boundary(const AffinePolynomial<double, 4>&,
                                                               const Interval<double>&);
template std::vector<BoundaryPoint<double>> stability_boundary(const AffinePolynomial<double, 5>&,
                                                               const Interval<double>&);
template std::vector<BoundaryFeature<double>> boundary_features(const AffinePolynomial<double, 4>&,
                                                                const GainWindow&);
template std::vector<BoundaryFeature<double>> boundary_features(const AffinePolynomial<double, 5>&,
                                                                const GainWindow&);
template std::vector<Interval<double>> stable_intervals(const Vector<double, 5>&,
                                                        const Vector<double, 5>&);
template std::vector<Interval<double>> stable_intervals(const Vector<double, 6>&,
                                                        const Vector<double, 6>&);
template std::vector<GainCrossing> circle_crossings(const LoopMap<double>&, FreeGain,
                                                    const PdGains<double>&);
template std::vector<Interval<double>> stable_gains(const LoopMap<double>&, FreeGain,
                                                    const PdGains<double>&);
template std::vector<BoundaryPoint<double>> stability_boundary(const ModalResponse<double>&,
                                                               const Interval<double>&);

template class UnitCircleCrossings<double>;

}  // namespace holdfast
