#pragma once

#include "holdfast/control/sampled_loop.hpp"
#include "property/loop_case.hpp"

namespace holdfast::test {

/// A loop, and other units to write it in: 2^mass kg, 2^length m and 2^time s, so that changing the
/// units rounds nothing.
struct UnitsCase {
  LoopCase loop;
  int mass = 0, length = 0, time = 0;

  std::vector<Parameter> parameters() {
    std::vector<Parameter> all = loop.parameters();
    all.insert(all.end(), {{"log2 mass", &mass}, {"log2 length", &length}, {"log2 time", &time}});
    return all;
  }

  /// What a quantity of kg^a m^b s^c is divided by: its numbers become larger by this.
  double factor(int kilograms, int metres, int seconds) const {
    return std::ldexp(1.0, mass * kilograms + length * metres + time * seconds);
  }
  double of_time() const { return factor(0, 0, 1); }
  double of_length() const { return factor(0, 1, 0); }
  double of_force() const { return factor(1, 1, -2); }
  double of_stiffness() const { return factor(1, 0, -2); }
  double of_damping() const { return factor(1, 0, -1); }

  /// Of [z₁, ż₁, z₂, ż₂].
  Vector<double, 4> of_state() const {
    const double velocity = factor(0, 1, -1);
    return {of_length(), velocity, of_length(), velocity};
  }

  /// The same loop, written in the other units.
  LoopCase rewritten() const {
    LoopCase other = loop;
    for (double* value : {&other.plant.conductor_mass, &other.plant.absorber_mass})
      *value *= factor(1, 0, 0);
    for (double* value : {&other.plant.conductor_stiffness, &other.plant.absorber_stiffness,
                          &other.gains.proportional})
      *value *= of_stiffness();
    for (double* value :
         {&other.plant.conductor_damping, &other.plant.absorber_damping, &other.gains.differential})
      *value *= of_damping();
    other.period *= of_time();
    other.excitation.amplitude *= of_force();
    other.excitation.frequency /= of_time();
    other.width *= of_length();
    other.state = other.state.cwiseProduct(of_state());
    return other;
  }

  /// The numbers of a sampled loop in the other units, written back in the first ones.
  SampledLoop<double> written_back(const SampledLoop<double>& other) const {
    const Vector<double, 4> unit = of_state();
    const auto matrix = [&unit](const Matrix<double, 4>& m) -> Matrix<double, 4> {
      return unit.cwiseInverse().asDiagonal() * m * unit.asDiagonal();
    };
    const auto column = [&](const Vector<double, 4>& v) -> Vector<double, 4> {
      return v.cwiseQuotient(unit) * of_force();
    };
    return {{other.sampling.period / of_time(), other.sampling.processing_delay / of_time()},
            matrix(other.transition),
            matrix(other.increment),
            column(other.previous_force),
            column(other.present_force),
            column(other.held_excitation)};
  }
};

/// Units of mass and length up to a thousand times larger or smaller, and of time if asked for.
inline UnitsCase random_units_case(Random& random, bool with_time) {
  UnitsCase drawn;
  drawn.loop = random_loop_case(random);
  const auto exponent = [&random] { return static_cast<int>(random.index(21)) - 10; };
  drawn.mass = exponent();
  drawn.length = exponent();
  drawn.time = with_time ? exponent() : 0;
  return drawn;
}

inline UnitsCase case_in_other_units(Random& random) { return random_units_case(random, true); }

inline bool same_loop(const SampledLoop<double>& a, const SampledLoop<double>& b) {
  return a.transition == b.transition && a.increment == b.increment &&
         a.previous_force == b.previous_force && a.present_force == b.present_force &&
         a.held_excitation == b.held_excitation;
}

/// A loop's matrices in both units, the second ones written back.
struct LoopInBothUnits {
  SampledLoop<double> first, other, back;
  bool same;  ///< to the last bit

  explicit LoopInBothUnits(const UnitsCase& units)
      : first(sampled_loop(units.loop.plant, units.loop.sampling())),
        other(sampled_loop(units.rewritten().plant, units.rewritten().sampling())),
        back(units.written_back(other)),
        same(same_loop(first, back)) {}
};

}  // namespace holdfast::test
