// Every entry of the library that takes a plant, a state, a vector or a matrix refuses one of
// another size than the rest, before it reads beyond it.

#include <functional>
#include <string>
#include <vector>

#include "holdfast/holdfast.hpp"
#include "support/lagging_plant.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

using Plant = LinearPlant<double>;
using Column = Eigen::VectorXd;

const Sampling<double> sampling{0.01};
const PdGains<double> gains{-557.0, -13.0};
const HarmonicExcitation<double> excitation{0.5, 10.0};
const LoopHardware hardware{80.0, 60.0, 0.7};
const Rational ratio{1, 10};

/// An entry that is to refuse what it is called with.
template <class Argument>
struct Entry {
  std::string name;
  std::function<void(const Argument&)> call;
};

template <class Argument>
void expect_refused(const Entry<Argument>& entry, const Argument& argument,
                    const std::string& what) {
  EXPECT_THROW(entry.call(argument), InvalidParameter) << entry.name << ": " << what;
}

void expect_sizes_refused(const std::vector<Entry<Column>>& entries,
                          const std::vector<Eigen::Index>& sizes) {
  for (const Entry<Column>& entry : entries)
    for (const Eigen::Index size : sizes)
      expect_refused<Column>(entry, Column::Zero(size), "size " + std::to_string(size));
}

/// A plant one of whose parts has lost or won an entry.
struct BrokenPlant {
  std::string part;
  Plant plant;
};

std::vector<BrokenPlant> broken_plants() {
  std::vector<BrokenPlant> broken;
  const auto breaks = [&](const std::string& part, auto& entries, const Plant& plant) {
    const auto whole = entries;
    for (const Eigen::Index by : {-1, 1}) {
      const bool column = whole.cols() == 1;
      entries.setZero(whole.rows() + (column ? by : 0), whole.cols() + (column ? 0 : by));
      broken.push_back({part, plant});
    }
    entries = whole;
  };
  Plant plant = test::lagging_plant();
  breaks("A", plant.released_matrix, plant);
  breaks("b", plant.force_input, plant);
  breaks("b_u", plant.command_input, plant);
  breaks("c", plant.excitation, plant);
  breaks("f", plant.drive_force, plant);
  auto& ports = plant.connections;
  breaks("z", ports.displacement, plant);
  breaks("v", ports.velocity, plant);
  breaks("h_z", ports.measured_displacement, plant);
  breaks("h_v", ports.measured_velocity, plant);
  breaks("dz", ports.relative_displacement, plant);
  breaks("dv", ports.relative_velocity, plant);
  breaks("e_z", ports.displacement_lift, plant);
  breaks("e_v", ports.velocity_lift, plant);
  return broken;
}

IdealLoop<double, Plant> ideal(const Plant& plant) {
  return {plant, sampling, gains, excitation, 0.0005};
}

ImplementedLoopOf<Plant> implemented(const Plant& plant) { return implemented_loop(ideal(plant)); }

DriveContact<Plant> contact_of(const Plant& plant, const Column& state) {
  return {plant, {}, Switching::exact, state};
}

TEST(Sizes, OfAPlantsPartsAreCheckedByEveryEntry) {
  const Column rest = Column::Zero(test::lagging_plant().order());
  const std::vector<Entry<Plant>> entries{
      {"validate", [](const Plant& p) { validate(p); }},
      {"state_matrix", [](const Plant& p) { p.state_matrix(); }},
      {"control_input", [](const Plant& p) { p.control_input(); }},
      {"excitation_input", [](const Plant& p) { p.excitation_input(); }},
      {"ports", [](const Plant& p) { p.ports(); }},
      {"ports_of", [](const Plant& p) { ports_of(p); }},
      {"PortReadings", [](const Plant& p) { PortReadings<Plant>{p}; }},
      {"with_measurement_filter", [](const Plant& p) { with_measurement_filter(p, 80.0); }},
      {"with_drive_lag", [](const Plant& p) { with_drive_lag(p, 60.0); }},
      {"with_drive_lag of second order", [](const Plant& p) { with_drive_lag(p, 60.0, 0.7); }},
      {"with_hardware", [](const Plant& p) { with_hardware(p, hardware); }},
      {"with_controller", [](const Plant& p) { with_controller(p, gains); }},
      {"natural_modes", [](const Plant& p) { natural_modes(p); }},
      {"engaged_dynamics", [](const Plant& p) { engaged_dynamics(p); }},
      {"locked_dynamics", [](const Plant& p) { locked_dynamics(p); }},
      {"dynamics_on_stop", [](const Plant& p) { dynamics_on_stop(p, 1e4, 1.0, 0.001); }},
      {"sampled_loop", [](const Plant& p) { sampled_loop(p, sampling); }},
      {"loop_map", [](const Plant& p) { loop_map(p, sampling); }},
      {"exact_harmonic", [](const Plant& p) { exact_harmonic(p, 0.01, 60.0); }},
      {"ModalResponse", [](const Plant& p) { return ModalResponse<double>(p, sampling); }},
      {"steady_response",
       [](const Plant& p) { steady_response(p, sampling, ForceHold::sampled, 60.0); }},
      {"true_amplitude_per_force", [](const Plant& p) { true_amplitude_per_force(p, 60.0); }},
      {"stability_margins", [](const Plant& p) { stability_margins(p, sampling, gains); }},
      {"max_sampling_period", [](const Plant& p) { max_sampling_period(p, {}); }},
      {"DriveContact", [&](const Plant& p) { contact_of(p, rest); }},
      {"event_motion", [&](const Plant& p) { event_motion(implemented(p), rest); }},
      {"event_metrics", [&](const Plant& p) { event_metrics(implemented(p), rest, 1.0); }},
      {"classify_motion", [&](const Plant& p) { classify_motion(implemented(p), rest); }},
      {"harmonically_forced_motion",
       [&](const Plant& p) { harmonically_forced_motion(ideal(p), rest); }},
      {"periodically_forced_motion",
       [&](const Plant& p) { periodically_forced_motion(ideal(p), ratio, rest); }},
  };
  for (const Entry<Plant>& entry : entries)
    for (const BrokenPlant& one : broken_plants()) expect_refused(entry, one.plant, one.part);
}

