#include "holdfast/math/poly/routh_hurwitz.hpp"

#include "support/polynomial/hurwitz_conditions.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

using Complex = std::complex<double>;

/// The real polynomial with `Degree` random roots, some of them pairs, all left of `right_end`.
template <int Degree>
Polynomial<double, Degree> with_roots_left_of(double right_end, test::Random& random,
                                              double& rightmost) {
  Vector<Complex, Degree + 1> product = Vector<Complex, Degree + 1>::Unit(0);
  rightmost = -std::numeric_limits<double>::infinity();
  const auto multiply_by = [&](const Complex& root) {
    for (int k = Degree; k > 0; --k) product[k] = product[k - 1] - root * product[k];
    product[0] *= -root;
    rightmost = std::max(rightmost, root.real());
  };
  int left = Degree;
  while (left > 0) {
    const double real = random.uniform(-2, right_end);
    if (left >= 2 && random.unit() < 0.6) {
      const double imaginary = random.uniform(0.1, 2);
      multiply_by({real, imaginary});
      multiply_by({real, -imaginary});
      left -= 2;
    } else {
      multiply_by({real, 0});
      --left;
    }
  }
  return product.real();
}

template <int Degree>
void expect_decided_by_the_roots(std::uint64_t seed) {
  test::Random random(seed);
  int stable = 0;
  for (int draw = 0; draw < 5000; ++draw) {
    double rightmost = 0;
    const auto p = with_roots_left_of<Degree>(0.5, random, rightmost);
    if (std::abs(rightmost) < 1e-6) continue;
    ASSERT_EQ((test::hurwitz_conditions<double, Degree + 1>(p).satisfied()), rightmost < 0)
        << rightmost;
    stable += rightmost < 0 ? 1 : 0;
  }
  EXPECT_GT(stable, 500);
  EXPECT_LT(stable, 4500);
}

TEST(RouthHurwitz, DecidesQuarticsByTheirRoots) { expect_decided_by_the_roots<4>(141); }
TEST(RouthHurwitz, DecidesQuinticsByTheirRoots) { expect_decided_by_the_roots<5>(142); }

/// The leading minor of order `order` of the Hurwitz matrix: entry (i, j) is a_{n − 2j + i},
/// counted from 1.
template <int Degree>
double hurwitz_minor(const Polynomial<double, Degree>& a, int order) {
  Eigen::MatrixXd h = Eigen::MatrixXd::Zero(order, order);
  for (int i = 1; i <= order; ++i) {
    for (int j = 1; j <= order; ++j) {
      const int k = Degree - 2 * j + i;
      if (k >= 0 && k <= Degree) h(i - 1, j - 1) = a[k];
    }
  }
  return h.determinant();
}

template <int Degree>
void expect_textbook_minors(std::uint64_t seed) {
  test::Random random(seed);
  for (int draw = 0; draw < 500; ++draw) {
    Polynomial<double, Degree> a = random.matrix<Polynomial<double, Degree>>();
    const auto conditions = test::hurwitz_conditions<double, Degree + 1>(a);
    for (int order = 2; order < Degree; ++order) {
      const double expected = hurwitz_minor<Degree>(a, order);
      const double found = conditions.determinants[static_cast<std::size_t>(order - 2)];
      EXPECT_NEAR(found, expected, 1e-13) << "H" << order;
    }
  }
}

TEST(RouthHurwitz, DeterminantsAreTheMinorsOfTheHurwitzMatrix) {
  expect_textbook_minors<4>(143);
  expect_textbook_minors<5>(144);
}

TEST(RouthHurwitz, ARootOnTheAxisIsNotStable) {
  Polynomial<double, 4> p;
  p << 2, 3, 3, 3, 1;  // (s² + 1)(s + 1)(s + 2)
  EXPECT_FALSE((test::hurwitz_conditions<double, 5>(p).satisfied()));
  p << 0, 6, 11, 6, 1;  // s (s + 1)(s + 2)(s + 3)
  EXPECT_FALSE((test::hurwitz_conditions<double, 5>(p).satisfied()));
}

TEST(RouthHurwitz, NothingIsStableWithANan) {
  for (int k = 0; k <= 4; ++k) {
    Polynomial<double, 4> p;
    p << 24, 50, 35, 10, 1;  // (s + 1)(s + 2)(s + 3)(s + 4)
    ASSERT_TRUE((test::hurwitz_conditions<double, 5>(p).satisfied()));
    p[k] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE((test::hurwitz_conditions<double, 5>(p).satisfied()));
  }
}

/// Half of the conditions decide as all of them do, and with either sign of the polynomial.
template <int Degree>
void expect_half_of_the_conditions_suffices(std::uint64_t seed) {
  test::Random random(seed);
  int stable = 0;
  for (int draw = 0; draw < 200000; ++draw) {
    Polynomial<double, Degree> p;
    for (int k = 0; k <= Degree; ++k) p[k] = random.log_uniform(0.1, 10.0);
    if (random.unit() < 0.2) p[static_cast<int>(random.index(Degree))] *= -1.0;
    const bool whole = test::hurwitz_conditions<double, Degree + 1>(p).satisfied();
    ASSERT_EQ((lienard_chipart_stable<double, Degree + 1>(p)), whole) << p.transpose();
    ASSERT_EQ((lienard_chipart_stable<double, Degree + 1>(-p)), whole) << p.transpose();
    ASSERT_EQ((is_hurwitz<double, Degree + 1>(1e100 * p)), whole) << p.transpose();
    stable += whole ? 1 : 0;
  }
  EXPECT_GT(stable, 1000);
  EXPECT_LT(stable, 190000);
}

TEST(LienardChipart, DecidesAsAllOfHurwitzsConditionsDo) {
  expect_half_of_the_conditions_suffices<4>(4);
  expect_half_of_the_conditions_suffices<5>(5);
}

TEST(LienardChipart, OfACubicIsThatOfItsRoots) {
  test::Random random(6);
  int stable = 0;
  for (int draw = 0; draw < 20000; ++draw) {
    Polynomial<double, 3> p;
    for (int k = 0; k <= 3; ++k) p[k] = random.sign() * random.log_uniform(0.1, 10.0);
    if (random.unit() < 0.8) p = p.cwiseAbs();
    double abscissa = -1e9;
    for (const auto& root : roots(p)) abscissa = std::max(abscissa, root.real());
    EXPECT_EQ((lienard_chipart_stable<double, 4>(p)), abscissa < 0.0) << p.transpose();
    stable += abscissa < 0.0 ? 1 : 0;
  }
  EXPECT_GT(stable, 1000);
}

}  // namespace
}  // namespace holdfast
