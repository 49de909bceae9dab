#include <algorithm>
#include <cmath>
#include <complex>
#include <random>
#include <vector>

#include "holdfast/math/linalg/eigenvalues.hpp"
#include "holdfast/span/span_poles.hpp"
#include "holdfast/span/span_roots.hpp"

#include "span/drake_span.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

using Complex = std::complex<double>;

TautString<double> damped_drake(double span) {
  TautString<double> string = drake_string();
  string.span = span;
  string.damping_ratio = 2e-4;
  return string;
}

LumpedDevice damper() { return stockbridge({4.0, {9.0, 24.0}, {0.15, 0.2}, 0.55, 0.4}); }

const Absorber<double> absorber{5.0, 78956.8, 125.0, 0.05};

/// The whole as matrices: modes, then the masses of the branches, M q̈ + C q̇ + K q = 0.
std::vector<Complex> dense_roots(const std::vector<ModeAtPlaces>& modes,
                                 const std::vector<std::pair<LumpedDevice, std::size_t>>& devices) {
  using Matrix = Eigen::MatrixXd;
  const auto n = static_cast<Eigen::Index>(modes.size());
  Eigen::Index size = n;
  for (const auto& [device, place] : devices)
    for (const DeviceBranch& branch : device.branches) size += std::isfinite(branch.mass) ? 1 : 0;
  Matrix mass = Matrix::Zero(size, size), damping = mass, stiffness = mass;
  for (Eigen::Index k = 0; k < n; ++k) {
    const ModeAtPlaces& mode = modes[static_cast<std::size_t>(k)];
    const double omega = mode.angular_frequency;
    mass(k, k) = mode.mass;
    damping(k, k) = 2.0 * mode.damping_ratio * omega * mode.mass;
    stiffness(k, k) = omega * omega * mode.mass;
  }
  Eigen::Index hung = n;
  for (const auto& [device, place] : devices) {
    Eigen::VectorXd clamp = Eigen::VectorXd::Zero(size);
    for (Eigen::Index k = 0; k < n; ++k)
      clamp[k] = modes[static_cast<std::size_t>(k)].shapes[place];
    mass += device.clamp_mass * clamp * clamp.transpose();
    for (const DeviceBranch& branch : device.branches) {
      Eigen::VectorXd across = clamp;
      if (std::isfinite(branch.mass)) {
        across[hung] = -1.0;
        mass(hung, hung) += branch.mass;
        ++hung;
      }
      mass += branch.inertance * across * across.transpose();
      damping += branch.damping * across * across.transpose();
      stiffness += branch.stiffness * across * across.transpose();
    }
  }
  Matrix state = Matrix::Zero(2 * size, 2 * size);
  state.topRightCorner(size, size).setIdentity();
  state.bottomLeftCorner(size, size) = -mass.ldlt().solve(stiffness);
  state.bottomRightCorner(size, size) = -mass.ldlt().solve(damping);
  const Eigen::VectorXcd values = eigenvalues<double, Eigen::Dynamic>(state);
  return {values.data(), values.data() + values.size()};
}

Complex nearest(const Complex& s, const std::vector<Complex>& all) {
  return *std::min_element(all.begin(), all.end(), [&](const Complex& a, const Complex& b) {
    return std::abs(a - s) < std::abs(b - s);
  });
}

double farthest(const std::vector<Complex>& found, const std::vector<Complex>& all) {
  double worst = 0.0;
  for (const Complex& s : found)
    worst = std::max(worst, std::abs(s - nearest(s, all)) / std::abs(s));
  return worst;
}

TEST(SpanPoles, AreTheEigenvaluesOfTheWhole) {
  const auto string = damped_drake(20.0);
  const auto modes = string_modes_at(string, {1.5, 0.9, 18.6}, 30, 0.0);
  const LumpedDevice inerter{{{30.0, 900.0, 2.0}}, 0.0};
  const LumpedDevice hung{{{absorber.damping, absorber.stiffness, 0.0, absorber.mass}},
                          absorber.clamp_mass};
  // Beyond 2 Z_c a pair of the dashpot's meets on the real axis, and one of both goes far away.
  for (const double impedances : {0.0, 1.0, 1.99, 2.01, 10.0, 1e3}) {
    const LumpedDevice dashpot{{{impedances * string.wave_impedance()}}, 0.0};
    SpanPoles span(modes);
    span.attach(dashpot, 1);
    span.attach(damper(), 1);
    span.attach(inerter, 2);
    std::vector<Complex> found;
    for (const PlantPole& pole : span.attach(absorber, 0)) found.push_back(pole.s);
    const auto all = dense_roots(modes, {{dashpot, 1}, {damper(), 1}, {inerter, 2}, {hung, 0}});
    ASSERT_EQ(found.size(), 2u * (30 + 2 + 1)) << impedances;
    EXPECT_LT(std::max(farthest(found, all), farthest(all, found)), 1e-9) << impedances;
  }
}