TEST(Sizes, OfAStateAreCheckedByEveryEntry) {
  const Plant plant = test::lagging_plant();
  const Column rest = Column::Zero(plant.order());
  const auto loop = implemented(plant);
  const DriveContact<Plant> contact = contact_of(plant, rest);
  const auto sampled = sampled_loop(plant, sampling);
  const auto input = exact_harmonic(plant, 0.01, excitation.angular_frequency());
  using Motion = HarmonicallyForcedMotion<double, Plant>;
  const Backlash<double> law(0.0);
  const PortReadings<Plant> readings(plant);
  const std::vector<Entry<Column>> entries{
      {"DriveContact", [&](const Column& x) { contact_of(plant, x); }},
      {"EventMotion",
       [&](const Column& x) { EventMotion<DriveContact<Plant>>(loop.digital, contact, x); }},
      {"event_motion", [&](const Column& x) { event_motion(loop, x); }},
      {"EventMotion::restore",
       [&](const Column& x) { event_motion(loop, rest).restore(0, x, 0.0, contact); }},
      {"event_metrics", [&](const Column& x) { event_metrics(loop, x, 1.0); }},
      {"classify_motion", [&](const Column& x) { classify_motion(loop, x); }},
      {"harmonically_forced_motion",
       [&](const Column& x) { harmonically_forced_motion(ideal(plant), x); }},
      {"periodically_forced_motion",
       [&](const Column& x) { periodically_forced_motion(ideal(plant), ratio, x); }},
      {"SampledMotion",
       [&](const Column& x) { Motion(sampled, gains, input, excitation, law, x, readings); }},
      {"SampledMotion::restore",
       [&](const Column& x) {
         auto motion = harmonically_forced_motion(ideal(plant), rest);
         auto memory = motion.memory();
         memory.state = x;
         motion.restore(memory);
       }},
  };
  expect_sizes_refused(entries, {rest.size() - 1, rest.size() + 1});
}

TEST(Sizes, OfAStateOfTheTwoMassesAreCheckedWhereTheyAreKnownAtRunTime) {
  const IdealLoop<double> loop{kollar2022_plant(), sampling, gains, excitation, 0.0005};
  const ImplementedLoop built = implemented_loop(loop);
  const std::vector<Entry<Column>> entries{
      {"event_motion", [&](const Column& x) { event_motion(built, x); }},
      {"classify_motion as built", [&](const Column& x) { classify_motion(built, x); }},
      {"classify_motion", [&](const Column& x) { classify_motion(loop, x); }},
      {"find_periodic_orbit", [&](const Column& x) { find_periodic_orbit(loop, x); }},
      {"harmonically_forced_motion", [&](const Column& x) { harmonically_forced_motion(loop, x); }},
      {"periodically_forced_motion",
       [&](const Column& x) { periodically_forced_motion(loop, ratio, x); }},
  };
  expect_sizes_refused(entries, {0, 3, 5});
  EXPECT_EQ(event_motion(built, Column::Unit(4, 2)).state(), (Vector<double, 4>::Unit(2)));
}

