#include "holdfast/sweep/sweep_motion.hpp"

#include "support/testing.hpp"
#include "sweep/sweep_setting.hpp"

namespace holdfast {
namespace {

TEST(SweepMotion, IsAdmissibleWhereItsLoopIsAndItBeginsSomewhere) {
  const SweepMotion motion = test::random_sweep_motions(1, 941, 1.0).front();
  EXPECT_NO_THROW(validate(motion));
  SweepMotion other = motion;
  other.loop.backlash_width = -1e-3;
  EXPECT_THROW(validate(other), InvalidParameter);
  for (int entry = 0; entry < 4; ++entry) {
    other = motion;
    other.initial_state[entry] = std::nan("");
    EXPECT_THROW(validate(other), InvalidParameter);
  }
}

TEST(SweepMotion, NumbersOfItsPlantTellEveryChange) {
  const TwoMass<double> plant = kollar2022_plant();
  TwoMass<double> other = plant;
  for (double* number :
       {&other.conductor_mass, &other.conductor_stiffness, &other.conductor_damping,
        &other.absorber_mass, &other.absorber_stiffness, &other.absorber_damping}) {
    *number *= 1.0 + 1e-15;
    EXPECT_NE(numbers_of(other), numbers_of(plant));
    other = plant;
  }
  EXPECT_EQ(numbers_of(other), numbers_of(plant));
}

}  // namespace
}  // namespace holdfast
