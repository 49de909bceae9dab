#include "holdfast/stability/boundary/boundary_features.hpp"

#include "support/polynomial/made_polynomial.hpp"
#include "support/polynomial/rounding.hpp"
#include "support/random_loop.hpp"

namespace holdfast {
namespace {

using Kind = BoundaryFeatureKind;

const GainWindow whole_plane{{-1e9, 1e9}, {-1e7, 1e7}};

template <int Degree>
AffinePolynomial<double, Degree> random_coefficients(test::Random& random) {
  AffinePolynomial<double, Degree> result;
  result.base = random.matrix<Polynomial<double, Degree>>();
  result.proportional = random.matrix<Polynomial<double, Degree>>();
  result.differential = random.matrix<Polynomial<double, Degree>>();
  return result;
}

int count(const std::vector<BoundaryFeature<double>>& features, Kind kind) {
  return static_cast<int>(std::count_if(features.begin(), features.end(),
                                        [kind](const auto& f) { return f.kind == kind; }));
}

/// |p(x)| at a root of a feature over what rounding may make of it: what is unknown of p(x) itself,
/// and what the gains, solved for at the feature's first root, are off by.
template <int Degree>
double relative_residual(const test::RoundingOfGains<Degree>& rounding,
                         const BoundaryFeature<double>& feature, const BoundaryRoot<double>& root,
                         double times_off = 0.0) {
  const auto x = rounding.place(root.angle);
  const bool lines_alone = feature.kind == Kind::end || feature.first.angle == 0.0;
  const PdGains<long double> off =
      lines_alone ? PdGains<long double>{} : rounding.of_pair(feature.first.angle, feature.gains);
  const PdGains<double> gains{
      feature.gains.proportional + times_off * static_cast<double>(off.proportional),
      feature.gains.differential + times_off * static_cast<double>(off.differential)};
  const auto bound = rounding.unknown(x, root.angle, feature.gains) +
                     rounding.moved(x, off.proportional, off.differential);
  return static_cast<double>(rounding.residual(x, gains) / bound);
}

// Rounding in the plane of w is up to 2^{5/2} = 5.7 of that in λ − 1, in each of some twenty
// operations.
constexpr double roundings_of_a_root = 128.0;

TEST(BoundaryFeatures, AreRootsOfThePolynomial) {
  test::Random random(821);
  int seen[5] = {}, lines_meet = 0, noticed = 0, moved = 0;
  double worst = 0.0, worst_stated = 0.0;
  const auto look_at = [&](const auto& polynomial, const GainWindow& window) {
    const test::RoundingOfGains rounding(polynomial);
    for (const auto& feature : boundary_features(polynomial, window)) {
      ++seen[static_cast<int>(feature.kind)];
      const bool two_lines = feature.first.curve == BoundaryCurve::plus_one;
      lines_meet += feature.kind == Kind::crossing && two_lines ? 1 : 0;
      for (const auto& root : {feature.first, feature.second})
        worst = std::max(worst, relative_residual(rounding, feature, root));
      worst_stated = std::max(worst_stated, feature.residual);
      if (feature.kind == Kind::end || two_lines) continue;
      ++moved;
      noticed += relative_residual(rounding, feature, feature.first, 4 * roundings_of_a_root) >
                         roundings_of_a_root
                     ? 1
                     : 0;
    }
  };
  for (int draw = 0; draw < 500; ++draw) {
    const auto plant = test::random_plant(random);
    const auto sampling = test::random_sampling(plant, random);
    // Gains with which sampling matters, m/τ² and m/τ, and up to ten times them.
    const double d = 10 * plant.conductor_mass / sampling.period, p = d / sampling.period;
    look_at(characteristic_polynomial(sampled_loop(plant, sampling)), {{-p, p}, {-d, d}});
    look_at(characteristic_polynomial(plant), whole_plane);
    look_at(random_coefficients<5>(random), whole_plane);
    auto continuous = random_coefficients<4>(random);
    continuous.proportional[4] = continuous.differential[4] = 0.0;
    look_at(continuous, whole_plane);
  }
  std::cout << "  tangents " << seen[0] << " + " << seen[1] << ", crossings " << seen[3]
            << ", ends " << seen[4] << ", worst residual " << worst << " roundings, stated "
            << worst_stated << "; gains moved by " << 4 * roundings_of_a_root << " are noticed "
            << noticed << " of " << moved << " times\n";
  EXPECT_LE(worst, roundings_of_a_root);
  EXPECT_LE(worst_stated, 1e-9);
  EXPECT_GE(noticed, moved / 2) << "gains that are further off";
  EXPECT_EQ(seen[static_cast<int>(Kind::cusp)], 0) << "a cusp takes a coincidence";
  EXPECT_GT(std::min({seen[0], seen[1], seen[3], seen[4], lines_meet}), 100);
}

TEST(BoundaryFeatures, CrossingsWithALineAreAllChangesOfSideAlongTheCurve) {
  test::Random random(823);
  int seen = 0;
  for (int draw = 0; draw < 300; ++draw) {
    const auto polynomial = random_coefficients<5>(random);
    const BoundaryCurves<double, 5> curves(polynomial);
    const auto& line = curves.lines()[random.index(curves.lines().size())];
    // Δ times the line's value changes sign at crossings alone, not at poles.
    const auto side = [&](double square) {
      const auto gains = curves.pairs().gains(square);
      return (line.constant + gains.proportional * line.proportional +
              gains.differential * line.differential) *
             evaluate(curves.pairs().denominator(), square);
    };
    const double from = 1e-4, to = 1e4;
    int changes = 0;
    const int steps = 4000;
    double before = side(from);
    for (int k = 1; k <= steps; ++k) {
      const double now = side(from * std::pow(to / from, static_cast<double>(k) / steps));
      changes += (now > 0) != (before > 0) ? 1 : 0;
      before = now;
    }
    int expected = 0;
    for (const auto& feature : boundary_features(polynomial, whole_plane)) {
      const bool meets = feature.kind == Kind::crossing &&
                         feature.first.curve == BoundaryCurve::complex_pair &&
                         feature.second.curve == line.curve;
      const double y = std::tan(feature.first.angle / 2) / curves.pairs().unit();
      expected += meets && y * y > from && y * y < to ? 1 : 0;
    }
    EXPECT_EQ(changes, expected) << draw;
    seen += expected;
  }
  EXPECT_GT(seen, 200);
}

TEST(BoundaryFeatures, TheCurveEndsInADoubleRoot) {
  test::Random random(824);
  int seen = 0;
  for (int draw = 0; draw < 300; ++draw) {
    const auto polynomial = random_coefficients<5>(random);
    for (const auto& feature : boundary_features(polynomial, whole_plane)) {
      if (feature.kind != Kind::end) continue;
      const double x = feature.second.curve == BoundaryCurve::minus_one ? -2.0 : 0.0;
      const Polynomial<double, 5> p = polynomial.at(feature.gains);
      const double size =
          100 * (1 + std::abs(feature.gains.proportional) + std::abs(feature.gains.differential));
      EXPECT_LE(std::abs(evaluate(p, x)), 1e-14 * size);
      EXPECT_LE(std::abs(evaluate(derivative<double, 6>(p), x)), 1e-14 * size);
      ++seen;
    }
  }
  EXPECT_GT(seen, 500);
}

/// A double pair at the angle (Y = tan²(θ/2) or ω²) makes a cusp at the gains.
template <int Degree>
AffinePolynomial<double, Degree> with_cusp(double angle, const PdGains<double>& gains,
                                           test::Random& random) {
  const double size = 2 - 2 * std::cos(angle);  // |e^{iθ} − 1|²
  const Polynomial<double, 2> pair =
      Degree == 5 ? test::quadratic(size, size) : test::quadratic(angle * angle, 0.0);
  return test::through<Degree>(test::product<Degree>(pair, pair, 0.4), gains, random);
}

template <int Degree>
void expect_cusps_are_told(std::uint64_t seed) {
  test::Random random(seed);
  for (int draw = 0; draw < 100; ++draw) {
    const double angle = random.uniform(0.3, 2.5);
    const PdGains<double> gains{random.uniform(-2, 2), random.uniform(-2, 2)};
    auto polynomial = with_cusp<Degree>(angle, gains, random);
    const GainWindow window{{gains.proportional - 1e-4, gains.proportional + 1e-4},
                            {gains.differential - 1e-4, gains.differential + 1e-4}};
    const auto exact = boundary_features(polynomial, window);
    const auto cusp = std::find_if(exact.begin(), exact.end(),
                                   [](const auto& f) { return f.kind == Kind::cusp; });
    ASSERT_NE(cusp, exact.end()) << draw;
    EXPECT_EQ(count(exact, Kind::cusp), 1) << draw;
    EXPECT_NEAR(cusp->first.angle, angle, 1e-9);
    EXPECT_NEAR(cusp->gains.proportional, gains.proportional, 1e-9);
    auto other = polynomial;
    other.base[1] += 1e-5;
    EXPECT_EQ(count(boundary_features(other, window), Kind::cusp), 0) << draw;
  }
}

TEST(BoundaryFeatures, ACuspIsToldFromTwoTangentsCloseTogether) {
  expect_cusps_are_told<4>(825);
  expect_cusps_are_told<5>(826);
}

TEST(BoundaryFeatures, KollarsContinuousLoopHasOneTangent) {
  // Without the damping of the conductor (c₁ = 0) P would be largest at ω⁴ = k₁k₂/(m₁m₂).
  const auto features =
      boundary_features(characteristic_polynomial(kollar2022_plant()), {{-1e5, 1e5}, {-1e4, 1e4}});
  ASSERT_EQ(features.size(), 1U);
  EXPECT_EQ(features[0].kind, Kind::vertical_tangent);
  EXPECT_NEAR(features[0].first.angle, std::pow(50.3 * 74.4 / (0.0767 * 0.16), 0.25), 1e-9);
}

/// How often P turns (and D) along the curve of root pairs in fine steps from Y = 10⁻⁵ to 10⁵. A
/// pole is no turn: the step across it is left out.
struct TurnScan {
  static constexpr int steps = 5000;
  static constexpr double step = 10.0 / steps;  // of log₁₀ Y
  int of_proportional = 0, of_differential = 0;

