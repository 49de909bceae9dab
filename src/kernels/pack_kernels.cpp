#include "kernels/pack_kernels.hpp"

namespace holdfast::program {

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
