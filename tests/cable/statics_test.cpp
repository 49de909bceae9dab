#include "holdfast/cable/statics.hpp"

#include "support/message_of.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

template <class Model>
StaticsFromRest<Model> resting_statics(double absorber_mass = 0.16);

template <>
StaticsFromRest<IrvinePointLoad<double>> resting_statics(double absorber_mass) {
  return irvine_statics(kollar2022_conductor(), 0.64, absorber_mass);
}
template <>
StaticsFromRest<CatenaryPointLoad<double>> resting_statics(double absorber_mass) {
  return exact_statics(kollar2022_conductor(), 0.64, absorber_mass);
}

template <class Model>
class StaticsOf : public testing::Test {};
using BothModels = testing::Types<IrvinePointLoad<double>, CatenaryPointLoad<double>>;
struct ModelName {
  template <class Model>
  static std::string GetName(int) {
    return std::is_same_v<Model, IrvinePointLoad<double>> ? "EquationOne" : "Catenary";
  }
};
TYPED_TEST_SUITE(StaticsOf, BothModels, ModelName);

TYPED_TEST(StaticsOf, DisplacementsCountFromTheEquilibriumWithTheAbsorber) {
  const auto statics = resting_statics<TypeParam>();
  EXPECT_EQ(statics.displacement(0.0), 0.0);
  const double weight = 0.16 * 9.81;
  EXPECT_EQ(statics.resting_displacement(), statics.model().displacement(weight));
  // Taking the weight away brings the bare cable back.
  EXPECT_NEAR(statics.displacement(-weight), -statics.resting_displacement(), 1e-12);
  EXPECT_EQ(statics.tension(0.3), statics.model().tension(weight + 0.3));
}

TYPED_TEST(StaticsOf, ForceUndoesDisplacement) {
  const auto statics = resting_statics<TypeParam>();
  for (const double force : {-2.5, -1.0, -0.2, -1e-6, 0.0, 1e-6, 0.2, 1.0, 10.0, 500.0}) {
    const double w = statics.displacement(force);
    EXPECT_NEAR(statics.force(w), force, 1e-8 * (1 + std::abs(force))) << force;
  }
}

TYPED_TEST(StaticsOf, ADisplacementBelowTheLowestForceIsRefused) {
  const auto statics = resting_statics<TypeParam>();
  const double lowest = statics.lowest_force();
  EXPECT_NEAR(lowest, -0.16 * 9.81 - kollar2022_conductor().weight() / 2, 1e-14);
  const double highest_place = statics.displacement(lowest * (1 - 1e-9));
  EXPECT_NO_THROW(static_cast<void>(statics.force(highest_place + 1e-6)));
  const auto message =
      tests::message_of<InvalidParameter>([&] { statics.force(highest_place - 1e-6); });
  EXPECT_EQ(message.rfind("displacement", 0), 0U) << message;
  EXPECT_THROW(statics.force(std::numeric_limits<double>::quiet_NaN()), InvalidParameter);
  EXPECT_THROW(statics.force(-std::numeric_limits<double>::infinity()), InvalidParameter);
}

template <class Build>
void expect_refusals(const Build& build) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto conductor = kollar2022_conductor();
  for (const double place : {0.0, 6.4, -0.1, nan})
    EXPECT_THROW(build(conductor, place, 0.16), InvalidParameter) << place;
  for (const double mass : {-0.1, nan})
    EXPECT_THROW(build(conductor, 0.64, mass), InvalidParameter) << mass;
  for (const double sag : {3.2, 4.0, 0.0, nan}) {
    auto other = conductor;
    other.sag = sag;
    EXPECT_THROW(build(other, 0.64, 0.16), InvalidParameter) << sag;
  }
  EXPECT_NO_THROW(build(conductor, 0.64, 0.0));
}

TEST(Statics, BadInputIsRefused) {
  expect_refusals([](const auto& c, double place, double mass) { irvine_statics(c, place, mass); });
  expect_refusals([](const auto& c, double place, double mass) { exact_statics(c, place, mass); });
}

/// Relative difference of the two models' displacement under 3 % of the weight, at a tenth of the
/// span, with Irvine's parameter held.
double models_apart(double sag_ratio) {
  auto conductor = kollar2022_conductor();
  conductor.sag = sag_ratio * conductor.span;
  conductor.youngs_modulus *= 1719.0 / conductor.irvine_parameter();
  const double force = 0.03 * conductor.weight();
  return std::abs(exact_statics(conductor, 0.64, 0.0).displacement(force) /
                      irvine_statics(conductor, 0.64, 0.0).displacement(force) -
                  1.0);
}

TEST(Statics, EquationOneIsTheShallowLimitOfTheExactStatics) {
  for (const double ratio : {1.0 / 20, 1.0 / 40}) {
    const double order = std::log2(models_apart(ratio) / models_apart(ratio / 2));
    EXPECT_NEAR(order, 2.0, 0.1) << ratio;
  }
}

}  // namespace
}  // namespace holdfast
