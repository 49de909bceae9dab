#pragma once

#include <cstdio>

namespace holdfast::bench {

/// Whether this processor has the instructions that the bench is compiled for; says so if not.
inline bool processor_suffices() {
#if defined(__x86_64__) && defined(__AVX512F__)
  if (__builtin_cpu_supports("avx512f")) return true;
  std::puts("this processor has no AVX-512");
  return false;
#elif defined(__x86_64__) && defined(__AVX2__)
  if (__builtin_cpu_supports("avx2")) return true;
  std::puts("this processor has no AVX2");
  return false;
#else
  return true;
#endif
}

}  // namespace holdfast::bench
