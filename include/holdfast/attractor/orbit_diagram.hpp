#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/between_samples.hpp"
#include "holdfast/motion/forced_loop.hpp"

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
inline double divergence_bound(const ForcedLoop<double>& loop, const Vector<double, 4>& state) {
  const double deflection = loop.excitation.amplitude / loop.plant.conductor_stiffness;
  const double scale = deflection * (1.0 + loop.excitation.angular_frequency()) +
                       loop.backlash_width + state.cwiseAbs().maxCoeff();
  return 1e12 * std::max(scale, 1e-100);
}

/// Shows the states of a motion once every forcing period after the transient; leaves the last of
/// them, at the excitation's peak, in `state`. @return false where it leaves the range of numbers
template <class Observer>
bool show_strobes(const ForcedLoop<double>& loop, const DiagramQuestion& question,
                  Vector<double, 4>& state, Observer&& observer) {
  constexpr std::int64_t samples_between_looks = 1 << 14;
  const double bound = divergence_bound(loop, state);
  const BetweenSamples between(loop);
  const double tau = loop.sampling.period, forcing_period = 1.0 / loop.excitation.frequency;
  auto motion = harmonically_forced_motion(loop, state);
  auto strobe = std::ceil(question.transient / forcing_period);
  for (int shown = 0; shown < question.strobes;) {
    const double previous_force = motion.memory().previous_force;
    const MotionSample<double> sample = motion.sense();
    if (!(sample.state.cwiseAbs().maxCoeff() < bound)) return false;
    if (question.watch && sample.index % samples_between_looks == 0) question.watch();
    // A strobe that falls on a sample but for rounding is that sample.
    double after = strobe * forcing_period - sample.time;
    for (; shown < question.strobes && after < tau * (1.0 - 1e-9); after += forcing_period) {
      const bool at_sample = after < 1e-9 * tau;
      state = at_sample ? sample.state : between.state(sample, previous_force, after);
      observer(state);
      ++shown;
      strobe += 1.0;
    }
    motion.advance();
  }
  return true;
}

}  // namespace detail

/// An orbit diagram (bifurcation diagram): stroboscopic states against a parameter, the parameter
/// going up through its values and back, each motion beginning where the last one ended, at the
/// excitation's peak. Where the two ways differ, attractors may coexist, if the transient is over
/// and the strobes cover the period.
///
/// The drive begins outside its backlash at each value. A motion
/// that diverges shows nothing, and the next one begins at the initial state.
/// @param path           parameter ↦ ForcedLoop<double>
/// @param values         of the parameter, in their order
/// @param initial_state  of the first motion
/// @param observer       called with each `StrobePoint`
/// @return how many of the motions, two for each value, diverged
/// @throws InvalidParameter where the question or a loop is not admissible
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
      const ForcedLoop<double> loop = path(values[index]);
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