TEST(SpanPoles, OfAnAbsorberAloneAreThoseOfThePlant) {
  const auto string = damped_drake(60.0);
  const auto modes = string_modes_at(string, {1.5}, 40, turn_of(400.0));
  const auto plant = plant_poles(bundled_string_modes(string, 1.5, 40, turn_of(400.0)), absorber);
  auto poles = SpanPoles(modes).attach(absorber, 0);
  ASSERT_EQ(poles.size(), plant.size());
  for (const PlantPole& pole : poles) {
    const auto same =
        std::min_element(plant.begin(), plant.end(), [&](const PlantPole& a, const PlantPole& b) {
          return std::abs(a.s - pole.s) < std::abs(b.s - pole.s);
        });
    EXPECT_NEAR(std::abs(same->s - pole.s), 0.0, 1e-10 * std::abs(pole.s));
    EXPECT_NEAR(std::abs(same->residue - pole.residue), 0.0, 1e-6 * std::abs(pole.residue) + 1e-15);
  }
}

// Modes that the truncation hardly touches: of all modes at once, and of many.
TEST(SpanPoles, OfManyModesAreTheRootsOfTheString) {
  const auto string = damped_drake(100.0);
  SpanPoles span(string_modes_at(string, {1.1, 98.7}, 400, turn_of(4000.0)));
  span.attach(damper(), 0);
  span.attach(LumpedDevice{{{60.0}}, 0.0}, 1);
  const auto roots = span_roots(string, {{1.1, damper()}, {98.7, LumpedDevice{{{60.0}}, 0.0}}}, 60);
  const auto found = span.roots();
  for (const SpanRoot& root : roots) {
    // Far from the axis damping by a ratio and by a complex stiffness are no longer the same.
    const double tolerance = root.damping() < 0.02 ? 2e-4 : 2e-3;
    EXPECT_LT(farthest({root.root}, found), tolerance);
    const Complex same = nearest(root.root, found);
    EXPECT_NEAR(-same.real() / std::abs(same), root.damping(), 0.02 * root.damping());
  }
}

// Bundles of two places at one frequency begin at the same pole, and two were followed to one.
TEST(SpanPoles, AreToldApartWhereTwoBundlesBeginTogether) {
  TautString<double> string = drake_string();
  auto modes = string_modes_at(string, {1.5, 0.9}, 300, 1e5);
  for (ModeAtPlaces& mode : modes) mode.damping_ratio = std::hypot(mode.damping_ratio, 5e-4);
  SpanPoles span(modes);
  span.attach(damper(), 1);
  EXPECT_EQ(span.attach({5.0, 500.0, 20.0, 0.3}, 0).size(), 2 * (modes.size() + 3));
  SpanPoles same({{6.0, 0.005, 30.0, {1.0, 0.0}}, {6.0, 0.005, 30.0, {0.0, 1.0}}});
  for (const std::size_t place : {0u, 1u}) same.attach(damper(), place);
  EXPECT_EQ(same.attach(absorber, 0).size(), 2u * (2 + 2 * 2 + 1));
}

// Both ends alike, as lines have them.
TEST(SpanPoles, AreFoundWhereBothEndsHaveTheSameDampers) {
  auto modes = string_modes_at(drake_string(), {1.7, 1.0, 299.0}, 300, 1e5);
  for (ModeAtPlaces& mode : modes) mode.damping_ratio = std::hypot(mode.damping_ratio, 2e-4);
  SpanPoles span(modes);
  const LumpedDevice other = stockbridge({0.82, {18.3, 66.2}, {0.067, 0.067}, 0.75, 0.0});
  for (const std::size_t place : {1u, 2u}) {
    span.attach(damper(), place);
    span.attach(other, place);
  }
  EXPECT_EQ(span.attach({1.0, 3553.0, 6.0, 0.0}, 0).size(), 2 * (modes.size() + 9));
}

TEST(SpanPoles, RefuseWhatIsNoSpan) {
  EXPECT_THROW(SpanPoles({}), InvalidParameter);
  SpanPoles span(string_modes_at(damped_drake(20.0), {1.5}, 5, 0.0));
  EXPECT_THROW(span.attach(LumpedDevice{{{-1.0}}, 0.0}, 0), InvalidParameter);
}

/// A string of length 1 whose waves run at 1 and whose impedance is 1.
TautString<double> unit_string(double damping_ratio = 0.0) {
  return {1.0, 1.0, 1.0, damping_ratio};
}

SpanRoot with_dashpot(double place, double damping, int n) {
  const SpanDevice device{place, LumpedDevice{{{damping}}, 0.0}};
  return span_roots(unit_string(), {device}, n).back();
}

/// sin β + i (c/Z_c) sin βa sin β(1 − a), s = iβ.
Complex krenk(const Complex& s, double place, double damping) {
  const Complex beta = s / Complex(0.0, 1.0);
  return std::sin(beta) +
         Complex(0.0, damping) * std::sin(beta * place) * std::sin(beta * (1.0 - place));
}