TEST(Sizes, OfASpansStateAreChecked) {
  const ModalLoop loop{
      {{1.0, 1.0, 30.0, 0.01}}, {0.16, 74.4, 4.0, 0.0}, sampling, gains, excitation, 0.0005};
  const std::vector<Entry<Column>> entries{
      {"modal_motion", [&](const Column& x) { modal_motion(loop, x); }},
      {"find_periodic_orbit", [&](const Column& x) { find_periodic_orbit(loop, x); }},
      {"classify_motion", [&](const Column& x) { classify_motion(loop, x); }},
  };
  expect_sizes_refused(entries, {0, 3, 6});
}

TEST(Sizes, OfMatricesAreChecked) {
  using Square = Eigen::MatrixXd;
  const std::vector<Entry<Square>> entries{
      {"balancing", [](const Square& m) { balancing(m); }},
      {"exponential", [](const Square& m) { exponential(m); }},
      {"eigenvalues", [](const Square& m) { eigenvalues(m); }},
      {"spectral_radius", [](const Square& m) { spectral_radius(m); }},
      {"spectral_abscissa", [](const Square& m) { spectral_abscissa(m); }},
      {"EigenBasis", [](const Square& m) { EigenBasis<double>{m}; }},
      {"EigenBasis::coordinates",
       [](const Square& m) {
         EigenBasis<double>(Square::Identity(2, 2)).coordinates(Column::Zero(m.rows() + m.cols()));
       }},
      {"EigenBasis::readings",
       [](const Square& m) {
         EigenBasis<double>(Square::Identity(2, 2))
             .readings(Eigen::RowVectorXd::Zero(m.rows() + m.cols()));
       }},
      {"discrete_lyapunov", [](const Square& m) { discrete_lyapunov(Square(m.topRows(1))); }},
      {"eigenvalue_derivative",
       [](const Square& m) { eigenvalue_derivative<double>(Square::Identity(4, 4), m, 1.0); }},
      {"multipliers_of_product",
       [](const Square& m) {
         multipliers_of_product(std::vector<Square>{Square::Identity(4, 4), m});
       }},
      {"multipliers_of_product of nothing",
       [](const Square&) { multipliers_of_product(std::vector<Square>{}); }},
      {"zero_order_hold", [](const Square& m) { zero_order_hold(Square(m.topRows(1)), m, 0.01); }},
      {"exact_harmonic",
       [](const Square& m) {
         exact_harmonic<double, Eigen::Dynamic>(Square::Zero(2, 2), Column::Zero(m.cols()), 0.01,
                                                60.0);
       }},
      {"MovingSpectrum",
       [](const Square& m) {
         MovingSpectrum<double>{{{Square::Zero(2, 2), m}, Square::Zero(2, 2)}};
       }},
      {"MovingSpectrum of one term",
       [](const Square&) {
         MovingSpectrum<double>{{{Square::Zero(2, 2)}, Square::Zero(2, 2)}};
       }},
      {"SteadyResponse",
       [](const Square& m) {
         const auto map = loop_map(kollar2022_plant(), sampling);
         const Column input = Column::Zero(m.cols());
         SteadyResponse<double>(map, HarmonicInput<double, Eigen::Dynamic>{input, input}, 60.0);
       }},
  };
  for (const Entry<Square>& entry : entries)
    for (const Eigen::Index columns : {3, 6})
      expect_refused<Square>(entry, Square::Zero(2, columns), std::to_string(columns) + " columns");
  for (const auto& of : {entries[0], entries[1], entries[2], entries[3], entries[4], entries[5]})
    expect_refused<Square>(of, Square(), "empty");
}

TEST(Sizes, OfGridsAndRecordsAreChecked) {
  const auto cells = [](std::int64_t p, std::int64_t d) {
    return GainGrid{{-600.0, 0.0, p}, {-20.0, 0.0, d}};
  };
  EXPECT_EQ(cells(30'000'000, 30'000'000).cells(), 900'000'000'000'000);
  for (const std::int64_t count : {std::int64_t{100'000'000}, std::int64_t{10'000'000'000}}) {
    EXPECT_THROW(cells(count, count).cells(), InvalidParameter);
    EXPECT_THROW(validate(cells(count, count)), InvalidParameter);
  }
  EXPECT_THROW(RecordedForce({0, 1, 2}, {0, 1}, RecordInterpolation::linear), InvalidParameter);
  EXPECT_THROW(decay_events({{0, 1, 2}, {0, 1}}), InvalidParameter);
}

TEST(Sizes, OfAReversedAxisAreToldInWords) {
  const GainGrid reversed{{100.0, -5.0, 3}, {-20.0, 0.0, 3}};
  try {
    validate(reversed);
    ADD_FAILURE() << "a reversed axis was taken";
  } catch (const InvalidParameter& error) {
    EXPECT_EQ(error.admissible(), "finite and >= 100");
  }
}

}  // namespace
}  // namespace holdfast
