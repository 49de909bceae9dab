// Every entry of the library whose comment names InvalidParameter refuses what is not admissible,
// and names it.

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "holdfast/holdfast.hpp"
#include "support/lagging_plant.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

const std::vector<double> not_finite{nan, infinity, -infinity};
const std::vector<double> negative_too{nan, infinity, -infinity, -1.0};
const std::vector<double> not_positive{nan, infinity, -infinity, -1.0, 0.0};
const std::vector<double> no_instant{nan, infinity, -1.0}, no_later_one{nan, infinity, -1.0, 0.0};
const std::vector<double> no_count{0.0, -1.0}, no_share{nan, infinity, -1.0, 1.0}, zero{0.0};

/// An entry with one argument that is not admissible.
struct Entry {
  std::string entry;
  std::string named;  ///< part of the name of what is refused
  std::vector<double> refused;
  std::function<void(double)> call;
};

void expect_refused(const std::vector<Entry>& entries) {
  for (const Entry& one : entries)
    for (const double value : one.refused) {
      try {
        one.call(value);
        ADD_FAILURE() << one.entry << " took " << one.named << " = " << value;
      } catch (const InvalidParameter& error) {
        EXPECT_NE(error.name().find(one.named), std::string::npos)
            << one.entry << " of " << value << " says: " << error.what();
      }
    }
}

const TwoMass<double> masses = kollar2022_plant();
const Sampling<double> sampling{0.01};
const PdGains<double> gains{-557.0, -13.0};
const GainGrid grid{{-600.0, 0.0, 3}, {-20.0, 0.0, 3}};
const GainWindow window{{-600.0, 0.0}, {-20.0, 0.0}};
const std::vector<double> times{0.0, 1.0};

Sampling<double> delayed(double delay) { return {0.01, delay}; }

/// The grid from another least P on, and with another number of D.
GainGrid grid_of(double from, double count) {
  return {{from, 0.0, 3}, {-20.0, 0.0, static_cast<std::int64_t>(count)}};
}

TwoMass<double> of_mass(double mass) {
  TwoMass<double> plant = masses;
  plant.absorber_mass = mass;
  return plant;
}

AffinePolynomial<double, 5> with_coefficient(double value) {
  auto polynomial = characteristic_polynomial(sampled_loop(masses, sampling));
  polynomial.base[2] = value;
  return polynomial;
}

const SampledLoop<double> loop = sampled_loop(masses, sampling);

TEST(Entries, OfPlantRefuseByName) {
  expect_refused({
      {"free_decay", "mass", not_positive, [](double x) { free_decay(of_mass(x), 1.0, times); }},
      {"free_decay", "time", no_instant,
       [](double x) {
         free_decay(masses, 1.0, {0, x});
       }},
      {"free_decay_at", "mass", not_positive,
       [](double x) { free_decay_at(of_mass(x), 1.0, 1.0); }},
      {"free_decay_events", "mass", not_positive, [](double x) { free_decay_events(of_mass(x)); }},
      {"natural_modes", "mass", not_positive, [](double x) { natural_modes(of_mass(x)); }},
      {"linear_plant", "mass", not_positive, [](double x) { linear_plant(of_mass(x)); }},
      {"with_drive_lag", "bandwidth", not_positive,
       [](double x) { with_drive_lag(linear_plant(masses), x); }},
      {"with_measurement_filter", "filter", not_positive,
       [](double x) { with_measurement_filter(linear_plant(masses), x); }},
      {"EnergyNorm", "mass", not_positive, [](double x) { EnergyNorm{of_mass(x)}; }},
      {"validate(LinearPlant)", "entries", not_finite,
       [](double x) {
         auto plant = linear_plant(masses);
         plant.connections.velocity_lift[2] = x;
         validate(plant);
       }},
      {"validate(LinearPlant)",
       "order",
       {0.0, 1.0, 3.0, 5.0},
       [](double x) {
         LinearPlant<double> plant = test::through_ports(masses);
         plant.connections.measured_velocity.resize(static_cast<Eigen::Index>(x));
         plant.connections.measured_velocity.setZero();
         validate(plant);
       }},
      {"validate(LinearPlant)", "direct transmission", zero,
       [](double x) {
         auto plant = linear_plant(masses);
         plant.direct_transmission = x;
         validate(plant);
       }},
  });
}

TEST(Entries, OfForcingRefuseByName) {
  expect_refused({{"PeriodicForcing", "denominator", no_count, [](double x) {
                     const IdealLoop<double> ideal{masses, sampling, gains, {0.5, 10.0}, 0.0005};
                     periodically_forced_motion(ideal, Rational{1, static_cast<std::int64_t>(x)},
                                                Vector<double, 4>(Vector<double, 4>::Zero()));
                   }}});
}

