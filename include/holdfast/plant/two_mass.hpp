#pragma once

#include <type_traits>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

/// The two-degree-of-freedom plant: conductor, reduced to the absorber's place, and absorber.
///
///     m₁ z̈₁ = −k₁ z₁ − c₁ ż₁ + k₂ (z₂ − z₁) + c₂ (ż₂ − ż₁) + u + F
///     m₂ z̈₂ =                 − k₂ (z₂ − z₁) − c₂ (ż₂ − ż₁) − u
///
/// u (N) is the control force and F (N) the excitation. With the state z = [z₁, ż₁, z₂, ż₂]ᵀ (m,
/// m/s, m, m/s; positive downward), ż = A z + b u + c F. Source: Kollár 2022, Eqs. (9)–(10). The
/// paper misprints the fourth row of A; here it is [k₂/m₂, c₂/m₂, −k₂/m₂, −c₂/m₂].
template <class Scalar>
struct TwoMass {
  static_assert(is_real<Scalar>, "the numbers of a plant are real: TwoMass<double>");

  Scalar conductor_mass;       ///< mass m₁ (kg), > 0
  Scalar conductor_stiffness;  ///< stiffness k₁ (N/m), > 0
  Scalar conductor_damping;    ///< damping c₁ (N s/m), ≥ 0
  Scalar absorber_mass;        ///< mass m₂ (kg), > 0
  Scalar absorber_stiffness;   ///< stiffness k₂ (N/m), > 0
  Scalar absorber_damping;     ///< damping c₂ (N s/m), ≥ 0

  /// The state matrix A, 4 × 4.
  Matrix<Scalar, 4> state_matrix() const {
    const Scalar zero(0), one(1);
    const Scalar &m1 = conductor_mass, &k1 = conductor_stiffness, &c1 = conductor_damping;
    const Scalar &m2 = absorber_mass, &k2 = absorber_stiffness, &c2 = absorber_damping;
    Matrix<Scalar, 4> a;
    a.row(0) << zero, one, zero, zero;
    a.row(1) << -(k1 + k2) / m1, -(c1 + c2) / m1, k2 / m1, c2 / m1;
    a.row(2) << zero, zero, zero, one;
    a.row(3) << k2 / m2, c2 / m2, -k2 / m2, -c2 / m2;
    return a;
  }

  /// The input vector b of the control force u (N), 4 × 1.
  Vector<Scalar, 4> control_input() const {
    return {Scalar(0), Scalar(1) / conductor_mass, Scalar(0), -Scalar(1) / absorber_mass};
  }

  /// The input vector c of the excitation F (N), 4 × 1.
  Vector<Scalar, 4> excitation_input() const {
    return {Scalar(0), Scalar(1) / conductor_mass, Scalar(0), Scalar(0)};
  }
};

/// Rejects a plant whose parameters are outside the ranges stated at the members.
/// @throws InvalidParameter naming the first member that is not admissible
inline void validate(const TwoMass<double>& plant) {
  require_positive("conductor mass m1", plant.conductor_mass, "kg");
  require_positive("conductor stiffness k1", plant.conductor_stiffness, "N/m");
  require_non_negative("conductor damping c1", plant.conductor_damping, "N s/m");
  require_positive("absorber mass m2", plant.absorber_mass, "kg");
  require_positive("absorber stiffness k2", plant.absorber_stiffness, "N/m");
  require_non_negative("absorber damping c2", plant.absorber_damping, "N s/m");
}

/// Whether the parameters of a plant are admissible, that is, `validate` accepts them.
inline bool is_admissible(const TwoMass<double>& plant) {
  try {
    validate(plant);
    return true;
  } catch (const InvalidParameter&) {
    return false;
  }
}

/// The relative displacement Δz = z₂ − z₁ (m) of a state that begins with [z₁, ż₁, z₂, ż₂].
template <class Scalar, int Size>
Scalar relative_displacement(const Vector<Scalar, Size>& state) {
  return state[2] - state[0];
}

/// The relative velocity Δż = ż₂ − ż₁ (m/s) of a state that begins with [z₁, ż₁, z₂, ż₂].
template <class Scalar, int Size>
Scalar relative_velocity(const Vector<Scalar, Size>& state) {
  return state[3] - state[1];
}

/// Converts the plant of two masses to another number type, for instance `long double`.
template <class To, class From>
TwoMass<To> converted(const TwoMass<From>& plant) {
  return {To(plant.conductor_mass), To(plant.conductor_stiffness), To(plant.conductor_damping),
          To(plant.absorber_mass),  To(plant.absorber_stiffness),  To(plant.absorber_damping)};
}

namespace detail {

/// Rejects two masses outside their ranges; packs, dual numbers and other plants are not checked.
template <class Plant>
void require_admissible(const Plant&) {}
template <class Scalar>
void require_admissible(const TwoMass<Scalar>& plant) {
  if constexpr (std::is_floating_point_v<Scalar>) validate(converted<double>(plant));
}

}  // namespace detail

/// The plant of Kollár 2022, Table 1: a scale model, the absorber at a tenth of the span.
inline TwoMass<double> kollar2022_plant() { return {0.0767, 50.3, 0.079, 0.16, 74.4, 4.0}; }

}  // namespace holdfast