// Krenk (2000), computed apart with many digits.
TEST(SpanRoots, OfOneDashpotAreKrenks) {
  const auto damping = [](double place, double kappa) {
    return with_dashpot(place, kappa / (pi<double> * place), 1).damping();
  };
  EXPECT_NEAR(damping(0.02, 0.25), 0.00472195100051, 1e-13);
  EXPECT_NEAR(damping(0.02, 1.0), 0.0102114686718, 1e-12);
  EXPECT_NEAR(damping(0.02, 4.0), 0.00472756204958, 1e-13);
  EXPECT_NEAR(damping(0.05, 1.0), 0.0264392727833, 1e-12);
}

TEST(SpanRoots, OfADashpotAtMidSpanAreKnown) {
  // c = Z_c: sin β + i sin²(β/2) = 0 has tan(β/2) = 2i, β = π + i ln 3 for odd n.
  const auto roots = span_roots(unit_string(), {{0.5, LumpedDevice{{{1.0}}, 0.0}}}, 5);
  for (const int n : {1, 3, 5}) {
    const Complex beta = roots[static_cast<std::size_t>(n - 1)].root / Complex(0.0, 1.0);
    EXPECT_NEAR(std::abs(beta - Complex(n * pi<double>, 1.0986122886681098)), 0.0, 1e-10) << n;
  }
  // A node feels nothing.
  EXPECT_NEAR(roots[1].damping(), 0.0, 1e-12);
}

TEST(SpanRoots, OfTenThousandDashpotsSolveTheEquationAndKeepToItsAsymptote) {
  std::mt19937 random(2000);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::uniform_int_distribution<int> modes(1, 8);
  double worst = 0.0;
  for (int k = 0; k < 10000; ++k) {
    const int n = modes(random);
    const double place = 0.002 * std::pow(10.0, unit(random)) / n;
    const double kappa = 0.05 * std::pow(400.0, unit(random));
    const double damping = kappa / (n * pi<double> * place);
    const SpanRoot root = with_dashpot(place, damping, n);
    // The slope of the equation at a root is about 1 + κ.
    EXPECT_LT(std::abs(krenk(root.root, place, damping)), 1e-11 * (1.0 + kappa) * n);
    const double asymptote = place * kappa / (1.0 + kappa * kappa);
    EXPECT_NEAR(root.asymptotic, asymptote, 1e-12);
    worst = std::max(worst, std::abs(root.damping() / asymptote - 1.0) / (n * place));
    EXPECT_LE(root.damping(), 0.5 * place * (1.0 + 8.0 * n * place));
  }
  // Of second order in n a/L, and no less: a test that cannot fail would have 0 here.
  EXPECT_LT(worst, 8.0);
  EXPECT_GT(worst, 0.5);
}

TEST(SpanRoots, OfABareStringAreItsOwn) {
  const auto roots = span_roots(unit_string(0.013), {}, 3);
  for (int n = 1; n <= 3; ++n) {
    const SpanRoot& root = roots[static_cast<std::size_t>(n - 1)];
    EXPECT_NEAR(root.damping(), 0.013, 1e-14);
    EXPECT_NEAR(std::abs(root.root), n * pi<double>, 1e-12);
  }
}

TEST(SpanRoots, OfALightDeviceAreThoseOfFirstOrder) {
  const SpanDevice light{0.13, LumpedDevice{{tuned_branch(1e-6, 1.2, 0.2)}, 1e-7}};
  const auto roots = span_roots(unit_string(), {light, {0.8, LumpedDevice{{{1e-6}}, 0.0}}}, 9);
  for (const SpanRoot& root : roots)
    EXPECT_NEAR(root.damping(), root.first_order, 2e-4 * root.first_order);
}

TEST(SpanRoots, OfTwoDevicesDoNotDependOnTheirOrder) {
  const auto string = drake_string();
  const SpanDevice stock{1.3, stockbridge({4.0, {9.0, 24.0}, {0.15, 0.2}, 0.55, 0.4})};
  const SpanDevice dashpot{298.2, LumpedDevice{{{90.0}}, 0.0}};
  const auto one = span_roots(string, {stock, dashpot}, 120);
  const auto other = span_roots(string, {dashpot, stock}, 120);
  for (std::size_t n = 0; n < one.size(); ++n)
    EXPECT_NEAR(std::abs(one[n].root - other[n].root), 0.0, 1e-10 * std::abs(one[n].root));
  // From the other support they are the same.
  const auto mirrored =
      span_roots(string, {{300.0 - 1.3, stock.device}, {300.0 - 298.2, dashpot.device}}, 120);
  for (std::size_t n = 0; n < one.size(); ++n)
    EXPECT_NEAR(std::abs(one[n].root - mirrored[n].root), 0.0, 1e-9 * std::abs(one[n].root));
}

}  // namespace
}  // namespace holdfast
