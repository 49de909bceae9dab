#include "holdfast/math/roots/first_root.hpp"

#include "holdfast/math/poly/polynomial.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

constexpr double root_epsilon = std::numeric_limits<double>::epsilon();

/// A polynomial times 1 + slope x.
Series with_factor(const Series& p, double slope) {
  Series product = Series::Zero(p.size() + 1);
  product.head(p.size()) = p;
  product.tail(p.size()) += slope * p;
  return product;
}

/// A polynomial times (x − centre)² + margin.
Series with_bowl(const Series& p, double centre, double margin) {
  Series product = Series::Zero(p.size() + 2);
  product.head(p.size()) = (centre * centre + margin) * p;
  product.segment(1, p.size()) -= 2.0 * centre * p;
  product.tail(p.size()) += p;
  return product;
}

/// Π (1 − x / r): above zero at 0, zero at every r.
Series falling_through(const std::vector<double>& places) {
  Series p = Series::Ones(1);
  for (const double place : places) p = with_factor(p, -1.0 / place);
  return p;
}

/// Horner's value may be wrong by as much; places within it of zero are zero.
double rounding_of(const Series& p) {
  return 4.0 * root_epsilon * static_cast<double>(p.size()) * p.cwiseAbs().sum();
}

/// How far a root of slope p′ moves where p errs by its rounding.
double blur_at(const Series& p, double root) {
  return rounding_of(p) / std::abs(value_and_slope(p, root).slope) + root_epsilon;
}

double lowest_in_unit_interval(const std::vector<double>& places) {
  double lowest = 2.0;
  for (const double place : places)
    if (place > 0.0 && place <= 1.0) lowest = std::min(lowest, place);
  return lowest;
}

TEST(FirstRoot, IsTheSmallestOfKnownRoots) {
  test::Random random(931);
  int crossings = 0, none = 0, most = 0;
  double worst = 0.0;
  for (int trial = 0; trial < 20000; ++trial) {
    std::vector<double> places(1 + random.index(6));
    for (double& place : places) place = random.sign() * random.log_uniform(0.01, 3.0);
    Series p = falling_through(places);
    if (random.unit() < 0.5) p = with_bowl(p, random.uniform(-1, 2), random.log_uniform(1e-3, 1.0));
    const double first = lowest_in_unit_interval(places);
    const FirstRoot found = first_root(p);
    most = std::max(most, found.evaluations);
    if (first > 1.0) {
      ASSERT_EQ(found.outcome, RootOutcome::none) << p.transpose();
      ASSERT_EQ(found.at, 1.0);
      ++none;
      continue;
    }
    ASSERT_NE(found.outcome, RootOutcome::none) << p.transpose();
    const double blur = blur_at(p, first);
    if (blur > 1e-3) continue;  // two of the roots are one to the precision of the coefficients
    ASSERT_NEAR(found.at, first, 4.0 * blur) << p.transpose();
    worst = std::max(worst, std::abs(found.at - first));
    crossings += found.outcome == RootOutcome::crossing ? 1 : 0;
  }
  std::cout << crossings << " crossings, " << none << " without a root, at most " << most
            << " evaluations, largest error " << worst << '\n';
  EXPECT_LE(most, 256);
  EXPECT_GT(crossings, 12000);
  EXPECT_GT(none, 2000);
}

/// The least real root in [0, 1] by math/poly/polynomial.hpp; 2 where there is none, −1 where that
/// is a matter of rounding.
double smallest_by_all_roots(const Series& p) {
  double least = 2.0;
  for (const std::complex<double>& root : roots(p)) {
    if (root.real() < -1e-6 || root.real() > 1.0 + 1e-6) continue;
    const double aside = std::abs(root.imag());
    if (aside > 1e-5) continue;
    const double inside = std::min(std::abs(root.real()), std::abs(root.real() - 1.0));
    if (aside > 1e-13 || inside < 1e-6) return -1.0;
    least = std::min(least, root.real());
  }
  return least;
}

TEST(FirstRoot, IsTheSmallestOfAllRootsOfATaylorSeries) {
  test::Random random(932);
  int compared = 0, with_root = 0, most = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    Series p(4 + static_cast<Eigen::Index>(random.index(16)));
    double size = 1.0;
    for (Eigen::Index k = 0; k < p.size(); size /= static_cast<double>(++k))
      p[k] = size * random.normal() * std::pow(3.0, static_cast<double>(k));
    p[0] = std::abs(p[0]);
    const double least = smallest_by_all_roots(p);
    const FirstRoot found = first_root(p);
    most = std::max(most, found.evaluations);
    if (least < 0.0) continue;
    ++compared;
    ASSERT_EQ(found.outcome == RootOutcome::none, least > 1.0) << p.transpose();
    if (least > 1.0) continue;
    ++with_root;
    ASSERT_NEAR(found.at, least, 4.0 * blur_at(p, least) + 1e-13) << p.transpose();
  }
  std::cout << compared << " compared, " << with_root << " with a root, at most " << most
            << " evaluations\n";
  EXPECT_LE(most, 256);
  EXPECT_GT(compared, 4900);
  EXPECT_GT(with_root, 2000);
}

