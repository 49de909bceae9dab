#pragma once

#include "holdfast/math/stats/trusted_digits.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "support/testing.hpp"

namespace holdfast::test {

/// Digits below which the program tells how many there are.
inline constexpr double six = 6.0;

/// Tests that compare a computation in double with the same in long double and print a table.
///
/// A quantity f of inputs x, computed by a backward stable algorithm, errs by about ε κ,
/// κ = Σ |x_i ∂f/∂x_i|/|f|. κ is measured here, in long double, by differences; so many digits may
/// be lost and, for the number of operations, three more.
class Digits : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!long_double_is_wider) GTEST_SKIP() << "long double is no wider than double here";
  }

  /// Takes the digits of one quantity into the table and requires as many as theory promises.
  void report(const std::string& quantity, const std::string& of, double digits, double promised) {
    RecordProperty(quantity + " of " + of, std::to_string(digits));
    std::printf("  %-34s %-34s %5.1f digits, promised %5.1f\n", quantity.c_str(), of.c_str(),
                digits, promised);
    EXPECT_GE(digits, promised) << quantity << " of " << of;
  }

  /// Compares f(x) in both types.
  /// @param f             generic: Vector<Scalar, N> → Scalar
  /// @param cancellation  ≥ 1, how many times larger the numbers are of which f is the difference
  template <int N, class Function>
  void compare(const std::string& quantity, const std::string& of, const Vector<double, N>& x,
               const Function& f, double cancellation = 1.0) {
    const Vector<long double, N> wide = x.template cast<long double>();
    const long double reference = f(wide);
    const double promised = promised_digits(f, wide, reference) - std::log10(cancellation);
    report(quantity, of, trusted_digits(f(x), reference), promised);
    EXPECT_GE(promised, six) << quantity << " of " << of << " is not to be trusted to six digits";
  }

  /// −log₁₀(1000 ε (1 + κ)/2).
  template <class Function, int N>
  static double promised_digits(const Function& f, const Vector<long double, N>& x,
                                long double value) {
    constexpr long double step = 1e-6L;
    long double condition = 0.0L;
    for (int i = 0; i < N; ++i) {
      Vector<long double, N> less = x, more = x;
      less[i] *= 1.0L - step;
      more[i] *= 1.0L + step;
      condition += std::abs((f(more) - f(less)) / (2.0L * step * value));
    }
    const long double unit = std::numeric_limits<double>::epsilon() / 2.0L;
    return static_cast<double>(-std::log10(1000.0L * unit * (1.0L + condition)));
  }
};

/// [m₁, k₁, c₁, m₂, k₂, c₂].
template <class Scalar>
TwoMass<Scalar> plant_of(const Vector<Scalar, 6>& x) {
  return {x[0], x[1], x[2], x[3], x[4], x[5]};
}
inline Vector<double, 6> plant_inputs() {
  const auto plant = kollar2022_plant();
  Vector<double, 6> x;
  x << plant.conductor_mass, plant.conductor_stiffness, plant.conductor_damping,
      plant.absorber_mass, plant.absorber_stiffness, plant.absorber_damping;
  return x;
}

/// [plant, τ, δ, P, D, F_m, f, r₀].
using LoopInputs = Vector<double, 13>;
template <class Scalar>
IdealLoop<Scalar> loop_of(const Vector<Scalar, 13>& x) {
  return {plant_of<Scalar>(x.template head<6>()),
          {x[6], x[7]},
          {x[8], x[9]},
          {x[10], x[11]},
          x[12],
          ForceHold::sampled};
}
inline LoopInputs loop_inputs(double period, double delay, double width, double frequency = 10.0) {
  LoopInputs x;
  x << plant_inputs(), period, delay, -557.0, -13.0, 0.5, frequency, width;
  return x;
}
template <class Scalar>
SampledLoop<Scalar> sampled_of(const Vector<Scalar, 13>& x) {
  return sampled_loop(loop_of(x).plant, loop_of(x).sampling);
}

struct SamplingCase {
  const char* name;
  double period, delay;
};
inline constexpr std::array<SamplingCase, 5> samplings{{{"1 ms", 0.001, 0.0},
                                                        {"10 ms (Fig. 4a)", 0.01, 0.0},
                                                        {"10 ms, delay 5 ms", 0.01, 0.005},
                                                        {"11 ms (Fig. 9)", 0.011, 0.0},
                                                        {"25 ms (Fig. 5)", 0.025, 0.0}}};

}  // namespace holdfast::test
