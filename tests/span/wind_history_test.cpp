#include "holdfast/span/wind/wind_history.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "holdfast/span/span_roots.hpp"
#include "holdfast/span/wind/energy_balance.hpp"
#include "holdfast/span/wind/turbulence.hpp"
#include "span/drake_span.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

constexpr std::array<double, 5> target_frequencies = {8.0, 12.0, 15.0, 20.0, 25.0};

/// Drake on a span whose modes are 0.5 Hz apart, 100 of them, in a wind that sheds at a frequency.
WindHistorySetting drake_in_wind(double frequency) {
  WindHistorySetting setting;
  setting.string = drake_string();
  setting.string.span = setting.string.wave_speed();
  setting.diameter = drake_strand().diameter;
  setting.rated_strength = drake_strand().rated_strength;
  setting.self_damping = self_damping_laws[0];
  setting.wind.mean_speed = frequency * setting.diameter / setting.strouhal;
  setting.stations = 200;
  setting.duration = 60.0;
  setting.place = 0.37 * setting.string.span;
  setting.force = WakeOscillatorLaw{};
  return setting;
}

/// Drake on 3.28 m, whose first mode is the frequency, in a wind that sheds at a multiple of it.
WindHistorySetting short_drake_in_wind(double frequency, double ratio) {
  WindHistorySetting setting = drake_in_wind(ratio * frequency);
  setting.string.span = setting.string.wave_speed() / (2.0 * frequency);
  setting.modes = 3;
  setting.stations = 24;
  setting.place = 0.4 * setting.string.span;
  return setting;
}

double relative(const WindHistorySetting& setting) {
  return wind_history(setting).amplitude / setting.diameter;
}

double balance(const WindPowerLaw& law, const SelfDampingLaw& damping, double frequency,
               double damping_ratio = 0.0) {
  const StrandedConductor drake = drake_strand();
  const BalancedAmplitude found = balanced_amplitude(law, frequency, drake.diameter, [&](double y) {
    return damping.power(drake, frequency, y) +
           damped_power(drake.mass_per_length, damping_ratio, turn_of(frequency), y);
  });
  return found.amplitude / drake.diameter;
}

/// The amplitude over the diameter at which a wake of small ε feeds one mode what it loses, the
/// shedding being at that mode. There q = q₀ cos ωt is in phase with the velocity and
///
///     q₀ (q₀²/4 − 1) = (A/ε) y |φ|,   2 ζ(y) y = (C_L0/(16π² St² μ)) 2 ⟨q₀ |φ|⟩
///
/// y in diameters, μ = m/(ρ d²), with ζ of stall and of self-damping.
double harmonic_balance(const WindHistorySetting& setting, double frequency) {
  const auto& law = std::get<WakeOscillatorLaw>(setting.force);
  const double d = setting.diameter, rho_d2 = law.fluid_density * d * d;
  const double m = setting.string.mass_per_length + law.added_mass_per_length(d);
  const double mass_number =
      law.lift_coefficient / (16.0 * std::pow(pi<double> * setting.strouhal, 2)) * rho_d2 / m;
  const auto excess = [&](double y) {
    double sum = 0.0;
    constexpr int places = 200;
    for (int k = 0; k < places; ++k) {
      const double shape = std::sin((k + 0.5) * pi<double> / places);
      const double right = law.coupling / law.nonlinearity * y * shape;
      double q = 2.0 + std::cbrt(4.0 * right);
      for (int turn = 0; turn < 30; ++turn)
        q -= (q * (q * q / 4.0 - 1.0) - right) / (0.75 * q * q - 1.0);
      sum += q * shape / places;
    }
    double zeta = setting.string.damping_ratio +
                  law.stall_damping(d, m, turn_of(frequency), turn_of(frequency));
    if (setting.self_damping)
      zeta += setting.self_damping->power(drake_strand(), frequency, y * d) /
              damped_power(m, 1.0, turn_of(frequency), y * d);
    return 2.0 * mass_number * sum - 2.0 * zeta * y;
  };
  double low = 1e-4, high = 2.0;
  for (int k = 0; k < 60; ++k)
    (excess(std::sqrt(low * high)) > 0.0 ? low : high) = std::sqrt(low * high);
  return low;
}

