#include "holdfast/core/errors.hpp"

#include "support/testing.hpp"

namespace holdfast {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double smallest = std::numeric_limits<double>::denorm_min();

template <class Action>
InvalidParameter refusal(Action action) {
  try {
    action();
  } catch (const InvalidParameter& error) {
    return error;
  }
  ADD_FAILURE() << "nothing was refused";
  return {"", 0.0, "", ""};
}

TEST(InvalidParameter, KeepsItsFourPartsAndSaysThemInOneSentence) {
  const InvalidParameter error("sampling period", -0.5, "s", "> 0");
  EXPECT_EQ(error.name(), "sampling period");
  EXPECT_EQ(error.value(), -0.5);
  EXPECT_EQ(error.unit(), "s");
  EXPECT_EQ(error.admissible(), "> 0");
  EXPECT_STREQ(error.what(), "sampling period = -0.5 s is not admissible: must be > 0");
}

TEST(InvalidParameter, APureNumberHasNoGapWhereTheUnitWouldStand) {
  EXPECT_STREQ(InvalidParameter("fraction", 2.0, "", "between 0 and 1").what(),
               "fraction = 2 is not admissible: must be between 0 and 1");
}

TEST(InvalidParameter, IsAnInvalidArgument) {
  EXPECT_THROW(require_finite("x", infinity, "m"), std::invalid_argument);
}

TEST(RequireFinite, RefusesNanAndBothInfinitiesOnly) {
  for (const double value : {not_a_number, infinity, -infinity}) {
    EXPECT_THROW(require_finite("x", value, "m"), InvalidParameter) << value;
  }
  for (const double value : {0.0, -0.0, -1e308, 1e308, smallest}) {
    EXPECT_NO_THROW(require_finite("x", value, "m")) << value;
  }
}

TEST(RequirePositive, RefusesZeroAndEverythingBelowAndBeyond) {
  for (const double value : {not_a_number, infinity, -infinity, 0.0, -0.0, -smallest}) {
    EXPECT_THROW(require_positive("x", value, "m"), InvalidParameter) << value;
  }
  for (const double value : {smallest, 1.0, 1e308}) {
    EXPECT_NO_THROW(require_positive("x", value, "m")) << value;
  }
}

TEST(RequireNonNegative, AdmitsZeroOfEitherSign) {
  for (const double value : {not_a_number, infinity, -infinity, -smallest}) {
    EXPECT_THROW(require_non_negative("x", value, "m"), InvalidParameter) << value;
  }
  for (const double value : {0.0, -0.0, smallest, 1e308}) {
    EXPECT_NO_THROW(require_non_negative("x", value, "m")) << value;
  }
}

TEST(RequireWithin, AdmitsBothEndsAndRefusesNan) {
  for (const double value :
       {not_a_number, infinity, -infinity, std::nextafter(1.0, 0.0), std::nextafter(2.0, 3.0)}) {
    EXPECT_THROW(require_within("x", value, "s", 1.0, 2.0), InvalidParameter) << value;
  }
  for (const double value : {1.0, 1.5, 2.0}) {
    EXPECT_NO_THROW(require_within("x", value, "s", 1.0, 2.0)) << value;
  }
}

TEST(Require, TheRefusalNamesParameterValueUnitAndRange) {
  const auto finite = refusal([] { require_finite("gain", infinity, "N/m"); });
  EXPECT_EQ(finite.name(), "gain");
  EXPECT_EQ(finite.value(), infinity);
  EXPECT_EQ(finite.unit(), "N/m");
  EXPECT_EQ(finite.admissible(), "finite");
  EXPECT_EQ(refusal([] { require_positive("mass", 0.0, "kg"); }).admissible(), "finite and > 0");
  EXPECT_EQ(refusal([] { require_non_negative("width", -1.0, "m"); }).admissible(),
            "finite and >= 0");
  const auto within = refusal([] { require_within("delay", 3.0, "s", 0.0, 2.5); });
  EXPECT_EQ(within.name(), "delay");
  EXPECT_EQ(within.value(), 3.0);
  EXPECT_EQ(within.admissible(), "between 0 and 2.5");
}

}  // namespace
}  // namespace holdfast
