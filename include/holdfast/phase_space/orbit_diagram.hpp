#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/harmonic.hpp"
#include "holdfast/excitation/harmonic_excitation.hpp"
#include "holdfast/excitation/multi_harmonic_force.hpp"
#include "holdfast/motion/dense_output.hpp"
#include "holdfast/motion/divergence.hpp"
#include "holdfast/motion/event_motion.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/motion/modal/modal_motion.hpp"
#include "holdfast/motion/modal/natural_motions.hpp"
#include "holdfast/plant/linear_plant.hpp"
#include "holdfast/plant/plant_poles.hpp"
#include "holdfast/plant/ports.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// Options of an orbit diagram: what it shows at each value of its parameter.
struct DiagramOptions {
  double transient = 30.0;           ///< s, ≥ 0: left out at each value
  int strobes = 50;                  ///< 1 … 10⁶: forcing periods that are shown
  std::function<void()> watch = {};  ///< called now and then; may throw to end the diagram
};

/// @throws InvalidParameter where it is not admissible
inline void validate(const DiagramOptions& options) {
  require_non_negative("transient", options.transient, "s");
  require_within("number of strobes", options.strobes, "", 1.0, 1e6);
}

/// One point of an orbit diagram.
struct StrobePoint {
  std::size_t index;  ///< of the parameter's value
  bool upward;        ///< on the way up, the values in their order; else on the way back
  /// [z, ż, z₂, ż₂] (m, m/s, m, m/s), conductor and absorber on both sides of the gap, at a whole
  /// number of forcing periods.
  Vector<double, 4> state;
};

namespace detail {

/// The state of the loops on a path.
template <class Loop>
struct StateOfLoop {
  using Type = StateOf<std::decay_t<decltype(std::declval<const Loop&>().plant)>>;
};
template <>
struct StateOfLoop<ModalLoop> {
  using Type = ModalMotion::Full;
};
template <class Family>
using StateOfFamily =
    typename StateOfLoop<std::decay_t<decltype(std::declval<const Family&>()(0.0))>>::Type;

/// Whether a motion of the loop may begin with a state: whether that has its order.
template <class Plant>
bool may_begin_with(const ImplementedLoopOf<Plant>& loop, const StateOf<Plant>& state) {
  return loop.plant.state_matrix().rows() == state.size();
}
/// Always so of a conductor: with more or fewer modes it keeps the slow ones (`show_strobes`).
inline bool may_begin_with(const ModalLoop&, const ModalMotion::Full&) { return true; }

/// Shows both sides of the gap once every forcing period after the transient; leaves the last state
/// in `state`. @return false where it leaves the range of numbers
/// @param state  the initial one
/// @throws InvalidParameter where the force has no harmonic
template <class Plant, class Observer>
bool show_strobes(const ImplementedLoopOf<Plant>& loop, const DiagramOptions& options,
                  StateOf<Plant>& state, Observer&& observer) {
  const std::vector<Harmonic>& harmonics = loop.digital.force.harmonics;
  if (harmonics.empty())
    throw InvalidParameter("number of harmonics", 0.0, "",
                           ">= 1: the strobes are at whole periods of the first one");
  const double forcing_period = 1.0 / harmonics.front().frequency;
  const double bound = divergence_bound(loop, state);
  constexpr std::int64_t samples_between_looks = 1 << 14;
  auto motion = event_motion(loop, state);
  DenseOutput between(motion);
  auto strobe = std::ceil(options.transient / forcing_period);
  for (int shown = 0; shown < options.strobes;) {
    const auto sample = motion.sense();
    if (!(sample.state.cwiseAbs().maxCoeff() < bound)) return false;
    if (options.watch && sample.index % samples_between_looks == 0) options.watch();
    // A strobe that falls on a sample but for rounding is that sample.
    const double period = motion.period(), end = period * (1.0 - 1e-9);
    double after = strobe * forcing_period - sample.time;
    if (!(after < end)) {
      motion.advance();
      continue;
    }
    between.begin();
    motion.advance(between);
    for (; shown < options.strobes && after < end; after += forcing_period) {
      const bool at_sample = after < 1e-9 * period;
      state = at_sample ? sample.state : between.state(after);
      observer(motion.readings().both_sides(state));
      ++shown;
      strobe += 1.0;
    }
  }
  return true;
}

/// ξ of a motion some time after its present sample, which it has taken.
/// @param after  s, < τ
/// @param force  what it has decided at that sample (N)
inline Eigen::VectorXcd amplitudes_after(const NaturalMotions& motions, const ModalMotion& motion,
                                         const HarmonicExcitation<double>& excitation, double after,
                                         double force) {
  const double phase = excitation.angular_frequency() * motion.time();
  const double cosine = excitation.amplitude * std::cos(phase),
               sine = excitation.amplitude * std::sin(phase);
  Eigen::VectorXcd amplitudes = motion.amplitudes();
  for (std::size_t k = 0; k < motions.size(); ++k) {
    const NaturalMotion of = motions.over(k, after);
    auto& amplitude = amplitudes[static_cast<Eigen::Index>(k)];
    amplitude = of.decay * amplitude + of.present * force +
                of.past * motion.memory().previous_force + of.cosine * cosine + of.sine * sine;
  }
  return amplitudes;
}

/// Shows the strobes of a conductor by its modes.
/// @throws InvalidParameter where its natural motions are not all found
template <class Observer>
bool show_strobes(const ModalLoop& loop, const DiagramOptions& options, ModalMotion::Full& state,
                  Observer&& observer) {
  // The loop before may have kept other modes apart: the slow ones are the same.
  const auto modes = 2 * static_cast<Eigen::Index>(loop.modes.size());
  const Eigen::Index kept = std::min(modes, state.size() - 2);
  ModalMotion::Full begin = ModalMotion::Full::Zero(modes + 2);
  begin << state.head(kept), ModalMotion::Full::Zero(modes - kept), state.tail(2);
  std::optional<ModalMotion> motion = modal_motion(loop, begin);
  if (!motion)
    throw InvalidParameter("natural motions that coincide", 0.0, "", "none: change the plant");
  const NaturalMotions motions(loop, plant_poles(loop.modes, loop.absorber));
  const double period = loop.sampling.period, forcing_period = 1.0 / loop.excitation.frequency;
  const double bound = divergence_bound(loop, begin);
  constexpr std::int64_t samples_between_looks = 1 << 14;
  auto strobe = std::ceil(options.transient / forcing_period);
  for (int shown = 0; shown < options.strobes;) {
    const MotionSample<double> sample = motion->sense();
    if (!(sample.state.cwiseAbs().maxCoeff() < bound)) return false;
    if (options.watch && sample.index % samples_between_looks == 0) options.watch();
    double after = strobe * forcing_period - sample.time;
    for (; shown < options.strobes && after < period * (1.0 - 1e-9); after += forcing_period) {
      const bool at_sample = after < 1e-9 * period;
      const Eigen::VectorXcd amplitudes =
          at_sample
              ? motion->amplitudes()
              : amplitudes_after(motions, *motion, loop.excitation, after, sample.control_force);
      observer(at_sample ? sample.state : motions.seen(amplitudes));
      if (++shown == options.strobes) state = motions.state_of(amplitudes);
      strobe += 1.0;
    }
    motion->advance();
  }
  return true;
}

}  // namespace detail

