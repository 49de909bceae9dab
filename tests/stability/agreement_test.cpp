// The stability tests of the sampled loop are three roads to one answer: Hurwitz's conditions after
// the Möbius–Zhukovsky transformation, the spectral radius, and the closed intervals of D. None of
// them owes anything to fast sampling, when the roots crowd at λ = 1.

#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/stability/boundary/boundary.hpp"
#include "holdfast/stability/boundary/stable_intervals.hpp"
#include "support/polynomial/hurwitz_conditions.hpp"
#include "support/polynomial/pair_gains.hpp"
#include "support/random_loop.hpp"

namespace holdfast {
namespace {

/// Verdicts by Hurwitz's conditions, by eigenvalues and by intervals.
using Verdicts = std::array<bool, 3>;

Verdicts verdicts(const SampledLoop<double>& loop, const PdGains<double>& gains) {
  const auto polynomial = characteristic_polynomial(loop);
  Polynomial<double, 5> in_w = in_half_plane<double, 6>(polynomial.at(gains));
  if (in_w[5] < 0) in_w = -in_w;
  const auto intervals = stable_differential_gains(polynomial, gains.proportional);
  return {test::hurwitz_conditions<double, 6>(in_w).satisfied(),
          spectral_radius<double, 5>(loop.engaged_map(gains)) < 1.0,
          std::any_of(intervals.begin(), intervals.end(),
                      [&](const auto& one) { return one.contains(gains.differential); })};
}

/// Disagreements of each road with the extended-precision answer.
class Tallies {
 public:
  void take(const Verdicts& found, const test::Growth& truth) {
    for (std::size_t k = 0; k < found.size(); ++k) {
      if (found[k] == (truth.excess < 0)) continue;
      ++wrong_[k];
      furthest_[k] = std::max(furthest_[k], std::abs(truth.excess));
    }
  }
  void check() const {
    for (const std::size_t k : {0U, 1U, 2U}) {
      const char* const name = std::array{"hurwitz", "eigenvalues", "intervals"}[k];
      std::cout << "  " << name << ": " << wrong_[k]
                << " wrong, furthest ||lambda| - 1| = " << furthest_[k] << "\n";
      testing::Test::RecordProperty(std::string("disagreements_") + name, wrong_[k]);
      EXPECT_LE(furthest_[k], 1e-9) << name;
    }
  }

 private:
  std::array<int, 3> wrong_{};
  std::array<double, 3> furthest_{};  // largest ||λ| − 1| that was judged wrongly
};

TEST(StabilityRoads, AgreeOnRandomLoopsUnlessARootIsOnTheCircle) {
  test::Random random(201);
  Tallies tallies;
  const int plants = 20000, gains_per_plant = 5;
  int stable = 0;
  for (int draw = 0; draw < plants; ++draw) {
    const auto plant = test::random_plant(random);
    const auto sampling = test::random_sampling(plant, random);
    const auto loop = sampled_loop(plant, sampling);
    for (int pair = 0; pair < gains_per_plant; ++pair) {
      const auto gains = test::random_gains(plant, sampling.period, random);
      const Verdicts found = verdicts(loop, gains);
      stable += found[0] ? 1 : 0;
      if (found[0] == found[1] && found[0] == found[2]) continue;
      tallies.take(found, test::growth(plant, sampling, gains));
    }
  }
  tallies.check();
  EXPECT_GE(stable, plants * gains_per_plant / 10);
  EXPECT_LE(stable, plants * gains_per_plant * 9 / 10);
}

TEST(StabilityRoads, AgreeCloseToTheBoundary) {
  test::Random random(202);
  Tallies tallies;
  int tested = 0, stable = 0;
  for (int draw = 0; draw < 20000; ++draw) {
    const auto plant = test::random_plant(random);
    const auto sampling = test::random_sampling(plant, random);
    const auto loop = sampled_loop(plant, sampling);
    const double angle = 2 * std::atan(random.log_uniform(0.01, 10.0));
    const auto edge = test::complex_pair_gains(characteristic_polynomial(loop), angle);
    if (!edge) continue;
    // Most of the curve borders on loops that another root destabilises: keep where this pair
    // decides.
    PdGains<double> gains = *edge;
    if (std::abs(test::growth(plant, sampling, gains).excess) > 1e-9) continue;
    gains.differential *= 1.0 + random.sign() * random.log_uniform(1e-8, 1e-6);
    const auto truth = test::growth(plant, sampling, gains);
    if (std::abs(truth.excess) < 1e-9 || std::abs(truth.excess) > 1e-6) continue;
    ++tested;
    stable += truth.excess < 0 ? 1 : 0;
    tallies.take(verdicts(loop, gains), truth);
  }
  std::cout << "  " << tested << " loops, " << stable << " of them stable\n";
  EXPECT_GT(tested, 500);
  EXPECT_GT(stable, tested / 5);
  EXPECT_LT(stable, tested * 4 / 5);
  tallies.check();
}

TEST(StabilityRoads, AgreeForTheContinuousLoop) {
  test::Random random(203);
  int stable = 0;
  const int draws = 20000;
  for (int draw = 0; draw < draws; ++draw) {
    const auto plant = test::random_plant(random);
    const auto gains = test::random_gains(plant, random.log_uniform(0.0003, 0.05), random);
    const auto polynomial = characteristic_polynomial(plant);
    const bool hurwitz = test::hurwitz_conditions<double, 5>(polynomial.at(gains)).satisfied();
    const Matrix<double, 4> closed =
        plant.state_matrix() + plant.control_input() * gains.feedback_row();
    const double abscissa = spectral_abscissa<double, 4>(closed);
    bool inside = false;
    for (const auto& interval : stable_differential_gains(polynomial, gains.proportional)) {
      inside = inside || interval.contains(gains.differential);
    }
    stable += hurwitz ? 1 : 0;
    if (std::abs(abscissa) <= 1e-9 * spectral_radius<double, 4>(closed)) continue;
    EXPECT_EQ(hurwitz, abscissa < 0) << abscissa;
    EXPECT_EQ(inside, abscissa < 0) << abscissa;
  }
  EXPECT_GT(stable, draws / 10);
  EXPECT_LT(stable, draws * 9 / 10);
}

}  // namespace
}  // namespace holdfast