// A pair of roots ever nearer to each other dips below zero by the square of its width, which a
// fixed step passes over. From 1e-7 on the dip is below the rounding of p, and whether it is there
// is for rounding to say: then the outcome is named.
TEST(FirstRoot, APairOfRootsIsNeverPassedOver) {
  test::Random random(933);
  int grazings = 0, most = 0;
  for (const double apart : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 0.0}) {
    for (int trial = 0; trial < 500; ++trial) {
      const double first = random.uniform(0.05, 0.95 - apart);
      std::vector<double> places{first, first + apart};
      for (int later = static_cast<int>(random.index(3)); later > 0; --later)
        places.push_back(random.uniform(first + 0.02, 2.0));
      const Series p = falling_through(places);
      const FirstRoot found = first_root(p);
      most = std::max(most, found.evaluations);
      ASSERT_NE(found.outcome, RootOutcome::none) << apart << ": " << p.transpose();
      const double blur = apart > 1e-6 ? blur_at(p, first) : 1e-6;
      ASSERT_NEAR(found.at, first, 4.0 * blur) << apart << ": " << p.transpose();
      ASSERT_LE(value_and_slope(p, found.at).value, rounding_of(p));
      if (apart >= 1e-4) {
        ASSERT_EQ(found.outcome, RootOutcome::crossing) << apart;
      }
      if (apart <= 1e-9) {
        ASSERT_EQ(found.outcome, RootOutcome::grazing) << apart;
      }
      grazings += found.outcome == RootOutcome::grazing ? 1 : 0;
    }
  }
  std::cout << grazings << " of 4000 grazing, at most " << most << " evaluations\n";
  EXPECT_LE(most, 256);
}

