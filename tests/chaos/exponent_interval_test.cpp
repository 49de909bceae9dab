#include "holdfast/chaos/chaos_indicators.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

// The intervals of the largest exponent, against maps whose exponent is known. An interval of 95 %
// would hold it in 950 of 1000 repeats and fail here; one that is twice too wide fails as well.

using Tangent = Matrix<double, 2>;
using NextTangent = std::function<Tangent()>;
constexpr int interval_repeats = 1000, least_covered = 980;
constexpr std::int64_t interval_steps = 1536;
const double golden_turn = 0.5 * (std::sqrt(5.0) - 1.0);

/// A map with its largest exponent.
struct KnownMap {
  const char* name;
  double exponent;  ///< per step
  bool wanders;     ///< its sums spread as √n, else they stay within bounds
  NextTangent (*begin)(test::Random&);
};

/// Of a map of one number.
Tangent tangent_of_one(double by) { return Vector<double, 2>(by, 0.0).asDiagonal(); }
/// The fractional part.
double wrapped(double x) { return x - std::floor(x); }
double entropy_of_split(double a) { return -a * std::log(a) - (1 - a) * std::log(1 - a); }

NextTangent logistic_map(double r, double x) {
  return [r, x]() mutable {
    const double slope = r - 2 * r * x;
    x = r * x * (1 - x);
    return tangent_of_one(slope);
  };
}

NextTangent skew_tent(double a, test::Random& random) {
  return [a, x = random.uniform(0.01, 0.99)]() mutable {
    const bool left = x < a;
    x = left ? x / a : (1 - x) / (1 - a);
    return tangent_of_one(left ? 1 / a : 1 / (a - 1));
  };
}

NextTangent continued_fractions(test::Random& random) {
  return [x = random.uniform(0.01, 0.99)]() mutable {
    const double slope = 1 / (x * x);
    x = wrapped(1 / x);
    if (x < 1e-12) x = golden_turn;
    return tangent_of_one(slope);
  };
}

NextTangent henon_map(test::Random& random) {
  Vector<double, 2> point(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1));
  return [point]() mutable {
    const double x = point[0];
    point = {1 - 1.4 * x * x + point[1], 0.3 * x};
    return (Tangent() << -2.8 * x, 1, 0.3, 0).finished();
  };
}

NextTangent gaussian_matrices(test::Random& random) {
  return [&random] {
    Tangent map;
    for (double& entry : map.reshaped()) entry = random.normal();
    return map;
  };
}

/// Two stretches, each of which stays for five steps on average.
NextTangent lasting_stretches(test::Random& random) {
  return [&random, strong = random.unit() < 0.5]() mutable {
    if (random.unit() < 0.2) strong = !strong;
    return tangent_of_one(strong ? 3.0 : 0.5);
  };
}

/// x ↦ h(h⁻¹(x) + golden turn), h the fractional linear map of the circle that stretches by 3 at
/// its fixed point: the derivative varies by a factor of 81, the exponent is 0.
NextTangent conjugate_rotation(test::Random& random) {
  return [turn = random.unit()]() mutable {
    constexpr double k = 3.0;
    const auto stretch_of_h = [](double at) {
      const double c = std::cos(pi<double> * at), s = std::sin(pi<double> * at);
      return k / (c * c + k * k * s * s);
    };
    const double before = stretch_of_h(turn);
    turn = wrapped(turn + golden_turn);
    return tangent_of_one(stretch_of_h(turn) / before);
  };
}

/// A rotation in other coordinates, scaled.
NextTangent focus(double modulus, test::Random& random) {
  const double angle = random.uniform(0.1, 3.0), k = random.log_uniform(0.1, 10.0);
  const double c = std::cos(angle), s = std::sin(angle);
  const Tangent map = modulus * (Tangent() << c, -k * s, s / k, c).finished();
  return [map] { return map; };
}

/// Of the almost Mathieu operator with coupling 2 at the energy 0, which is in its spectrum.
NextTangent almost_mathieu(test::Random& random) {
  return [turn = random.unit()]() mutable {
    const double potential = 4 * std::cos(2 * pi<double> * turn);
    turn = wrapped(turn + golden_turn);
    return (Tangent() << -potential, -1, 1, 0).finished();
  };
}

double three_cycle_exponent(double r) {
  double x = 0.5, sum = 0.0;
  for (int n = 0; n < 3000; ++n) x = r * x * (1 - x);
  for (int n = 0; n < 3; ++n) {
    sum += std::log(std::abs(r - 2 * r * x));
    x = r * x * (1 - x);
  }
  return sum / 3;
}

const KnownMap known_maps[] = {
    {"logistic map", std::log(2.0), false,
     [](test::Random& random) { return logistic_map(4.0, random.uniform(0.01, 0.99)); }},
    {"logistic map of period 3", three_cycle_exponent(3.83), false,
     [](test::Random& random) { return logistic_map(3.83, random.uniform(0.01, 0.99)); }},
    {"skew tent map", entropy_of_split(0.3), true,
     [](test::Random& random) { return skew_tent(0.3, random); }},
    {"very skew tent map", entropy_of_split(0.05), true,
     [](test::Random& random) { return skew_tent(0.05, random); }},
    // P. Lévy, A. Khinchin: π²/(6 ln 2).
    {"continued fractions", pi<double>* pi<double> / (6 * std::log(2.0)), true,
     continued_fractions},
    // J. C. Sprott, Chaos and Time-Series Analysis, 2003.
    {"Henon map", 0.41922, true, henon_map},
    // ½ (ln 2 + ψ(1)): C. M. Newman, Commun. Math. Phys. 103, 1986.
    {"Gaussian matrices", 0.5 * (std::log(2.0) - 0.57721566490153286061), true, gaussian_matrices},
    {"lasting stretches", 0.5 * std::log(1.5), true, lasting_stretches},
    {"conjugate rotation", 0.0, false, conjugate_rotation},
    {"elliptic matrix", 0.0, false, [](test::Random& random) { return focus(1.0, random); }},
    {"stable focus", std::log(0.9), false, [](test::Random& random) { return focus(0.9, random); }},
    // The logarithm of the coupling: J. Bourgain, S. Jitomirskaya, J. Stat. Phys. 108, 2002.
    {"almost Mathieu", std::log(2.0), false, almost_mathieu},
};

