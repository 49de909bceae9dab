// Verdicts on the stability of the sampled loop are those of its roots in extended precision,
// unless a root lies so near to the unit circle that rounding decides.

#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/stability/boundary/stable_intervals.hpp"
#include "property/loop_case.hpp"
#include "support/polynomial/hurwitz_conditions.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

using test::LoopCase;

bool any_contains(const std::vector<Interval<double>>& intervals, double value) {
  return std::any_of(intervals.begin(), intervals.end(),
                     [value](const auto& interval) { return interval.contains(value); });
}

test::PropertyOutcome verdicts_agree(const LoopCase& drawn) {
  const test::Growth truth = test::growth(drawn.plant, drawn.sampling(), drawn.gains);
  if (!(std::abs(truth.excess) > 1e-9)) return test::does_not_apply();
  const bool stable = truth.excess < 0.0;
  const auto is_wrong = [&](const std::string& verdict) {
    return test::fails(verdict + (stable ? " calls it unstable, " : " calls it stable, ") +
                       test::differs("max |lambda| - 1", truth.excess, 0.0));
  };
  const SampledLoop<double> loop = sampled_loop(drawn.plant, drawn.sampling());
  const auto polynomial = characteristic_polynomial(loop);
  const auto in_mu = polynomial.at(drawn.gains);
  Polynomial<double, 5> in_w = in_half_plane<double, 6>(in_mu);
  if (in_w[5] < 0.0) in_w = -in_w;
  if (test::hurwitz_conditions<double, 6>(in_w).satisfied() != stable)
    return is_wrong("Routh-Hurwitz");
  if (is_hurwitz<double, 6>(in_w) != stable) return is_wrong("Lienard-Chipart");
  if ((spectral_radius<double, 5>(loop.engaged_map(drawn.gains)) < 1.0) != stable)
    return is_wrong("the spectral radius");
  const auto& [p, d] = drawn.gains;
  if (any_contains(stable_differential_gains(polynomial, p), d) != stable)
    return is_wrong("the stable intervals of D");
  if (any_contains(stable_proportional_gains(polynomial, d), p) != stable)
    return is_wrong("the stable intervals of P");
  return test::holds();
}

TEST(StabilityVerdicts, AgreeWithTheRoots) {
  test::expect_property(701, 2000, test::random_loop_case, verdicts_agree, 0.9);
}

/// A gain is moved to within 10⁻⁸ … 10⁻² of itself of an end of a stable interval.
LoopCase random_case_near_the_boundary(test::Random& random) {
  LoopCase drawn = test::random_loop_case(random);
  const auto polynomial = characteristic_polynomial(sampled_loop(drawn.plant, drawn.sampling()));
  const auto intervals = stable_differential_gains(polynomial, drawn.gains.proportional);
  if (intervals.empty()) return drawn;
  const auto& interval = intervals[random.index(intervals.size())];
  const double end = random.unit() < 0.5 ? interval.lower : interval.upper;
  if (!std::isfinite(end)) return drawn;
  drawn.gains.differential = end * (1.0 + random.sign() * random.log_uniform(1e-8, 1e-2));
  return drawn;
}

TEST(StabilityVerdicts, AgreeWithTheRootsNearTheBoundary) {
  test::expect_property(702, 2000, random_case_near_the_boundary, verdicts_agree, 0.5);
}

}  // namespace
}  // namespace holdfast
