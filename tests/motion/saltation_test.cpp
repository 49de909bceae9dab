#include "holdfast/motion/saltation.hpp"

#include "support/dense_routes.hpp"
#include "support/random.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

constexpr double saltation_gravity = 9.81;

/// A field without a jump, a reset without a rate: all that a crossing may have is random.
template <int Size>
SurfaceCrossing<Size> random_crossing(test::Random& random) {
  SurfaceCrossing<Size> crossing;
  crossing.before = random.matrix<Vector<double, Size>>();
  crossing.after = random.matrix<Vector<double, Size>>();
  crossing.gradient = random.matrix<RowVector<double, Size>>();
  crossing.gradient_rate = random.uniform(-1.0, 1.0);
  crossing.reset = random.matrix<Matrix<double, Size>>();
  crossing.reset_rate = random.matrix<Vector<double, Size>>();
  return crossing;
}

template <int Size>
bool is_transversal(const SurfaceCrossing<Size>& crossing) {
  return std::abs(crossing.gradient.dot(crossing.before) + crossing.gradient_rate) > 0.05;
}

TEST(Saltation, WithoutAJumpOfTheFieldItIsTheDerivativeOfTheReset) {
  test::Random random(811);
  for (int trial = 0; trial < 200; ++trial) {
    auto crossing = random_crossing<4>(random);
    crossing.after = crossing.reset * crossing.before + crossing.reset_rate;
    if (!is_transversal(crossing)) continue;
    EXPECT_LT((saltation_matrix(crossing) - crossing.reset).cwiseAbs().maxCoeff(), 1e-13);
  }
}

TEST(Saltation, TakesTheFieldBeforeToTheFieldAfterWhereNothingDependsOnTime) {
  test::Random random(812);
  for (int trial = 0; trial < 200; ++trial) {
    auto crossing = random_crossing<4>(random);
    crossing.gradient_rate = 0.0;
    crossing.reset_rate.setZero();
    if (!is_transversal(crossing)) continue;
    const Vector<double, 4> taken = saltation_matrix(crossing) * crossing.before;
    EXPECT_LT((taken - crossing.after).norm(), 1e-12);
  }
}

