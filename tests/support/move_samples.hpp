#pragma once

#include <cstdint>

namespace holdfast::test {

/// Moves what takes samples on over some of them.
template <class Motion>
void move_samples(Motion& motion, std::int64_t samples) {
  for (std::int64_t j = 0; j < samples; ++j) {
    motion.sense();
    motion.advance();
  }
}

}  // namespace holdfast::test
