#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <type_traits>

#include "holdfast/contact/contact_guard.hpp"
#include "holdfast/control/digital_loop.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/excitation/force_over_samples.hpp"
#include "holdfast/motion/no_event_bound.hpp"
#include "holdfast/motion/subinterval_step.hpp"
#include "holdfast/plant/affine_dynamics.hpp"
#include "holdfast/plant/decaying_norm.hpp"
#include "holdfast/plant/energy.hpp"
#include "holdfast/plant/ports.hpp"

namespace holdfast {

namespace detail {

/// The norm of a plant's states without the states of its controller. The controller's states come
/// last, are constant between the samples and enter no guard.
template <int any>
class NormBesideController {
 public:
  explicit NormBesideController(const Matrix<double, any>& a)
      : order_(order_of(a)), norm_(a.topLeftCorner(order_, order_)) {}
  double operator()(const Vector<double, any>& x) const { return norm_(x.head(order_)); }
  double dual(const Vector<double, any>& row) const { return norm_.dual(row.head(order_)); }

 private:
  static Eigen::Index order_of(const Matrix<double, any>& a) {
    Eigen::Index order = a.rows();
    while (order > 1 && a.row(order - 1).isZero(0.0) && a.col(order - 1).isZero(0.0)) --order;
    return order;
  }

  Eigen::Index order_;
  DecayingNorm<any> norm_;
};

template <class Plant>
using NormOf = std::conditional_t<
    HasController<Plant>::value, NormBesideController<Eigen::Dynamic>,
    std::conditional_t<HasPorts<Plant>::value, DecayingNorm<states_of<Plant>>, EnergyNorm>>;

}  // namespace detail

/// The motion of a plant in one contact mode, with exact steps over the two parts of a sampling
/// period: part 0 before t_j + δ, part 1 after it (δ: processing delay).
template <class Plant>
class ModeMotion {
 public:
  static constexpr int states = states_of<Plant>;  ///< N, the order of the plant
  /// A norm that bounds the state: EnergyNorm for the two masses, else based on DecayingNorm.
  using Norm = detail::NormOf<Plant>;
  using Bound = NoEventBoundOf<Norm, states>;  ///< bound that may prove that a guard has no zero

  /// The largest admissible ‖A‖ τ and ω τ, with the state matrix A, the highest forcing frequency ω
  /// (rad/s) and the sampling period τ. A period with a contact change takes about max(‖A‖, ω) τ
  /// Taylor series: this limits the work.
  static constexpr double most_turns_per_sample = 1e6;

  /// Constructs the motion from the mode's equations of motion, the loop and its excitation.
  /// @throws InvalidParameter where ‖A‖ τ or ω τ exceeds `most_turns_per_sample`
  ModeMotion(const AffineDynamicsOf<states>& dynamics, const DigitalLoop& loop,
             const ForceOverSamples& force)
      : dynamics_(dynamics),
        rate_(admissible_rate(
            std::max(balanced_norm(dynamics.state), force.highest_angular_frequency()),
            loop.sampling.period)),
        steps_{{{dynamics, loop.force.harmonics, 0.0, loop.sampling.processing_delay},
                {dynamics, loop.force.harmonics, loop.sampling.processing_delay,
                 loop.sampling.period - loop.sampling.processing_delay}}} {}

  /// The matrices A, b, c and the drift of the mode.
  const AffineDynamicsOf<states>& dynamics() const { return dynamics_; }
  /// The mode's rate max(‖A‖, ω) (1/s): a Taylor series over a time ≤ 1/rate is exact to rounding.
  double rate() const { return rate_; }
  /// The exact step over part 0 (t_j to t_j + δ) or part 1 (t_j + δ to t_{j+1}) of the period.
  const SubintervalStep<states>& step(std::size_t part) const { return steps_[part]; }

  /// The bound that may prove that no guard of the mode has a zero. It is constructed at the first
  /// call; later calls ignore the arguments.
  /// @param law    contact of the drive; for two masses its plant(mode) defines the EnergyNorm
  /// @param mode   number of the mode
  /// @param guard  one of the mode's guards
  /// @param force  the excitation
  template <class Law>
  const Bound& bound(const Law& law, int mode, const GuardOf<states>& guard,
                     const ForceOverSamples& force) {
    if (bound_ == std::nullopt) {
      if constexpr (detail::HasPorts<Plant>::value) {
        bound_.emplace(dynamics_, dynamics_.state, guard, force.bounds());
      } else {
        bound_.emplace(dynamics_, law.plant(mode), guard, force.bounds());
      }
    }
    return *bound_;
  }

 private:
  static double admissible_rate(double rate, double period) {
    if (rate * period <= most_turns_per_sample) return rate;
    throw InvalidParameter("fastest rate of the motion times the sampling period", rate * period,
                           "", "at most 1e6: reduce the sampling period");
  }

  AffineDynamicsOf<states> dynamics_;
  double rate_;
  std::array<SubintervalStep<states>, 2> steps_;
  std::optional<Bound> bound_;
};

}  // namespace holdfast
