#pragma once

#include <complex>

#include "holdfast/stability/chart/proved_family.hpp"
#include "holdfast/stability/response/loop_response.hpp"
#include "support/random.hpp"

namespace holdfast::test {

/// Parameters by the given shares either way, each with a probability of 0.6.
template <std::size_t N>
ParameterBox<N> box_about(const std::array<double, N>& middle, double least, double most,
                          Random& random) {
  ParameterBox<N> box{middle, middle};
  for (std::size_t k = 0; k < N; ++k) {
    if (random.unit() < 0.4) continue;
    const double half = random.log_uniform(least, most) * std::abs(middle[k]);
    box.lowest[k] -= half;
    box.highest[k] += half;
  }
  return box;
}

/// A loop of a box, many of its parameters at an end.
template <std::size_t N>
std::array<double, N> member_of(const ParameterBox<N>& box, Random& random) {
  std::array<double, N> member;
  for (std::size_t k = 0; k < N; ++k) {
    const bool is_end = random.unit() < 0.3;
    const double share = is_end ? (random.sign() > 0.0 ? 1.0 : 0.0) : random.unit();
    member[k] = box.lowest[k] + share * (box.highest[k] - box.lowest[k]);
  }
  return member;
}

/// The base function less the sum over the frequencies that samples do not tell apart is the factor
/// times 1 − P G_z − D G_v, by the map of the sampled loop; in the frame of a box whose middle is
/// another loop.
/// @param v  of the angle, see angle_at()
template <class Loop>
void expect_function_of(const Loop& loop, const typename Loop::template Parameters<double>& values,
                        double v, const LoopMap<double>& map) {
  typename Loop::template Parameters<EnclosedSlope> x;
  typename Loop::template Parameters<Enclosure> all;
  for (std::size_t k = 0; k < values.size(); ++k) x[k].value = all[k] = Enclosure(values[k]);
  auto middle = values;
  middle[0] *= 0.8;
  middle[Loop::place_of_period] *= 1.1;
  const double period = middle[Loop::place_of_period];
  auto frame = loop.frame_at(middle, v / period);
  const auto at = detail::angle_at(v, x[Loop::place_of_period], frame.tuning(x), period);
  const double theta = at.theta.value.middle();
  loop.sum_modes(all, at.tuned.value, frame);
  const auto base = loop.base(x, at, frame);
  const detail::AliasSum sum = loop.aliases(all)(at.theta.value);
  const auto factor = loop.factor(all, {at.theta.value, at.omega.value, at.tuned.value}, frame);
  const auto by_p = factor * sum.proportional, by_d = factor * sum.differential;
  const Enclosure p = all[Loop::place_of_p], d = all[Loop::place_of_d];
  const Enclosure real = base.real.value - p * by_p.real - d * by_d.real;
  const Enclosure imag = base.imag.value - p * by_p.imag - d * by_d.imag;
  const auto response = LoopResponse<double>(map).at_angle(theta);
  const std::complex<double> own(factor.real.middle(), factor.imag.middle());
  const std::complex<double> wanted =
      own * (1.0 - p.middle() * response.displacement - d.middle() * response.velocity);
  const double rounding = 1e-7 * std::abs(wanted) + 1e-9 * std::abs(own);
  for (const auto& [found, exact] : {std::pair{real, wanted.real()}, {imag, wanted.imag()}}) {
    EXPECT_LE(found.lower(), exact + rounding) << theta;
    EXPECT_GE(found.upper(), exact - rounding) << theta;
    EXPECT_LE(found.radius(), 0.03 * std::abs(own) + rounding) << theta;
  }
}

}  // namespace holdfast::test
