#include "holdfast/simd/pack.hpp"
#include "kernels/kernels_on.hpp"

namespace holdfast::program {

const PackKernels& avx512_kernels() { return KernelsOn<simd::Pack<double, xsimd::avx512bw>>::all; }

}  // namespace holdfast::program
