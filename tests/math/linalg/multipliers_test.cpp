#include "holdfast/math/linalg/multipliers.hpp"

#include "support/dense_routes.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

using Map5 = Matrix<double, 5>;

constexpr double minus_infinity = -std::numeric_limits<double>::infinity();

/// ln |λ| of the product in long double, largest first.
Vector<double, 5> logarithms_of_product(const std::vector<Map5>& maps) {
  Matrix<long double, 5> product = Matrix<long double, 5>::Identity();
  for (const Map5& map : maps) product = map.cast<long double>() * product;
  return test::log_moduli_of(product);
}

std::vector<Map5> random_maps(test::Random& random, int count) {
  std::vector<Map5> maps;
  for (int k = 0; k < count; ++k) maps.push_back(random.matrix<Map5>());
  return maps;
}

template <class Map = Map5>
Map random_orthogonal(test::Random& random) {
  return test::orthogonal_factor_of(random.matrix<Map>());
}

/// Maps X_{k+1} B X_kᵀ with X_K = X₀: their product is similar to B^K.
template <class Map>
std::vector<Map> disguised(const Map& block, int count, test::Random& random) {
  std::vector<Map> maps;
  const Map start = random_orthogonal<Map>(random);
  Map before = start;
  for (int k = 1; k <= count; ++k) {
    const Map after = k == count ? start : random_orthogonal<Map>(random);
    maps.emplace_back(after * block * before.transpose());
    before = after;
  }
  return maps;
}

TEST(Multipliers, OfShortProductsAreTheEigenvaluesOfTheProduct) {
  test::Random random(801);
  for (int trial = 0; trial < 300; ++trial) {
    const auto maps = random_maps(random, 1 + static_cast<int>(random.index(6)));
    const Vector<double, 5> expected = logarithms_of_product(maps);
    const auto found = multipliers_of_product(maps);
    ASSERT_EQ(found.size(), 5U);
    // Long double resolves an eigenvalue to 1e-19 of the largest one, times its condition.
    for (int i = 0; i < 5; ++i) {
      const double accuracy = 1e-9 + 1e-15 * std::exp(expected[0] - expected[i]);
      EXPECT_NEAR(found[static_cast<std::size_t>(i)].log_modulus, expected[i], accuracy) << trial;
    }
  }
}

TEST(Multipliers, SpanTheWholeRangeOfNumbersAndMore) {
  test::Random random(803);
  Map5 block = Map5::Zero();
  block.diagonal() << 1.01, -0.9, 0.2, 1e-3, 2e-5;
  for (const int count : {3, 50, 1000}) {
    const auto found = multipliers_of_product(disguised(block, count, random));
    for (int i = 0; i < 5; ++i) {
      const auto& multiplier = found[static_cast<std::size_t>(i)];
      const double expected = count * std::log(std::abs(block(i, i)));
      EXPECT_NEAR(multiplier.log_modulus, expected, 1e-11 * count) << count << ' ' << i;
      const bool negative = i == 1 && count % 2 == 1;
      EXPECT_NEAR(std::abs(multiplier.angle), negative ? pi<double> : 0.0, 1e-9);
    }
  }
}

TEST(Multipliers, OfAnyOrderAreFoundLikewise) {
  test::Random random(806);
  Matrix<double, 8> block = Matrix<double, 8>::Zero();
  block.diagonal() << 1.01, -0.9, 0.4, 0.2, 0.03, 1e-3, 2e-5, 0.0;
  for (const int count : {3, 50, 300}) {
    std::vector<Eigen::MatrixXd> maps;
    for (const auto& map : disguised(block, count, random)) maps.emplace_back(map);
    const auto found = multipliers_of_product(maps);
    ASSERT_EQ(found.size(), 8U);
    for (int i = 0; i < 7; ++i) {
      const double expected = count * std::log(std::abs(block(i, i)));
      EXPECT_NEAR(found[static_cast<std::size_t>(i)].log_modulus, expected, 1e-10 * count)
          << count << ' ' << i;
    }
    EXPECT_EQ(found.back().log_modulus, minus_infinity);
  }
}

TEST(Multipliers, OfATriangularProductAreTheProductsOfItsDiagonalInAnyOrder) {
  // The space of the first coordinates is invariant, and the smallest multiplier's.
  for (const int count : {1, 10, 400, 2000}) {
    Map5 map = Map5::Zero();
    map.diagonal() << 0.1, 0.5, 0.9, 1.0, 0.02;
    for (int i = 0; i < 5; ++i)
      for (int j = i + 1; j < 5; ++j) map(i, j) = 0.3 - 0.1 * i;
    const auto found =
        multipliers_of_product(std::vector<Map5>(static_cast<std::size_t>(count), map));
    Vector<double, 5> expected = count * map.diagonal().array().log();
    std::sort(expected.begin(), expected.end(), std::greater<>());
    for (int i = 0; i < 5; ++i)
      EXPECT_NEAR(found[static_cast<std::size_t>(i)].log_modulus, expected[i], 1e-10 * count)
          << count << ' ' << i;
  }
}

