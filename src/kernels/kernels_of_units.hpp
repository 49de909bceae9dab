#pragma once

namespace holdfast::program {

struct PackKernels;

/// One unit each, compiled for its instruction set; those that the program does not have are not
/// defined. Call none of a set that the processor has not got.
const PackKernels& baseline_kernels();
const PackKernels& avx2_kernels();
const PackKernels& avx512_kernels();

}  // namespace holdfast::program
