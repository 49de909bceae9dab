#include "kernels/kernels_on.hpp"
#ifdef HOLDFAST_HAS_SIMD
#include "holdfast/simd/pack.hpp"
#endif

namespace holdfast::program {

#ifdef HOLDFAST_HAS_SIMD
using BaselinePack = simd::Pack<double>;
#else
using BaselinePack = double;
#endif

const PackKernels& baseline_kernels() { return KernelsOn<BaselinePack>::all; }

}  // namespace holdfast::program
