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

/// Bundles bend under a force and start under a blow as their modes do together.
TEST(TautString, BundlesStandForAllModes) {
  TautString<double> string = taut_string(kollar2022_conductor());
  const double place = 0.64;
  for (const double stiffness : {0.0, 1e-4}) {
    string.bending_stiffness = stiffness;
    const auto all = string_modes(string, place, 3000);
    const double highest = all.back().angular_frequency;
    for (const int apart : {1, 17, 100}) {
      const auto bundled = bundled_string_modes(string, place, apart, highest);
      EXPECT_LT(bundled.size(), static_cast<std::size_t>(apart) + 100U);
      // The first behind is a mode alone.
      const auto next = static_cast<std::size_t>(apart);
      EXPECT_NEAR(bundled[next].angular_frequency, all[next].angular_frequency,
                  0.3 / apart * all[next].angular_frequency);
      EXPECT_NEAR(std::pow(bundled[next].shape, 2), std::pow(all[next].shape, 2), 1e-12);
      EXPECT_EQ(bundled[next].damping_ratio, string.damping_ratio);
      // At s on the real axis, from rest to far above where bundling begins.
      for (const double s : {1e-3, 20.0, 300.0, 3000.0}) {
        const double expected = receptance(all, Complex(s)).real();
        const double tolerance = apart > 1 && s < 100.0 ? 1e-3 : 0.025;
        EXPECT_NEAR(receptance(bundled, Complex(s)).real(), expected, tolerance * expected)
            << apart << ' ' << s << ' ' << stiffness;
      }
    }
  }
  EXPECT_EQ(bundled_string_modes(string, place, 5, 1.0).size(), 5U);
  EXPECT_THROW(bundled_string_modes(string, place, 5, std::nan("")), InvalidParameter);
  EXPECT_THROW(bundled_string_modes(string, 7.0, 5, 1e3), InvalidParameter);
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
