#include "holdfast/simd/pack.hpp"
#include "kernels/kernels_on.hpp"

namespace holdfast::program {

const PackKernels& avx2_kernels() {
  return KernelsOn<simd::Pack<double, xsimd::fma3<xsimd::avx2>>>::all;
}

}  // namespace holdfast::program