TEST(Entries, OfAnAxisRefuseByName) {
  const auto chart = [](double from, double to, double count) {
    const Axis axis{from, to, static_cast<std::int64_t>(count)};
    validate(LoopChart{{masses, sampling, gains},
                       {LoopParameter::sampling_period, axis},
                       {LoopParameter::differential_gain, {-20.0, 0.0, 3}}});
  };
  expect_refused({
      {"LoopChart",
       "axis",
       {nan, infinity, -infinity, 0.001},
       [&](double x) { chart(0.002, x, 3); }},
      {"LoopChart", "axis", not_finite, [&](double x) { chart(x, 0.002, 3); }},
      {"LoopChart", "axis", no_count, [&](double x) { chart(0.001, 0.002, x); }},
  });
}

TEST(Entries, OfSignalRefuseByName) {
  expect_refused({
      {"amplitude_spectrum", "sampling period", not_positive,
       [](double x) { amplitude_spectrum(times, x, SpectralWindow::hann); }},
      {"samples_per_common_period", "sampling period", not_positive,
       [](double x) { samples_per_common_period(10.0, x); }},
      {"samples_per_common_period", "frequency", negative_too,
       [](double x) { samples_per_common_period(x, 0.01); }},
      {"whole_period_samples", "frequency", negative_too,
       [](double x) { whole_period_samples(100, x, 0.01); }},
      {"decay_events", "displacement", not_finite,
       [](double x) {
         decay_events({{0, 1, 2, 3}, {1, x, 0.5, -0.5}});
       }},
      {"decay_events", "time", no_later_one,
       [](double x) {
         decay_events({{0, x, 2, 3}, {1, -1, 0.5, -0.5}});
       }},
  });
}

TEST(Entries, OfControlRefuseByName) {
  expect_refused({
      {"sampled_loop", "mass", not_positive, [](double x) { sampled_loop(of_mass(x), sampling); }},
      {"sampled_loop", "sampling period", negative_too,
       [](double x) { sampled_loop(masses, Sampling<double>{x}); }},
      {"sampled_loop", "delay", no_share, [](double x) { sampled_loop(masses, delayed(x)); }},
      {"loop_map", "mass", not_positive, [](double x) { loop_map(of_mass(x), sampling); }},
      {"loop_map", "plant", not_finite,
       [](double x) {
         auto plant = linear_plant(masses);
         plant.force_input[1] = x;
         loop_map(plant, sampling);
       }},
      {"loop_map", "delay", negative_too, [](double x) { loop_map(masses, delayed(x)); }},
      {"held_commands", "sampling period", not_positive,
       [](double x) { held_commands(Sampling<double>{x}); }},
      {"held_commands", "delay", negative_too, [](double x) { held_commands(delayed(x)); }},
      {"tuned_proportional_gain", "mass", not_positive,
       [](double x) { tuned_proportional_gain(74.4, x, 10.0); }},
      {"tuned_proportional_gain", "frequency", not_positive,
       [](double x) { tuned_proportional_gain(74.4, 0.16, x); }},
      {"exact_harmonic", "angular frequency", not_finite,
       [](double x) { exact_harmonic(masses, 0.01, x); }},
      {"exact_harmonic", "sampling period", negative_too,
       [](double x) { exact_harmonic(masses, x, 60.0); }},
      {"Controller", "gain", not_finite,
       [](double x) {
         Controller({x, 0.0}, {});
       }},
      {"SamplingClock", "sampling period", not_positive, [](double x) { SamplingClock{x}; }},
  });
}