/// An orbit diagram (bifurcation diagram): stroboscopic states against a parameter, the parameter
/// going up through its values and back, each motion beginning where the last one ended, at the
/// excitation's peak. Where the two ways differ, attractors may coexist, if the transient is over
/// and the strobes cover the period.
///
/// The strobes are at whole periods of the first harmonic of the force, from t = 0 on; where there
/// are more harmonics or a record, a motion begins with them at t = 0 again, and only a common
/// period keeps their phases from one motion to the next.
///
/// The drive begins outside its backlash at each value (a dead zone where the state is), the
/// computer without a memory of the past. A motion that diverges shows no more of itself, and
/// the next one begins at the initial state; so does one whose loop has another order than that
/// before, as where commands on their way become more.
/// @param family         parameter ↦ ImplementedLoopOf<Plant>, or ModalLoop
/// @param values         of the parameter, in their order
/// @param initial_state  a state, or parameter ↦ state
/// @param options        how much is left out and shown at each value
/// @param observer       called with each `StrobePoint`
/// @return how many of the motions, two for each value, diverged
/// @throws InvalidParameter where the question or a loop is not admissible, or its force has no
/// harmonic
template <class Family, class Initial, class Observer>
std::size_t run_orbit_diagram(const Family& family, const std::vector<double>& values,
                              const Initial& initial_state, const DiagramOptions& options,
                              Observer&& observer) {
  using State = detail::StateOfFamily<Family>;
  validate(options);
  const auto initial = [&](double value) -> State {
    if constexpr (std::is_convertible_v<const Initial&, State>)
      return initial_state;
    else
      return initial_state(value);
  };
  std::optional<State> state;  // none: the motion begins anew
  std::size_t diverged = 0;
  for (const bool upward : {true, false}) {
    for (std::size_t k = 0; k < values.size(); ++k) {
      const std::size_t index = upward ? k : values.size() - 1 - k;
      const auto loop = family(values[index]);
      if (!state || !detail::may_begin_with(loop, *state)) state = initial(values[index]);
      if (detail::show_strobes(loop, options, *state, [&](const Vector<double, 4>& sides) {
            observer(StrobePoint{index, upward, sides});
          }))
        continue;
      state.reset();
      ++diverged;
    }
  }
  return diverged;
}

}  // namespace holdfast
