// Proved poles and residues against those of plant_poles, whose approximations
// they begin with, and against what no approximation enters: sums over residues
// and the transfer function itself.

#include "holdfast/plant/enclosed_poles.hpp"

#include "support/string_case.hpp"

namespace holdfast::test {
namespace {

using Complex = std::complex<double>;
using Long = std::complex<long double>;

ConductorWithAbsorber span(int modes, double damping, const Absorber<double>& absorber,
                           double place = 0.64, const LoopHardware& hardware = {}) {
  return string_with_absorber(modes, damping, hardware, place, absorber);
}

const Absorber<double> paper{0.16, 74.4, 4.0, 0.01};
const LoopHardware late{80.0, 60.0, 0.7};

/// G_z(s) of the plant by its receptance, in extended precision.
Long transfer(const ConductorWithAbsorber& conductor, const Long& s) {
  std::vector<PlaceMode<long double>> modes;
  for (const auto& m : conductor.modes)
    modes.push_back({m.angular_frequency, m.damping_ratio, m.shape, m.mass});
  const auto& a = conductor.absorber;
  const Absorber<long double> absorber{a.mass, a.stiffness, a.damping, a.clamp_mass};
  Long g = place_response(receptance(modes, s), absorber, s).to_drive;
  const long double turn = 2.0L * pi<long double>;
  const LoopHardware& lags = conductor.hardware;
  if (lags.measurement_filter != LoopHardware::ideal)
    g *= turn * lags.measurement_filter /
         (s + turn * static_cast<long double>(lags.measurement_filter));
  if (lags.drive_bandwidth == LoopHardware::ideal) return g;
  const long double rate = turn * lags.drive_bandwidth;
  if (lags.drive_damping == LoopHardware::ideal) return g * rate / (s + rate);
  return g * rate * rate /
         (s * (s + 2.0L * static_cast<long double>(lags.drive_damping) * rate) + rate * rate);
}

std::vector<ConductorWithAbsorber> conductors() {
  return {span(1, 0.02, paper),
          span(10, 0.02, {0.16, 74.4, 4.0, 0.0}),
          span(40, 0.02, paper),
          span(40, 1e-6, paper),
          span(40, 0.0, paper),
          span(12, 0.02, paper, 0.64, {80.0}),
          span(12, 0.02, paper, 0.64, {LoopHardware::ideal, 60.0}),
          span(12, 0.02, paper, 0.64, late),
          span(12, 0.02, paper, 0.64, {80.0, 60.0, 1.7}),
          span(30, 0.02, {0.16, 74.4, 40.0, 0.02})};
}

TEST(EnclosedPoles, SumUpToTheTransferFunction) {
  Random random(1);
  for (const ConductorWithAbsorber& conductor : conductors()) {
    const auto poles = enclosed_poles(conductor);
    ASSERT_FALSE(poles.empty());
    for (int trial = 0; trial < 30; ++trial) {
      const Complex s = std::polar(random.log_uniform(0.1, 3000.0), random.uniform(0.0, 1.5));
      ComplexEnclosure sum;
      double size = 0.0;
      for (const EnclosedPole& pole : poles) {
        const ComplexEnclosure part = pole.residue / (ComplexEnclosure(s, 0.0) - pole.s);
        sum += part;
        if (pole.is_pair) sum += conj(pole.residue) / (ComplexEnclosure(s, 0.0) - conj(pole.s));
        size += part.magnitude();
      }
      const long double away = std::abs(transfer(conductor, Long(s)) - Long(sum.middle()));
      EXPECT_LE(away, static_cast<long double>(sum.radius()) + 1e-17L * size) << s;
      EXPECT_LT(sum.radius(), 1e-8 * size) << s;
    }
  }
}

TEST(EnclosedPoles, HoldTheApproximationsAndAreNarrow) {
  for (const ConductorWithAbsorber& conductor : conductors()) {
    const auto approximate = with_hardware(conductor.poles, conductor.hardware);
    std::size_t count = 0;
    for (const EnclosedPole& pole : enclosed_poles(conductor)) {
      count += pole.is_pair ? 2 : 1;
      double nearest = 1e300, residue = 1e300;
      for (const PlantPole& other : approximate)
        if (std::abs(other.s - pole.s.middle()) < nearest) {
          nearest = std::abs(other.s - pole.s.middle());
          residue = std::abs(other.residue - pole.residue.middle());
        }
      EXPECT_LE(nearest, pole.s.radius() + 1e-9 * pole.s.magnitude());
      EXPECT_LT(pole.s.radius(), 1e-9 * pole.s.magnitude());
      EXPECT_LT(residue, pole.residue.radius() + 1e-7 * pole.residue.magnitude());
      EXPECT_EQ(pole.is_pair, pole.s.imaginary().is_positive());
    }
    EXPECT_EQ(count, approximate.size());
  }
}

/// The discs hold the roots however the approximations are wrong, or are said
/// not to.
TEST(EnclosedPoles, HoldRootsOfWrongApproximations) {
  Random random(2);
  const ConductorWithAbsorber right = span(6, 0.02, paper);
  const auto sharp = enclosed_poles(right);
  int held = 0, touched = 0;
  for (int trial = 0; trial < 300; ++trial) {
    ConductorWithAbsorber wrong = right;
    const double error = random.log_uniform(1e-12, 0.3);
    for (PlantPole& pole : wrong.poles)
      if (pole.s.imag() == 0.0) pole.s *= 1.0 + error * random.uniform(-1.0, 1.0);
    for (PlantPole& pole : wrong.poles) {
      if (pole.s.imag() <= 0.0) continue;
      const Complex before = pole.s;
      pole.s *= Complex(1.0) + std::polar(error, random.uniform(0.0, 6.28));
      for (PlantPole& partner : wrong.poles)
        if (partner.s == std::conj(before)) partner.s = std::conj(pole.s);
    }
    const auto poles = enclosed_poles(wrong);
    if (poles.empty()) {
      ++touched;
      continue;
    }
    ++held;
    for (std::size_t k = 0; k < poles.size(); ++k) {
      int inside = 0;
      for (const EnclosedPole& root : sharp) {
        if (std::abs(root.s.middle() - poles[k].s.middle()) > poles[k].s.radius() + root.s.radius())
          continue;
        ++inside;
        EXPECT_LE(std::abs(root.residue.middle() - poles[k].residue.middle()),
                  poles[k].residue.radius() + root.residue.radius())
            << error;
      }
      EXPECT_EQ(inside, 1) << error;
    }
  }
  EXPECT_GT(held, 100);
  EXPECT_GT(touched, 20);
}

/// A mode with a node at the place is seen by nobody, and its pole is that of
/// the bare mode.
TEST(EnclosedPoles, KeepAModeThatTheAbsorberDoesNotTouch) {
  ConductorWithAbsorber conductor = span(8, 0.01, paper);
  conductor.modes[3].shape = 0.0;
  conductor.modes[5].shape = 1e-12;
  conductor.poles = plant_poles(conductor.modes, conductor.absorber);
  const auto poles = enclosed_poles(conductor);
  ASSERT_EQ(poles.size(),
            10U);  // eight pairs, and two of the absorber, which creeps back
  int unseen = 0;
  for (const EnclosedPole& pole : poles) {
    const auto& mode = conductor.modes[3];
    const Complex bare =
        mode.angular_frequency * Complex(-mode.damping_ratio, std::sqrt(1.0 - 1e-4));
    if (std::abs(pole.s.middle() - bare) > 1e-6) continue;
    ++unseen;
    EXPECT_LE(std::abs(pole.s.middle() - bare), pole.s.radius() + 1e-13 * std::abs(bare));
    EXPECT_LE(std::abs(pole.residue.middle()), pole.residue.radius());
    EXPECT_LT(pole.residue.radius(), 1e-12);
  }
  EXPECT_EQ(unseen, 1);
}

TEST(EnclosedPoles, SayNothingOfWhatIsNotApart) {
  ConductorWithAbsorber conductor = span(8, 0.01, paper);
  conductor.poles.erase(conductor.poles.begin());
  EXPECT_TRUE(enclosed_poles(conductor).empty());
  conductor.poles.clear();
  EXPECT_TRUE(enclosed_poles(conductor).empty());
  // Twice the same lag.
  EXPECT_TRUE(enclosed_poles(span(8, 0.01, paper, 0.64, {60.0, 60.0})).empty());
}

TEST(EnclosedPoles, DiscsAreApartBeyondBothRadii) {
  const std::vector<ComplexEnclosure> centres{0.0, ComplexEnclosure({0.0, 3.0}, 0.0), 9.0};
  EXPECT_TRUE(detail::are_apart(centres, {1.0, 1.9, 0.5}));
  EXPECT_FALSE(detail::are_apart(centres, {1.0, 2.0, 0.5}));
  EXPECT_FALSE(detail::are_apart(centres, {2.5, 1.0, 0.5}));
  EXPECT_FALSE(detail::are_apart(centres, {1.0, 1.0, 8.5}));
  EXPECT_FALSE(detail::are_apart(centres, {1.0, 1.0, std::nan("")}));
}

/// Of two masses the discs are those of one mode, but for the decimals.
TEST(EnclosedPoles, OfTwoMassesAreOfTheirDecimals) {
  const TwoMass<double> masses = kollar2022_plant();
  for (const LoopHardware& hardware : {LoopHardware{}, late}) {
    const double omega = std::sqrt(masses.conductor_stiffness / masses.conductor_mass);
    ConductorWithAbsorber conductor{
        {{omega, masses.conductor_damping / (2.0 * omega * masses.conductor_mass), 1.0,
          masses.conductor_mass}},
        {masses.absorber_mass, masses.absorber_stiffness, masses.absorber_damping},
        {},
        hardware};
    conductor.poles = plant_poles(conductor.modes, conductor.absorber);
    const auto decimals = enclosed_poles(masses, hardware), doubles = enclosed_poles(conductor);
    ASSERT_FALSE(decimals.empty());
    ASSERT_EQ(decimals.size(), doubles.size());
    for (std::size_t k = 0; k < decimals.size(); ++k) {
      EXPECT_LE(std::abs(decimals[k].s.middle() - doubles[k].s.middle()),
                decimals[k].s.radius() + doubles[k].s.radius());
      EXPECT_LE(std::abs(decimals[k].residue.middle() - doubles[k].residue.middle()),
                decimals[k].residue.radius() + doubles[k].residue.radius());
      EXPECT_LT(decimals[k].s.radius(), 1e-12 * decimals[k].s.magnitude());
    }
  }
  EXPECT_THROW(enclosed_poles(TwoMass<double>{}), InvalidParameter);
}

TEST(EnclosedPoles, RefuseWhatIsNotAdmissible) {
  ConductorWithAbsorber conductor = span(2, 0.01, paper);
  conductor.absorber.mass = 0.0;
  EXPECT_THROW(enclosed_poles(conductor), InvalidParameter);
  conductor = span(2, 0.01, paper, 0.64, late);
  conductor.hardware.drive_damping = -1.0;
  EXPECT_THROW(enclosed_poles(conductor), InvalidParameter);
}

TEST(EnclosedPoles, AConductorWithDevicesHasNoPlantOfItsBareModes) {
  ConductorWithAbsorber conductor = span(8, 0.01, paper);
  EXPECT_EQ(linear_plant(conductor).force_input.size(), 18);
  conductor.has_devices = true;
  EXPECT_THROW(linear_plant(conductor), InvalidParameter);
}

}  // namespace
}  // namespace holdfast::test
