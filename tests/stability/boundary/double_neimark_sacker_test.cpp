#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/boundary/boundary_features.hpp"

#include "holdfast/stability/boundary/boundary_curves.hpp"
#include "support/polynomial/made_polynomial.hpp"
#include "support/random_loop.hpp"

namespace holdfast {
namespace {

template <int Degree>
void expect_made_pairs_are_found(std::uint64_t seed) {
  test::Random random(seed);
  for (int draw = 0; draw < 300; ++draw) {
    const double first = random.log_uniform(0.05, 20.0), second = random.log_uniform(0.05, 20.0);
    const PdGains<double> gains{random.uniform(-3, 3), random.uniform(-3, 3)};
    const auto made = test::product<Degree>(test::quadratic(first, 0), test::quadratic(second, 0),
                                            random.uniform(-2, 2));
    const RootPairCurve<double> curve(test::through_in_half_plane<Degree>(made, gains, random));
    const double unit = curve.unit() * curve.unit();
    const auto pairs = double_neimark_sacker_points(curve);
    EXPECT_LE(pairs.size(), Degree == 4 ? 1U : 3U);
    const auto found = [&](const DoubleNeimarkSacker<double>& pair) {
      return std::abs(pair.lower_square * unit - std::min(first, second)) < 1e-7 &&
             std::abs(pair.upper_square * unit - std::max(first, second)) < 1e-7 &&
             std::abs(pair.gains.proportional - gains.proportional) < 1e-7 &&
             std::abs(pair.gains.differential - gains.differential) < 1e-7;
    };
    EXPECT_TRUE(std::any_of(pairs.begin(), pairs.end(), found)) << draw;
  }
}

TEST(DoubleNeimarkSackerPoints, MadeOnPurposeAreFound) {
  expect_made_pairs_are_found<4>(811);
  expect_made_pairs_are_found<5>(812);
}

TEST(DoubleNeimarkSackerPoints, OfAnUndampedPlantAreItsOwnFrequenciesAtZeroGains) {
  test::Random random(813);
  for (int draw = 0; draw < 200; ++draw) {
    TwoMass<double> plant = test::random_plant(random);
    plant.conductor_damping = plant.absorber_damping = 0.0;
    const auto sampling = test::random_sampling(plant, random);
    const BoundaryCurves<double, 5> curves(
        characteristic_polynomial(sampled_loop(plant, sampling)));
    // ω² are the roots of m₁m₂ω⁴ − (k₁m₂ + k₂(m₁ + m₂))ω² + k₁k₂; angles fold at π.
    const double a = plant.conductor_mass * plant.absorber_mass;
    const double c = plant.conductor_stiffness * plant.absorber_stiffness;
    const double b = plant.conductor_stiffness * plant.absorber_mass +
                     plant.absorber_stiffness * (plant.conductor_mass + plant.absorber_mass);
    const double large = (b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
    const auto folded = [&](double square) {
      return std::acos(std::cos(std::sqrt(square) * sampling.period));
    };
    const double first = folded(large), second = folded(c / (a * large));
    const auto pairs = double_neimark_sacker_points(curves.pairs());
    const auto at_rest = [&](const DoubleNeimarkSacker<double>& pair) {
      const double lower = curves.angle(pair.lower_square);
      const double upper = curves.angle(pair.upper_square);
      return std::abs(lower - std::min(first, second)) < 1e-7 &&
             std::abs(upper - std::max(first, second)) < 1e-7 &&
             std::abs(pair.gains.proportional) <
                 1e-6 * (plant.conductor_stiffness + plant.absorber_stiffness);
    };
    EXPECT_TRUE(std::any_of(pairs.begin(), pairs.end(), at_rest)) << draw;
  }
}

/// A point of a finely sampled curve; θ in equal steps of ln tan(θ/2).
struct CurveSample {
  double square;
  PdGains<double> gains;
};

std::vector<CurveSample> finely_sampled(const RootPairCurve<double>& curve, double from, double to,
                                        int count) {
  std::vector<CurveSample> samples;
  for (int k = 0; k <= count; ++k) {
    const double square = from * std::pow(to / from, static_cast<double>(k) / count);
    samples.push_back({square, curve.gains(square)});
  }
  return samples;
}

double side(const CurveSample& a, const CurveSample& b, const CurveSample& point) {
  return (b.gains.proportional - a.gains.proportional) *
             (point.gains.differential - a.gains.differential) -
         (b.gains.differential - a.gains.differential) *
             (point.gains.proportional - a.gains.proportional);
}

/// Pairs of chords that cross, by trying all of them.
int crossing_chords(const std::vector<CurveSample>& samples) {
  int result = 0;
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    for (std::size_t j = i + 2; j + 1 < samples.size(); ++j) {
      const bool second_is_split = (side(samples[i], samples[i + 1], samples[j]) > 0) !=
                                   (side(samples[i], samples[i + 1], samples[j + 1]) > 0);
      const bool first_is_split = (side(samples[j], samples[j + 1], samples[i]) > 0) !=
                                  (side(samples[j], samples[j + 1], samples[i + 1]) > 0);
      result += first_is_split && second_is_split ? 1 : 0;
    }
  }
  return result;
}

/// Double pairs with 10⁻³ < Y < 10³ on one branch between poles, and how many chords say so; the
/// curve is connected there, and a chord leads across no pole.
struct ChordCount {
  int found = 0, expected = 0;

