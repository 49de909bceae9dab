#pragma once

#include <complex>
#include <type_traits>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/plant/linear_plant.hpp"

namespace holdfast {

/// A mode of a conductor with its shape at the absorber's place:
///
///     M_n (q̈_n + 2 ζ_n ω_n q̇_n + ω_n² q_n) = φ_n f,   z = Σ φ_n q_n
///
/// where f is the force (N) on the conductor at that place and z its displacement (m).
template <class Scalar>
struct PlaceMode {
  Scalar angular_frequency;  ///< angular frequency ω_n (rad/s), > 0
  Scalar damping_ratio;      ///< damping ratio ζ_n, ≥ 0
  Scalar shape;  ///< shape φ_n at the absorber, in any scaling; M_n is proportional to its square
  Scalar mass;   ///< modal mass M_n (kg), > 0

  /// The response (s²) of q_n to φ_n f/M_n, 1/(s² + 2 ζ_n ω_n s + ω_n²) at s (1/s).
  std::complex<Scalar> response(const std::complex<Scalar>& s) const {
    const std::complex<Scalar> divisor = s * (s + Scalar(2) * damping_ratio * angular_frequency) +
                                         angular_frequency * angular_frequency;
    return std::conj(divisor) / std::norm(divisor);
  }
};

/// The absorber on a conductor, without its drive.
template <class Scalar>
struct Absorber {
  Scalar mass;            ///< mass m₂ (kg), > 0
  Scalar stiffness;       ///< stiffness k₂ of its spring (N/m), ≥ 0
  Scalar damping;         ///< damping c₂ (N s/m), ≥ 0
  Scalar clamp_mass = 0;  ///< mass M_c of the clamp, fixed to the conductor (kg), ≥ 0
};

/// Rejects modes and an absorber outside the ranges stated at their members.
/// @throws InvalidParameter naming the first member that is not admissible
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

/// The receptance of the bare conductor at the absorber's place (m/N; unchecked), H(s) = Σ φ_n² /
/// (M_n (s² + 2 ζ_n ω_n s + ω_n²)).
/// @param modes  modes at the absorber's place
/// @param s      complex frequency (1/s)
template <class Scalar>
std::complex<Scalar> receptance(const std::vector<PlaceMode<Scalar>>& modes,
                                const std::complex<Scalar>& s) {
  const Scalar x = s.real(), y = s.imag();
  Scalar re(0), im(0);
  for (const PlaceMode<Scalar>& mode : modes) {
    const Scalar omega = mode.angular_frequency,
                 beyond = x + Scalar(2) * mode.damping_ratio * omega;
    const Scalar real = (x * beyond - y * y) + omega * omega, imaginary = x * y + y * beyond;
    const Scalar share =
        mode.shape * mode.shape / (mode.mass * (real * real + imaginary * imaginary));
    re += share * real;
    im -= share * imaginary;
  }
  return {re, im};
}

namespace detail {

/// The share T_a(s) = m₂ s²/(m₂ s² + c₂ s + k₂) of the drive's force that acts on the conductor.
template <class Scalar>
std::complex<Scalar> transmitted_share(const Absorber<Scalar>& absorber,
                                       const std::complex<Scalar>& s) {
  const std::complex<Scalar> inertia = absorber.mass * s * s;
  return inertia / (inertia + absorber.stiffness + absorber.damping * s);
}

/// The dynamic stiffness M_c s² + K_p(s) (N/m) of the absorber without its drive, with K_p = T_a
/// (k₂ + c₂ s).
template <class Scalar>
std::complex<Scalar> passive_stiffness(const Absorber<Scalar>& absorber,
                                       const std::complex<Scalar>& s) {
  return absorber.clamp_mass * s * s +
         transmitted_share(absorber, s) * (absorber.stiffness + absorber.damping * s);
}

}  // namespace detail

/// The responses of the conductor at the absorber's place, to a force there and to the drive.
template <class Scalar>
struct PlaceResponse {
  std::complex<Scalar> to_force;  ///< receptance z/F (m/N)
  std::complex<Scalar> to_drive;  ///< response G_z (m/N) of z to the drive's force
};

/// The responses of a conductor with absorber, from the bare conductor's receptance H (unchecked):
///
///     1/H′ = 1/H + M_c s²,   T_a = m₂ s²/(m₂ s² + c₂ s + k₂),   K_p = T_a (k₂ + c₂ s)
///     z/F = H′/(1 + H′ K_p),   G_z = T_a z/F
///
/// H′ includes the clamp, K_p is the absorber's dynamic stiffness without its drive, and T_a the
/// share of the drive's force that acts on the conductor. H may include any number of modes.
/// @param bare      receptance H (m/N) at s
/// @param absorber  absorber with its clamp
/// @param s         complex frequency (1/s)
template <class Scalar>
PlaceResponse<Scalar> place_response(const std::complex<Scalar>& bare,
                                     const Absorber<Scalar>& absorber,
                                     const std::complex<Scalar>& s) {
  const std::complex<Scalar> to_force =
      Scalar(1) / (Scalar(1) / bare + detail::passive_stiffness(absorber, s));
  return {to_force, detail::transmitted_share(absorber, s) * to_force};
}

namespace detail {

/// Coordinates of N modes, N × 1, scaled to a displacement of 1 at the absorber's place.
/// @param share  function from a mode to its coordinate before scaling
template <class Scalar, class Share>
Vector<Scalar, Eigen::Dynamic> scaled_at_place(const std::vector<PlaceMode<Scalar>>& modes,
                                               const Share& share) {
  Vector<Scalar, Eigen::Dynamic> shares(static_cast<Eigen::Index>(modes.size()));
  Scalar there(0);
  Eigen::Index n = 0;
  for (const PlaceMode<Scalar>& mode : modes) {
    shares[n] = share(mode);
    there += mode.shape * shares[n++];
  }
  return shares / there;
}

}  // namespace detail

/// The modal coordinates q (N × 1) of a conductor deflected statically by a force at the absorber's
/// place, with a displacement of 1 m there.
/// @param modes  modes at the absorber's place, at least one without a node there (unchecked)
template <class Scalar>
Vector<Scalar, Eigen::Dynamic> bent_conductor(const std::vector<PlaceMode<Scalar>>& modes) {
  return detail::scaled_at_place(modes, [](const PlaceMode<Scalar>& mode) {
    return mode.shape / (mode.mass * mode.angular_frequency * mode.angular_frequency);
  });
}

/// The modal velocities q̇ (N × 1) of a conductor after an impulse at the absorber's place that
/// gives this place a velocity of 1 m/s (unchecked).
/// @param modes  modes at the absorber's place
template <class Scalar>
Vector<Scalar, Eigen::Dynamic> struck_conductor(const std::vector<PlaceMode<Scalar>>& modes) {
  return detail::scaled_at_place(
      modes, [](const PlaceMode<Scalar>& mode) { return mode.shape / mode.mass; });
}

/// The state [q₁, q̇₁, …, q_N, q̇_N, z₂, ż₂] of `modal_plant` with given [z, ż, z₂, ż₂]
/// (unchecked). The conductor is deflected to z by a static force at the absorber's place, and has
/// the velocities after an impulse there that gives ż.
/// @param modes  modes at the absorber's place
/// @param seen   observed state [z, ż, z₂, ż₂] (m, m/s, m, m/s)
template <class Scalar>
Vector<Scalar, Eigen::Dynamic> modal_state(const std::vector<PlaceMode<Scalar>>& modes,
                                           const Vector<Scalar, 4>& seen) {
  const auto absorber = static_cast<Eigen::Index>(2 * modes.size());
  Vector<Scalar, Eigen::Dynamic> state(absorber + 2);
  state(Eigen::seq(0, absorber - 2, 2)) = seen[0] * bent_conductor(modes);
  state(Eigen::seq(1, absorber - 1, 2)) = seen[1] * struck_conductor(modes);
  state.tail(2) = seen.template tail<2>();
  return state;
}

namespace detail {

/// The equations of motion of a conductor's modes, with input and output at the absorber's place.
template <class Scalar>
struct ModesAtPlace {
  Matrix<Scalar, Eigen::Dynamic> released;      // of the bare modes
  RowVector<Scalar, Eigen::Dynamic> z, v;       // of the conductor at the place
  RowVector<Scalar, Eigen::Dynamic> restoring;  // φᵀ(ω² q + 2ζω q̇), which presses on a clamp
  Vector<Scalar, Eigen::Dynamic> receptive;     // φ/M on the velocities
  Scalar mobility{0};                           // Σ φ²/M, 1/kg

