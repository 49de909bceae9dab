// Explicit instantiations of orbit/proof for double.

#include "holdfast/orbit/proof/event_orbit_proof.hpp"
#include "holdfast/orbit/proof/orbit_proof.hpp"

namespace holdfast {

template class detail::OrbitProver<Enclosure>;
template OrbitProof prove_orbit(const IdealLoop<double>&, const PeriodicOrbit&, double);
template EventOrbitProof prove_event_orbit(const IdealLoop<double>&, const EventOrbit&,
                                           const StroboscopicState<DriveContact<>>&, double);

}  // namespace holdfast