// The same laws by two routes: a power a frequency, and a hundred modes in time.
TEST(WindHistory, OfMeasuredPowerEndsAtTheEnergyBalance) {
  for (const WindPowerLaw& law : wind_power_laws) {
    for (const double frequency : target_frequencies) {
      WindHistorySetting setting = drake_in_wind(frequency);
      setting.force = law;
      setting.steps_per_cycle = 16;
      setting.initial_amplitude = 0.1 * setting.diameter;
      setting.duration = frequency < 10.0 ? 400.0 : 200.0;
      const WindHistory history = wind_history(setting);
      const double expected = balance(law, self_damping_laws[0], frequency) * setting.diameter;
      EXPECT_NEAR(history.amplitude / expected, 1.0, 0.02) << law.name << " " << frequency;
      EXPECT_NEAR(history.frequency, frequency, 2e-3 * frequency);
      EXPECT_EQ(history.mode, static_cast<int>(std::lround(2.0 * frequency)));
    }
  }
}

TEST(WindHistory, OfMeasuredPowerWithDevicesAndTurbulenceEndsThereToo) {
  WindHistorySetting setting = drake_in_wind(20.0);
  const double far = setting.string.span - 1.1;
  setting.devices = {{1.1, LumpedDevice{{{2.0}}, 0.0}}, {far, LumpedDevice{{{1.0}}, 0.0}}};
  setting.wind.intensity = 0.05;
  setting.force = wind_power_laws[0];
  setting.steps_per_cycle = 16;
  setting.initial_amplitude = 0.05 * setting.diameter;
  std::vector<double> modes;
  for (int n = 1; n <= 40; ++n) modes.push_back(setting.string.angular_frequency(n));
  const double zeta = device_damping(setting.string, setting.devices, modes).back();
  EXPECT_GT(zeta, 5e-5);
  const double expected =
      balance(in_turbulence(wind_power_laws[0], 0.05), self_damping_laws[0], 20.0, zeta);
  EXPECT_NEAR(relative(setting) / expected, 1.0, 0.02);
  EXPECT_LT(expected, 0.9 * balance(wind_power_laws[0], self_damping_laws[0], 20.0));
}

TEST(DeviceDamping, IsThatOfTheRootsOfTheSpan) {
  const TautString<double> string = drake_string();
  const std::vector<SpanDevice> devices = {{1.1, LumpedDevice{{{200.0}}, 0.0}},
                                           {298.5, LumpedDevice{{{100.0}}, 0.0}}};
  std::vector<double> modes;
  for (int n = 1; n <= 120; ++n) modes.push_back(string.angular_frequency(n));
  const std::vector<double> found = device_damping(string, devices, modes);
  const auto roots = span_roots(string, devices, 120);
  for (std::size_t n = 0; n < 120; ++n)
    EXPECT_NEAR(found[n] / roots[n].damping(), 1.0, 0.01) << n + 1;
}

// The article's law for one mode and small ε, in which the first harmonic is all.
TEST(WindHistory, OfOneModeAndItsWakesIsTheirHarmonicBalance) {
  for (const double damping : {3e-4, 1e-3, 4e-3}) {
    WindHistorySetting setting = short_drake_in_wind(20.0, 1.0);
    setting.force = WakeOscillatorLaw{2.0, 0.05, 0.3, 0.8, 0.0};
    setting.self_damping.reset();
    setting.string.damping_ratio = damping;
    setting.modes = 1;
    setting.initial_amplitude = 0.1 * setting.diameter;
    setting.duration = 100.0;
    EXPECT_NEAR(relative(setting) / harmonic_balance(setting, 20.0), 1.0, 0.005) << damping;
  }
}

/// Amplitudes of a wake oscillator on a hundred modes against the band of the laws of power.
struct Comparison {
  double lowest, highest;       // by two laws of wind and three of self-damping
  std::array<double, 3> wakes;  // with each of the latter
};

Comparison compared(double frequency) {
  Comparison found{1.0, 0.0, {}};
  for (std::size_t k = 0; k < 3; ++k) {
    for (const WindPowerLaw& law : wind_power_laws) {
      const double y = balance(law, self_damping_laws[k], frequency);
      found.lowest = std::min(found.lowest, y);
      found.highest = std::max(found.highest, y);
    }
    WindHistorySetting setting = drake_in_wind(frequency);
    setting.self_damping = self_damping_laws[k];
    setting.initial_amplitude = 0.1 * setting.diameter;
    if (frequency < 14.0) setting.stations = 128;
    setting.duration = frequency < 14.0 ? 200.0 : 60.0;
    found.wakes[k] = relative(setting);
    // All that the other modes and the wakes at the nodes do is small.
    EXPECT_NEAR(found.wakes[k] / harmonic_balance(setting, frequency), 1.0, 0.08) << frequency;
  }
  return found;
}

TEST(WindHistory, OfWakesIsWithinTheBandOfTheLawsAtSmallAmplitude) {
  for (const double frequency : {20.0, 25.0}) {
    const Comparison found = compared(frequency);
    for (const double y : found.wakes) {
      EXPECT_GT(y, found.lowest) << frequency;
      EXPECT_LT(y, found.highest) << frequency;
    }
  }
}