  /// Sets the rows of N modes. @param order  2N plus the number of further states, with rows 0
  ModesAtPlace(const std::vector<PlaceMode<Scalar>>& modes, Eigen::Index order)
      : released(Matrix<Scalar, Eigen::Dynamic>::Zero(order, order)),
        z(RowVector<Scalar, Eigen::Dynamic>::Zero(order)),
        v(z),
        restoring(z),
        receptive(z.transpose()) {
    Eigen::Index q = 0;
    for (const PlaceMode<Scalar>& mode : modes) {
      const Scalar stiffness = mode.angular_frequency * mode.angular_frequency;
      const Scalar damping = Scalar(2) * mode.damping_ratio * mode.angular_frequency;
      z[q] = v[q + 1] = mode.shape;
      restoring[q] = mode.shape * stiffness;
      restoring[q + 1] = mode.shape * damping;
      receptive[q + 1] = mode.shape / mode.mass;
      mobility += mode.shape * mode.shape / mode.mass;
      released(q, q + 1) = Scalar(1);
      released(q + 1, q) = -stiffness;
      released(q + 1, q + 1) = -damping;
      q += 2;
    }
  }
};

}  // namespace detail

/// The plant of order 2N + 2 that consists of N modes of a conductor and the absorber.
///
///     x = [q₁, q̇₁, …, q_N, q̇_N, z₂, ż₂]
///     f = F + s + k₂ (z₂ − z) + c₂ (ż₂ − ż) − M_c z̈,   m₂ z̈₂ = −s − k₂ (z₂ − z) − c₂ (ż₂ − ż)
///
/// F (N) is the excitation and s (N) the drive's force. The clamp mass M_c couples the modes; since
/// it acts at one place, the mass matrix diag(M_n) + M_c φ φᵀ has the closed inverse of Sherman and
/// Morrison. The computer reads z and ż of the conductor at the absorber.
/// @throws InvalidParameter where modes or absorber are not admissible
template <class Scalar>
LinearPlant<Scalar> modal_plant(const std::vector<PlaceMode<Scalar>>& modes,
                                const Absorber<Scalar>& absorber) {
  if constexpr (std::is_same_v<Scalar, double>) validate(modes, absorber);
  const auto z2 = static_cast<Eigen::Index>(2 * modes.size()), v2 = z2 + 1, order = z2 + 2;
  const detail::ModesAtPlace<Scalar> conductor(modes, order);
  RowVector<Scalar, Eigen::Dynamic> relative_z = -conductor.z, relative_v = -conductor.v;
  relative_z[z2] = relative_v[v2] = Scalar(1);

  LinearPlant<Scalar> plant;
  const Scalar share = Scalar(1) / (Scalar(1) + absorber.clamp_mass * conductor.mobility);
  plant.excitation = share * conductor.receptive;
  plant.force_input = plant.excitation;
  plant.force_input[v2] = Scalar(-1) / absorber.mass;
  plant.released_matrix =
      conductor.released + absorber.clamp_mass * share * conductor.receptive * conductor.restoring +
      plant.force_input * (absorber.stiffness * relative_z + absorber.damping * relative_v);
  plant.released_matrix(z2, v2) += Scalar(1);

  plant.command_input = Vector<Scalar, Eigen::Dynamic>::Zero(order);
  plant.drive_force = RowVector<Scalar, Eigen::Dynamic>::Zero(order);
  plant.connections = {conductor.z,
                       conductor.v,
                       conductor.z,
                       conductor.v,
                       relative_z,
                       relative_v,
                       Vector<Scalar, Eigen::Dynamic>::Unit(order, z2),
                       Vector<Scalar, Eigen::Dynamic>::Unit(order, v2)};
  return plant;
}

}  // namespace holdfast
