#pragma once

#include <array>
#include <cstddef>

#include "holdfast/core/lanes.hpp"

namespace holdfast {

/// A number of every lane, to be read and written as a pack or lane by lane.
template <class Scalar>
class LaneNumbers {
 public:
  static constexpr std::size_t lanes = Lanes<Scalar>::count;  ///< how many there are

  /// All of them.
  Scalar all() const { return Lanes<Scalar>::load(numbers_.data()); }
  /// Writes all of them.
  void set(const Scalar& numbers) { Lanes<Scalar>::store(numbers, numbers_.data()); }
  /// The number of one lane.
  double& operator[](std::size_t lane) { return numbers_[lane]; }
  /// The number of one lane.
  double operator[](std::size_t lane) const { return numbers_[lane]; }

 private:
  alignas(lanes * sizeof(double)) std::array<double, lanes> numbers_{};
};

}  // namespace holdfast
