#pragma once

#include <array>
#include <cstddef>

#include "holdfast/core/lanes.hpp"

namespace holdfast {

/// An array with one number for each lane, accessible as a pack or lane by lane.
template <class Scalar>
class LaneNumbers {
 public:
  static constexpr std::size_t lanes = Lanes<Scalar>::count;  ///< number of lanes

  /// The numbers of all lanes as a pack.
  Scalar all() const { return Lanes<Scalar>::load(numbers_.data()); }
  /// Sets the numbers of all lanes from a pack.
  void set(const Scalar& numbers) { Lanes<Scalar>::store(numbers, numbers_.data()); }
  /// The number of one lane, for writing.
  double& operator[](std::size_t lane) { return numbers_[lane]; }
  /// The number of one lane, for reading.
  double operator[](std::size_t lane) const { return numbers_[lane]; }

 private:
  alignas(lanes * sizeof(double)) std::array<double, lanes> numbers_{};
};

}  // namespace holdfast
