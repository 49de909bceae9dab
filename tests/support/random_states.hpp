#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "holdfast/core/types.hpp"
#include "support/random.hpp"

namespace holdfast::test {

/// Random states of the two masses within 5 mm and 0.2 m/s.
inline std::vector<Vector<double, 4>> random_states(std::uint64_t seed, std::size_t count) {
  Random random(seed);
  std::vector<Vector<double, 4>> states;
  for (std::size_t k = 0; k < count; ++k) {
    const Vector<double, 4> unit = random.matrix<Vector<double, 4>>();
    states.push_back(unit.cwiseProduct(Vector<double, 4>(0.005, 0.2, 0.005, 0.2)));
  }
  return states;
}

}  // namespace holdfast::test
