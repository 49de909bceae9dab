// Explicit instantiations of orbit/proof for double.

#include "holdfast/orbit/proof/orbit_proof.hpp"

namespace holdfast {

template OrbitProof prove_orbit(const IdealLoop<double>&, const PeriodicOrbit&, double);

}  // namespace holdfast
