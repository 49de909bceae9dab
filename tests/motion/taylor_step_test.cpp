#include "holdfast/motion/taylor_step.hpp"
#include "holdfast/contact/contact.hpp"
#include "holdfast/excitation/multi_harmonic_force.hpp"
#include "holdfast/motion/subinterval_step.hpp"

#include "support/dense_routes.hpp"
#include "support/random_loop.hpp"

namespace holdfast {
namespace {

using PreciseState = Vector<long double, 4>;

/// ż = A z + drift + b u + c Σ F cos ω t over x h, in extended precision: one exponential of
/// [z; 1; cos ω t; sin ω t].
PreciseState precise_state(const AffineDynamics& dynamics, const Vector<double, 4>& state,
                           double command, const Harmonic& harmonic, double time,
                           long double length) {
  Matrix<long double, 7> generator = Matrix<long double, 7>::Zero();
  generator.topLeftCorner<4, 4>() = dynamics.state.cast<long double>();
  generator.block<4, 1>(0, 4) =
      dynamics.drift.cast<long double>() +
      dynamics.command.cast<long double>() * static_cast<long double>(command);
  generator.block<4, 1>(0, 5) = dynamics.force.cast<long double>();
  const long double omega = 2.0L * pi<long double> * harmonic.frequency;
  generator(5, 6) = -omega;
  generator(6, 5) = omega;
  const long double angle = omega * time + harmonic.phase;
  Vector<long double, 7> begin;
  begin << state.cast<long double>(), 1.0L, harmonic.amplitude * std::cos(angle),
      harmonic.amplitude * std::sin(angle);
  return (exponential<long double, 7>(generator * length) * begin).head<4>();
}

/// The motion of a plant with all its inputs.
AffineDynamics driven_dynamics(const TwoMass<double>& plant, test::Random& random) {
  return {plant.state_matrix(), plant.control_input(), plant.excitation_input(),
          plant.control_input() * random.uniform(-1.0, 1.0)};
}

TEST(TaylorStep, IsTheExactMotionToRoundOff) {
  test::Random random(1311);
  double worst = 0.0;
  for (int draw = 0; draw < 1000; ++draw) {
    const auto plant = test::random_plant(random);
    const AffineDynamics dynamics = driven_dynamics(plant, random);
    const Vector<double, 4> unit = balancing(dynamics.state);
    const Harmonic harmonic{random.uniform(0.0, 2.0), random.log_uniform(0.1, 100.0),
                            random.uniform(-3.0, 3.0)};
    const double rate = std::max(balanced_norm(dynamics.state), harmonic.angular_frequency());
    const double share = random.log_uniform(1e-3, 1.0), length = share / rate;
    const double time = random.uniform(0.0, 0.1), command = random.uniform(-1.0, 1.0);
    Series force(terms_for(share));
    MultiHarmonicForce{{harmonic}, nullptr}.expand(time, length, force);
    const Vector<double, 4> begin = unit.asDiagonal() * random.matrix<Vector<double, 4>>();
    const TaylorStep motion(dynamics, begin, command, force, length);
    for (const double x : {0.0, 0.25, 0.7, 1.0}) {
      const PreciseState exact = precise_state(dynamics, begin, command, harmonic, time,
                                               static_cast<long double>(length) * x);
      const Vector<double, 4> wrong = motion.state(x) - exact.cast<double>();
      // Relative to the state and to what the inputs may add, in units that suit all components.
      const Vector<double, 4> inputs = dynamics.drift.cwiseAbs() +
                                       dynamics.command.cwiseAbs() * std::abs(command) +
                                       dynamics.force.cwiseAbs() * harmonic.amplitude;
      const Vector<double, 4> scale = exact.cast<double>().cwiseAbs() + length * inputs;
      const double error = wrong.cwiseQuotient(unit).cwiseAbs().maxCoeff() /
                           scale.cwiseQuotient(unit).cwiseAbs().maxCoeff();
      worst = std::max(worst, error);
      ASSERT_LT(error, 1e-14) << "draw " << draw << ", x = " << x << ", ‖A‖ h = " << share;
    }
  }
  std::cout << "largest relative error " << worst << '\n';
}

/// x^n / n! + x^{n+1} / (n + 1)! + …
long double rest_of_exponential(long double x, int terms) {
  long double term = 1.0L, rest = 0.0L;
  for (int k = 1; k <= terms; ++k) term *= x / k;
  for (int k = terms + 1; k < terms + 60; ++k) {
    rest += term;
    term *= x / k;
  }
  return rest;
}

TEST(TermsFor, LeaveARestThatIsNegligibleAndAreNoMoreThanThatTakes) {
  test::Random random(1314);
  constexpr long double negligible = 0x1p-60L;
  int fewest = most_terms, most = 0;
  for (int draw = 0; draw < 20000; ++draw) {
    const double x = draw == 0 ? 1.0 : random.log_uniform(1e-20, 1.0);
    const int terms = terms_for(x);
    fewest = std::min(fewest, terms);
    most = std::max(most, terms);
    ASSERT_GE(terms, 1);
    ASSERT_LE(terms, most_terms);
    // The rest is the first term left out, more or less.
    ASSERT_LE(rest_of_exponential(x, terms), 1.1L * negligible) << x;
    if (terms > 1) {
      ASSERT_GT(rest_of_exponential(x, terms - 1), negligible) << x;
    }
  }
  EXPECT_EQ(fewest, 1);
  EXPECT_EQ(most, most_terms);
  EXPECT_EQ(terms_for(0.0), 1);
}

TEST(BalancedNorm, BoundsEveryEigenvalueWhateverTheUnits) {
  test::Random random(1315);
  for (int draw = 0; draw < 300; ++draw) {
    const Matrix<double, 4> a = test::random_plant(random).state_matrix();
    const double norm = balanced_norm(a);
    const double fastest = test::moduli_of(a)[0];
    ASSERT_GE(norm, fastest * (1.0 - 1e-9));
    ASSERT_LE(norm, 10.0 * fastest) << "much longer steps would do";
    Vector<double, 4> unit;
    for (int i = 0; i < 4; ++i) unit[i] = std::exp2(std::floor(random.uniform(-20.0, 20.0)));
    const double elsewhere =
        balanced_norm(Matrix<double, 4>(unit.cwiseInverse().asDiagonal() * a * unit.asDiagonal()));
    ASSERT_LE(elsewhere, 2.0 * norm);
    ASSERT_GE(elsewhere, 0.5 * norm);
  }
}

AffineDynamics dynamics_of_plant(const TwoMass<double>& plant) {
  return {plant.state_matrix(), plant.control_input(), plant.excitation_input()};
}

/// F_l cos ω_l t and F_l sin ω_l t.
std::vector<ExcitationSample<double>> phases_at(const std::vector<Harmonic>& lines, double time) {
  std::vector<ExcitationSample<double>> phases;
  for (const Harmonic& line : lines) {
    const double angle = line.angular_frequency() * time;
    phases.push_back({line.amplitude * std::cos(angle), line.amplitude * std::sin(angle)});
  }
  return phases;
}

TEST(SubintervalStep, BothPartsOfAPeriodAreTheSampledLoop) {
  test::Random random(1341);
  for (int draw = 0; draw < 300; ++draw) {
    const auto plant = test::random_plant(random);
    const Sampling<double> sampling = test::random_sampling(plant, random);
    const SampledLoop<double> loop = sampled_loop(plant, sampling);
    const double delay = sampling.processing_delay;
    const SubintervalStep first(dynamics_of_plant(plant), {}, 0.0, delay);
    const SubintervalStep second(dynamics_of_plant(plant), {}, delay, sampling.period - delay);
    const Vector<double, 4> begin = random.matrix<Vector<double, 4>>();
    const double before = random.uniform(-9, 9), now = random.uniform(-9, 9), held = 2.5;
    const Vector<double, 4> found =
        second.state(first.state(begin, before, held, {}), now, held, {});
    const Vector<double, 4> expected = loop.transition * begin + loop.previous_force * before +
                                       loop.present_force * now + loop.held_excitation * held;
    const Vector<double, 4> size = loop.transition.cwiseAbs() * begin.cwiseAbs() +
                                   loop.previous_force.cwiseAbs() * std::abs(before) +
                                   loop.present_force.cwiseAbs() * std::abs(now) +
                                   loop.held_excitation.cwiseAbs() * held;
    ASSERT_LE((found - expected).cwiseQuotient(size).cwiseAbs().maxCoeff(), 1e-10) << draw;
  }
}

// z(t_j + begin + length) does not depend on where the part before it was cut.
TEST(SubintervalStep, TwoPartsAreOneLongerPart) {
  test::Random random(1342);
  const std::vector<Harmonic> lines{{0.5, 10.0}, {0.3, 27.0, 1.1}, {0.2, 1.7, -2.5}};
  for (int draw = 0; draw < 300; ++draw) {
    const auto plant = test::random_plant(random);
    const AffineDynamics dynamics = dynamics_on_stop(plant, plant.absorber_stiffness, 0.0, 0.01);
    const double begin = random.uniform(0.0, 0.01), cut = random.uniform(0.0, 0.01);
    const double length = cut + random.uniform(0.0, 0.01);
    const SubintervalStep whole(dynamics, lines, begin, length);
    const SubintervalStep first(dynamics, lines, begin, cut);
    const SubintervalStep second(dynamics, lines, begin + cut, length - cut);
    const auto phases = phases_at(lines, random.uniform(0.0, 1.0));
    const Vector<double, 4> z = random.matrix<Vector<double, 4>>();
    const double command = random.uniform(-5, 5);
    const Vector<double, 4> once = whole.state(z, command, 0.0, phases);
    const Vector<double, 4> twice =
        second.state(first.state(z, command, 0.0, phases), command, 0.0, phases);
    const double size = once.norm() + (whole.transition.cwiseAbs() * z.cwiseAbs()).norm() +
                        whole.drift.norm() + whole.command.norm() * std::abs(command);
    ASSERT_LE((once - twice).norm(), 1e-11 * size) << draw;
  }
}

// The quotient of differences of a short part is the equation of motion at its beginning.
TEST(SubintervalStep, ItsRateIsTheEquationOfMotionWithItsPhases) {
  test::Random random(1343);
  const auto plant = kollar2022_plant();
  const AffineDynamics dynamics = dynamics_on_stop(plant, 300.0, 2.0, 0.001);
  const std::vector<Harmonic> lines{{0.5, 10.0, 0.3}, {0.3, 27.0, -1.1}};
  for (int draw = 0; draw < 200; ++draw) {
    const double begin = random.uniform(0.0, 0.01), time = random.uniform(0.0, 1.0);
    const double length = 1e-6, command = random.uniform(-5, 5);
    const SubintervalStep step(dynamics, lines, begin, length);
    const Vector<double, 4> z = 0.01 * random.matrix<Vector<double, 4>>();
    const Vector<double, 4> rate =
        (step.state(z, command, 0.0, phases_at(lines, time)) - z) / length;
    double force = 0.0;
    for (const Harmonic& line : lines) force += line.at(time + begin + length / 2);
    const Vector<double, 4> expected =
        dynamics.state * z + dynamics.drift + dynamics.command * command + dynamics.force * force;
    ASSERT_LE((rate - expected).norm(), 1e-3 * expected.norm() + 1e-3) << draw;
    const Vector<double, 4> without = expected - dynamics.force * force;
    ASSERT_GT((rate - without).norm(),
              0.5 * (dynamics.force * force).norm() - 2e-3 - 1e-3 * expected.norm());
  }
}

TEST(SubintervalStep, WithoutLengthNothingMoves) {
  const SubintervalStep step(dynamics_of_plant(kollar2022_plant()), {{0.5, 10.0}}, 0.004, 0.0);
  const Vector<double, 4> z(0.001, -0.02, 0.003, 0.04);
  EXPECT_EQ(step.state(z, 5.0, 0.0, phases_at({{0.5, 10.0}}, 0.3)), z);
  EXPECT_EQ(step.state(z, 5.0, 0.7, {}), z);
}

}  // namespace
}  // namespace holdfast
