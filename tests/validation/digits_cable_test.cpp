// How many digits of what the cable and the plant derives may be trusted: the same templates in
// double and in long double, over the cases of Kollár 2022 (Table 1, Fig. 2).

#include "holdfast/cable/conductor.hpp"
#include "holdfast/cable/hanging_cable.hpp"
#include "holdfast/cable/modes.hpp"
#include "holdfast/cable/statics.hpp"
#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/plant/free_decay.hpp"
#include "holdfast/plant/reduction.hpp"
#include "support/digits.hpp"

namespace holdfast::cable_digits {
namespace {

using test::plant_inputs;
using test::plant_of;
using test::six;

/// [μ, L, f, A, E, ζ, g, x_p, m₂] of Table 1.
Vector<double, 9> cable_inputs() {
  const auto c = kollar2022_conductor();
  Vector<double, 9> x;
  x << c.mass_per_length, c.span, c.sag, c.area, c.youngs_modulus, c.damping_ratio, c.gravity, 0.64,
      0.16;
  return x;
}
template <class Scalar>
Conductor<Scalar> conductor_of(const Vector<Scalar, 9>& x) {
  return {x[0], x[1], x[2], x[3], x[4], x[5], x[6]};
}
template <class Scalar>
Scalar resting_load(const Vector<Scalar, 9>& x) {
  return x[8] * x[6];
}

template <class Scalar>
HangingCable<Scalar> cable_of(const Vector<Scalar, 9>& x) {
  return HangingCable<Scalar>(conductor_of(x));
}
template <template <class> class PointLoad, class Scalar>
PointLoad<Scalar> statics_of(const Vector<Scalar, 9>& x) {
  return PointLoad<Scalar>(conductor_of(x), x[7]);
}

class CableDigits : public test::Digits {
 protected:
  /// Compares one of the two statics.
  template <template <class> class PointLoad>
  void compare_statics(const std::string& by) {
    const auto x = cable_inputs();
    const auto cable = [](const auto& v) { return statics_of<PointLoad>(v); };
    compare("tension with the absorber, " + by, "Table 1", x,
            [&](const auto& v) { return cable(v).tension(resting_load(v)); });
    compare("drop under the absorber, " + by, "Table 1", x,
            [&](const auto& v) { return cable(v).displacement(resting_load(v)); });
    compare("stiffness k1, " + by, "Table 1", x,
            [&](const auto& v) { return cable(v).stiffness(resting_load(v)); });
    for (const double force : {-1.0, -0.4, 0.2, 0.4, 1.0}) {
      // Beyond the equilibrium with the absorber's weight: a difference of two drops.
      const auto displacement = [&](const auto& v) {
        const auto loaded = cable(v);
        const auto rest = resting_load(v);
        return loaded.displacement(rest + std::decay_t<decltype(rest)>(force)) -
               loaded.displacement(rest);
      };
      compare("displacement, " + by, "Fig. 2, " + std::to_string(force).substr(0, 4) + " N", x,
              displacement,
              1.0 + cable(x).displacement(resting_load(x)) / std::abs(displacement(x)));
    }
  }
};

TEST_F(CableDigits, OfTheCableAsItHangs) {
  const auto x = cable_inputs();
  const std::string of = "Table 1";
  compare("parabolic tension H", of, x,
          [](const auto& v) { return conductor_of(v).parabolic_tension(); });
  compare("Irvine parameter", of, x,
          [](const auto& v) { return conductor_of(v).irvine_parameter(); });
  compare("catenary tension H", of, x, [](const auto& v) { return cable_of(v).bare_tension(); });
  compare("unstretched length", of, x,
          [](const auto& v) { return cable_of(v).unstretched_length(); });
}

TEST_F(CableDigits, OfTheStaticsUnderTheAbsorber) {
  compare_statics<CatenaryPointLoad>("exact");
  compare_statics<IrvinePointLoad>("Eq. 1");
}

TEST_F(CableDigits, OfTheModes) {
  for (const int n : {1, 2, 3}) {
    compare("symmetric frequency", "Table 1, mode " + std::to_string(n), cable_inputs(),
            [n](const auto& v) {
              using Scalar = typename std::decay_t<decltype(v)>::Scalar;
              const auto conductor = conductor_of(v);
              return Scalar(symmetric_frequency(n, conductor.irvine_parameter()) *
                            conductor.transverse_wave_speed() / conductor.span);
            });
  }
}

/// [k₁, m₂, f₁, f₂].
template <class Scalar>
FrequencyReduction<Scalar> asked_of(const Vector<Scalar, 4>& x) {
  return {x[0], x[1], x[2], x[3]};
}
constexpr auto smaller_stiffness = [](const auto& v) {
  return absorber_stiffness_root(asked_of(v), false);
};
constexpr auto mass = [](const auto& v) {
  return reduced_conductor_mass(asked_of(v), absorber_stiffness_root(asked_of(v), false));
};
constexpr auto discriminant = [](const auto& v) { return reduction_discriminant(asked_of(v)); };

TEST_F(CableDigits, OfTheReduction) {
  const Vector<double, 4> table_1(50.3, 0.16, 1.999, 6.998);
  compare("reduced k2", "Table 1", table_1, smaller_stiffness);
  compare("reduced m1", "Table 1", table_1, mass);
  compare("discriminant", "Table 1", table_1, discriminant);
  compare("largest absorber mass", "Table 1", table_1,
          [](const auto& v) { return largest_absorber_mass(asked_of(v)); });
}

/// The absorber's mass for which the two roots lie `room` apart in the discriminant.
Vector<double, 4> near_double_root(double room) {
  Vector<double, 4> x(50.3, 0.16, 1.999, 6.998);
  x[1] = largest_absorber_mass(asked_of(x)) / (1.0 + room);
  return x;
}

TEST_F(CableDigits, NearTheDoubleRootAreAsFewAsTheDiscriminantHas) {
  // The discriminant is a difference of numbers near 1: its digits are those that are left. k2 goes
  // with its root, and keeps about half of those that are lost.
  for (const double room : {1e-6, 1e-9, 1e-12}) {
    const auto x = near_double_root(room);
    const Vector<long double, 4> wide = x.cast<long double>();
    const std::string of = "discriminant about 1e" + std::to_string(std::lround(std::log10(room)));
    const double left = trusted_digits(discriminant(x), discriminant(wide));
    report("discriminant", of, left, 15.0 + std::log10(room) - 1.0);
    report("reduced k2", of, trusted_digits(smaller_stiffness(x), smaller_stiffness(wide)),
           15.0 + 0.5 * std::log10(room) - 1.0);
  }
  const auto last = near_double_root(1e-12);
  EXPECT_LT(trusted_digits(discriminant(last), discriminant(last.cast<long double>().eval())), six)
      << "what has fewer than six digits is said to have fewer";
}

TEST_F(CableDigits, OfThePlantAndItsDecay) {
  const auto x = plant_inputs();
  compare("slowest pole, |Re s|", "Table 1", x,
          [](const auto& v) { return -spectral_abscissa(plant_of(v).state_matrix()); });
  const DecayEvents events = free_decay_events(kollar2022_plant());
  const auto decay = [&](const auto& v) { return *relative_decay(plant_of(v), events); };
  compare("first opposite peak", "§7, c2 = 4", x,
          [&](const auto& v) { return decay(v).first_peak; });
  compare("its time", "§7, c2 = 4", x, [&](const auto& v) { return decay(v).first_peak_time; });
  compare("period of the decay", "§7, c2 = 4", x, [&](const auto& v) { return decay(v).period; });
  compare("logarithmic decrement", "§7, c2 = 4", x,
          [&](const auto& v) { return decay(v).logarithmic_decrement; });
  compare("tuned P, Eq. 6", "10 Hz", x, [](const auto& v) {
    return tuned_proportional_gain(v[4], v[3], decltype(v[0] + v[0])(10));
  });
}

}  // namespace
}  // namespace holdfast::cable_digits
