#pragma once

#include <optional>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "case/model/reduction_of_case.hpp"
#include "jobs/cable/damping_fit.hpp"

namespace holdfast::program {

/// One row of what `reduce` prints.
struct Quantity {
  std::string name;    ///< key of the case file, or what else it is
  std::string symbol;  ///< in the equations; "" without one
  double value;
  std::string unit;  ///< "" without dimension
};

/// The plant that the case's conductor reduces to, how sure each parameter is, the readings of k1
/// and the cable itself. Without a fit what belongs to c2 is NaN.
///
/// Throws what plant_without_absorber_damping() and require_reading_range() throw.
std::vector<Quantity> reduction_table(const Case& the_case,
                                      const std::optional<AbsorberDampingFit>& damping);

}  // namespace holdfast::program
