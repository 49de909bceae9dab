#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/rational.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/orbit/loop_orbit.hpp"
#include "holdfast/orbit/state_scale.hpp"

namespace holdfast {

/// The limits of a search for a periodic orbit: longest period and number of samples simulated.
struct OrbitLimits {
  std::int64_t largest_period = 1'000'000;  ///< longest period sought (samples), 1 … 10⁸
  /// Largest number of samples simulated, 0 … 10⁹; 0 means eight times the largest period.
  std::int64_t most_samples = 0;
  /// Function called every q samples (f τ = p/q) of the search, if set; it may throw to end it.
  std::function<void()> watch = {};
};

/// Validates the limits of a search. @throws InvalidParameter where a limit is out of its range
inline void validate(const OrbitLimits& limits) {
  require_within("largest period", static_cast<double>(limits.largest_period), "samples", 1.0, 1e8);
  require_within("number of samples", static_cast<double>(limits.most_samples), "", 0.0, 1e9);
}

namespace detail {

/// The record of the samples that a search has simulated: itinerary and extent of the states.
template <class Symbol, class Plant>
struct SeenMotion {
  std::vector<Symbol> itinerary;
  StateScaleOf<Plant> extent;
  std::int64_t reference = 0;  ///< sample whose state later states are compared with

  std::int64_t taken() const { return static_cast<std::int64_t>(itinerary.size()); }

  /// Whether a motion starts within 10⁻⁶ of a state and, up to rounding, ends no farther from it.
  /// @param before,after  distance from the state at start and end, as a share of the extent
  bool came_nearer(const StateOf<Plant>& state, double before, double after) const {
    return before <= 1e-6 && after <= std::max(before, 1e-12 * extent.share_of(state));
  }
};

/// The search for the periodic orbit on which one motion settles.
///
/// At every stroboscopic instant (sampling and forcing in phase) the state is compared with a
/// reference state, which is replaced whenever the number of samples has doubled (R. P. Brent, An
/// improved Monte Carlo factorization algorithm, BIT 20, 1980). If the state is near the reference,
/// the number of samples since the reference is a candidate period. The search then solves for the
/// orbit with this period, and ends when the motion settles on it. All solutions after the first
/// one together cost at most about as much as simulating the motion.
/// @tparam Model  a motion with Plant, readings(), state(), memory(), is_followed(),
///                has_contact_of(), take_sample() and these members, which depend on its kind:
///
///     Result, samples_per_solved()      an OrbitResultOf; cost of solving, in samples of motion
///     may_repeat(seen, period)          whether to solve for an orbit of this period
///     solve(seen, period, reference)    the orbit of this period near the state; appends the
///                                       samples that it simulates to `seen`
///     is_same(known, other, seen)       whether two orbits are the same
///     approach(found, seen)             called when an orbit is proposed
///     has_come(found, seen)             whether the motion has settled on the proposed orbit
template <class Model>
class ReturnSearch {
 public:
  using Result = typename Model::Result;

  /// @param model  model with its motion at a stroboscopic instant
  /// @param ratio  forcing frequency × sampling period, f τ = p/q
  ReturnSearch(const Model& model, const Rational& ratio, const OrbitLimits& limits)
      : model_(model),
        ratio_(ratio),
        limits_(limits),
        seen_{{}, StateScaleOf<typename Model::Plant>(model_.readings()), 0},
        reference_(model_.memory()),
        largest_ever_(State::Zero(model_.state().size())) {
    if (limits_.most_samples == 0) limits_.most_samples = 8 * limits_.largest_period;
    seen_.extent.include(model_.state());
    set_reference();
  }

  Result run() {
    while (seen_.taken() + ratio_.denominator <= limits_.most_samples) {
      take_stroboscopic_instant();
      if (limits_.watch) limits_.watch();
      if (!(model_.state().cwiseAbs().maxCoeff() < 1e100))
        return finish(OrbitOutcome::diverges, {});
      if (!model_.is_followed()) return finish(OrbitOutcome::none_found, {});
      if (has_come() || look_for_return()) return finish(proposed_.outcome, proposed_);
      if (seen_.taken() >= 2 * std::max(seen_.reference, ratio_.denominator)) set_reference();
    }
    if (proposed_.orbit) return finish(OrbitOutcome::approaching, proposed_);
    return finish(failed_.outcome, failed_);
  }

 private:
  using State = typename Model::State;

  void take_stroboscopic_instant() {
    for (std::int64_t j = 0; j < ratio_.denominator; ++j)
      seen_.itinerary.push_back(model_.take_sample());
    largest_ = largest_.cwiseMax(model_.state().cwiseAbs());
    largest_ever_ = largest_ever_.cwiseMax(largest_);
    seen_.extent.include(model_.state());
  }

  void set_reference() {
    reference_ = model_.memory();
    seen_.reference = seen_.taken();
    largest_ = model_.state().cwiseAbs();
  }

  bool near_reference() const {
    const State near = 1e-3 * largest_ + 1e-9 * largest_ever_;
    return model_.has_contact_of(reference_) &&
           ((model_.state() - reference_.state).cwiseAbs().array() <= near.array()).all();
  }

  bool has_come() { return proposed_.orbit && model_.has_come(proposed_, seen_); }

  /// Solves for the orbit after a near return. @return whether the motion has settled on that orbit
  bool look_for_return() {
    const std::int64_t period = seen_.taken() - seen_.reference;
    if (period > limits_.largest_period || !near_reference() || !model_.may_repeat(seen_, period))
      return false;
    if (candidates_ > 0 && model_.samples_per_solved() * (solved_samples_ + period) > seen_.taken())
      return false;
    solved_samples_ += period;
    ++candidates_;
    const std::int64_t taken = seen_.taken();
    const Result found = model_.solve(seen_, period, reference_);
    const bool is_closed = seen_.extent.share_of(model_.state() - reference_.state) <= 1e-9;
    if (seen_.taken() > taken) set_reference();
    if (!found.orbit) return false;
    if (found.outcome == OrbitOutcome::neutral) {
      (is_closed ? proposed_ : failed_) = found;
      return is_closed;
    }
    if (found.outcome == OrbitOutcome::not_reproduced) {
      failed_ = found;
      return false;
    }
    if (found.outcome == OrbitOutcome::certified && !found.orbit->is_attracting()) return false;
    if (proposed_.orbit && model_.is_same(proposed_, found, seen_)) return false;
    proposed_ = found;
    model_.approach(proposed_, seen_);
    return has_come();
  }

  Result finish(OrbitOutcome outcome, Result found) const {
    found.outcome = outcome;
    found.samples = seen_.taken();
    found.candidates = candidates_;
    return found;
  }

  Model model_;
  Rational ratio_;
  OrbitLimits limits_;
  SeenMotion<typename Model::Symbol, typename Model::Plant> seen_;
  typename Model::Memory reference_;
  State largest_, largest_ever_;  // largest |x_i| since the reference, and ever
  std::int64_t solved_samples_ = 0;
  int candidates_ = 0;
  Result proposed_;  // an orbit on which the motion has not settled yet
  Result failed_;    // the last solution that was not reproduced or is neutral
};

}  // namespace detail
}  // namespace holdfast
