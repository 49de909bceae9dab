#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "holdfast/core/types.hpp"

namespace holdfast::detail {

/// The factor ρ of contracting_forms(): the square root of the orbit's mean contraction per map,
/// but at least 1/2. The square root keeps the forms small.
/// @param log_modulus  ln of the largest multiplier, < 0
/// @param count        number of maps in a period
inline double contracting_rate(double log_modulus, std::size_t count) {
  return std::exp(std::max(0.5 * log_modulus / static_cast<double>(count), std::log(0.5)));
}

/// The matrices P_j of quadratic forms along a periodic sequence of linear maps M_j, not rigorous,
///
///     P_j = M_jᵀ P_{j+1} M_j / ρ² + Q_j,   j = 0 … N − 1,   P_N = P_0
///
/// P_0 = Σ_k (Fᵀ)ᵏ Q Fᵏ, where F = M_{N−1} … M_0/ρᴺ, and Q is P_0 by this recursion from P_N = 0.
/// @param count    N ≥ 1
/// @param map_of   j ↦ M_j, Size × Size of doubles
/// @param rest_of  j ↦ Q_j, positive definite
/// @param rate     factor ρ from contracting_rate()
/// @return nullopt if the sum is not finite: some multiplier then has a modulus ≥ ρᴺ
template <int Size, class MapOf, class RestOf>
std::optional<std::vector<Matrix<double, Size>>> contracting_forms(std::size_t count,
                                                                   const MapOf& map_of,
                                                                   const RestOf& rest_of,
                                                                   double rate) {
  using Form = Matrix<double, Size>;
  const auto symmetric = [](const Form& form) -> Form { return 0.5 * (form + form.transpose()); };
  Form period = map_of(0) / rate;
  for (std::size_t j = 1; j < count; ++j) period = map_of(j) * period / rate;
  std::vector<Form> forms(count);
  const auto go_back = [&](Form last) {
    for (std::size_t j = count; j-- > 0;) {
      const Form& map = map_of(j);
      last = symmetric(map.transpose() * last * map) / (rate * rate) + rest_of(j);
      forms[j] = last;
    }
  };
  go_back(Form::Zero(period.rows(), period.cols()));
  Form sum = forms.front();
  for (int turn = 0; turn < 60 && period.norm() > 1e-12; ++turn) {
    sum = symmetric(sum + period.transpose() * sum * period);
    period = (period * period).eval();
  }
  if (!sum.allFinite()) return std::nullopt;
  go_back(sum);
  return forms;
}

}  // namespace holdfast::detail
