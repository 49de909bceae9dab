#pragma once

#include <complex>
#include <type_traits>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/plant/linear_plant.hpp"

namespace holdfast {

/// A mode of a conductor as its place with the absorber sees it:
///
///     M_n (q̈_n + 2 ζ_n ω_n q̇_n + ω_n² q_n) = φ_n f,   z = Σ φ_n q_n
///
/// f is the force (N) on the conductor at that place and z its displacement (m).
template <class Scalar>
struct PlaceMode {
  Scalar angular_frequency;  ///< ω_n (rad/s), > 0
  Scalar damping_ratio;      ///< ζ_n, ≥ 0
  Scalar shape;              ///< φ_n at the absorber, in any unit: M_n goes with its square
  Scalar mass;               ///< M_n (kg), > 0
};

/// The absorber on a conductor, its drive being apart.
template <class Scalar>
struct Absorber {
  Scalar mass;            ///< m₂ (kg), > 0
  Scalar stiffness;       ///< k₂ (N/m), ≥ 0
  Scalar damping;         ///< c₂ (N s/m), ≥ 0
  Scalar clamp_mass = 0;  ///< M_c (kg), ≥ 0: what of it moves with the conductor
};

/// Refuses modes and an absorber outside the ranges that their members state.
/// @throws InvalidParameter naming the first one
inline void validate(const std::vector<PlaceMode<double>>& modes,
                     const Absorber<double>& absorber) {
  require_within("number of modes", static_cast<double>(modes.size()), "", 1, 10000);
  for (const PlaceMode<double>& mode : modes) {
    require_positive("angular frequency of a mode", mode.angular_frequency, "rad/s");
    require_non_negative("damping ratio of a mode", mode.damping_ratio, "");
    require_finite("shape of a mode at the absorber", mode.shape, "");
    require_positive("mass of a mode", mode.mass, "kg");
  }
  require_positive("absorber mass m2", absorber.mass, "kg");
  require_non_negative("absorber stiffness k2", absorber.stiffness, "N/m");
  require_non_negative("absorber damping c2", absorber.damping, "N s/m");
  require_non_negative("clamp mass", absorber.clamp_mass, "kg");
}

/// H(s) = Σ φ_n² / (M_n (s² + 2 ζ_n ω_n s + ω_n²)) (m/N), the receptance of the bare conductor at
/// the absorber's place, by these modes (unchecked).
/// @param modes  as its place sees them
/// @param s      1/s
template <class Scalar>
std::complex<Scalar> receptance(const std::vector<PlaceMode<Scalar>>& modes,
                                const std::complex<Scalar>& s) {
  std::complex<Scalar> sum(0);
  for (const PlaceMode<Scalar>& mode : modes)
    sum += mode.shape * mode.shape /
           (mode.mass * (s * (s + Scalar(2) * mode.damping_ratio * mode.angular_frequency) +
                         mode.angular_frequency * mode.angular_frequency));
  return sum;
}

/// What the conductor answers at the absorber's place to a force there, and to the drive.
template <class Scalar>
struct PlaceResponse {
  std::complex<Scalar> to_force;  ///< z/F (m/N)
  std::complex<Scalar> to_drive;  ///< G_z = z/s (m/N), the drive pushing the absorber back
};

/// The conductor with its absorber by the receptance of the bare one, without sampling (unchecked):
///
///     1/H′ = 1/H + M_c s²,  K_p = m₂ s² (k₂ + c₂ s)/(m₂ s² + c₂ s + k₂),  T_a = m₂ s²/(…)
///     z/F = H′/(1 + H′ K_p),   G_z = T_a z/F
///
/// The route to a plant's transfer functions that forms no matrix; H may be that of all modes at
/// once.
/// @param bare      H (m/N) at s
/// @param absorber  with its clamp
/// @param s         1/s
template <class Scalar>
PlaceResponse<Scalar> place_response(const std::complex<Scalar>& bare,
                                     const Absorber<Scalar>& absorber,
                                     const std::complex<Scalar>& s) {
  const std::complex<Scalar> inertia = absorber.mass * s * s;
  const std::complex<Scalar> spring = absorber.stiffness + absorber.damping * s;
  const std::complex<Scalar> transmitted = inertia / (inertia + spring);
  const std::complex<Scalar> to_force =
      Scalar(1) / (Scalar(1) / bare + absorber.clamp_mass * s * s + transmitted * spring);
  return {to_force, transmitted * to_force};
}

/// A conductor by N of its modes with the absorber, as a plant of order 2N + 2.
///
///     x = [q₁, q̇₁, …, q_N, q̇_N, z₂, ż₂]
///     f = F + s + k₂ (z₂ − z) + c₂ (ż₂ − ż) − M_c z̈,   m₂ z̈₂ = −s − k₂ (z₂ − z) − c₂ (ż₂ − ż)
///
/// with s the force of the drive. The clamp mass couples the modes; since it acts at one place, the
/// mass matrix diag(M_n) + M_c φ φᵀ has the closed inverse of Sherman and Morrison.
/// The computer reads z and ż of the conductor at the absorber.
/// @throws InvalidParameter where modes or absorber are not admissible
template <class Scalar>
LinearPlant<Scalar> modal_plant(const std::vector<PlaceMode<Scalar>>& modes,
                                const Absorber<Scalar>& absorber) {
  if constexpr (std::is_same_v<Scalar, double>) validate(modes, absorber);
  using Row = RowVector<Scalar, Eigen::Dynamic>;
  using Column = Vector<Scalar, Eigen::Dynamic>;
  const auto count = static_cast<Eigen::Index>(modes.size());
  const Eigen::Index order = 2 * count + 2, z2 = 2 * count, v2 = z2 + 1;

  Row z = Row::Zero(order), v = z;  // of the conductor at the absorber
  Row restoring = z;  // φᵀ (ω² q + 2 ζ ω q̇), what the modes press on the clamp with
  Column receptive = Column::Zero(order);  // φ/M on the velocities
  Scalar mobility(0);                      // Σ φ²/M, 1/kg
  LinearPlant<Scalar> plant;
  plant.released_matrix = Matrix<Scalar, Eigen::Dynamic>::Zero(order, order);
  for (Eigen::Index n = 0; n < count; ++n) {
    const PlaceMode<Scalar>& mode = modes[static_cast<std::size_t>(n)];
    const Eigen::Index q = 2 * n, rate = q + 1;
    const Scalar stiffness = mode.angular_frequency * mode.angular_frequency;
    const Scalar damping = Scalar(2) * mode.damping_ratio * mode.angular_frequency;
    z[q] = v[rate] = mode.shape;
    restoring[q] = mode.shape * stiffness;
    restoring[rate] = mode.shape * damping;
    receptive[rate] = mode.shape / mode.mass;
    mobility += mode.shape * mode.shape / mode.mass;
    plant.released_matrix(q, rate) = Scalar(1);
    plant.released_matrix(rate, q) = -stiffness;
    plant.released_matrix(rate, rate) = -damping;
  }
  const Scalar share = Scalar(1) / (Scalar(1) + absorber.clamp_mass * mobility);
  plant.released_matrix += absorber.clamp_mass * share * receptive * restoring;

  Row relative_z = -z, relative_v = -v;
  relative_z[z2] = relative_v[v2] = Scalar(1);
  plant.excitation = share * receptive;
  plant.force_input = plant.excitation;
  plant.force_input[v2] = Scalar(-1) / absorber.mass;
  plant.released_matrix +=
      plant.force_input * (absorber.stiffness * relative_z + absorber.damping * relative_v);
  plant.released_matrix(z2, v2) += Scalar(1);

  plant.command_input = Column::Zero(order);
  plant.drive_force = Row::Zero(order);
  plant.connections = {
      z, v, z, v, relative_z, relative_v, Column::Unit(order, z2), Column::Unit(order, v2)};
  return plant;
}

}  // namespace holdfast
