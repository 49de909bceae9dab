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

const PackKernels& pack_kernels(InstructionSet set) {
#ifdef HOLDFAST_HAS_AVX512
  if (set == InstructionSet::avx512) return avx512_kernels();
#endif
#ifdef HOLDFAST_HAS_AVX2
  if (set == InstructionSet::avx2) return avx2_kernels();
#endif
  static_cast<void>(set);
  return baseline_kernels();
}

}  // namespace holdfast::program