TEST(Multipliers, RotationsAreComplexPairs) {
  test::Random random(804);
  for (const double angle : {0.3, 1.0, 3.0}) {
    Map5 block = Map5::Zero();
    block.topLeftCorner<2, 2>() << std::cos(angle), -std::sin(angle), std::sin(angle),
        std::cos(angle);
    block.topLeftCorner<2, 2>() *= 0.98;
    block.block<2, 2>(2, 2) = 0.1 * block.topLeftCorner<2, 2>().transpose();
    block(4, 4) = 0.5;
    for (const int count : {1, 7, 300}) {
      const auto found = multipliers_of_product(disguised(block, count, random));
      const double turned = std::abs(std::remainder(count * angle, 2.0 * pi<double>));
      EXPECT_NEAR(found[0].log_modulus, count * std::log(0.98), 1e-11 * count);
      EXPECT_NEAR(found[1].log_modulus, found[0].log_modulus, 1e-11 * count);
      EXPECT_NEAR(std::abs(found[0].angle), turned, 1e-9 * count);
      EXPECT_DOUBLE_EQ(found[0].angle, -found[1].angle);
      EXPECT_NEAR(found[2].log_modulus, count * std::log(0.5), 1e-11 * count);
      EXPECT_NEAR(found[4].log_modulus, count * std::log(0.098), 1e-11 * count);
      EXPECT_NEAR(std::abs(found[4].angle), turned, 1e-9 * count);
    }
  }
}

TEST(Multipliers, ANullDirectionIsExactlyMinusInfinity) {
  // One map of rank 4 among others, its kernel anywhere.
  test::Random random(806);
  for (const int count : {1, 5, 200}) {
    auto maps = random_maps(random, count);
    Map5& flat = maps[static_cast<std::size_t>(count) / 2];
    flat.col(4) = flat.col(0) - 0.5 * flat.col(2);
    const auto found = multipliers_of_product(maps);
    EXPECT_EQ(found[4].log_modulus, minus_infinity);
    EXPECT_EQ(found[4].value(), std::complex<double>(0.0, 0.0));
    EXPECT_TRUE(std::isfinite(found[3].log_modulus));
    if (count > 10) continue;
    const Vector<double, 5> expected = logarithms_of_product(maps);
    for (int i = 0; i < 4; ++i)
      EXPECT_NEAR(found[static_cast<std::size_t>(i)].log_modulus, expected[i], 1e-9);
  }
}

TEST(Multipliers, AnAnnihilatedCoordinateLeavesTheOthers) {
  for (int axis = 0; axis < 5; ++axis) {
    Map5 map = Map5::Identity() * 0.5;
    map(axis, axis) = 0.0;
    const auto found = multipliers_of_product({map, map, map});
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(found[i].log_modulus, 3.0 * std::log(0.5), 1e-14) << axis;
    EXPECT_EQ(found[4].log_modulus, minus_infinity) << axis;
  }
}

TEST(Multipliers, DirectionsThatTwoMapsAnnihilateTogetherAreMinusInfinityToo) {
  // The first map leaves out one axis, the second another: the product has rank 3.
  Map5 first = Map5::Identity(), second = Map5::Identity();
  first(3, 3) = 0.0;
  second(4, 4) = 0.0;
  test::Random random(807);
  const Map5 turn = random_orthogonal(random);
  const auto found =
      multipliers_of_product({turn * first * turn.transpose(), turn * second * turn.transpose()});
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found[i].log_modulus, 0.0, 1e-13);
  EXPECT_EQ(found[3].log_modulus, minus_infinity);
  EXPECT_EQ(found[4].log_modulus, minus_infinity);
}

TEST(Multipliers, TheZeroMapAnnihilatesEverything) {
  for (const Multiplier& multiplier : multipliers_of_product({Map5::Zero(), Map5::Identity()}))
    EXPECT_EQ(multiplier.log_modulus, minus_infinity);
}

TEST(Multiplier, ValueHasItsModulusAndAngle) {
  const std::complex<double> value = Multiplier{std::log(0.25), 2.0}.value();
  EXPECT_NEAR(std::abs(value), 0.25, 1e-15);
  EXPECT_NEAR(std::arg(value), 2.0, 1e-15);
  EXPECT_EQ((Multiplier{-5000.0, 1.0}.value()), std::complex<double>(0.0, 0.0));
}

}  // namespace
}  // namespace holdfast