TEST(Entries, OfStabilityRefuseByName) {
  const auto polynomial = [] { return characteristic_polynomial(loop); };
  expect_refused({
      {"characteristic_polynomial", "mass", not_positive,
       [](double x) { characteristic_polynomial(of_mass(x)); }},
      {"stability_chart", "polynomial", not_finite,
       [](double x) { stability_chart(with_coefficient(x), grid); }},
      {"stability_chart", "gain", not_finite,
       [&](double x) { stability_chart(polynomial(), grid_of(x, 3)); }},
      {"stability_chart", "number of", no_count,
       [&](double x) { stability_chart(polynomial(), grid_of(-600, x)); }},
      {"stability_chart", "number of", no_count,
       [&](double x) {
         stability_chart(UnitCircleCrossings<double>({linear_plant(masses), sampling}),
                         grid_of(-600, x));
       }},
      {"stable_differential_gains", "gain", not_finite,
       [&](double x) { stable_differential_gains(polynomial(), x); }},
      {"stable_differential_gains", "polynomial", not_finite,
       [](double x) { stable_differential_gains(with_coefficient(x), -557.0); }},
      {"stable_proportional_gains", "gain", not_finite,
       [&](double x) { stable_proportional_gains(polynomial(), x); }},
      {"stable_gains", "gain", not_finite,
       [](double x) {
         stable_gains(loop_map(masses, sampling), FreeGain::differential, {x, 0.0});
       }},
      {"differential_gains_within_radius", "radius", not_positive,
       [](double x) { differential_gains_within_radius(loop, -557.0, x); }},
      {"differential_gains_within_radius", "gain", not_finite,
       [](double x) { differential_gains_within_radius(loop, x, 0.9); }},
      {"stability_boundary", "polynomial", not_finite,
       [](double x) { stability_boundary(with_coefficient(x), window.proportional); }},
      {"gain_regions", "polynomial", not_finite,
       [](double x) { gain_regions(with_coefficient(x), window); }},
      {"boundary_features", "polynomial", not_finite,
       [](double x) { boundary_features(with_coefficient(x), window); }},
      {"SteadyResponse", "angular frequency", not_positive,
       [](double x) { SteadyResponse<double>(loop, held_harmonic(loop), x); }},
      {"minimum_radius", "gain", not_finite, [](double x) { minimum_radius(loop, x); }},
      {"max_sampling_period", "mass", not_positive,
       [](double x) { max_sampling_period(of_mass(x), {}); }},
      {"stability_margins", "mass", not_positive,
       [](double x) { stability_margins(of_mass(x), sampling, gains); }},
  });
}

TEST(Entries, OfMotionAndOrbitRefuseByName) {
  const IdealLoop<double> ideal{masses, {0.01}, {-557.0, -13.0}, {0.5, 10.0}, 0.002};
  const Vector<double, 4> rest = Vector<double, 4>::Zero();
  const auto from = [](double x) { return Vector<double, 4>(x, 0, 0, 0); };
  const auto heavy = [=](double x) {
    IdealLoop<double> other = ideal;
    other.plant = of_mass(x);
    return other;
  };
  expect_refused({
      {"harmonically_forced_motion", "mass", not_positive,
       [=](double x) { harmonically_forced_motion<double>(heavy(x), rest); }},
      {"harmonically_forced_motion", "state", not_finite,
       [=](double x) { harmonically_forced_motion<double>(ideal, from(x)); }},
      {"event_motion", "mass", not_positive,
       [=](double x) { event_motion(implemented_loop(heavy(x)), rest); }},
      {"event_motion", "state", not_finite,
       [=](double x) { event_motion(implemented_loop(ideal), from(x)); }},
      {"Recorder", "samples", {-1.0}, [](double x) { Recorder{static_cast<std::int64_t>(x)}; }},
      {"samples_within", "duration", negative_too, [](double x) { samples_within(x, 0.01); }},
      {"find_periodic_orbit", "state", not_finite,
       [=](double x) { find_periodic_orbit(ideal, from(x)); }},
      {"find_periodic_orbit", "mass", not_positive,
       [=](double x) { find_periodic_orbit(heavy(x), rest); }},
      {"classify_motion", "mass", not_positive, [=](double x) { classify_motion(heavy(x), rest); }},
      {"motion_metrics", "state", not_finite,
       [=](double x) {
         const SweepMotion one{ideal, from(x)};
         MotionMetrics metrics;
         motion_metrics<double>(&one, 1, 1.0, &metrics);
       }},
  });
}

TEST(Entries, OfCableAndExcitationRefuseByName) {
  expect_refused({
      {"validate(HarmonicExcitation)", "amplitude", negative_too,
       [](double x) {
         validate(HarmonicExcitation<double>{x, 10.0});
       }},
      {"validate(HarmonicExcitation)", "frequency", not_positive,
       [](double x) {
         validate(HarmonicExcitation<double>{0.5, x});
       }},
      {"conductor_damping", "mass", not_positive,
       [](double x) { conductor_damping(x, 50.0, 0.02); }},
      {"reduce_to_frequencies", "stiffness", not_positive,
       [](double x) {
         reduce_to_frequencies(FrequencyReduction<double>{x, 0.16, 2.0, 7.0});
       }},
      {"rayleigh_damping", "frequency", not_positive,
       [](double x) { rayleigh_damping(0.02, x, 7.0); }},
  });
}

}  // namespace
}  // namespace holdfast
