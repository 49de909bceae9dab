#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "holdfast/contact/hysteresis.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/lanes.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/forcing.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/motion/sampled_motion.hpp"

namespace holdfast {

/// What a motion of the sampled loop with backlash remembers.
template <class Scalar>
using ForcedMotionMemory = MotionMemory<Scalar, BacklashMemory<Scalar>>;

/// A motion that begins at rest in its drive.
inline ForcedMotionMemory<double> memory_of_start(const Vector<double, 4>& initial_state) {
  return {initial_state, 0.0, {false, 0.0, 0.0, 0.0}};
}

/// One of many motions on its way to an orbit.
struct ActiveTrajectory {
  std::size_t number;                 ///< the caller's
  ForcedMotionMemory<double> memory;  ///< at a stroboscopic instant (sampling and forcing in phase)
  int orbit = -1;                     ///< of the set, once attracted
  bool diverged = false;  ///< an entry of its state has reached 10¹⁰⁰, or is no number
};

namespace detail {

/// The lanes of a motion's memory as numbers: z₁ … ż₂, u, inside, lower, upper, Δż.
template <class Scalar>
class MemoryLanes {
  using Lane = Lanes<Scalar>;

 public:
  void put(std::size_t lane, const ForcedMotionMemory<double>& memory) {
    for (std::size_t k = 0; k < 4; ++k)
      numbers_[k][lane] = memory.state[static_cast<Eigen::Index>(k)];
    numbers_[4][lane] = memory.previous_force;
    numbers_[5][lane] = memory.backlash.inside ? 1.0 : 0.0;
    numbers_[6][lane] = memory.backlash.lower;
    numbers_[7][lane] = memory.backlash.upper;
    numbers_[8][lane] = memory.backlash.previous_velocity;
  }

  ForcedMotionMemory<double> get(std::size_t lane) const {
    return {{numbers_[0][lane], numbers_[1][lane], numbers_[2][lane], numbers_[3][lane]},
            numbers_[4][lane],
            {numbers_[5][lane] > 0.5, numbers_[6][lane], numbers_[7][lane], numbers_[8][lane]}};
  }

  void read(const ForcedMotionMemory<Scalar>& memory) {
    for (std::size_t k = 0; k < 4; ++k)
      Lane::store(memory.state[static_cast<Eigen::Index>(k)], numbers_[k].data());
    std::array<std::uint8_t, Lane::count> inside;
    Lane::store_flags(memory.backlash.inside, inside.data());
    std::copy(inside.begin(), inside.end(), numbers_[5].begin());
    Lane::store(memory.previous_force, numbers_[4].data());
    Lane::store(memory.backlash.lower, numbers_[6].data());
    Lane::store(memory.backlash.upper, numbers_[7].data());
    Lane::store(memory.backlash.previous_velocity, numbers_[8].data());
  }

  ForcedMotionMemory<Scalar> pack() const {
    const auto load = [this](std::size_t k) { return Lane::load(numbers_[k].data()); };
    return {{load(0), load(1), load(2), load(3)},
            load(4),
            {load(5) > Scalar(0.5), load(6), load(7), load(8)}};
  }

 private:
  std::array<std::array<double, Lane::count>, 9> numbers_{};
};

}  // namespace detail

/// Moves many motions of one loop on until each is attracted by an orbit of a set, diverges,
/// or has gone a given number of samples: as many at a time as `Scalar` has lanes, a lane taking
/// the next motion as soon as its own has ended.
template <class Scalar>
class MotionBatch {
  using Lane = Lanes<Scalar>;
  using Forcing = SharedForcing<Scalar, PeriodicForcing<double>>;

 public:
  /// @param motion  of the loop, at a stroboscopic instant; its state does not matter
  /// @param gains   of the loop
  /// @param ratio   of forcing_ratio(loop)
  MotionBatch(const PeriodicallyForcedMotion<double>& motion, const PdGains<double>& gains,
              const Rational& ratio)
      : ratio_(ratio),
        motion_(converted<Scalar>(motion.loop()),
                {Scalar(gains.proportional), Scalar(gains.differential)}, Forcing(motion.forcing()),
                Backlash<Scalar>(Scalar(motion.law().width())),
                Vector<Scalar, 4>::Constant(Scalar(0))) {}

  /// @param motions        attracted and diverged ones are marked, the others have moved on by at
  ///                       least `samples` samples, a whole number of common periods
  /// @param count          number of motions, ≥ 0
  /// @param samples        ≥ 1
  /// @param attractor_set  of orbits of the same loop: AttractorSet, or what else has an
  ///                       attracted_by(memory)
  /// @throws InvalidParameter for less than one sample
  template <class Attractors>
  void run(ActiveTrajectory* motions, std::size_t count, std::int64_t samples,
           const Attractors& attractor_set) {
    require_positive("number of samples", static_cast<double>(samples), "");
    // Looking costs about as much as twenty samples of all lanes.
    const std::int64_t looks_every = (63 / ratio_.denominator + 1) * ratio_.denominator;
    const std::int64_t looks = (samples + looks_every - 1) / looks_every;
    std::size_t next = 0;
    for (Place& place : places_) start(place, motions, count, next, looks);
    while (std::any_of(places_.begin(), places_.end(),
                       [](const Place& place) { return place.motion != nullptr; })) {
      motion_.restore(lanes_.pack());
      for (std::int64_t j = 0; j < looks_every; ++j) {
        motion_.sense();
        motion_.advance();
      }
      lanes_.read(motion_.memory());
      for (std::size_t lane = 0; lane < Lane::count; ++lane) {
        if (look(lane, attractor_set)) start(places_[lane], motions, count, next, looks);
      }
    }
  }

 private:
  struct Place {
    ActiveTrajectory* motion = nullptr;
    std::int64_t looks_left = 0;
  };

  /// Puts the next motion, if there is one, into a lane.
  void start(Place& place, ActiveTrajectory* motions, std::size_t count, std::size_t& next,
             std::int64_t looks) {
    place = {};
    if (next == count) return;
    place = {motions + next++, looks};
    lanes_.put(static_cast<std::size_t>(&place - places_.data()), place.motion->memory);
  }

  /// Whether a lane's motion has ended, or its samples have.
  template <class Attractors>
  bool look(std::size_t lane, const Attractors& attractor_set) {
    Place& place = places_[lane];
    if (place.motion == nullptr) return false;
    ActiveTrajectory& motion = *place.motion;
    motion.memory = lanes_.get(lane);
    motion.diverged = !(motion.memory.state.cwiseAbs().maxCoeff() < 1e100);
    if (!motion.diverged) motion.orbit = attractor_set.attracted_by(motion.memory);
    return motion.diverged || motion.orbit >= 0 || --place.looks_left == 0;
  }

  Rational ratio_;
  SampledMotion<Scalar, Backlash<Scalar>, Forcing> motion_;
  detail::MemoryLanes<Scalar> lanes_;
  std::array<Place, Lane::count> places_;
};

}  // namespace holdfast
