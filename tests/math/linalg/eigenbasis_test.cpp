// The eigenbasis as the transfer functions of a system, against a dense solution at each s.

#include "holdfast/math/linalg/eigenbasis.hpp"

#include "support/dense_routes.hpp"
#include "support/random.hpp"

namespace holdfast::test {
namespace {

using Square = Matrix<double, Eigen::Dynamic>;
using Column = Vector<double, Eigen::Dynamic>;

Square random_square(Random& random, Eigen::Index n) {
  Square m(n, n);
  for (auto& entry : m.reshaped()) entry = random.normal();
  return m;
}

TEST(EigenBasis, GivesTheTransferFunctionOfADenseSolution) {
  Random random(250);
  for (int draw = 0; draw < 200; ++draw) {
    const auto n = static_cast<Eigen::Index>(1 + random.index(12));
    const Square a = random_square(random, n);
    const Column b = random_square(random, n).col(0), h = random_square(random, n).col(0);
    const EigenBasis<double> basis(a);
    ASSERT_TRUE(basis.is_sound()) << draw;
    const std::complex<double> s(4.0 * random.normal(), 4.0 * random.normal());
    const EigenBasis<double>::ComplexVector terms =
        basis.readings(h.transpose()).cwiseProduct(basis.coordinates(b));
    const std::complex<double> sum = (terms.array() / (s - basis.values().array())).sum();
    const Eigen::MatrixXcd shifted = s * Square::Identity(n, n) - a;
    const std::complex<double> expected = (h.cast<std::complex<double>>().transpose() *
                                           solution_of(shifted, b.cast<std::complex<double>>()))
                                              .value();
    const double size = (terms.array() / (s - basis.values().array())).abs().sum();
    EXPECT_LT(std::abs(sum - expected), 1e-9 * size) << draw;
  }
}

TEST(EigenBasis, UnitsDoNotCostDigits) {
  Random random(251);
  for (int draw = 0; draw < 50; ++draw) {
    const Square a = random_square(random, 6);
    const Column b = random_square(random, 6).col(0), h = random_square(random, 6).col(0);
    Column unit(6);
    for (double& entry : unit) entry = std::exp2(std::round(20.0 * random.normal()));
    const Square other = unit.asDiagonal() * a * unit.cwiseInverse().asDiagonal();
    const EigenBasis<double> basis(a), of_other(other);
    const std::complex<double> s(0.3, 1.7);
    const auto value = [&](const EigenBasis<double>& one, const Column& in, const Column& out) {
      return (one.readings(out.transpose()).array() * one.coordinates(in).array() /
              (s - one.values().array()))
          .sum();
    };
    const auto expected = value(basis, b, h);
    const auto found = value(of_other, unit.cwiseProduct(b), unit.cwiseInverse().cwiseProduct(h));
    EXPECT_LT(std::abs(found - expected), 1e-10 * std::abs(expected)) << draw;
  }
}

TEST(EigenBasis, SaysWhereEigenvectorsCoincide) {
  Square jordan(3, 3);
  jordan << -1.0, 1.0, 0.0, 0.0, -1.0, 1.0, 0.0, 0.0, -2.0;
  EXPECT_FALSE(EigenBasis<double>(jordan).is_sound());
  jordan(1, 1) = -1.001;
  EXPECT_TRUE(EigenBasis<double>(jordan).is_sound());
}

}  // namespace
}  // namespace holdfast::test