  explicit ChordCount(const RootPairCurve<double>& curve) {
    std::vector<double> cuts = {1e-3};
    for (const double pole : curve.poles()) {
      if (pole > 1e-3 && pole < 1e3) cuts.push_back(pole);
    }
    cuts.push_back(1e3);
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      const double from = cuts[k] * (1 + 1e-3), to = cuts[k + 1] * (1 - 1e-3);
      if (!(from < to)) continue;
      found += crossing_chords(finely_sampled(curve, from, to, 1000));
      for (const auto& pair : double_neimark_sacker_points(curve)) {
        expected += pair.lower_square > from && pair.upper_square < to ? 1 : 0;
      }
    }
  }
};

TEST(DoubleNeimarkSackerPoints, AreAllThatTryingEveryPairOfChordsFinds) {
  test::Random random(815);
  int loops = 0, others = 0;
  for (int draw = 0; draw < 60; ++draw) {
    const auto plant = test::random_plant(random);
    const auto sampling = test::random_sampling(plant, random);
    const BoundaryCurves<double, 5> loop(characteristic_polynomial(sampled_loop(plant, sampling)));
    const ChordCount of_loop(loop.pairs());
    EXPECT_EQ(of_loop.found, of_loop.expected) << draw;
    loops += of_loop.expected;
    // Far enough apart for the chords to show the loop between them.
    const double first = random.log_uniform(0.1, 5.0), second = first * random.uniform(1.5, 10.0);
    const auto made = test::product<5>(test::quadratic(first, 0), test::quadratic(second, 0), 0.5);
    const auto any = test::through_in_half_plane<5>(made, {0, 0}, random);
    const ChordCount of_any{RootPairCurve<double>(any)};
    EXPECT_EQ(of_any.found, of_any.expected) << draw;
    others += of_any.expected;
  }
  std::cout << "  " << loops << " crossings of loops, " << others << " of other polynomials\n";
  EXPECT_GT(loops, 15);
  EXPECT_GT(others, 15);
}

TEST(DoubleNeimarkSackerPoints, OfTheUndampedContinuousLoopAreNotIsolated) {
  TwoMass<double> plant = kollar2022_plant();
  plant.conductor_damping = plant.absorber_damping = 0.0;
  EXPECT_TRUE(
      double_neimark_sacker_points(RootPairCurve(characteristic_polynomial(plant))).empty());
}

TEST(DoubleNeimarkSackerPoints, NeedTwoDifferentPairs) {
  test::Random random(816);
  for (int draw = 0; draw < 100; ++draw) {
    const double square = random.log_uniform(0.1, 10.0);
    const auto cusp = test::product<5>(test::quadratic(square, 0), test::quadratic(square, 0), 0.7);
    const RootPairCurve<double> curve(test::through_in_half_plane<5>(cusp, {0.3, -0.4}, random));
    for (const auto& pair : double_neimark_sacker_points(curve)) {
      EXPECT_GT(pair.upper_square - pair.lower_square, 1e-3 * pair.upper_square) << draw;
    }
  }
}

}  // namespace
}  // namespace holdfast