/// Time as one more state, ṫ = 1, makes a crossing that depends on time one that does not.
TEST(Saltation, ACrossingThatDependsOnTimeIsOneWithTimeAmongTheStates) {
  test::Random random(813);
  for (int trial = 0; trial < 200; ++trial) {
    const auto crossing = random_crossing<3>(random);
    if (!is_transversal(crossing)) continue;
    SurfaceCrossing<4> extended;
    extended.before << crossing.before, 1.0;
    extended.after << crossing.after, 1.0;
    extended.gradient << crossing.gradient, crossing.gradient_rate;
    extended.reset.topLeftCorner<3, 3>() = crossing.reset;
    extended.reset.topRightCorner<3, 1>() = crossing.reset_rate;
    const Matrix<double, 4> whole = saltation_matrix(extended);
    const Matrix<double, 3> part = saltation_matrix(crossing);
    EXPECT_LT((whole.topLeftCorner<3, 3>() - part).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((whole.row(3) - RowVector<double, 4>(0, 0, 0, 1)).cwiseAbs().maxCoeff(), 1e-14);
  }
}

/// R is known on the surface alone: R + q h is the same reset there, for any q.
TEST(Saltation, DoesNotDependOnTheResetBesideTheSurface) {
  test::Random random(817);
  for (int trial = 0; trial < 200; ++trial) {
    const auto crossing = random_crossing<3>(random);
    if (!is_transversal(crossing)) continue;
    const Vector<double, 3> direction = random.matrix<Vector<double, 3>>();
    auto other = crossing;
    other.reset += direction * crossing.gradient;
    other.reset_rate += direction * crossing.gradient_rate;
    EXPECT_LT((saltation_matrix(other) - saltation_matrix(crossing)).norm(), 1e-12);
  }
}

TEST(Saltation, AFieldThatSlidesLosesTheDirectionAcrossTheSurface) {
  test::Random random(814);
  for (int trial = 0; trial < 200; ++trial) {
    SurfaceCrossing<4> crossing;
    crossing.before = random.matrix<Vector<double, 4>>();
    crossing.gradient = random.matrix<RowVector<double, 4>>();
    if (!is_transversal(crossing)) continue;
    const Vector<double, 4> other = random.matrix<Vector<double, 4>>();
    const double across = crossing.gradient.dot(other) / crossing.gradient.squaredNorm();
    crossing.after = other - crossing.gradient.transpose() * across;
    const Matrix<double, 4> saltation = saltation_matrix(crossing);
    EXPECT_LT((crossing.gradient * saltation).norm(), 1e-12 * saltation.norm());
    const Eigen::VectorXd stretches = test::singular_values_of(saltation);
    EXPECT_GT(stretches[2], 1e-9 * stretches[0]);
    EXPECT_LT(stretches[3], 1e-12 * stretches[0]);
  }
}

/// A motion by constant fields on both sides of a surface that moves, with a reset: where it is
/// after a given time is a function of where it began that is written down in one line.
TEST(Saltation, IsTheDerivativeOfAFlowByConstantFields) {
  test::Random random(815);
  int tried = 0;
  while (tried < 100) {
    const auto crossing = random_crossing<3>(random);
    if (!is_transversal(crossing)) continue;
    const double speed = crossing.gradient.dot(crossing.before) + crossing.gradient_rate;
    // The surface is h = ∂h/∂x x + ∂h/∂t t, met at the time `met` from x.
    const auto flow = [&](const Vector<double, 3>& begin) -> Vector<double, 3> {
      const double met = -crossing.gradient.dot(begin) / speed;
      const Vector<double, 3> there = begin + crossing.before * met;
      return crossing.reset * there + crossing.reset_rate * met - crossing.after * met;
    };
    const Matrix<double, 3> saltation = saltation_matrix(crossing);
    for (int column = 0; column < 3; ++column) {
      const Vector<double, 3> unit = Vector<double, 3>::Unit(column);
      const Vector<double, 3> difference = 0.5 * (flow(unit) - flow(-unit));
      EXPECT_LT((difference - saltation.col(column)).norm(), 1e-12 * (1.0 + saltation.norm()));
    }
    ++tried;
  }
}

/// A ball that falls freely between impacts on a table, v → −e v + (1 + e) w(t).
struct BouncingBall {
  double restitution;

  static Matrix<double, 2> flight(double time) {
    Matrix<double, 2> free;
    free << 1.0, time, 0.0, 1.0;
    return free;
  }

  /// S at an impact with v before it, on a table of velocity w and acceleration a.
  Matrix<double, 2> saltation(double before, double velocity, double acceleration) const {
    const double after = -restitution * before + (1.0 + restitution) * velocity;
    SurfaceCrossing<2> impact;
    impact.before << before, -saltation_gravity;
    impact.after << after, -saltation_gravity;
    impact.gradient << 1.0, 0.0;
    impact.gradient_rate = -velocity;
    impact.reset << 1.0, 0.0, 0.0, -restitution;
    impact.reset_rate << 0.0, (1.0 + restitution) * acceleration;
    return saltation_matrix(impact);
  }
};

/// One impact every period T of the table: the ball comes and goes with g T / 2. In time and
/// velocity after the impacts, t' and v' follow from
///
///     Y(t) + v (t' − t) − g (t' − t)² / 2 = Y(t'),   v' = −e (v − g (t' − t)) + (1 + e) Ẏ(t')
///
/// and the derivative there has det e² and trace 1 + e² + (1 + e)² Ÿ / g. (Guckenheimer and Holmes
/// 1983, sec. 2.4, neglect the table's height beside that of the flight: det e.)
TEST(Saltation, BouncingBallOnAVibratingTableHasTheMultipliersOfItsImpactMap) {
  test::Random random(816);
  for (int trial = 0; trial < 100; ++trial) {
    const BouncingBall ball{random.uniform(0.1, 0.95)};
    const double e = ball.restitution, period = random.uniform(0.02, 0.5);
    const double angular = 2.0 * pi<double> / period;
    const double velocity = saltation_gravity * period * (1.0 - e) / (2.0 * (1.0 + e));
    const double amplitude = velocity / angular * random.uniform(1.05, 6.0);
    // Ẏ = A ω cos φ is the velocity asked for; the acceleration is −A ω² sin φ, of either sign.
    const double sine = std::sqrt(1.0 - std::pow(velocity / (amplitude * angular), 2));
    const double acceleration = -random.sign() * amplitude * angular * angular * sine;

    const Matrix<double, 2> monodromy =
        BouncingBall::flight(period) *
        ball.saltation(-0.5 * saltation_gravity * period, velocity, acceleration);
    const double trace = 1.0 + e * e + (1.0 + e) * (1.0 + e) * acceleration / saltation_gravity;
    EXPECT_NEAR(monodromy.determinant(), e * e, 1e-11 * monodromy.squaredNorm());
    EXPECT_NEAR(monodromy.trace(), trace, 1e-12 * (1.0 + monodromy.norm()));
    const auto multipliers = test::eigenvalues_of(monodromy);
    for (int i = 0; i < 2; ++i) {
      const std::complex<double> mu = multipliers[i];
      const double size = 1.0 + std::abs(trace);
      EXPECT_LT(std::abs(mu * mu - trace * mu + e * e), 1e-9 * size * size);
    }
  }
}

/// The period doubles where λ = −1: Ÿ = −2 g (1 + e²) / (1 + e)². Below, the ball keeps in step.
TEST(Saltation, BouncingBallLosesItsStepWhereTheMultiplierIsMinusOne) {
  const BouncingBall ball{0.6};
  const double e = ball.restitution, period = 0.1;
  const double velocity = saltation_gravity * period * (1.0 - e) / (2.0 * (1.0 + e));
  const double edge = -2.0 * saltation_gravity * (1.0 + e * e) / ((1.0 + e) * (1.0 + e));
  const auto largest = [&](double acceleration) {
    const Matrix<double, 2> monodromy =
        BouncingBall::flight(period) *
        ball.saltation(-0.5 * saltation_gravity * period, velocity, acceleration);
    return test::moduli_of(monodromy)[0];
  };
  EXPECT_NEAR(largest(edge), 1.0, 1e-12);
  EXPECT_LT(largest(0.99 * edge), 1.0);
  EXPECT_GT(largest(1.01 * edge), 1.0);
  EXPECT_GT(largest(0.01), 1.0);  // the other solution of the same velocity is a saddle
}

/// A table at height zero whose velocity is linear in time within each unit of it, as in the map of
/// high bounces with a sawtooth: v' = e v + k s(t'), t' = t + 2 v / g. Its derivative in (t, v) is
/// the same everywhere, [[1, 2/g], [k, e + 2k/g]], and so are the exponents known: the logarithms
/// of its eigenvalues, the first of them positive.
class SawtoothBall {
 public:
  static constexpr double restitution = 0.7, rate = 6.0;  // e; k (m/s²)

  static Matrix<double, 2> section_map() {
    Matrix<double, 2> map;
    const double time_per_velocity = 2.0 / saltation_gravity;
    map << 1.0, time_per_velocity, rate, restitution + rate * time_per_velocity;
    return map;
  }

  /// From just after an impact to just after the next. @return the derivative at fixed times
  Matrix<double, 2> bounce() {
    const double flight = 2.0 * velocity_ / saltation_gravity;
    phase_ = std::fmod(phase_ + flight, 1.0);
    const double before = -velocity_;
    velocity_ = restitution * velocity_ + rate * (1.0 + phase_);
    SurfaceCrossing<2> impact;
    impact.before << before, -saltation_gravity;
    impact.after << velocity_, -saltation_gravity;
    impact.gradient << 1.0, 0.0;
    impact.reset << 1.0, 0.0, 0.0, -restitution;
    impact.reset_rate << 0.0, rate;
    return saltation_matrix(impact) * BouncingBall::flight(flight);
  }

  /// What (δt, δv) just after an impact are at a fixed time: −v δt, δv + g δt.
  Matrix<double, 2> from_section() const {
    Matrix<double, 2> map;
    map << -velocity_, 0.0, saltation_gravity, 1.0;
    return map;
  }

 private:
  double phase_ = 0.3, velocity_ = 20.0;
};

TEST(Saltation, ABallOnASawtoothHasTheSameDerivativeAtEveryImpact) {
  SawtoothBall ball;
  for (int impact = 0; impact < 1000; ++impact) {
    const Matrix<double, 2> expected_from = ball.from_section();
    const Matrix<double, 2> map = ball.bounce();
    const Matrix<double, 2> seen = map * expected_from;
    const Matrix<double, 2> expected = ball.from_section() * SawtoothBall::section_map();
    ASSERT_LT((seen - expected).norm(), 1e-12 * expected.norm());
  }
}

TEST(Saltation, ABallOnASawtoothHasItsKnownPositiveExponent) {
  SawtoothBall ball;
  constexpr int impacts = 100000;
  Vector<double, 2> direction(1.0, 0.0);
  double of_length = 0.0, of_area = 0.0;  // exponents an impact
  for (int impact = 0; impact < impacts; ++impact) {
    const Matrix<double, 2> map = ball.bounce();
    direction = (map * direction).eval();
    of_length += std::log(direction.norm()) / impacts;
    of_area += std::log(std::abs(map.determinant())) / impacts;
    direction.normalize();
  }
  const auto multipliers = test::eigenvalues_of(SawtoothBall::section_map());
  const double larger = std::max(multipliers[0].real(), multipliers[1].real());
  ASSERT_GT(std::log(larger), 0.5);
  // Vectors at fixed times and in (t, v) differ by a matrix that is bounded along with its inverse,
  // the velocity staying between 20 and 40 m/s: a constant over all impacts.
  EXPECT_NEAR(of_length, std::log(larger), 5.0 / impacts);
  EXPECT_NEAR(of_area, std::log(SawtoothBall::restitution), 5.0 / impacts);
}

}  // namespace
}  // namespace holdfast
