// Explicit instantiations of chaos for double.

#include "holdfast/chaos/block_spectrum.hpp"
#include "holdfast/chaos/event_lyapunov.hpp"
#include "holdfast/chaos/itinerary_blocks.hpp"
#include "holdfast/chaos/lyapunov_spectrum.hpp"
#include "holdfast/chaos/modal_classification.hpp"
#include "holdfast/chaos/motion_classification.hpp"

namespace holdfast {

template class BlockSpectrum<double>;
template ItineraryBlocks::ItineraryBlocks(const Matrix<double, 5>&, const Matrix<double, 5>&);

template EventClassification classify_motion(const ImplementedLoop&, const Vector<double, 4>&,
                                             const OrbitLimits&);

template void EventLyapunov<DriveContact<>>::advance();
template void EventLyapunov<DriveContact<ControlledPlant>>::advance();

template LyapunovResult run_event_lyapunov(EventMotion<DriveContact<>>&, const LyapunovRun&,
                                           const std::function<void()>&);

template EventClassificationOf<Eigen::Dynamic> classify_motion(
    const ImplementedLoopOf<ControlledPlant>&, const Vector<double, Eigen::Dynamic>&,
    const OrbitLimits&);

template LyapunovResult run_event_lyapunov(EventMotion<DriveContact<ControlledPlant>>&,
                                           const LyapunovRun&, const std::function<void()>&);

template class LyapunovSpectrum<double, 5>;
template class LyapunovSpectrum<double, 7>;
template class LyapunovSpectrum<double, Eigen::Dynamic>;

template SampledClassification classify_motion(const IdealLoop<double>&, const Vector<double, 4>&,
                                               const OrbitLimits&);

template SampledClassification classify_motion(const ModalLoop&, const ModalMotion::Full&,
                                               const OrbitLimits&);

}  // namespace holdfast