/// The largest exponent of maps that are taken one by one.
ExponentEstimate estimate_after_settling(const NextTangent& next, std::int64_t pushed) {
  const Vector<double, 2> anywhere(0.0, 0.0);
  const detail::TangentMaps<2>::OfState map = [&](const auto&) { return next(); };
  detail::TangentMaps<2> tangents(2, map);
  for (int n = 0; n < 300; ++n) tangents.push(anywhere);
  tangents.restart();
  for (std::int64_t n = 0; n < pushed; ++n) tangents.push(anywhere);
  return detail::largest_exponent(tangents.spectrum());
}

ExponentEstimate estimate_of(const KnownMap& map, std::uint64_t seed, std::int64_t pushed) {
  test::Random random(seed);
  return estimate_after_settling(map.begin(random), pushed);
}

/// What repeats of a map show.
struct Coverage {
  int covered = 0;
  double mean_half_width = 0.0;
  double error = 0.0;  ///< root mean square
};

Coverage coverage_of(const KnownMap& map, int count, std::int64_t pushed) {
  Coverage found;
  for (int repeat = 0; repeat < count; ++repeat) {
    const ExponentEstimate estimate =
        estimate_of(map, 5000 + static_cast<std::uint64_t>(repeat), pushed);
    const double error = std::abs(estimate.value - map.exponent);
    if (error <= estimate.half_width) ++found.covered;
    found.mean_half_width += estimate.half_width / count;
    found.error += error * error / count;
  }
  found.error = std::sqrt(found.error);
  return found;
}

class ExponentInterval : public testing::TestWithParam<KnownMap> {};

TEST_P(ExponentInterval, CoversTheKnownExponent) {
  const Coverage found = coverage_of(GetParam(), interval_repeats, interval_steps);
  std::printf("  %d of %d, half width %.1e, error %.1e\n", found.covered, interval_repeats,
              found.mean_half_width, found.error);
  EXPECT_GE(found.covered, least_covered);
}

/// P(|T| ≤ t) = 99 % of Student's T of 31 degrees of freedom, by its density in θ, t = √31 tan θ.
TEST(ExponentEstimate, IsAsWideAsStudentsDistributionSays) {
  const double end = std::atan(exponent_estimate(0.0, 1.0).half_width / std::sqrt(31.0));
  double inside = 0.0, all = 0.0;
  for (double at = 0.5e-5; at < 1.0; at += 1e-5) {
    inside += end * std::pow(std::cos(end * at), 30.0);
    all += 0.5 * pi<double> * std::pow(std::cos(0.5 * pi<double> * at), 30.0);
  }
  EXPECT_NEAR(inside / all, 0.99, 1e-9);
}

TEST_P(ExponentInterval, IsSharp) {
  // 99 % of a normal distribution lie within 2.58 standard deviations; Student's quantile and the
  // larger of two standard errors add a quarter. Bounded sums leave an interval that falls as 1/n.
  const KnownMap& map = GetParam();
  const Coverage found = coverage_of(map, 200, interval_steps);
  if (map.wanders) {
    EXPECT_LT(found.mean_half_width, 3.6 * found.error);
  } else {
    const Coverage longer = coverage_of(map, 50, 8 * interval_steps);
    EXPECT_LT(longer.mean_half_width, found.mean_half_width / 5);
  }
}

INSTANTIATE_TEST_SUITE_P(KnownMaps, ExponentInterval, testing::ValuesIn(known_maps),
                         [](const auto& instance) {
                           std::string name = instance.param.name;
                           name.erase(
                               std::remove_if(name.begin(), name.end(),
                                              [](unsigned char c) { return !std::isalnum(c); }),
                               name.end());
                           return name;
                         });

TEST(ExponentIntervalOfMaps, IsThatOfAnExactExponentWhereNothingVaries) {
  // Doubling map, cat map, rotation: nothing but rounding is left.
  const double c = std::cos(0.7), s = std::sin(0.7);
  const std::pair<Tangent, double> constant[] = {
      {tangent_of_one(2.0), std::log(2.0)},
      {(Tangent() << 2, 1, 1, 1).finished(), std::log(0.5 * (3 + std::sqrt(5.0)))},
      {(Tangent() << c, -s, s, c).finished(), 0.0}};
  for (const auto& [map, exponent] : constant) {
    const ExponentEstimate found =
        estimate_after_settling([tangent = map] { return tangent; }, interval_steps);
    EXPECT_NEAR(found.value, exponent, found.half_width);
    EXPECT_LT(found.half_width, 1.1e-12);
  }
}

}  // namespace
}  // namespace holdfast
