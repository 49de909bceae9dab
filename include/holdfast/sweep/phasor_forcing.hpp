#pragma once

#include <cstddef>

#include "holdfast/core/types.hpp"
#include "holdfast/excitation/phasor_table.hpp"

namespace holdfast {

/// The forcing of a `SampledMotion` from a table that outlives it and is turned by the motion's
/// driver.
template <class Scalar>
class TurningForcing {
 public:
  /// @param table  to be turned to each multiple of its `block` before that sample is advanced
  explicit TurningForcing(const TurningTable<Scalar>& table) : table_(&table) {}

  /// The addition (4 × 1) of the present sampling period; goes on to the next one.
  Vector<Scalar, 4> next() { return table_->addition(index_++ % TurningTable<Scalar>::block); }

 private:
  const TurningTable<Scalar>* table_;
  std::size_t index_ = 0;
};

}  // namespace holdfast
