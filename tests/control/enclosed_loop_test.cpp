#include "holdfast/control/enclosed_loop.hpp"

#include "support/random_loop.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

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
