// The taut string: its modes together against the closed receptance of all of them.

#include "holdfast/cable/taut_string.hpp"

#include "support/testing.hpp"

namespace holdfast {
namespace {

using Complex = std::complex<double>;

TautString<double> lossless_string() {
  TautString<double> string = taut_string(kollar2022_conductor());
  string.damping_ratio = 0.0;
  return string;
}

TEST(TautString, OfTheConductorHasTheTensionOfItsSag) {
  const TautString<double> string = taut_string(kollar2022_conductor());
  EXPECT_NEAR(string.tension, 0.043 * 9.81 * 6.4 * 6.4 / (8.0 * 0.29), 1e-14);
  EXPECT_NEAR(string.wave_impedance() * string.wave_speed(), string.tension, 1e-14);
  // The lowest mode is half a wave.
  EXPECT_NEAR(string.angular_frequency(1), 3.141592653589793 * string.wave_speed() / 6.4, 1e-12);
}

/// What the modes left out would add falls as 1/N.
TEST(TautString, ModesSumUpToTheClosedReceptance) {
  const TautString<double> string = lossless_string();
  const double place = 0.64;
  for (const Complex s : {Complex(0.5, 20.0), Complex(3.0, 100.0), Complex(40.0, 7.0)}) {
    const Complex closed = receptance(string, place, s);
    double before = 0.0;
    for (const int count : {500, 1000, 2000}) {
      const double difference =
          std::abs(receptance(string_modes(string, place, count), s) - closed);
      if (before > 0.0) {
        EXPECT_NEAR(difference / before, 0.5, 0.05) << count;
      }
      before = difference;
    }
    EXPECT_LT(before, 1e-2 * std::abs(closed));
  }
}

TEST(TautString, LongAndDampedByDistanceIsTheInfiniteString) {
  TautString<double> string = lossless_string();
  string.span = 400.0;
  const Complex s(2.0, 30.0);
  const Complex infinite = 1.0 / (2.0 * s * string.wave_impedance());
  EXPECT_LT(std::abs(receptance(string, 190.0, s) - infinite), 1e-12 * std::abs(infinite));
  EXPECT_TRUE(std::isfinite(receptance(string, 190.0, Complex(1e4, 30.0)).real()));
}

TEST(TautString, BendingStiffnessRaisesTheHighModes) {
  TautString<double> string = lossless_string();
  const double first = string.angular_frequency(1), high = string.angular_frequency(200);
  string.bending_stiffness = 1e-3;
  EXPECT_NEAR(string.angular_frequency(1) / first, 1.0, 1e-4);
  // Far up, a beam: (nπ/L)² √(EI/μ).
  EXPECT_GT(string.angular_frequency(200), 1.5 * high);
  const double waves = 20000.0 * 3.141592653589793 / string.span;
  EXPECT_NEAR(string.angular_frequency(20000) / (waves * waves * std::sqrt(1e-3 / 0.043)), 1.0,
              1e-3);
}

TEST(TautString, RefusesWhatIsNotAdmissible) {
  const TautString<double> string = lossless_string();
  EXPECT_THROW(string_modes(string, 0.0, 4), InvalidParameter);
  EXPECT_THROW(string_modes(string, 6.4, 4), InvalidParameter);
  EXPECT_THROW(string_modes(string, 0.64, 0), InvalidParameter);
  TautString<double> other = string;
  other.tension = 0.0;
  EXPECT_THROW(string_modes(other, 0.64, 4), InvalidParameter);
  other = string;
  other.bending_stiffness = -1.0;
  EXPECT_THROW(validate(other), InvalidParameter);
  other = string;
  other.damping_ratio = 1.0;
  EXPECT_THROW(validate(other), InvalidParameter);
}

}  // namespace
}  // namespace holdfast
