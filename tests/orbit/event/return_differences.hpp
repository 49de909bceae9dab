#pragma once

#include "holdfast/orbit/event/return_map.hpp"
#include "support/dense_routes.hpp"
#include "support/move_samples.hpp"
#include "support/testing.hpp"

namespace holdfast::test {

/// Eigenvalues of the derivative of X_N by X_0 at a point, by differences; |λ| in falling order.
/// @param steps  of [x; u_{j−1}; the gap; the displacement as last read]
template <class Contact>
Eigen::VectorXd moduli_by_differences(RepeatingMotion<Contact> motion,
                                      const StroboscopicState<Contact>& point, std::int64_t samples,
                                      const Eigen::VectorXd& steps) {
  Eigen::MatrixXd derivative(steps.size(), steps.size());
  for (Eigen::Index i = 0; i < steps.size(); ++i) {
    Eigen::VectorXd ends[2];
    for (const int side : {0, 1}) {
      Eigen::VectorXd by = Eigen::VectorXd::Zero(steps.size());
      by[i] = side == 0 ? steps[i] : -steps[i];
      motion.go_to(holdfast::detail::shifted(point, holdfast::detail::PointDeviation<Contact>(by)));
      move_samples(motion, samples);
      ends[side] = holdfast::detail::difference(point, motion.point());
    }
    derivative.col(i) = 0.5 * (ends[0] - ends[1]).cwiseQuotient(steps);
  }
  return moduli_of(derivative);
}

}  // namespace holdfast::test
