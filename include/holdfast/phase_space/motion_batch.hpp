#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "holdfast/contact/hysteresis.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/lanes.hpp"
#include "holdfast/core/select.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/forcing.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/motion/sampled_motion.hpp"

namespace holdfast {

/// The memory of a motion of the sampled loop with backlash: state, previous force and gap.
template <class Scalar>
using ForcedMotionMemory = MotionMemory<Scalar, BacklashMemory<Scalar>>;

/// The memory of a motion before its first sample: no previous force, the drive outside its gap.
inline ForcedMotionMemory<double> memory_of_start(const Vector<double, 4>& initial_state) {
  return {initial_state, 0.0, {false, 0.0, 0.0, 0.0}};
}

/// One of many motions that are run until an orbit of a set attracts them.
struct ActiveTrajectory {
  std::size_t number;                 ///< number of the motion, given by the caller
  ForcedMotionMemory<double> memory;  ///< memory at a stroboscopic instant (phase 0 of the force)
  int orbit = -1;         ///< number of the orbit that attracts the motion; −1: none yet
  bool diverged = false;  ///< whether the state has reached 10¹⁰⁰ or is not a number
};

namespace detail {

/// The memories of the motions in all SIMD lanes, packed side by side.
/// @param of_lane  (lane) → const ForcedMotionMemory<double>&
template <class Scalar, class OfLane>
ForcedMotionMemory<Scalar> packed_memory(const OfLane& of_lane) {
  const auto number = [&](const auto& part) {
    return from_lanes<Scalar>([&](std::size_t lane) -> double { return part(of_lane(lane)); });
  };
  using Memory = ForcedMotionMemory<double>;
  return {from_lanes<Scalar>([&](std::size_t lane) { return of_lane(lane).state; }),
          number([](const Memory& of) { return of.previous_force; }),
          {number([](const Memory& of) { return of.backlash.inside ? 1.0 : 0.0; }) > Scalar(0.5),
           number([](const Memory& of) { return of.backlash.lower; }),
           number([](const Memory& of) { return of.backlash.upper; }),
           number([](const Memory& of) { return of.backlash.previous_velocity; })}};
}

/// The memory of the motion in a single SIMD lane.
template <class Scalar>
ForcedMotionMemory<double> memory_of_lane(const ForcedMotionMemory<Scalar>& memory,
                                          std::size_t lane) {
  const auto number = [lane](const Scalar& pack) { return lane_of(pack, lane); };
  const auto& [inside, lower, upper, velocity] = memory.backlash;
  return {{number(memory.state[0]), number(memory.state[1]), number(memory.state[2]),
           number(memory.state[3])},
          number(memory.previous_force),
          {number(select(inside, Scalar(1), Scalar(0))) > 0.5, number(lower), number(upper),
           number(velocity)}};
}

}  // namespace detail

/// A runner for many motions of one loop. Each motion is run until an orbit of a set attracts it,
/// until it diverges, or for a given number of samples. The motions run in parallel in the lanes of
/// `Scalar`; a lane starts the next motion when its previous one ends.
template <class Scalar>
class MotionBatch {
 public:
  /// @param motion  any motion of the loop at a stroboscopic instant; the state is not used
  explicit MotionBatch(const PeriodicallyForcedMotion<double>& motion)
      : motion_(in_every_lane(motion, Vector<Scalar, 4>::Constant(Scalar(0)).eval())) {}

  /// Runs motions, one per lane at a time.
  /// @param motions        motions to be run; attracted and diverged motions are marked, all others
  ///                       advance by `samples` or more, in whole common periods with the forcing
  /// @param count          number of motions, ≥ 0
  /// @param samples        number of samples, ≥ 1
  /// @param attractor_set  orbits of the loop: an AttractorSet or a type with attracted_by(memory)
  /// @throws InvalidParameter where `samples` is less than 1
  template <class Attractors>
  void run(ActiveTrajectory* motions, std::size_t count, std::int64_t samples,
           const Attractors& attractor_set) {
    require_positive("number of samples", static_cast<double>(samples), "");
    // Looking costs about as much as twenty samples of all lanes.
    const auto period = static_cast<std::int64_t>(motion_.forcing().samples());
    const std::int64_t looks_every = (63 / period + 1) * period;
    const std::int64_t looks = (samples + looks_every - 1) / looks_every;
    ActiveTrajectory* const end = motions + count;
    const auto start_next = [&](Place& place) {
      place = motions == end ? Place{} : Place{motions++, looks};
    };
    std::for_each(places_.begin(), places_.end(), start_next);
    const auto is_taken = [](const Place& place) { return place.motion != nullptr; };
    while (std::any_of(places_.begin(), places_.end(), is_taken)) {
      advance(looks_every);
      for (Place& place : places_)
        if (is_taken(place) && has_ended(place, attractor_set)) start_next(place);
    }
  }

 private:
  struct Place {
    ActiveTrajectory* motion = nullptr;
    std::int64_t looks_left = 0;
  };

  /// Advances all lanes; a lane without a motion starts from the zero state.
  void advance(std::int64_t samples) {
    motion_.restore(
        detail::packed_memory<Scalar>([&](std::size_t lane) -> const ForcedMotionMemory<double>& {
          return places_[lane].motion != nullptr ? places_[lane].motion->memory : at_rest_;
        }));
    for (std::int64_t j = 0; j < samples; ++j) {
      motion_.sense();
      motion_.advance();
    }
    const ForcedMotionMemory<Scalar> memory = motion_.memory();
    for (std::size_t lane = 0; lane < places_.size(); ++lane)
      if (places_[lane].motion != nullptr)
        places_[lane].motion->memory = detail::memory_of_lane(memory, lane);
  }

  /// Whether a lane's motion has diverged, is attracted, or has reached its number of samples.
  template <class Attractors>
  static bool has_ended(Place& place, const Attractors& attractor_set) {
    ActiveTrajectory& motion = *place.motion;
    motion.diverged = !(motion.memory.state.cwiseAbs().maxCoeff() < 1e100);
    if (!motion.diverged) motion.orbit = attractor_set.attracted_by(motion.memory);
    return motion.diverged || motion.orbit >= 0 || --place.looks_left == 0;
  }

  SampledMotion<Scalar, Backlash<Scalar>, PeriodicForcing<double>> motion_;
  ForcedMotionMemory<double> at_rest_ = memory_of_start(Vector<double, 4>::Zero());
  std::array<Place, Lanes<Scalar>::count> places_;
};

}  // namespace holdfast