  explicit TurnScan(const RootPairCurve<long double>& curve) {
    int p_before = 0, d_before = 0;
    bool positive = false;
    PdGains<long double> here{};
    for (int k = 0; k <= steps; ++k) {
      const long double square = std::pow(10.0L, -5 + 10.0L * k / steps);
      const bool now_positive = evaluate(curve.denominator(), square) > 0;
      const auto next = curve.gains(square);
      if (k > 0 && now_positive == positive) {
        count(next.proportional - here.proportional, p_before, of_proportional);
        count(next.differential - here.differential, d_before, of_differential);
      }
      here = next;
      positive = now_positive;
    }
  }

  static void count(long double by, int& before, int& turns) {
    const int now = by > 0 ? 1 : -1;
    turns += before != 0 && now != before ? 1 : 0;
    before = now;
  }
};

void expect_all_but_close_pairs(std::vector<double> found, int scanned) {
  std::sort(found.begin(), found.end());
  int close = 0;
  for (std::size_t k = 0; k + 1 < found.size(); ++k)
    if (found[k + 1] - found[k] <= 2 * TurnScan::step) ++close, ++k;
  const int missed = static_cast<int>(found.size()) - scanned;
  EXPECT_TRUE(missed % 2 == 0 && missed >= 0 && missed <= 2 * close)
      << found.size() << " found, " << scanned << " in the scan, pairs in two steps " << close;
}

/// Two turns within two steps may be seen by the features alone.
template <int Degree>
int expect_all_turns_are_found(const AffinePolynomial<long double, Degree>& precise,
                               const AffinePolynomial<double, Degree>& polynomial) {
  const BoundaryCurves<long double, Degree> curves(precise);
  const TurnScan scan(curves.pairs());
  std::vector<double> vertical, horizontal;  // log₁₀ Y
  for (const auto& feature :
       detail::FeatureFinder<double, Degree>(BoundaryCurves<double, Degree>(polynomial)).find()) {
    const double angle = feature.first.angle, y = Degree == 5 ? std::tan(angle / 2) : angle;
    const double square = std::pow(y / static_cast<double>(curves.pairs().unit()), 2);
    if (square < 1e-5 || square > 1e5) continue;
    if (feature.kind == Kind::vertical_tangent) vertical.push_back(std::log10(square));
    if (feature.kind == Kind::horizontal_tangent) horizontal.push_back(std::log10(square));
  }
  expect_all_but_close_pairs(vertical, scan.of_proportional);
  expect_all_but_close_pairs(horizontal, scan.of_differential);
  return static_cast<int>(vertical.size() + horizontal.size());
}

template <int Degree>
AffinePolynomial<long double, Degree> extended(const AffinePolynomial<double, Degree>& exact) {
  return {exact.base.template cast<long double>(), exact.proportional.template cast<long double>(),
          exact.differential.template cast<long double>()};
}

TEST(BoundaryFeatures, TangentsAreAllTurnsAlongTheCurve) {
  test::Random random(827);
  int seen = 0;
  for (int draw = 0; draw < 60; ++draw) {
    const auto any = random_coefficients<5>(random);
    seen += expect_all_turns_are_found<5>(extended(any), any);
    auto continuous = random_coefficients<4>(random);
    continuous.proportional[4] = continuous.differential[4] = 0.0;
    seen += expect_all_turns_are_found<4>(extended(continuous), continuous);
    const auto plant = test::random_plant(random);
    const auto sampling = test::random_sampling(plant, random);
    const Sampling<long double> precise{sampling.period, sampling.processing_delay};
    seen += expect_all_turns_are_found<5>(
        characteristic_polynomial(sampled_loop(converted<long double>(plant), precise)),
        characteristic_polynomial(sampled_loop(plant, sampling)));
  }
  EXPECT_GT(seen, 200);
}

TEST(BoundaryFeatures, WithoutDampingTheContinuousCurveTurnsBackOnItself) {
  test::Random random(829);
  for (int draw = 0; draw < 200; ++draw) {
    TwoMass<double> plant = test::random_plant(random);
    plant.conductor_damping = plant.absorber_damping = 0.0;
    // On D = 0, P = −(m₁m₂ω⁴ − (…)ω² + k₁k₂)/(m₂ω²) has its maximum at ω⁴ = k₁k₂/(m₁m₂).
    const auto features = boundary_features(characteristic_polynomial(plant), whole_plane);
    ASSERT_EQ(features.size(), 1U) << draw;
    EXPECT_EQ(features[0].kind, Kind::cusp);
    EXPECT_EQ(features[0].gains.differential, 0.0);
    const double expected = std::pow(plant.conductor_stiffness * plant.absorber_stiffness /
                                         (plant.conductor_mass * plant.absorber_mass),
                                     0.25);
    EXPECT_NEAR(features[0].first.angle / expected, 1.0, 1e-7) << draw;
  }
}

TEST(BoundaryFeatures, ALineIsKeptHoweverFarApartTheRootsAre) {
  // (s + 1)² (s² + 900 s + 10⁶) + P (1 + s²) + D s: s = 0 at P = −10⁶.
  AffinePolynomial<double, 4> polynomial;
  polynomial.base = test::product<4>(test::quadratic(1, 2), test::quadratic(1e6, 900));
  polynomial.proportional << 1, 0, 1, 0, 0;
  polynomial.differential << 0, 1, 0, 0, 0;
  const auto features = boundary_features(polynomial, whole_plane);
  const auto end = std::find_if(features.begin(), features.end(),
                                [](const auto& f) { return f.kind == Kind::end; });
  ASSERT_NE(end, features.end());
  EXPECT_EQ(end->second.curve, BoundaryCurve::zero);
  EXPECT_NEAR(end->gains.proportional, -1e6, 1e-8);
  EXPECT_NEAR(end->gains.differential, -2000900.0, 1e-8);
}

TEST(BoundaryFeatures, OutsideTheWindowAreLeftOut) {
  const auto polynomial =
      characteristic_polynomial(sampled_loop(kollar2022_plant(), Sampling<double>{0.01}));
  const GainWindow window{{-300.0, 60.0}, {-20.0, 10.0}};
  const auto all = boundary_features(polynomial, whole_plane);
  const auto inside = boundary_features(polynomial, window);
  EXPECT_LT(inside.size(), all.size());
  EXPECT_EQ(static_cast<std::ptrdiff_t>(inside.size()),
            std::count_if(all.begin(), all.end(),
                          [&](const auto& f) { return window.contains(f.gains); }));
}

TEST(BoundaryFeatures, ABadWindowIsRefused) {
  const auto polynomial = characteristic_polynomial(kollar2022_plant());
  constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
  for (const GainWindow& bad : {GainWindow{{1, 1}, {0, 1}},
                                {{0, 1}, {1, 1}},
                                {{0, 1}, {2, 1}},
                                {{0, 1}, {not_a_number, 1}},
                                {{0, 1}, {0, std::numeric_limits<double>::infinity()}}}) {
    EXPECT_THROW(boundary_features(polynomial, bad), InvalidParameter);
  }
}

}  // namespace
}  // namespace holdfast