TEST(WindHistory, OfWakesLeavesTheBandDownwardsWhereAmplitudesGrow) {
  const Comparison found = compared(15.0);
  EXPECT_NEAR(found.wakes[0] / found.lowest, 0.98, 0.03);
  EXPECT_NEAR(found.wakes[1] / found.lowest, 1.55, 0.05);
  EXPECT_NEAR(found.wakes[2] / found.lowest, 0.96, 0.03);
  EXPECT_LT(found.wakes[1], found.highest);
}

// The other physics does not say the same at large amplitude: stall bounds it at about a quarter of
// the diameter, whatever the span's own damping, where the laws of power give more.
TEST(WindHistory, OfWakesIsBelowTheBandAtTwelveHertz) {
  const Comparison found = compared(12.0);
  for (const double y : found.wakes) {
    EXPECT_LT(y, found.lowest);
    EXPECT_GT(y, 0.64 * found.lowest);
  }
}

TEST(WindHistory, OfWakesIsHalfOfTheBandAtEightHertz) {
  const Comparison found = compared(8.0);
  for (const double y : found.wakes) {
    EXPECT_LT(y, 0.56 * found.lowest);
    EXPECT_GT(y, 0.40 * found.lowest);
  }
  WindHistorySetting undamped = short_drake_in_wind(8.0, 1.0);
  undamped.self_damping.reset();
  EXPECT_NEAR(harmonic_balance(undamped, 8.0), 0.27, 0.03);
}

TEST(WindHistory, FallsOutsideTheRangeOfLockIn) {
  const auto at = [](double ratio) {
    WindHistorySetting setting = short_drake_in_wind(20.0, ratio);
    setting.self_damping = self_damping_laws[1];
    setting.initial_amplitude = 0.3 * setting.diameter;
    setting.duration = 150.0;
    return wind_history(setting);
  };
  const WindHistory locked = at(1.0);
  for (const double ratio : {0.96, 1.05}) {
    const WindHistory beside = at(ratio);
    EXPECT_GT(beside.amplitude, 0.7 * locked.amplitude) << ratio;
    EXPECT_NEAR(beside.frequency, 20.0, 0.02) << ratio;
  }
  for (const double ratio : {0.8, 0.88, 1.15, 1.3})
    EXPECT_LT(at(ratio).amplitude, 0.05 * locked.amplitude) << ratio;
}

TEST(WindHistory, IsSmallerInTurbulenceAndTheSameForTheSameSeed) {
  WindHistorySetting setting = drake_in_wind(20.0);
  setting.duration = 40.0;
  setting.initial_amplitude = 0.05 * setting.diameter;
  const double steady = relative(setting);
  setting.wind.intensity = 0.1;
  const WindHistory gusty = wind_history(setting);
  EXPECT_LT(gusty.amplitude, 0.8 * steady * setting.diameter);
  EXPECT_EQ(wind_history(setting).displacements, gusty.displacements);
  setting.wind.seed = 2;
  EXPECT_NE(wind_history(setting).displacements, gusty.displacements);
}

TEST(WindHistory, ChangesByLessThanAHundredthWithHalfTheStep) {
  WindHistorySetting setting = drake_in_wind(20.0);
  setting.duration = 40.0;
  setting.initial_amplitude = 0.05 * setting.diameter;
  const double coarse = relative(setting);
  setting.steps_per_cycle = 80;
  EXPECT_NEAR(relative(setting) / coarse, 1.0, 0.01);
  setting.steps_per_cycle = 40;
  setting.stations = 400;
  EXPECT_NEAR(relative(setting) / coarse, 1.0, 0.015);
}

// An example of use: a history as a table, and what is said of it.
TEST(WindHistory, CanBeWrittenAsATable) {
  WindHistorySetting setting = short_drake_in_wind(20.0, 1.0);
  setting.place = 0.5 * setting.string.span;
  setting.initial_amplitude = 0.02 * setting.diameter;
  setting.duration = 40.0;
  setting.stride = 5;
  const WindHistory history = wind_history(setting);
  std::ostringstream table;
  table << "time_s,displacement_m\n";
  double squares = 0.0;
  for (std::size_t k = 0; k < history.times.size(); ++k) {
    table << history.times[k] << ',' << history.displacements[k] << '\n';
    if (history.times[k] >= 30.0) squares += 4.0 * std::pow(history.displacements[k], 2);
  }
  EXPECT_EQ(table.str().substr(0, 24), "time_s,displacement_m\n0,");
  EXPECT_NEAR(static_cast<double>(history.times.size()), 40.0 * 20.0 * 40.0 / 5.0, 1.0);
  EXPECT_NEAR(history.times[1], 1.0 / 160.0, 1e-12);
  EXPECT_NEAR(history.antinode, setting.place, 0.04 * setting.string.span);
  const double rms = std::sqrt(squares / static_cast<double>(history.times.size()));
  EXPECT_NEAR(std::sqrt(2.0) * rms / history.amplitude, 1.0, 0.01);
  EXPECT_LT(history.spread, 0.05 * history.amplitude);
}

