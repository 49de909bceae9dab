#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/harmonic.hpp"
#include "holdfast/excitation/multi_harmonic_force.hpp"
#include "holdfast/motion/forced_loop.hpp"
#include "holdfast/motion/real_loop.hpp"
#include "holdfast/motion/sampled_motion.hpp"
#include "holdfast/phase_space/motion_dense_output.hpp"

namespace holdfast {

/// What an orbit diagram shows at each value of its parameter.
struct DiagramQuestion {
  double transient = 30.0;           ///< s, ≥ 0: left out at each value
  int strobes = 50;                  ///< 1 … 10⁶: forcing periods that are shown
  std::function<void()> watch = {};  ///< called now and then; may throw to end the diagram
};

/// @throws InvalidParameter where it is not admissible
inline void validate(const DiagramQuestion& question) {
  require_non_negative("transient", question.transient, "s");
  require_within("number of strobes", question.strobes, "", 1.0, 1e6);
}

/// One point of an orbit diagram.
struct StrobePoint {
  std::size_t index;        ///< of the parameter's value
  bool upward;              ///< on the way up, the values in their order; else on the way back
  Vector<double, 4> state;  ///< [z₁, ż₁, z₂, ż₂] at a whole number of forcing periods
};

namespace detail {

/// A size that no bounded motion reaches: 10¹² times all that sets its scale.
/// @tparam Loop  RealLoop
template <class Loop>
double divergence_bound(const Loop& loop, const Vector<double, 4>& state) {
  const ComposedForce& force = loop.digital.force;
  double largest = 0.0;
  if (force.record)
    for (const double row : force.record->forces()) largest = std::max(largest, std::abs(row));
  for (const Harmonic& harmonic : force.harmonics) largest += harmonic.amplitude;
  const double deflection = largest / loop.plant.conductor_stiffness;
  const double scale = deflection * (1.0 + force.highest_angular_frequency()) +
                       loop.backlash.width + state.cwiseAbs().maxCoeff();
  return 1e12 * std::max(scale, 1e-100);
}

/// Shows the states of a motion once every forcing period after the transient; leaves the last of
/// them in `state`. @return false where it leaves the range of numbers
/// @param forcing_period  s
/// @param bound           of the state's entries
template <class Way, class Observer>
bool show_strobes(Way& way, const DiagramQuestion& question, double forcing_period, double bound,
                  Vector<double, 4>& state, Observer&& observer) {
  constexpr std::int64_t samples_between_looks = 1 << 14;
  auto strobe = std::ceil(question.transient / forcing_period);
  for (int shown = 0; shown < question.strobes;) {
    const MotionSample<double> sample = way.sense();
    if (!(sample.state.cwiseAbs().maxCoeff() < bound)) return false;
    if (question.watch && sample.index % samples_between_looks == 0) question.watch();
    // A strobe that falls on a sample but for rounding is that sample.
    const double period = way.period(), end = period * (1.0 - 1e-9);
    double after = strobe * forcing_period - sample.time;
    way.advance(after < end);
    for (; shown < question.strobes && after < end; after += forcing_period) {
      const bool at_sample = after < 1e-9 * period;
      state = at_sample ? sample.state : way.state(after);
      observer(state);
      ++shown;
      strobe += 1.0;
    }
  }
  return true;
}

template <class Scalar, class Observer>
bool show_strobes(const ForcedLoop<Scalar>& loop, const DiagramQuestion& question,
                  Vector<double, 4>& state, Observer&& observer) {
  SampledWay<ForcedLoop<Scalar>> way(loop, state);
  return show_strobes(way, question, 1.0 / loop.excitation.frequency,
                      divergence_bound(real_loop(loop), state), state, observer);
}

/// @throws InvalidParameter where the force has no harmonic
template <class Observer>
bool show_strobes(const RealLoop& loop, const DiagramQuestion& question, Vector<double, 4>& state,
                  Observer&& observer) {
  const std::vector<Harmonic>& harmonics = loop.digital.force.harmonics;
  if (harmonics.empty())
    throw InvalidParameter("number of harmonics", 0.0, "",
                           ">= 1: the strobes are at whole periods of the first one");
  return with_motion(loop, state, [&](auto motion) {
    HybridWay way(motion);
    return show_strobes(way, question, 1.0 / harmonics.front().frequency,
                        divergence_bound(loop, state), state, observer);
  });
}

}  // namespace detail

/// An orbit diagram (bifurcation diagram): stroboscopic states against a parameter, the parameter
/// going up through its values and back, each motion beginning where the last one ended, at the
/// excitation's peak. Where the two ways differ, attractors may coexist, if the transient is over
/// and the strobes cover the period.
///
/// The strobes of a RealLoop are at whole periods of the first harmonic of its force, from t = 0
/// on; where there are more harmonics or a record, a motion begins with them at t = 0 again, and
/// only a common period keeps their phases from one motion to the next.
///
/// The drive begins outside its backlash at each value (a dead zone where the state is), the
/// computer without a memory of the past. A motion that diverges shows no more of itself, and
/// the next one begins at the initial state.
/// @param path           parameter ↦ ForcedLoop<double> or RealLoop
/// @param values         of the parameter, in their order
/// @param initial_state  of the first motion
/// @param question       how much is left out and shown at each value
/// @param observer       called with each `StrobePoint`
/// @return how many of the motions, two for each value, diverged
/// @throws InvalidParameter where the question or a loop is not admissible, or the force of a
/// RealLoop has no harmonic
template <class Path, class Observer>
std::size_t run_orbit_diagram(const Path& path, const std::vector<double>& values,
                              const Vector<double, 4>& initial_state,
                              const DiagramQuestion& question, Observer&& observer) {
  validate(question);
  Vector<double, 4> state = initial_state;
  std::size_t diverged = 0;
  for (const bool upward : {true, false}) {
    for (std::size_t k = 0; k < values.size(); ++k) {
      const std::size_t index = upward ? k : values.size() - 1 - k;
      const auto loop = path(values[index]);
      validate(loop);
      const bool bounded =
          detail::show_strobes(loop, question, state, [&](const Vector<double, 4>& strobe) {
            observer(StrobePoint{index, upward, strobe});
          });
      if (bounded) continue;
      state = initial_state;
      ++diverged;
    }
  }
  return diverged;
}

}  // namespace holdfast
