#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "holdfast/control/loop_input.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/lanes.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/sweep/sweep_motion.hpp"

namespace holdfast::detail {

/// The matrices of the loops of a sweep, computed only where they differ from those of the previous
/// loop (matrix exponentials cost some microseconds). A derived class may observe the samples by
/// its own operator() and pause(), which hide these members.
class SweepMatrices {
 public:
  struct Matrices {
    SampledLoop<double> sampled;
    HarmonicInput<double> input;
  };

  /// The matrices of a loop. @tparam Loop  IdealLoop<double>
  template <class Loop>
  const Matrices& of(const Loop& loop) {
    const bool same_loop = known_ && numbers_of(known_->plant) == numbers_of(loop.plant) &&
                           known_->sampling.period == loop.sampling.period &&
                           known_->sampling.processing_delay == loop.sampling.processing_delay;
    const bool same_input = same_loop && known_->hold == loop.hold &&
                            (loop.hold == ForceHold::sampled ||
                             known_->excitation.frequency == loop.excitation.frequency);
    if (!same_loop) matrices_.sampled = sampled_loop(loop.plant, loop.sampling);
    if (!same_input) {
      matrices_.input = harmonic_input(loop.plant, matrices_.sampled, loop.hold,
                                       loop.excitation.angular_frequency());
    }
    known_ = loop;
    return matrices_;
  }

  /// Hook called at every sample with the numbers of the motions in the lanes, the sample's index
  /// and the lanes whose drive transmits.
  template <class LaneMask>
  void operator()(const std::size_t* /*motions*/, std::int64_t /*index*/,
                  const LaneMask& /*engaged*/) const {}
  /// Hook called every few hundred samples; in a derived class it may throw.
  void pause() const {}

 private:
  /// The zero matrices that are stored before the first loop.
  static Matrices of_no_loop() {
    const Matrix<double, 4> square = Matrix<double, 4>::Zero();
    const Vector<double, 4> column = Vector<double, 4>::Zero();
    return {{{}, square, square, column, column, column}, {column, column}};
  }

  std::optional<IdealLoop<double>> known_;
  Matrices matrices_ = of_no_loop();
};

/// The sampled loops of all lanes, joined into packs.
template <class Scalar>
SampledLoop<Scalar> loop_from_lanes(
    const std::array<SweepMatrices::Matrices, Lanes<Scalar>::count>& lanes) {
  using Loop = SampledLoop<double>;
  const auto lane = [&](auto member) {
    return from_lanes<Scalar>([&](std::size_t k) -> const auto& {
      return lanes[k].sampled.*member;
    });
  };
  const auto time = [&](auto member) {
    return from_lanes<Scalar>([&](std::size_t k) { return lanes[k].sampled.sampling.*member; });
  };
  return {{time(&Sampling<double>::period), time(&Sampling<double>::processing_delay)},
          lane(&Loop::transition),
          lane(&Loop::increment),
          lane(&Loop::previous_force),
          lane(&Loop::present_force),
          lane(&Loop::held_excitation)};
}

}  // namespace holdfast::detail