TEST(WindHistory, RefusesWhatIsNoSpanInAWind) {
  const auto refused = [](auto&& change) {
    WindHistorySetting setting = drake_in_wind(20.0);
    change(setting);
    EXPECT_THROW(wind_history(setting), InvalidParameter);
  };
  refused([](auto& s) { s.diameter = 0.0; });
  refused([](auto& s) { s.wind.mean_speed = -1.0; });
  refused([](auto& s) { s.wind.intensity = 0.4; });
  refused([](auto& s) { s.wind.span_scale = 0.0; });
  refused([](auto& s) { s.duration = 0.1; });
  refused([](auto& s) { s.modes = 0; });
  refused([](auto& s) { s.stations = s.modes; });
  refused([](auto& s) { s.steps_per_cycle = 8; });
  refused([](auto& s) { s.observed = 0.0; });
  refused([](auto& s) { s.place = s.string.span; });
  refused([](auto& s) { s.rated_strength = s.string.tension; });
  refused([](auto& s) { s.self_damping->amplitude_exponent = 1.9; });
  refused([](auto& s) { s.force = WakeOscillatorLaw{12.0, 0.0}; });
  refused([](auto& s) { s.devices = {{s.string.span, LumpedDevice{{{1.0}}, 0.0}}}; });
  // Measured power asks for a mode at the shedding.
  refused([](auto& s) { s.modes = 30, s.force = wind_power_laws[0]; });
}

TEST(ModesInStep, GoesExactly) {
  using Column = ModesInStep<>::Column;
  const Column omega = Column::Constant(1, 7.0), zeta = Column::Constant(1, 0.1);
  ModesInStep<> motion(omega, 0.3);
  motion.damp(zeta);
  for (int k = 0; k < 9; ++k) motion.step(Column::Constant(1, 4.9));
  const double decay = 0.1 * 7.0, turn = 7.0 * std::sqrt(0.99), time = 2.7;
  const double expected =
      0.1 * (1.0 - std::exp(-decay * time) *
                       (std::cos(turn * time) + decay / turn * std::sin(turn * time)));
  EXPECT_NEAR(motion.position[0], expected, 1e-14);
}

TEST(GustField, HasItsVarianceAndItsScales) {
  const TurbulentWind wind{4.0, 0.2, 40.0, 10.0, 7};
  GustField<> field(wind, 21, 1.0);
  double mean = 0.0, square = 0.0, along = 0.0, later = 0.0, before = 0.0;
  constexpr int count = 30000;
  for (int k = 0; k < count; ++k) {
    const auto& speeds = field.at(2.0 * k);
    const double u = speeds[0] - 4.0;
    mean += u / count;
    square += u * u / count;
    along += u * (speeds[10] - 4.0) / count;
    later += u * before / count;
    before = u;
  }
  EXPECT_NEAR(mean, 0.0, 0.05);
  EXPECT_NEAR(square, 0.64, 0.04);
  EXPECT_NEAR(along / square, std::exp(-1.0), 0.04);
  EXPECT_NEAR(later / square, std::exp(-0.2), 0.02);
}

TEST(Turbulence, LowersThePower) {
  EXPECT_EQ(turbulent_share(0.0), 1.0);
  EXPECT_NEAR(turbulent_share(0.09), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(turbulent_share(0.2), 0.4104, 1e-4);
  // As of a wind that gives its whole power within a tenth of its mean and none outside.
  for (double intensity = 0.005; intensity < 0.3; intensity += 0.005)
    EXPECT_NEAR(std::erf(0.1 / (std::sqrt(2.0) * intensity)), turbulent_share(intensity), 0.09);
  EXPECT_NEAR(in_turbulence(wind_power_laws[0], 0.09).at(0.1),
              wind_power_laws[0].at(0.1) / std::sqrt(2.0), 1e-12);
  EXPECT_THROW(turbulent_share(1.1), InvalidParameter);
  EXPECT_THROW(turbulent_share(std::nan("")), InvalidParameter);
}

}  // namespace
}  // namespace holdfast