TEST(FirstRoot, WhatStaysAboveZeroHasNone) {
  test::Random random(934);
  int most = 0;
  for (const double margin : {1e-1, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
    for (int trial = 0; trial < 500; ++trial) {
      Series p = with_bowl(Series::Ones(1), random.uniform(-0.2, 1.2), margin);
      for (int factor = static_cast<int>(random.index(5)); factor > 0; --factor)
        p = with_factor(p, random.uniform(-0.9, 0.9));
      const FirstRoot found = first_root(p);
      most = std::max(most, found.evaluations);
      ASSERT_EQ(found.outcome, RootOutcome::none)
          << "margin " << margin << ", at " << found.at << ", where it is "
          << value_and_slope(p, found.at).value << ": " << p.transpose();
      ASSERT_EQ(found.at, 1.0);
    }
  }
  std::cout << "at most " << most << " evaluations\n";
  EXPECT_LE(most, 256);
}

// Σ k (k − 1) |c_k| exceeds |p″| by ten orders of magnitude here, so that steps by that bound alone
// would not come to the end.
TEST(FirstRoot, ABoundOfTheBendThatIsFarTooLargeMakesNoRoot) {
  Series p = Series::Ones(1);
  for (int factor = 0; factor < 18; ++factor) p = with_factor(p, -2.0);
  p[0] += 1.0;  // 1 + (1 − 2x)¹⁸
  const FirstRoot found = first_root(p);
  EXPECT_EQ(found.outcome, RootOutcome::none)
      << "at " << found.at << ", where it is " << value_and_slope(p, found.at).value;
}

TEST(FirstRoot, LeadingZerosAreDividedOut) {
  test::Random random(935);
  for (int zeros = 1; zeros <= 4; ++zeros) {
    for (int trial = 0; trial < 200; ++trial) {
      const Series q = falling_through({random.uniform(0.1, 0.9), random.uniform(1.1, 3.0)});
      Series p = Series::Zero(q.size() + zeros);
      p.tail(q.size()) = q;
      const FirstRoot found = first_root(p), without = first_root(q);
      ASSERT_EQ(found.at, without.at);
      ASSERT_EQ(found.outcome, without.outcome);
      p.tail(q.size()) = -q;
      ASSERT_EQ(first_root(p).at, 0.0) << "it begins by falling";
      ASSERT_EQ(first_root(p).outcome, RootOutcome::crossing);
    }
  }
  EXPECT_EQ(first_root(Series::Zero(5)).outcome, RootOutcome::none);
  EXPECT_EQ(first_root(Series::Constant(1, -1.0)).at, 0.0);
  EXPECT_EQ(first_root(Series::Constant(1, 1.0)).outcome, RootOutcome::none);
}

TEST(FirstRoot, BothEndsBelongToTheInterval) {
  const Series ends_at_one = falling_through({1.0, -2.0});
  EXPECT_NEAR(first_root(ends_at_one).at, 1.0, 1e-15);
  EXPECT_EQ(first_root(falling_through({1.0 + 1e-9, -2.0})).outcome, RootOutcome::none);
  const FirstRoot before = first_root(falling_through({1.0 - 1e-9, -2.0}));
  EXPECT_EQ(before.outcome, RootOutcome::crossing);
  EXPECT_NEAR(before.at, 1.0 - 1e-9, 1e-15);
  Series below(2);
  below << -1e-300, 1.0;
  EXPECT_EQ(first_root(below).at, 0.0) << "below zero at 0, though it rises";
}

TEST(FirstRoot, OfAnOddMultiplicityIsThere) {
  test::Random random(936);
  for (int trial = 0; trial < 500; ++trial) {
    const double place = random.uniform(0.1, 0.9);
    const FirstRoot triple = first_root(falling_through({place, place, place}));
    ASSERT_NE(triple.outcome, RootOutcome::none);
    ASSERT_NEAR(triple.at, place, 1e-4) << "the cube root of the rounding";
  }
}

// A function that begins within its rounding above zero and rises: d just after a change of contact
// at an end of the gap. What rounding makes of p(0) must not be seen in the root that comes later.
TEST(FirstRoot, AHairAboveZeroIsNotSeenLater) {
  test::Random random(937);
  double worst = 0.0;
  for (const double hair : {1e-300, 1e-30, 1e-20, 1e-18, 1e-17, 1e-16}) {
    for (int trial = 0; trial < 2000; ++trial) {
      const double place = random.uniform(0.05, 1.0);
      Series p(3 + static_cast<Eigen::Index>(random.index(2)));
      p.setZero();
      p[0] = hair, p[1] = 1.0, p[2] = -1.0 / place;         // x (1 − x / place), and for degree 3
      if (p.size() == 4) p[2] += 0.3, p[3] = -0.3 / place;  // times 1 + 0.3 x
      const FirstRoot found = first_root(p);
      ASSERT_EQ(found.outcome, RootOutcome::crossing);
      ASSERT_NEAR(found.at, place, 8.0 * blur_at(p, place)) << hair << ": " << p.transpose();
      worst = std::max(worst, std::abs(found.at - place));
    }
  }
  std::cout << "largest error " << worst << '\n';
}

TEST(FirstRoot, DoesNotDependOnTheUnitOfTheValue) {
  test::Random random(938);
  for (int trial = 0; trial < 1000; ++trial) {
    const Series p = falling_through(
        {random.uniform(0.1, 1.5), random.uniform(-3.0, -0.1), random.log_uniform(0.1, 3.0)});
    const FirstRoot found = first_root(p), scaled = first_root(0x1.0p-60 * p);
    ASSERT_EQ(found.at, scaled.at);
    ASSERT_EQ(found.outcome, scaled.outcome);
    ASSERT_EQ(found.evaluations, scaled.evaluations);
  }
}

TEST(FirstRoot, NeitherHugeNorTinyValuesHideIt) {
  const Series p = falling_through({0.4, -1.0, 2.0});
  const FirstRoot found = first_root(p);
  for (const double unit : {0x1.0p-1000, 0x1.0p-500, 0x1.0p500, 0x1.0p1000}) {
    const FirstRoot scaled = first_root(unit * p);
    EXPECT_EQ(scaled.outcome, RootOutcome::crossing) << unit;
    EXPECT_NEAR(scaled.at, found.at, 1e-15) << unit;
    EXPECT_LE(scaled.evaluations, found.evaluations + 1) << unit;
  }
}

TEST(FirstRoot, WhatIsNotFiniteHasNone) {
  for (const double odd :
       {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    Series p(3);
    p << 1.0, odd, -3.0;
    EXPECT_EQ(first_root(p).outcome, RootOutcome::none);
    EXPECT_EQ(first_root(p).evaluations, 0);
  }
}

TEST(FirstRoot, ACrossingTakesFewEvaluations) {
  test::Random random(939);
  int all = 0;
  constexpr int trials = 5000;
  for (int trial = 0; trial < trials; ++trial) {
    const double place = random.uniform(0.0, 1.0), omega = random.uniform(0.2, 1.0);
    Series p(20);  // sin ω (place − x)
    const double sine = std::sin(omega * place), cosine = std::cos(omega * place);
    double size = 1.0;
    for (Eigen::Index k = 0; k < 20; size *= omega / static_cast<double>(++k)) {
      const double derivatives[] = {sine, -cosine, -sine, cosine};
      p[k] = size * derivatives[k % 4];
    }
    const FirstRoot found = first_root(p);
    ASSERT_NEAR(found.at, place, 1e-14);
    ASSERT_LE(found.evaluations, 12);
    all += found.evaluations;
  }
  EXPECT_LE(all, 7 * trials);
}

}  // namespace
}  // namespace holdfast
