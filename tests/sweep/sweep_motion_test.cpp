#include "holdfast/sweep/sweep_motion.hpp"
#include "holdfast/sweep/sweep_matrices.hpp"

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

void expect_matrices_of(const detail::SweepMatrices::Matrices& found,
                        const IdealLoop<double>& loop) {
  const auto sampled = sampled_loop(loop.plant, loop.sampling);
  const auto input =
      harmonic_input(loop.plant, sampled, loop.hold, loop.excitation.angular_frequency());
  EXPECT_EQ(found.sampled.transition, sampled.transition);
  EXPECT_EQ(found.sampled.previous_force, sampled.previous_force);
  EXPECT_EQ(found.sampled.present_force, sampled.present_force);
  EXPECT_EQ(found.sampled.sampling.period, sampled.sampling.period);
  EXPECT_EQ(found.input.cosine, input.cosine);
  EXPECT_EQ(found.input.sine, input.sine);
}

// Every number that the matrices depend on is changed alone, and back.
TEST(SweepMatrices, AreThoseOfTheLoopWhateverWasAskedForBefore) {
  IdealLoop<double> loop = test::random_sweep_motions(1, 931, 1.0).front().loop;
  detail::SweepMatrices matrices;
  for (const ForceHold hold : {ForceHold::sampled, ForceHold::exact}) {
    loop.hold = hold;
    loop.sampling.processing_delay = 0.25 * loop.sampling.period;
    for (double* number :
         {&loop.plant.conductor_mass, &loop.plant.conductor_stiffness,
          &loop.plant.conductor_damping, &loop.plant.absorber_mass, &loop.plant.absorber_stiffness,
          &loop.plant.absorber_damping, &loop.sampling.period, &loop.sampling.processing_delay,
          &loop.excitation.frequency, &loop.excitation.amplitude, &loop.gains.proportional,
          &loop.gains.differential, &loop.backlash_width}) {
      const double before = *number;
      for (const double value : {before, 1.5 * before, before}) {
        *number = value;
        expect_matrices_of(matrices.of(loop), loop);
      }
    }
  }
}

}  // namespace
}  // namespace holdfast
