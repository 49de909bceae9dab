#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/quantiser.hpp"
#include "holdfast/core/errors.hpp"

namespace holdfast {

/// The source of the conductor's velocity in the controller.
enum class VelocitySensing {
  measured,    ///< a velocity sensor
  difference,  ///< the backward difference of the displacement readings
};

/// The quantisation, velocity sensing and saturation of a real controller; none by default.
struct ControllerLimits {
  double displacement_quantum = 0;  ///< resolution q_z (m) of the displacement, ≥ 0; 0: exact
  double velocity_quantum = 0;  ///< resolution q_v (m/s) of a measured velocity, ≥ 0; 0: exact;
                                ///< not used with VelocitySensing::difference
  /// Source of the velocity v̂_j in the command.
  VelocitySensing velocity = VelocitySensing::measured;
  double largest_force = std::numeric_limits<double>::infinity();  ///< bound u_max (N) of |u|, > 0
};

/// Whether the limits are ideal: they leave the control law u = P z₁ + D ż₁ unchanged.
inline bool is_ideal(const ControllerLimits& limits) {
  return limits.displacement_quantum == 0 && limits.velocity_quantum == 0 &&
         limits.velocity == VelocitySensing::measured &&
         limits.largest_force == std::numeric_limits<double>::infinity();
}

/// Validates the limits. @throws InvalidParameter unless both quanta are finite and ≥ 0 and the
/// largest force is > 0 (infinity: no limit)
inline void validate(const ControllerLimits& limits) {
  require_non_negative("displacement quantum", limits.displacement_quantum, "m");
  require_non_negative("velocity quantum", limits.velocity_quantum, "m/s");
  if (!(limits.largest_force > 0)) {
    throw InvalidParameter("largest force", limits.largest_force, "N", "> 0");
  }
}

/// The memory of a controller: its previous reading.
struct ControllerMemory {
  double previous_displacement = 0;  ///< displacement reading ẑ_{j−1} (m); valid if has_sampled
  bool has_sampled = false;          ///< whether there was a previous sample
};

/// Derivatives of a command u_j by the displacement z₁ and the velocity ż₁ of the conductor.
struct ControllerSlope {
  double displacement = 0;           ///< derivative ∂u_j/∂z₁ by z₁ at t_j (N/m)
  double velocity = 0;               ///< derivative ∂u_j/∂ż₁ by ż₁ at t_j (N s/m)
  double previous_displacement = 0;  ///< derivative ∂u_j/∂z₁ by z₁ at t_{j−1} (N/m)
};

/// The proportional–differential law with gains P and D and with ControllerLimits:
///
///     ẑ_j = q_z round(z₁ / q_z)
///     v̂_j = q_v round(ż₁ / q_v)        measured
///         = (ẑ_j − ẑ_{j−1}) / h_j       difference; 0 at the first sample
///     u_j = min(max(P ẑ_j + D v̂_j, −u_max), u_max)
///
/// h_j is the time since the previous sample. With ideal limits u_j is P z₁ + D ż₁ to the last bit,
/// unless the compiler fuses products with sums. Where the velocity is a difference, v̂_j changes in
/// steps of q_z / h_j, and q_v has no effect. No memory is allocated.
///
/// Sources: Kollár 2022, Eq. (5), for the law; for the rounding see `quantised`.
class Controller {
 public:
  /// Controller before its first sample. @throws InvalidParameter for inadmissible gains or limits
  Controller(const PdGains<double>& gains, const ControllerLimits& limits)
      : gains_(gains), limits_(limits) {
    validate(gains_);
    validate(limits_);
  }

  /// Computes the command of sample j. @return u_j (N), within ±u_max
  /// @param displacement  displacement z₁ (m)
  /// @param velocity      velocity ż₁ (m/s); not used where the velocity is a difference
  /// @param elapsed       time h_j (s) since the previous sample, > 0; used only where the velocity
  ///                      is a difference, from the second sample on
  /// @throws InvalidParameter where h_j is used and not finite and > 0; the controller is unchanged
  double command(double displacement, double velocity, double elapsed) {
    const bool differs = limits_.velocity == VelocitySensing::difference;
    if (differs && memory_.has_sampled)
      require_positive("time since the last sample", elapsed, "s");
    const double read = quantised(displacement, limits_.displacement_quantum);
    const double rate =
        differs ? difference(read, elapsed) : quantised(velocity, limits_.velocity_quantum);
    const double demand = gains_.proportional * read + gains_.differential * rate;
    const bool saturates = std::abs(demand) > limits_.largest_force;
    slope_ = saturates ? ControllerSlope{} : free_slope(elapsed);
    memory_ = {read, true};
    return std::clamp(demand, -limits_.largest_force, limits_.largest_force);
  }

  /// The derivatives of the last command. All are zero under saturation, |P ẑ_j + D v̂_j| > u_max,
  /// before the first command and after `restore`. A derivative by a quantised reading is zero.
  const ControllerSlope& slope() const { return slope_; }

  /// Memory of the controller, on which its next commands depend.
  const ControllerMemory& memory() const { return memory_; }
  /// Copies the memory of a controller with the same gains and limits; the slopes become zero.
  void restore(const ControllerMemory& memory) {
    memory_ = memory;
    slope_ = {};
  }
  /// The resolutions of the readings, the largest force and the source of the velocity.
  const ControllerLimits& limits() const { return limits_; }

 private:
  double difference(double read, double elapsed) const {
    return memory_.has_sampled ? (read - memory_.previous_displacement) / elapsed : 0.0;
  }

  /// The slope without saturation; to be called before the sample is stored in the memory.
  ControllerSlope free_slope(double elapsed) const {
    const double through_displacement =
        limits_.displacement_quantum > 0 ? 0.0 : gains_.proportional;
    if (limits_.velocity == VelocitySensing::measured) {
      return {through_displacement, limits_.velocity_quantum > 0 ? 0.0 : gains_.differential, 0.0};
    }
    if (limits_.displacement_quantum > 0 || !memory_.has_sampled) {
      return {through_displacement, 0.0, 0.0};
    }
    const double through_difference = gains_.differential / elapsed;
    return {through_displacement + through_difference, 0.0, -through_difference};
  }

  PdGains<double> gains_;
  ControllerLimits limits_;
  ControllerMemory memory_;
  ControllerSlope slope_;
};

}  // namespace holdfast
