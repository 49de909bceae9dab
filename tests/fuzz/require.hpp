#pragma once

#include <cstdio>
#include <cstdlib>

namespace holdfast::fuzz {

/// Ends the fuzzer, which then keeps its input, where a property does not hold.
inline void require(bool holds, const char* property) {
  if (holds) return;
  std::fprintf(stderr, "broken: %s\n", property);
  std::abort();
}

}  // namespace holdfast::fuzz
