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

/// The options of an orbit diagram for each value of its parameter.
struct DiagramOptions {
  double transient = 30.0;  ///< time before the first plotted state at each value (s), ≥ 0
  int strobes = 50;  ///< number of states plotted at each value, one per force period, 1 … 10⁶
  std::function<void()> watch = {};  ///< called every 2¹⁴ samples; may throw to end the diagram
};

/// Validates the options. @throws InvalidParameter where they are not admissible
inline void validate(const DiagramOptions& options) {
  require_non_negative("transient", options.transient, "s");
  require_within("number of strobes", options.strobes, "", 1.0, 1e6);
}

/// One point of an orbit diagram.
struct StrobePoint {
  std::size_t index;  ///< index of the parameter's value in the list of values
  bool upward;        ///< true while the values are passed in order, false in reverse order
  /// The state [z, ż, z₂, ż₂] of conductor and absorber (m, m/s, m, m/s) at a stroboscopic time.
  Vector<double, 4> state;
};

namespace detail {

/// The type of the state with which a motion of a loop begins.
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

/// Whether a state has the order of the loop, so that a motion may begin with it.
template <class Plant>
bool may_begin_with(const ImplementedLoopOf<Plant>& loop, const StateOf<Plant>& state) {
  return loop.plant.state_matrix().rows() == state.size();
}
/// Whether a modal state may begin a motion: always; missing modes start at rest.
inline bool may_begin_with(const ModalLoop&, const ModalMotion::Full&) { return true; }

/// Reports the state of both sides of the gap once every forcing period after the transient.
/// @return false where the motion exceeds divergence_bound()
/// @param state  the initial state, replaced by the last one
/// @throws InvalidParameter where the force has no harmonic component
template <class Plant, class Observer>
bool show_strobes(const ImplementedLoopOf<Plant>& loop, const DiagramOptions& options,
                  StateOf<Plant>& state, Observer&& observer) {
  const std::vector<Harmonic>& harmonics = loop.digital.force.harmonics;
  if (harmonics.empty())
    throw InvalidParameter("number of harmonics", 0.0, "",
                           ">= 1: the diagram has one point per period of the first harmonic");
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

/// The modal amplitudes ξ of a motion at a time after its present sample, taken by `sense()`.
/// @param after  time after the sample (s), < τ
/// @param force  the force decided at that sample (N)
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

/// Reports the stroboscopic states of a conductor given by its modes.
/// @throws InvalidParameter where some of its natural motions were not found
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
    throw InvalidParameter("distance between the plant's poles", 0.0, "",
                           "> 0: change a mode or the absorber");
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

/// Computes an orbit diagram (bifurcation diagram): one state per forcing period, plotted against a
/// parameter that runs through its values and back. Each motion begins where the previous one
/// ended. Where the two directions differ, attractors may coexist, provided that the transient is
/// over and the plotted states cover the period.
///
/// The stroboscopic instants are whole periods of the force's first harmonic, counted from t = 0.
/// Every motion begins at t = 0 of its force. From one motion to the next, further harmonics and a
/// recorded force therefore jump in phase unless the whole force repeats after a motion's duration.
///
/// At each value the drive begins outside its backlash; with a dead zone the state determines
/// the contact. No force from an earlier sample acts. A diverging motion is plotted up to its
/// divergence. The initial state starts the first motion, each motion after a diverged one, and
/// each motion in a loop whose order differs from the previous one (more delayed commands).
/// @param family         function from the parameter to an ImplementedLoopOf<Plant> or ModalLoop
/// @param values         values of the parameter, in their order
/// @param initial_state  a state, or a function from the parameter to a state
/// @param options        transient and number of plotted states at each value
/// @param observer       called with each `StrobePoint`
/// @return number of diverged motions; there are two motions for each value
/// @throws InvalidParameter where an option or a loop is not admissible, or a force has no harmonic
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
