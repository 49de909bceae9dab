// Explicit instantiations of chaos for double.

#include "holdfast/chaos/block_spectrum.hpp"
#include "holdfast/chaos/event_lyapunov.hpp"
#include "holdfast/chaos/itinerary_blocks.hpp"
#include "holdfast/chaos/lyapunov_spectrum.hpp"
#include "holdfast/chaos/motion_classification.hpp"
#include "holdfast/chaos/switching_complexity.hpp"
#include "holdfast/chaos/zero_one_test.hpp"

namespace holdfast {

template BlockSpectrum<double>::BlockSpectrum(std::shared_ptr<const ItineraryBlocks>,
                                              LyapunovScope);
template void BlockSpectrum<double>::restart(const Blocks&);
template std::array<LyapunovSpectrum<double, 5>, 1> BlockSpectrum<double>::spectra(
    const Blocks&) const;
template void BlockSpectrum<double>::close_block();

template EventClassification classify_motion(const ImplementedLoop&, const Vector<double, 4>&,
                                             const OrbitLimits&);

template LyapunovResult run_event_lyapunov(EventMotion<DriveContact<>>&, const LyapunovRun&,
                                           const std::function<void()>&);

template ItineraryBlocks::ItineraryBlocks(const Matrix<double, 5>&, const Matrix<double, 5>&);

template int LyapunovSpectrum<double, 5>::rank_of(const Matrix<double, 5>&);
template void LyapunovSpectrum<double, 5>::push(const Matrix<double, 5>&, int);
template Vector<double, 5> LyapunovSpectrum<double, 5>::exponents() const;
template Vector<double, 5> LyapunovSpectrum<double, 5>::cautious_standard_errors() const;
template int LyapunovSpectrum<double, 7>::rank_of(const Matrix<double, 7>&);
template void LyapunovSpectrum<double, 7>::push(const Matrix<double, 7>&, int);
template Vector<double, 7> LyapunovSpectrum<double, 7>::exponents() const;
template Vector<double, 7> LyapunovSpectrum<double, 7>::cautious_standard_errors() const;

template SampledClassification classify_motion(const IdealLoop<double>&, const Vector<double, 4>&,
                                               const OrbitLimits&);

template SwitchingComplexity switching_complexity(const std::vector<bool>&);

template ZeroOneResult zero_one_test(const std::vector<double>&, int);

}  // namespace holdfast
