#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/control/enclosed_loop.hpp"

#include "support/random.hpp"
#include "support/random_loop.hpp"

namespace holdfast {
namespace {

/// Two free masses of 1 kg and 2 kg: a user's own plant, simple enough for hand calculation.
template <class Scalar>
struct FreeMasses {
  Matrix<Scalar, 4> state_matrix() const {
    Matrix<Scalar, 4> a = Matrix<Scalar, 4>::Zero();
    a(0, 1) = a(2, 3) = Scalar(1);
    return a;
  }
  Vector<Scalar, 4> control_input() const {
    return {Scalar(0), Scalar(1), Scalar(0), Scalar(-0.5)};
  }
  Vector<Scalar, 4> excitation_input() const {
    return {Scalar(0), Scalar(1), Scalar(0), Scalar(0)};
  }
};

TEST(SampledLoop, TheIncrementKeepsItsDigitsHoweverFastTheSampling) {
  test::Random random(73);
  const TwoMass<long double> precise{0.0767L, 50.3L, 0.079L, 0.16L, 74.4L, 4.0L};
  const TwoMass<double> plant{0.0767, 50.3, 0.079, 0.16, 74.4, 4.0};
  for (const double period : {1e-9, 1e-7, 1e-5, 1e-3, 1e-1}) {
    const auto rough = sampled_loop(plant, Sampling<double>{period, period / 3});
    const auto reference =
        sampled_loop(precise, Sampling<long double>{static_cast<long double>(period),
                                                    static_cast<long double>(period / 3)});
    const Matrix<double, 4> expected = reference.increment.cast<double>();
    EXPECT_LE(((rough.increment - expected).array() / expected.array()).abs().maxCoeff(), 1e-12)
        << period;
    for (int i = 0; i < 4; ++i) {
      EXPECT_NEAR(rough.present_force[i] / static_cast<double>(reference.present_force[i]), 1.0,
                  1e-12);
      EXPECT_NEAR(rough.previous_force[i] / static_cast<double>(reference.previous_force[i]), 1.0,
                  1e-12);
    }
  }
}

TEST(SampledLoop, FreeMassesMoveOnTheParabolasOfHandCalculation) {
  for (const double period : {0.001, 0.5}) {
    for (const double fraction : {0.0, 0.3, 1.0}) {
      const double delay = fraction * period, after = period - delay;
      const auto loop = sampled_loop(FreeMasses<double>{}, Sampling<double>{period, delay});
      const PdGains<double> gains{-2.0, -3.0};
      EXPECT_EQ(loop.previous_force.isZero(0.0), fraction == 0.0);
      EXPECT_EQ(loop.present_force.isZero(0.0), fraction == 1.0);
      // Displacement and velocity per newton on 1 kg: u_j pushes for `after`, u_{j−1} for `delay`
      // and then coasts.
      const double present = after * after / 2, previous = delay * period - delay * delay / 2;
      Matrix<double, 5> expected = Matrix<double, 5>::Zero();
      expected.row(0) << 1 - 2 * present, period - 3 * present, 0, 0, previous;
      expected.row(1) << -2 * after, 1 - 3 * after, 0, 0, delay;
      expected.row(2) << present, 1.5 * present, 1, period, -0.5 * previous;
      expected.row(3) << after, 1.5 * after, 0, 1, -0.5 * delay;
      expected.row(4) << -2, -3, 0, 0, 0;
      EXPECT_LE((loop.engaged_map(gains) - expected).cwiseAbs().maxCoeff(), 1e-15 * 10);
      Matrix<double, 5> idle = Matrix<double, 5>::Zero();
      idle.row(0) << 1, period, 0, 0, previous;
      idle.row(1) << 0, 1, 0, 0, delay;
      idle.row(2) << 0, 0, 1, period, -0.5 * previous;
      idle.row(3) << 0, 0, 0, 1, -0.5 * delay;
      EXPECT_LE((loop.backlash_map() - idle).cwiseAbs().maxCoeff(), 1e-15 * 10);
    }
  }
}

TEST(Sampling, WhatIsOutOfRangeIsRefused) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
  for (const double period : {0.0, -0.001, infinity, -infinity, not_a_number}) {
    EXPECT_THROW(validate(Sampling<double>{period, 0.0}), InvalidParameter) << period;
  }
  for (const double delay : {-1e-9, std::nextafter(0.01, 1.0), infinity, -infinity, not_a_number}) {
    try {
      validate(Sampling<double>{0.01, delay});
      ADD_FAILURE() << delay;
    } catch (const InvalidParameter& error) {
      EXPECT_EQ(error.name(), "processing delay");
      EXPECT_EQ(error.unit(), "s");
      EXPECT_EQ(error.admissible(), "between 0 and 0.01");
    }
  }
  for (const double delay : {0.0, 0.005, 0.01})
    EXPECT_NO_THROW(validate(Sampling<double>{0.01, delay}));
}

TEST(SampledLoop, OfNoTimeChangesNothing) {
  EXPECT_EQ(sampled_loop(kollar2022_plant(), Sampling<double>{0.0}).transition,
            (Matrix<double, 4>::Identity()));
}

/// A loop of extended precision, of the given doubles, lies within that of all decimals that they
/// are nearest to.
TEST(EnclosedLoop, HoldsTheLoopOfExtendedPrecision) {
  test::Random random(31);
  int narrow = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const TwoMass<double> plant = test::random_plant(random);
    const Sampling<double> sampling = test::random_sampling(plant, random);
    const auto ours = sampled_loop(enclosed(plant), enclosed(sampling)).transition;
    const Matrix<long double, 4> wide =
        sampled_loop(converted<long double>(plant),
                     Sampling<long double>{sampling.period, sampling.processing_delay})
            .transition;
    double widest = 0.0;
    for (Eigen::Index k = 0; k < 16; ++k) {
      EXPECT_LE(static_cast<long double>(ours(k).lower()), wide(k)) << trial;
      EXPECT_GE(static_cast<long double>(ours(k).upper()), wide(k)) << trial;
      widest = std::max(widest, ours(k).radius());
    }
    narrow += widest < 1e-11 * static_cast<double>(wide.cwiseAbs().maxCoeff()) ? 1 : 0;
  }
  // Samples of many of the plant's periods lose more.
  EXPECT_GT(narrow, 150);
}

TEST(EnclosedLoop, RefusesWhatIsNotAdmissible) {
  TwoMass<double> plant = kollar2022_plant();
  plant.conductor_mass = 0.0;
  EXPECT_THROW(enclosed(plant), InvalidParameter);
  EXPECT_THROW(enclosed(Sampling<double>{0.0, 0.0}), InvalidParameter);
  EXPECT_THROW(enclosed(Sampling<double>{0.001, 0.002}), InvalidParameter);
}

}  // namespace
}  // namespace holdfast
